# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and volumes."""

import functools
import os

from . import _arrays, _core, _map, _parameters, _report
from ._progress import listening
from ._samples import Samples, as_samples


@_parameters.with_proposals
def read(path, xyz=("", "", ""), particles="", cells=False, progress=None, map=None):
    """Read samples from a file, as the tools do.

    Parameters
    ----------
    path : str or os.PathLike
        By the ending: pcd, ply; csv, txt, xyz, dat, tsv; npy, npz; las; of VTK vtk, vtp, vtu,
        vts, vtkhdf, its lists pvd, vtm, pvtu, pvtp, pvts, its trees vthb and htg; of NetCDF
        nc, nc4, cdf; of HDF5 h5, hdf5, hdf, he5, h5part (`file.h5:/group` names a part of it);
        of Exodus ex2, exo, exii, e; case of EnSight, foam of OpenFOAM, p3d of PLOT3D, bgeo and
        bhclassic of Houdini. .gz, .bz2 or .zst may follow. Snapshots of Gadget may have any
        name. "-" is standard input. Files of VTK report no progress.
    xyz : sequence of three str, optional
        Columns of a text file that hold the coordinates, by names or zero-based numbers; by
        default they are found by usual names.
    particles : str
        Of a snapshot: gas, dm, disk, bulge, stars, bh, or a number; by default gas, else
        the first kind there is.
    cells : bool
        Of files of VTK, Exodus, EnSight and OpenFOAM: take the centres of cells with
        their data instead of points.
    {progress}
    map : "auto", tuple or Map, optional
        Origin (longitude, latitude) of the map that longitude and latitude are put on, with
        "m" or "km" behind them; "auto": their median. By default files of NetCDF choose it,
        and tables keep degrees. `map=samples.map` puts several files on one map.

    Returns
    -------
    Samples

    Raises
    ------
    OSError
        With the file and, for text, the line.

    Examples
    --------
    >>> import tempfile
    >>> path = tempfile.mkdtemp() + "/points.csv"
    >>> with open(path, "w") as file:
    ...     _ = file.write("lon,lat,depth,T\\n1,2,-3,15.5\\n4,5,-6,12.5\\n")
    >>> samples = uvol.read(path, xyz=("lon", "lat", "depth"))
    >>> samples.points.tolist(), samples["T"].tolist()
    ([[1.0, 2.0, -3.0], [4.0, 5.0, -6.0]], [15.5, 12.5])
    """
    from . import _io
    if isinstance(xyz, str) or not hasattr(xyz, "__iter__"):
        raise TypeError(f"xyz is {_parameters.shown(xyz)}: it must be a sequence of three columns.")
    columns = [_parameters.text(str(column), "A column") for column in xyz]
    if len(columns) != 3:
        raise ValueError(f"xyz names {len(columns)} columns: there must be three.")
    with listening(progress) as listener:
        dataset = _io.read(os.fsencode(path), columns, _parameters.text(str(particles), "particles"), _parameters.flag(cells, "cells"),
                           _map.wanted(map), listener)
    _report.warn(dataset.notes)
    samples = Samples._of(dataset)
    if str(path) != "-":
        place = os.path.abspath(os.fsencode(path))
        samples._read_cells = functools.partial(_read_cells, place, _state_of(place), columns, str(particles), cells, _map.wanted(map))
    return samples


def _state_of(path):
    """Size and time of a file, which differ once it is written again; None if the path is not that of a file, such as
    "file.h5:/group"."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


def _read_cells(path, state, *arguments):
    """The cells of a file that samples were read from, and what was wrong with them."""
    from . import _io
    if state != _state_of(path):
        return None, [_core.make_message("cells_not_used", {"reason": "The file is another one than when its points were read."})]
    return _io.read_cells(path, *arguments)


@_parameters.with_proposals
def write(path, points, fields=None, triangles=None, ascii=False, progress=None):
    """Write samples, a surface or a mesh to a file: their `save`.

    Parameters
    ----------
    path : str or os.PathLike
        Of points pcd, ply, vtp, vtkhdf, csv or npz, by the ending.
    points : array_like, shape (n, 3), Samples, Surface or Mesh
        Coordinates, float32 or float64; or an object that has `save`.
    {fields}
    triangles : array_like of int, shape (m, 3)
        Triangles of the points. The file is a mesh: ply, vtp, vtkhdf, obj, off or stl.
    {ascii of Points.save}
    {progress}

    Examples
    --------
    >>> import tempfile
    >>> path = tempfile.mkdtemp() + "/points.ply"
    >>> uvol.write(path, np.eye(3), {"rho": np.array([1, 2, 3], np.int16)})
    >>> uvol.read(path)
    Samples of 3 points: rho (int16)
    """
    if triangles is not None:
        vertices = as_samples(points, fields)
        vertices._save(path, _arrays.as_triangles(triangles, len(vertices)), ascii, progress)
        return
    if fields is not None or not hasattr(points, "save"):
        points = Samples(points, fields)
    points.save(path, ascii=ascii, progress=progress)


@_parameters.with_proposals
def read_mesh(path, map=None):
    """Read a mesh with all fields of its vertices, as `save` writes it.

    Parameters
    ----------
    path : str or os.PathLike
        ply, vtp, vtkhdf, obj, off or stl, by the ending.
    map : "auto", tuple or Map, optional
        Origin of a map for vertices with fields of longitude and latitude: (longitude, latitude),
        with "m" or "km" behind them. "auto": their median. `map=samples.map` uses one map for both.

    Returns
    -------
    vertices : Samples
    triangles : numpy.ndarray of uint32, shape (m, 3)
        Empty for a file of points.

    Examples
    --------
    >>> import tempfile
    >>> path = tempfile.mkdtemp() + "/a.obj"
    >>> uvol.write(path, np.eye(3), triangles=[[0, 1, 2]])
    >>> vertices, triangles = uvol.read_mesh(path)
    >>> triangles
    array([[0, 1, 2]], dtype=uint32)
    """
    from . import _io
    dataset, triangles = _io.read_mesh(os.fsencode(path), _map.wanted(map))
    _report.warn(dataset.notes)
    return Samples._of(dataset), triangles


@_parameters.with_proposals
def read_volume(path):
    """Read a scalar volume: nrrd, nhdr, mha, mhd, vti, or structured points in vtk.

    Parameters
    ----------
    path : str or os.PathLike

    Returns
    -------
    values : numpy.ndarray of float32, shape (nz, ny, nx)
    origin, spacing : tuple of float
        Of x, y and z: the place of the first value, and the distances of values.
    name : str
        Of the values; "" where the file has none.

    Examples
    --------
    >>> import tempfile
    >>> path = tempfile.mkdtemp() + "/grid.nrrd"
    >>> points = np.random.default_rng(1).random((2000, 3))
    >>> model = uvol.Interpolator(points, {"rho": points[:, 0]}, gradients=False, errors=False)
    >>> model.grid((3, 4, 5), box=([0.2] * 3, [0.8] * 3)).save(path)
    >>> values, origin, spacing, name = uvol.read_volume(path)
    >>> values.shape, [round(step, 3) for step in spacing]
    ((5, 4, 3), [0.3, 0.2, 0.15])
    """
    from . import _io
    values, origin, spacing, name = _io.read_volume(os.fsencode(path))
    return values, tuple(origin), tuple(spacing), name
