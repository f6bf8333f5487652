# SPDX-License-Identifier: MIT
"""Compiles the library of the repository, or of the source archive, beside the package, and writes peri/_generated.py of its header.

The compiler is that of CC, or of the system; CFLAGS are added. An archive (sdist) holds the sources in csrc/.
"""
import os
import re
import shutil
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "csrc")
if not os.path.isfile(os.path.join(ROOT, "peri.h")):
    ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, HERE)
import generate  # noqa: E402

SOURCES = ["peri.h", "peri_impl.c", "src", "LICENSE", os.path.join("tools", "api.py")]


def version():
    with open(os.path.join(ROOT, "peri.h")) as f:
        return re.search(r'#define PERI_VERSION +"([^"]+)"', f.read()).group(1)


def compiler():
    from setuptools._distutils.ccompiler import new_compiler
    from setuptools._distutils.sysconfig import customize_compiler
    one = new_compiler()
    customize_compiler(one)
    return one


def takes(one, flag, folder):
    """Does the compiler take this flag?"""
    source = os.path.join(folder, "probe.c")
    with open(source, "w") as f:
        f.write("int main(void) { return 0; }\n")
    try:
        objects = one.compile([source], output_dir=folder, extra_preargs=[flag])
        one.link_executable(objects, os.path.join(folder, "probe"), extra_preargs=[flag])
    except Exception:
        return False
    return True


def build_library(folder):
    """libperi of this system into the folder: kernels of each precision and dimension, and the core, side by side."""
    one = compiler()
    msvc = one.compiler_type == "msvc"
    work = tempfile.mkdtemp()
    try:
        openmp = [] if msvc or not takes(one, "-fopenmp", work) else ["-fopenmp"]
        flags = (["/O2"] if msvc else ["-std=c99", "-O2", "-fPIC"]) + openmp + os.environ.get("CFLAGS", "").split()
        kernels = {"d": (64, 64), "m": (64, 32), "f": (32, 32)}
        units = [(os.path.join("src", "kernels", "unit.c"), [("PERI_SPLIT", None), ("PERI_T_REAL", str(r)), ("PERI_T_BOND", str(b)),
                                                             ("PERI_T_DIM", dim)], k + dim)
                 for k, (r, b) in kernels.items() for dim in "23"]
        units.append(("peri_impl.c", [("PERI_SPLIT", None)], "core"))

        def compile_one(unit):
            source, macros, name = unit
            macros = [(k, v) for k, v in macros]
            # the compiler objects of distutils are not made for threads: one each
            mine = compiler()
            return mine.compile([os.path.join(ROOT, source)], output_dir=os.path.join(work, name), macros=macros, include_dirs=[ROOT],
                                extra_preargs=flags)[0]

        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            objects = list(pool.map(compile_one, units))
        suffix = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
        os.makedirs(folder, exist_ok=True)
        names = [f["name"] for f in generate.load_api(ROOT)["functions"]] if msvc else None
        one.link_shared_object(objects, os.path.join(folder, "libperi" + suffix), libraries=[] if msvc else ["m"], extra_postargs=openmp,
                               export_symbols=names)
    except Exception as e:
        raise SystemExit("peri: the library was not compiled: %s\nA C99 compiler is needed: cc, gcc or clang (Debian: apt install gcc); "
                         "CC=... names another." % e)
    finally:
        shutil.rmtree(work, ignore_errors=True)


class Build(build_py):
    def run(self):
        super().run()
        folder = os.path.join(self.build_lib, "peri")
        generate.main([ROOT, os.path.join(folder, "_generated.py")])
        build_library(folder)


class Archive(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for name in SOURCES:
            source, target = os.path.join(ROOT, name), os.path.join(base_dir, "csrc", name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            if os.path.isdir(source):
                shutil.copytree(source, target)
            else:
                shutil.copy(source, target)
        shutil.copy(os.path.join(HERE, "generate.py"), base_dir)


class Wheel(bdist_wheel):
    def get_tag(self):  # any Python, of this system
        return ("py3", "none") + super().get_tag()[2:]


class Compiled(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), cmdclass={"build_py": Build, "sdist": Archive, "bdist_wheel": Wheel}, distclass=Compiled)
