# SPDX-License-Identifier: BSD-3-Clause
"""The module installed by pip and by CMake, without a network."""

import os
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
USE = ("import numpy, pcl_uvol; points = numpy.random.default_rng(1).random((2000, 3)); "
       "surface = pcl_uvol.isosurface(points, {'a': points[:, 0]}, iso=0.5); "
       "surface.save('surface.ply'); print(pcl_uvol.__file__, len(pcl_uvol.read('surface.ply')) == len(surface) > 0)")


def use(python, folder, **environment):
    """Where an interpreter finds the module, which must work."""
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    found = subprocess.run([python, "-c", USE], cwd=folder, env={**variables, **environment}, check=True,
                           capture_output=True, text=True).stdout.split()
    assert found[1] == "True"
    return pathlib.Path(found[0])


@pytest.mark.long
def test_pip_installs_into_a_virtual_environment(tmp_path):
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "env"], check=True)
    python = tmp_path / "env" / "bin" / "python3"
    environment = {**os.environ, "CMAKE_ARGS": "-DPCL_UVOL_WARNINGS_AS_ERRORS=ON"}  # as compiled before: ccache
    subprocess.run([python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", ROOT],
                   check=True, env=environment)
    assert tmp_path in use(python, tmp_path).parents


@pytest.mark.long
def test_a_wheel_can_be_built(tmp_path):
    environment = {**os.environ, "CMAKE_ARGS": "-DPCL_UVOL_WARNINGS_AS_ERRORS=ON"}
    subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-index", "--no-deps",
                    "--wheel-dir", tmp_path, ROOT], check=True, env=environment)
    assert len(list(tmp_path.glob("pcl_uvol-*.whl"))) == 1


@pytest.mark.long
def test_cmake_installs_beside_the_libraries(tmp_path):
    build = os.environ.get("PCL_UVOL_BINARY_DIR")
    if not build:
        pytest.skip("PCL_UVOL_BINARY_DIR does not say where the build is")
    for component in ("python", "core", "libraries"):
        subprocess.run(["cmake", "--install", build, "--component", component, "--prefix", tmp_path / "prefix"],
                       check=True, capture_output=True)
    folder = next((tmp_path / "prefix").rglob("pcl_uvol/__init__.py")).parents[1]
    assert folder in use(sys.executable, tmp_path, PYTHONPATH=str(folder)).parents
