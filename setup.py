# SPDX-License-Identifier: BSD-3-Clause
"""Builds the extensions of the Python module by CMake, with the libraries that they need beside them."""

import os
import pathlib
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
OFF = ("TOOLS", "TESTS", "BENCHMARKS", "MPI")


class CMakeBuild(build_ext):
    """All extensions come from one build; CMake installs them into the package."""

    def run(self):
        build = ROOT / "build" / "python"
        package = pathlib.Path(self.build_lib).resolve() / "pcl_uvol"
        self.call("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  "-DPCL_UVOL_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}", "-DPCL_UVOL_PYTHON_DIR=.",
                  "-DCMAKE_INSTALL_LIBDIR=pcl_uvol/libraries", *(f"-DPCL_UVOL_BUILD_{part}=OFF" for part in OFF),
                  *shlex.split(os.environ.get("CMAKE_ARGS", "")))
        self.call("cmake", "--build", build)
        for component in ("python", "core", "libraries"):
            self.call("cmake", "--install", build, "--component", component, "--prefix", package.parent)
        for link in (package / "libraries").glob("*.so.*"):  # wheels have no links
            if link.is_symlink():
                link.resolve().replace(link)

    @staticmethod
    def call(*command):
        subprocess.run([str(word) for word in command], check=True)


setup(ext_modules=[Extension("pcl_uvol._core", []), Extension("pcl_uvol._io", []),
                   Extension("pcl_uvol._charts", []), Extension("pcl_uvol._vtk", [])], cmdclass={"build_ext": CMakeBuild})
