# SPDX-License-Identifier: MIT
"""Pictures of the Python package, for test_python.py. SOURCES OF TRUTH: the colour map at numbers that the test chose, cell by cell; counts
of sides of a box; what the body itself says of its cracks; a run without pictures, bit by bit."""
import contextlib
import io
import os
import shutil
import subprocess
import sys
import types

import matplotlib
import numpy as np

OUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "build", "checks")


def plate(peri, n=(6, 4)):
    body = peri.Body(space="plane_stress", horizon=3, threads=1)
    body.add_material("bond_based", young=1, density=1, critical_stretch=0.05)
    body.add_box([0, 0], n, 1)
    body.build()
    return body


def cells_have_their_colours(check, peri):
    body = plate(peri)
    numbers = np.arange(24.0)
    ax = body.plot(numbers, limits=(0, 23), colorbar=False)
    image = ax.images[0]
    lo, hi = np.array(image.get_extent())[[0, 2]], np.array(image.get_extent())[[1, 3]]
    pixels = image.get_array()
    check(np.allclose([lo, hi], [[0, 0], [6, 4]]), "the picture covers %s to %s" % (lo, hi))
    colours = matplotlib.colormaps["cividis"](numbers / 23)
    for part in (0.05, 0.5, 0.95):  # of each cell
        at = np.floor((body.position.copy() - 0.5 + part - lo) / (hi - lo) * [pixels.shape[1], pixels.shape[0]]).astype(int)
        check(np.allclose(pixels[at[:, 1], at[:, 0]], colours), "cells at %g have other colours" % part)
    body.add_displacement(body.select_box([3, 0], [6, 4]), [2, 0])
    right = body.plot(numbers, limits=(0, 23), deformed=True, colorbar=False).images[0]
    check(abs(right.get_extent()[1] - 8) < 0.6 and not right.get_array()[:, int(right.get_array().shape[1] * 0.5), 3].any(),
          "where the body is: a gap from 3 to 5")
    enlarged = body.plot(numbers, deformed=3, colorbar=False).images[0]
    check(abs(enlarged.get_extent()[1] - 12) < 0.6, "displacements three times as large")
    ten = body.plot(numbers, deformed="auto", colorbar=False).images[0]
    check(abs(ten.get_extent()[1] - 6 - 0.1 * 5) < 0.2, "displacements a tenth of the body")


def numbers_of_fields(check, raises, peri):
    body = plate(peri)
    from peri.plotting import values_of
    body.velocity = np.arange(48.0).reshape(24, 2)
    v = np.arange(48.0).reshape(24, 2)
    check(np.allclose(values_of(body, "velocity")[0], np.hypot(v[:, 0], v[:, 1])), "length of a vector")
    check(np.allclose(values_of(body, "velocity", "y")[0], v[:, 1]), "component of a vector")
    body.displacement = np.stack([1e-3 * body.position[:, 0], np.zeros(24)], axis=1)
    xx, yy, xy = body.stress.T
    mises = np.sqrt(xx ** 2 - xx * yy + yy ** 2 + 3 * xy ** 2)  # plane stress
    check(np.allclose(values_of(body, "stress")[0], mises, rtol=1e-9), "von Mises")
    check(np.allclose(values_of(body, "stress", "yy")[0], yy), "component of a stress")
    raises(ValueError, lambda: body.plot("stress", component="zz"), "xx, yy, xy")
    raises(ValueError, lambda: body.plot("colour"), "no Field is called")


def cracks_and_pieces(check, peri):
    body = plate(peri)
    body.cut_segment([3, 0], [3, 4])
    ax = body.plot(cracks=True)
    drawn, own = ax.collections[0].get_segments(), body.cracks().lines()
    check(len(drawn) == len(own) == 1 and np.allclose(drawn[0], own[0]) and np.allclose(own[0][:, 0], 3), "the crack")
    pieces = body.plot("fragment").images[0].get_array()
    table = matplotlib.colormaps["tab20"].colors
    check(np.allclose(pieces[0, 0, :3], table[0]) and np.allclose(pieces[0, -1, :3], table[1]), "a colour for each piece")
    block = peri.Body(space="solid", horizon=2, threads=1)
    block.add_material("bond_based", young=1, density=1)
    block.add_box([0, 0, 0], [3, 2, 2], 1)
    block.build()
    shown = block.plot(np.arange(12.0)).collections[0]
    check(len(shown._vec[0]) == 3 * 2 * 2 * (3 * 2 + 3 * 2 + 2 * 2), "two triangles on each of 32 sides")


def films(check, peri):
    from PIL import Image

    def moving():
        body = plate(peri, (8, 4))
        body.add_velocity(body.select_box([0, 0], [4, 4]), [-0.5, 0])
        return body
    os.makedirs(OUT, exist_ok=True)
    body, plain = moving(), moving()
    told = []
    path = body.animate(os.path.join(OUT, "film.gif"), steps=20, time_step=0.1, frames=5, cracks=True, dpi=30,
                        on_frame=lambda b: told.append(b.step_count))
    plain.advance(steps=20, time_step=0.1)
    check(told == [4, 8, 12, 16, 20], "frames at %s" % told)
    with Image.open(path) as film:
        check(film.n_frames == 6, "%d frames: the start and five" % film.n_frames)
    check(np.array_equal(body.displacement.copy(), plain.displacement.copy()) and body.broken_count == plain.broken_count > 0,
          "a film leaves the run as it is")
    page = moving().animate(os.path.join(OUT, "film.html"), steps=4, time_step=0.1, frames=2, dpi=30)
    with open(page) as f:
        text = f.read()
    check(text.startswith("<!DOCTYPE html>") and text.count("data:image/png;base64") == 3, "a page with three pictures")
    if not (shutil.which("ffmpeg") and shutil.which("ffprobe")):
        print("    skip: no ffmpeg here, MP4 is not tried")
        return
    film = moving().animate(os.path.join(OUT, "film.mp4"), steps=4, time_step=0.1, frames=2, dpi=30)
    told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-of", "csv=p=0", "-show_entries", "stream=nb_read_frames", film],
                          stdout=subprocess.PIPE, check=True).stdout
    check(int(told.split(b",")[0]) == 3, "a film with three pictures: %s" % told)


def handed_over(check, peri):
    """To meshio, and to a stand-in of pyvista, which Debian lacks: a vertex per point at its place, with the fields."""
    body = plate(peri)
    body.velocity = np.arange(48.0).reshape(24, 2)
    x, v = (np.pad(body.field(name), ((0, 0), (0, 1))) for name in ("position", "velocity"))

    class PolyData:
        def __init__(self, points):
            self.points, self.point_data = points, {}
    modules = {"pyvista": types.SimpleNamespace(PolyData=PolyData)}
    try:
        import meshio  # noqa: F401
    except ImportError:
        print("    skip: no meshio here")
        modules["meshio"] = None
    before = sys.modules.get("pyvista")
    sys.modules["pyvista"] = modules["pyvista"]
    meshes = [body.to_pyvista()] + ([] if "meshio" in modules else [body.to_meshio()])
    if before is None:
        del sys.modules["pyvista"]
    else:
        sys.modules["pyvista"] = before
    for mesh in meshes:
        same = np.array_equal(mesh.points, x) and np.array_equal(mesh.point_data["velocity"], v)
        check(same and np.array_equal(mesh.point_data["volume"], np.ones(24)), "places and fields of a mesh")
    if "meshio" not in modules:
        cells = meshes[1].cells[0]
        check(cells.type == "vertex" and np.array_equal(cells.data[:, 0], np.arange(24)), "a vertex per point")


def progress(check, peri):
    def said(run):
        with contextlib.redirect_stderr(io.StringIO()) as text:
            run()
        return text.getvalue()
    body = plate(peri)
    check("100" in said(lambda: body.advance(steps=50, time_step=0.01, progress=True)), "how far an advance has come")
    body.prescribe_displacement(body.select_box([0, 0], [2, 4]), "xy")
    body.apply_body_force(body.select_box([4, 0], [6, 4]), [1e-3, 0])
    check("100" in said(lambda: body.solve(steps=2, progress=True)), "how far a solve has come")
    check(said(lambda: body.advance(steps=5, time_step=0.01)) == "", "silent else")


def run(check, raises, peri):
    import matplotlib.pyplot as plt
    cells_have_their_colours(check, peri)
    numbers_of_fields(check, raises, peri)
    cracks_and_pieces(check, peri)
    films(check, peri)
    handed_over(check, peri)
    progress(check, peri)
    plt.close("all")
