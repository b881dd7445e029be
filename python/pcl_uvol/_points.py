# SPDX-License-Identifier: BSD-3-Clause
"""Points with fields: samples, and what surfaces are made of."""

import os

import numpy as np

from . import _arrays, _map, _parameters, _report
from ._bridges import Bridges
from ._errors import FieldError
from ._progress import listening


class Points(Bridges):
    """Points with named fields, in the memory of the library.

    Arrays that are taken out of it are views that cannot be written to; they keep the
    memory alive.
    """

    def __init__(self, dataset):
        self._dataset = dataset
        self._records = None
        self._points = None

    def __len__(self):
        return self._dataset.count

    @property
    def records(self):
        """numpy.ndarray, shape (n,): all fields as a structured array, without a copy.

        x, y, z are float32, relative to `origin`.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3), {"rho": [1.0, 2.0, 3.0]})
        >>> samples.records.dtype.names, np.shares_memory(samples.records, samples["rho"])
        (('x', 'y', 'z', 'rho'), True)
        """
        if self._records is None:
            records = _arrays.view_records(self._dataset)
            records.flags.writeable = False
            self._records = records
        return self._records

    @property
    def origin(self):
        """numpy.ndarray, shape (3,): what is added to x, y, z of the records, in units of
        the coordinates.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3) * 1e-3 + [5e6, 0, 0])
        >>> bool(abs(samples.origin[0] - 5e6) < 1e-3), bool(samples.points[0, 0] == 5000000.001)
        (True, True)
        """
        return np.array(self._dataset.origin)

    @property
    def box(self):
        """numpy.ndarray, shape (3,): sides of the box that a file names, which samples
        may repeat in (`periodic`); 0 for none.

        Examples
        --------
        >>> uvol.Samples(np.eye(3)).box.tolist()  # of arrays: there is no file
        [0.0, 0.0, 0.0]
        """
        return np.array(self._dataset.box)

    @property
    def map(self):
        """Map or None: the map that x and y are on, if they were computed of longitude and
        latitude.

        Examples
        --------
        >>> import tempfile
        >>> path = tempfile.mkdtemp() + "/points.csv"
        >>> with open(path, "w") as file:
        ...     _ = file.write("lon,lat,depth,T\\n8,-43,5,12\\n9,-42,10,11\\n8.5,-42.5,20,10\\n")
        >>> samples = uvol.read(path, map="auto")
        >>> samples.map, samples.points[2].tolist()
        (Map(longitude=8.5, latitude=-42.5, unit='km'), [0.0, 0.0, -20.0])
        """
        return _map.of(self._dataset)

    def _on_map_of(self, other):
        """These points on the map of others, if both are on one."""
        if self._dataset.map in (None, other._dataset.map) or other._dataset.map is None:
            return self
        return Points(self._dataset.on_map(other._dataset.map))

    @property
    def points(self):
        """numpy.ndarray, shape (n, 3): the coordinates.

        A view in float32 without an origin; else computed in double, once.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3, dtype=np.float32))
        >>> samples.points.dtype, np.shares_memory(samples.points, samples.records)
        (dtype('float32'), True)
        >>> uvol.Samples(np.eye(3)).points.dtype
        dtype('float64')
        """
        if self._points is None:
            points = _arrays.view_axes(self.records, "xyz")
            if self._dataset.double_coordinates or self.origin.any():
                points = points + self.origin
                points.flags.writeable = False
            self._points = points
        return self._points

    @property
    def labels(self):
        """dict of str to list of str: for each column of names, the names of the
        zero-based numbers, in alphabetical order; -1 is a missing name.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3), {"hole": ["B", "", "A"]})
        >>> samples.labels, samples.records["hole"].tolist()
        ({'hole': ['A', 'B']}, [1, -1, 0])
        """
        return {name: names for name, names in self._dataset.labels.items() if name in self.keys()}

    def keys(self):
        """Names of the fields, coordinates left out.

        Returns
        -------
        list of str

        Examples
        --------
        >>> uvol.Samples(np.eye(3), {"rho": [1.0, 2.0, 3.0]}).keys()
        ['rho']
        """
        return [name for name in self.records.dtype.names if name not in ("x", "y", "z")]

    def __iter__(self):
        return iter(self.keys())

    def __contains__(self, name):
        return name in self.keys()

    def __getitem__(self, name):
        """The values of a field.

        Parameters
        ----------
        name : str
            A field, or what is computed of one: `vel[1]`, `|vel|`, `|vx,vy,vz|`.

        Returns
        -------
        numpy.ndarray, shape (n,) or (n, k)
            A view in the type of the field. Of a column of names an array of texts, ""
            for none; its numbers are in `records`, its names in `labels`.

        Raises
        ------
        FieldError
            For a field that is not there.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3), {"vel": np.eye(3, dtype=np.float32) * 2})
        >>> samples["vel"].shape, samples["vel[1]"].tolist(), samples["|vel|"].tolist()
        ((3, 3), [0.0, 2.0, 0.0], [2.0, 2.0, 2.0])
        """
        if not isinstance(name, str):
            raise TypeError(f"Fields are asked for by their names, not by {_parameters.shown(name)}.")
        if name in self.labels:
            names = np.array(self.labels[name] + [""], dtype=object)
            return names[np.clip(self.records[name], -1, len(names) - 1)]
        if name in self.keys():
            return self.records[name]
        if any(mark in name for mark in "[|"):
            _parameters.text(name, "The name of a field")
            return self._dataset.read_scalar(name)
        raise FieldError(describe_missing(name, self.keys()))

    @_parameters.with_proposals
    def save(self, path, ascii=False, progress=None):
        """Write a file as the tools do: pcd, ply, vtp, vtkhdf, csv or npz, by the ending of its name.

        Parameters
        ----------
        path : str or os.PathLike
        ascii : bool
            Write PCD and PLY as text. Only text reports progress.
        {progress}

        Raises
        ------
        OSError
            If the file cannot be written. No file is left behind then.

        Examples
        --------
        >>> import tempfile
        >>> path = tempfile.mkdtemp() + "/points.pcd"
        >>> uvol.Samples(np.eye(3), {"rho": [1.0, 2.0, 3.0]}).save(path)
        >>> uvol.read(path)
        Samples of 3 points: rho (float64)
        """
        self._save(path, np.empty((0, 3), np.uint32), ascii, progress)

    def _save(self, path, triangles, ascii, progress):
        from . import _io
        with listening(progress) as listener:
            losses = _io.write(os.fsencode(path), self._dataset, triangles, _parameters.flag(ascii, "ascii"), self._comments(), listener)
        _report.warn(losses)

    def _comments(self):
        """Lines for files that have comments."""
        return []

    def __getstate__(self):
        state = self.__dict__.copy()
        state.update(_records=None, _points=None)  # views of memory that is elsewhere
        return state


def describe_missing(name, names):
    """A sentence about a field that is not there, with the one that was meant."""
    return f"There is no field {name!r}{_parameters.propose(names, name)}; the fields are {', '.join(names) or 'none'}."
