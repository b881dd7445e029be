# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and volumes."""

import os

from . import _report
from ._samples import Samples


def read(path, xyz=("", "", "")):
    """Read samples from a file, as the tools do.

    Parameters
    ----------
    path : str or os.PathLike
        pcd, ply, csv, txt, xyz, dat, tsv, vtk, vtp, vtu or vts, by the ending.
    xyz : sequence of three str, optional
        Columns of a text file that hold the coordinates, by names or numbers from 0; by
        default they are found by usual names.

    Returns
    -------
    Samples

    Raises
    ------
    OSError
        With the file and, for text, the line.
    """
    from . import _io
    columns = [str(column) for column in xyz]
    if len(columns) != 3:
        raise ValueError(f"xyz names {len(columns)} columns: there must be three.")
    dataset = _io.read(os.fspath(path), columns)
    _report.tell(dataset.notes)
    return Samples._of(dataset)


def write(path, points, fields=None, ascii=False):
    """Write samples, a surface or a mesh to a file: their `save`.

    Parameters
    ----------
    path : str or os.PathLike
    points, fields
        As those of `Samples`, or something that has `save`.
    ascii : bool
        PCD and PLY as text.
    """
    if not hasattr(points, "save"):
        points = Samples(points, fields)
    points.save(path, ascii=ascii)


def read_volume(path):
    """Read a scalar volume: nrrd, nhdr, mha, mhd, vti, or structured points in vtk.

    Returns
    -------
    values : numpy.ndarray of float32, shape (nz, ny, nx)
    origin, spacing : tuple of float
    name : str
    """
    from . import _io
    values, origin, spacing, name = _io.read_volume(os.fspath(path))
    return values, tuple(origin), tuple(spacing), name
