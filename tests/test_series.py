# SPDX-License-Identifier: MIT
"""The series that tests/test_series.c leaves, read by parsers that are not ours: Python's XML and NumPy, and VTK or meshio where they are.

    python3 tests/test_series.py build/tests/test_series

SOURCE OF TRUTH: what the C program has printed of the same fields, with all digits.
"""
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np

PREFIX = "build/tests/series"


def read_vtu(path):
    """Points and point data of a VTU with raw appended data."""
    raw = open(path, "rb").read()
    begin = raw.index(b"_", raw.index(b"<AppendedData")) + 1
    tree = ElementTree.fromstring(raw[:begin] + b"\n</AppendedData></VTKFile>")
    kinds = {"Float64": "f8", "Int32": "i4", "UInt8": "u1"}
    order = "<" if tree.get("byte_order") == "LittleEndian" else ">"
    arrays = {}
    for node in tree.iter("DataArray"):
        at = begin + int(node.get("offset"))
        size = int(np.frombuffer(raw, order + "u8", 1, at)[0])
        kind = np.dtype(order + kinds[node.get("type")])
        values = np.frombuffer(raw, kind, size // kind.itemsize, at + 8)
        arrays[node.get("Name")] = values.reshape(-1, int(node.get("NumberOfComponents")))
    return arrays


def main():
    subprocess.run([sys.argv[1]], check=True, stdout=subprocess.DEVNULL)
    lines = [np.array(line.split(), float) for line in open(PREFIX + ".txt")]
    entries = ElementTree.parse(PREFIX + ".pvd").getroot().find("Collection").findall("DataSet")
    assert len(entries) == len(lines) == 12
    for entry, line in zip(entries, lines):
        assert float(entry.get("timestep")) == line[0] or abs(float(entry.get("timestep")) / line[0] - 1) < 1e-15
        got = read_vtu(os.path.join(os.path.dirname(PREFIX), entry.get("file")))
        want = line[1:].reshape(-1, 6)
        assert list(got) == ["position", "current_position", "deformation_gradient", "connectivity", "offsets", "types"]
        assert np.array_equal(got["current_position"][:, :2], want[:, :2]) and not got["current_position"][:, 2].any()
        f = got["deformation_gradient"].reshape(-1, 3, 3)
        assert np.array_equal(f[:, :2, :2].reshape(-1, 4), want[:, 2:]) and (f[:, 2, 2] == 1).all()
        assert len(got["types"]) == len(want) and (got["types"] == 1).all()
    checked = "NumPy"
    first = os.path.join(os.path.dirname(PREFIX), entries[-1].get("file"))
    try:
        import vtk
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(first)
        reader.Update()
        assert reader.GetOutput().GetNumberOfCells() == len(lines[-1]) // 6
        checked += ", VTK"
    except ImportError:
        pass
    try:
        import meshio
        mesh = meshio.read(first)
        assert np.array_equal(mesh.point_data["current_position"][:, :2], lines[-1][1:].reshape(-1, 6)[:, :2])
        checked += ", meshio"
    except ImportError:
        pass
    print("    12 frames read by " + checked)
    print("test_series_py: 1 passed, 0 failed")


main()
