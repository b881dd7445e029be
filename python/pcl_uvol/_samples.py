# SPDX-License-Identifier: BSD-3-Clause
"""Scattered samples: what everything starts from."""

import os
import numpy as np

from . import _arrays, _core, _parameters, _report
from ._errors import FieldError
from ._pictures import Drawable
from ._points import Points, describe_missing
from ._progress import listening


class Samples(Drawable, Points):
    """Samples of fields at scattered points.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Coordinates, float32 or float64. Doubles keep their digits: they are held
        relative to an origin. A structured array with x, y, z brings its other fields,
        as a table of pandas or xarray does (`from_dataframe`); records of `empty` and
        samples are taken as they are, all others are copied once.
    fields : mapping of str to array_like, optional
        Values, shape (n,) or (n, k), of any type of numbers, which is kept. NaN, masked
        values and pandas' missing ones are missing values. Columns of names, as texts or
        categories, are kept as labels.

    Attributes
    ----------
    report, parameters : dict
        Of the stage that made them, else empty.
    snapshots : list of tuple
        Of a level set that keeps some, else empty.

    Examples
    --------
    >>> import numpy as np, pcl_uvol as uvol
    >>> samples = uvol.Samples(np.eye(3), {"rho": [1.0, 2.0, 3.0]})
    >>> samples["rho"]
    array([1., 2., 3.])
    >>> samples
    Samples of 3 points: rho (float64)
    >>> holes = uvol.Samples(np.eye(3), {"hole": ["A-2", "A-1", "A-2"]})
    >>> len(holes.where("hole = A-2")), holes.labels
    (2, {'hole': ['A-1', 'A-2']})
    """

    @_parameters.with_proposals
    def __init__(self, points, fields=None):
        if isinstance(points, (str, bytes, os.PathLike)):
            raise TypeError(f"points is {_parameters.shown(points)}: it must be an array; read() makes samples of files.")
        is_structured = bool(getattr(getattr(points, "dtype", None), "names", None))
        if fields is not None and (is_structured or isinstance(points, Points)):
            raise TypeError("Samples and structured arrays have their fields: give fields with an array of points.")
        if isinstance(points, Points):
            self._begin(points._dataset)
            self._read_cells = getattr(points, "_read_cells", None)
            return
        dataset = None
        if is_structured:
            records = np.ma.asarray(points) if np.ma.isMaskedArray(points) else np.asarray(points)
            dataset = _arrays.take_over(records)
            if dataset is None:
                points, fields = _split(records, ("x", "y", "z"))
        elif fields is None and _is_table(points):
            points, fields = _columns_of(points, "xyz", None)
        self._begin(dataset or _arrays.make_dataset(points, fields))
        _report.warn(self._dataset.notes)

    @classmethod
    def _of(cls, dataset, report=None, parameters=None, like=None):
        """`like` has the same points, so the facts about its file apply to these as well."""
        samples = cls.__new__(cls)
        samples._begin(dataset)
        samples._read_cells = None if like is None else like._read_cells
        samples.report = {} if report is None else report
        samples.parameters = _parameters.Parameters(parameters or {})
        return samples

    def _begin(self, dataset):
        Points.__init__(self, dataset)
        self.report = {}
        self.parameters = _parameters.Parameters()
        self.snapshots = []
        self._derived = {}
        self._read_cells = self._cells = None

    @classmethod
    @_parameters.with_proposals
    def from_dataframe(cls, frame, points=("x", "y", "z"), fields=None):
        """Samples from the columns of a pandas.DataFrame or an xarray.Dataset.

        Parameters
        ----------
        frame : pandas.DataFrame or xarray.Dataset
        points : sequence of three str
            Columns of the coordinates.
        fields : sequence of str, optional
            Columns to take; by default all others that hold numbers or names. Variables of
            a grid are repeated along those dimensions of the coordinates that they lack, a
            further dimension gives several numbers per point.

        Returns
        -------
        Samples

        Examples
        --------
        >>> import pandas
        >>> frame = pandas.DataFrame({"lon": [1.0, 2.0], "lat": [3.0, 4.0], "depth": [5.0, 6.0], "T": [7, 8]})
        >>> uvol.Samples.from_dataframe(frame, points=("lon", "lat", "depth"))
        Samples of 2 points: T (int64)
        """
        if _names_of(frame) is None:
            raise TypeError(f"{_parameters.shown(frame)} is not a table: it must be a pandas.DataFrame or an xarray.Dataset.")
        return cls(*_columns_of(frame, points, fields))

    @_parameters.with_proposals
    def compute(self, expression, threads=0, progress=None):
        """Samples with one more field: the values of an expression.

        Parameters
        ----------
        expression : str
            For example `log10(rho)`, `|vel|`, `Q(vel)`, `|grad(rho)|`.
        {threads, progress}

        Returns
        -------
        Samples
            The same object if it has the field already.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3), {"rho": [1.0, 10.0, 100.0]})
        >>> samples.compute("log10(rho)")["log10(rho)"]
        array([0., 1., 2.])
        """
        return self._with_field(expression, threads, progress)[0]

    @_parameters.with_proposals
    def density(self, length=0.0, threads=0, progress=None):
        """Samples with the SPH density of particles.

        Parameters
        ----------
        length : float
            One smoothing length h for all particles, in units of the coordinates. The kernel ends at
            2 h. 0: the field of smoothing lengths with a usual name, otherwise 48 neighbours.
        {threads, progress}

        Returns
        -------
        Samples
            With the field `sph_density`, from the fields of masses and smoothing lengths with usual
            names. Without a field of masses, it is the number of particles per volume.

        Examples
        --------
        >>> grid = np.stack(np.meshgrid(*[np.arange(12.0)] * 3), axis=-1).reshape(-1, 3)
        >>> samples = uvol.Samples(grid, {"mass": np.full(len(grid), 2.0)}).density()
        >>> inside = np.all((samples.points > 4) & (samples.points < 7), axis=1)
        >>> bool(np.allclose(samples["sph_density"][inside], 2.0, rtol=0.02))
        True
        """
        parameters = {"length": _parameters.number(length, "length")}
        with listening(progress) as listener:
            dataset, report = self._dataset.with_density(parameters["length"], _parameters.count(threads, "threads"),
                                                         listener)
        _report.warn(report["warnings"])
        return Samples._of(dataset, report, parameters, like=self)

    @_parameters.with_proposals
    def sampling(self, scale=(1.0, 1.0, 1.0), rotate=None, threads=0, progress=None):
        """Samples with the local sampling class and spacings, as `uvol_info -out` writes them.

        Parameters
        ----------
        {scale, rotate of info}
        {threads, progress}

        Returns
        -------
        Samples
            With the fields `local_dimension` (isolated, line, sheet, volume), `spacing_along` and
            `spacing_across`: lengths, NaN where there is no neighbour in that direction.

        Examples
        --------
        >>> line = np.stack([np.arange(50.0), np.zeros(50), np.zeros(50)], axis=1)
        >>> uvol.Samples(line).sampling()["local_dimension"][25]
        'line'
        """
        stretch = _parameters.Stretch(scale, rotate)
        parameters = {"scale": stretch.resolve(self._dataset), "rotation": stretch.rotation}
        with listening(progress) as listener:
            dataset = _core.with_sampling(self._dataset, *parameters.values(), _parameters.count(threads, "threads"),
                                          listener)
        return Samples._of(dataset, None, parameters, like=self)

    @_parameters.with_proposals
    def outer_layer(self, value, field="", threads=0, progress=None):
        """Samples with a layer of further samples around them, about one spacing outside, where the
        field has a known value. It closes surfaces.

        Parameters
        ----------
        value : float
            Value of the field. Other fields get the values of the nearest sample.
        field : str
            Name of a field. "": `intensity`, otherwise the only candidate.
        {threads, progress}

        Returns
        -------
        Samples
            The further samples come last.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> closed = uvol.Samples(points, {"rho": np.ones(2000)}).outer_layer(0.0)
        >>> outer = closed.points[2000:]
        >>> closed["rho"][2000:].max(), bool((np.abs(outer - 0.5).max(axis=1) > 0.4).all())
        (0.0, True)
        """
        parameters = {"field": _parameters.text(field, "field"), "value": _parameters.number(value, "value")}
        with listening(progress) as listener:
            dataset, report = self._dataset.with_outer_layer(*parameters.values(), _parameters.count(threads, "threads"),
                                                             listener)
        return Samples._of(dataset, report, parameters)

    @_parameters.with_proposals
    def where(self, expression, threads=0, progress=None):
        """The samples for which an expression is true.

        Parameters
        ----------
        expression : str
            For example `T > 4 && depth < 100` or `hole = A-2`. It is false where a value is missing.
        {threads, progress}

        Returns
        -------
        Samples

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3), {"T": [3.0, 5.0, np.nan]})
        >>> samples.where("T > 4")["T"]
        array([5.])
        """
        with listening(progress) as listener:
            dataset, _ = self._dataset.select(_parameters.text(expression, "expression"), _parameters.count(threads, "threads"), listener)
        return Samples._of(dataset)

    @_parameters.with_proposals
    def take(self, indices):
        """The samples of some indices, or of a mask.

        Parameters
        ----------
        indices : array_like of int or bool, or slice
            Whatever chooses rows of an array; what is masked chooses none.

        Returns
        -------
        Samples

        Raises
        ------
        IndexError
            For rows that are not there.

        Examples
        --------
        >>> samples = uvol.Samples(np.eye(3), {"T": [3.0, 5.0, 7.0]})
        >>> samples.take([2, 0])["T"].tolist(), samples.take(samples["T"] > 4)["T"].tolist()
        ([7.0, 3.0], [5.0, 7.0])
        """
        if indices is None or isinstance(indices, (str, tuple)):
            raise TypeError(f"indices is {_parameters.shown(indices)}: it must be an array of indices, a mask, or a slice.")
        if np.ma.isMaskedArray(indices):
            indices = indices.filled(False) if indices.dtype.kind == "b" else indices.compressed()
        try:
            rows = np.arange(len(self))[indices]
        except ValueError:  # lists of different lengths
            raise IndexError(f"indices is {_parameters.shown(indices)}: it must be an array of indices, a mask, or a "
                             "slice.") from None
        return Samples._of(self._dataset.take(rows))

    def _with_field(self, expression, threads, progress, sides=(0.0, 0.0, 0.0)):
        """Samples that have the field, and its name. Made once: a tree built for them
        serves again. Derivatives see across the faces of a box of such sides."""
        if not isinstance(expression, str):
            raise TypeError(f"field is {_parameters.shown(expression)}: it must be the name of a field, or an expression.")
        if expression == "":
            return self, ""
        _parameters.text(expression, "field")
        made = (expression, *sides)
        if made not in self._derived:
            with listening(progress) as listener:
                dataset, name, report = self._dataset.with_field(expression, "", sides, _parameters.count(threads, "threads"),
                                                                 listener)
            samples = self if dataset is self._dataset else Samples._of(dataset, like=self)
            self._derived[made] = (samples, name, report["warnings"])
        samples, name, messages = self._derived[made]
        _report.warn(messages)
        return samples, name

    def _with_numbers(self, expression, threads, progress, sides=(0.0, 0.0, 0.0)):
        """The same of a field that stages take: names are refused."""
        samples, name = self._with_field(expression, threads, progress, sides)
        samples._dataset.refuse_names(name)
        return samples, name

    def _find_box(self, periodic):
        """The sides of the box that samples repeat in; 0 for none."""
        if isinstance(periodic, str):
            if periodic != "header":
                raise ValueError(f"periodic is {periodic!r}: it must be three sides, or 'header'.")
            if not self.box.any():
                raise ValueError("The file names no box: give its sides, as in periodic=(100, 100, 100).")
            return self.box.tolist()
        sides = [0.0, 0.0, 0.0] if periodic is None else _parameters.numbers(periodic, "periodic")
        if len(sides) != 3:
            raise ValueError(f"periodic has {len(sides)} sides: there must be three, 0 along an axis for none.")
        return sides

    def _with_images(self, sides, scale, threads, progress):
        """These samples with images beyond the faces of a periodic box."""
        with listening(progress) as listener:
            imaged = _core.ImagedSamples(self._dataset, sides, scale, _parameters.count(threads, "threads"), listener)
        _report.warn(imaged.report["warnings"])
        return imaged

    def __getstate__(self):
        state = super().__getstate__()
        state.update(_derived={}, _cells=None)
        return state

    def _find_cells(self):
        """The cells of the file that these samples are all of; None of other samples."""
        if self._cells is None and self._read_cells is not None:
            self._cells = self._read_cells(self._dataset)
        cells, messages = self._cells or (None, [])
        _report.warn(messages)
        return cells

    def __repr__(self):
        fields = []
        for name in self.keys():
            if name in self.labels:
                fields.append(f"{name} ({len(self.labels[name])} names)")
                continue
            values = self.records.dtype[name]
            fields.append(f"{name} ({values.base}" + (f" x {values.shape[0]})" if values.shape else ")"))
        return f"Samples of {len(self)} points: {', '.join(fields) or 'no fields'}"


def _split(records, axes):
    """Coordinates and fields of a structured array."""
    missing = [axis for axis in axes if axis not in records.dtype.names]
    if missing:
        raise ValueError(f"The structured array has no field {missing[0]}: it needs x, y and z.")
    records = records.reshape(-1)
    return _arrays.stack_axes(records, axes, "field"), {name: records[name] for name in records.dtype.names if name not in axes}


def _is_field(column):
    return getattr(getattr(column, "dtype", None), "kind", "O") in "biuf" or _arrays.as_labels(column) is not None


def _names_of(table):
    """The columns of a table of pandas, the variables of one of xarray; None for what is
    no table."""
    if isinstance(table, np.ndarray):
        return None
    names = getattr(table, "columns", getattr(table, "variables", None))
    return None if names is None else list(names)


def _is_table(points):
    """Whether it is a table with fields; three columns that are not called x, y and z are
    coordinates in their order."""
    names = _names_of(points)
    return names is not None and (hasattr(points, "variables") or len(names) != 3 or set(names) == set("xyz"))


def _columns_of(table, axes, fields):
    """Coordinates and fields of a table."""
    axes, names = list(axes), _names_of(table)
    if len(axes) != 3:
        raise ValueError(f"points names {len(axes)} columns: there must be three.")
    if isinstance(fields, str):
        raise TypeError(f"fields is {fields!r}: it must be a sequence of columns.")
    for number, name in enumerate(names):
        if name in names[:number]:
            raise ValueError(f"The table has several columns {name!r}: give them different names.")
    for name in axes + list(fields or []):
        if name not in names:
            raise FieldError(describe_missing(str(name), [str(known) for known in names]))
    columns = _Grid(table, axes) if hasattr(table, "variables") else table
    if fields is None:
        fields = [name for name in columns if name not in axes and _is_field(columns[name])]
    return _arrays.stack_axes(columns, axes, "column"), {str(name): columns[name] for name in fields}


class _Grid:
    """Variables of a dataset of xarray as columns, with a row for each place."""

    def __init__(self, dataset, axes):
        self._dataset = dataset
        spanned = {dim for axis in axes for dim in dataset[axis].dims}
        in_order = [dim for name in dataset.variables for dim in dataset[name].dims if dim in spanned]
        self._sizes = {dim: dataset.sizes[dim] for dim in dict.fromkeys(in_order)}

    def __iter__(self):
        """Names of the variables that depend on the place."""
        return (name for name in self._dataset.variables if not self._sizes.keys().isdisjoint(self._dataset[name].dims))

    def __getitem__(self, name):
        variable = self._dataset[name].variable
        further = [dim for dim in variable.dims if dim not in self._sizes]
        if len(further) > 1:
            raise ValueError(f"The variable {name!r} has the dimensions {', '.join(map(str, further))} besides those of "
                             "the coordinates: one, of several numbers per point, is all that a field can have.")
        sizes = dict(self._sizes, **{dim: self._dataset.sizes[dim] for dim in further})
        values = variable.set_dims(sizes).values
        return values.reshape(-1, values.shape[-1]) if further else values.reshape(-1)


def as_samples(points, fields):
    """Samples as they are, or made of arrays, or of a table."""
    return points if isinstance(points, Samples) and fields is None else Samples(points, fields)
