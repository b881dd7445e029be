# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the Python module share. PCL_UVOL_TOOL_DIR names the folder of the tools, whose results
are those of the module."""

import contextlib
import os
import pathlib
import struct
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import pcl_uvol as uvol


def pytest_configure(config):
    config.addinivalue_line("markers", "long: takes more than some seconds")


def pixels_of(path):
    """Size and packed pixels of a PNG file, without what else it tells."""
    data, place, kept = path.read_bytes(), 8, []
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        if kind in (b"IHDR", b"IDAT"):
            kept.append(data[place + 8:place + 8 + length])
        place += length + 12
    return kept


@contextlib.contextmanager
def raises(error, code=None, values=None, match=None):
    """pytest.raises for an error with this code and at least these values. Texts of the library may change, so only
    errors without a code, those of Python and of pcl_uvol/*.py, are recognized by a match."""
    with pytest.raises(error, match=match) as raised:
        yield raised
    assert getattr(raised.value, "code", None) == code
    if values:
        found = raised.value.values
        assert {name: found.get(name) for name in values} == values


@contextlib.contextmanager
def warns(code):
    """pytest.warns for a warning of the library with this code, which may be one of several."""
    with pytest.warns(uvol.ResultWarning) as warned:
        yield warned
    assert code in [getattr(warning.message, "code", None) for warning in warned]


@pytest.fixture
def ball():
    """Samples of the distance to the centre of a cube, with other fields of several types."""
    random = np.random.default_rng(7)
    points = random.random((4000, 3))
    fields = {
        "r": np.linalg.norm(points - 0.5, axis=1),
        "vel": (points - 0.5).astype(np.float32),
        "id": np.arange(4000, dtype=np.int32),
    }
    return points, fields


@pytest.fixture
def sphere(ball):
    """The isosurface of radius 0.3."""
    return uvol.isosurface(*ball, field="r", iso=0.3, outside="higher")


@pytest.fixture
def tool_folder():
    folder = os.environ.get("PCL_UVOL_TOOL_DIR")
    if not folder:
        pytest.skip("PCL_UVOL_TOOL_DIR does not say where the tools are")
    return pathlib.Path(folder)


@pytest.fixture
def run_tool(tmp_path, tool_folder):
    """Calls run_tool("uvol_isosurface", argument, ...), in a folder of the test's own: what the tool prints."""
    def run(tool, *arguments):
        command = [tool_folder / tool, *map(str, arguments)]
        return subprocess.run(command, check=True, cwd=tmp_path, capture_output=True, text=True).stdout

    return run


@pytest.fixture
def run_python():
    """Calls run_python(code): what a new interpreter prints."""
    def run(code):
        return subprocess.run([sys.executable, "-c", textwrap.dedent(code)], check=True, capture_output=True,
                              text=True).stdout

    return run
