# SPDX-License-Identifier: BSD-3-Clause
"""Fields at places in rows: lines, slices and grids."""

import os

import numpy as np

from . import _parameters
from ._errors import FieldError
from ._pictures import Picture
from ._points import describe_missing


class Lattice:
    """Fields at places at equal distances along up to three axes.

    Arrays have the shape of the lattice without axes of one place; the first axis of
    the coordinates runs fastest, it is the last one of the arrays.

    Attributes
    ----------
    shape : tuple of int
    points : numpy.ndarray, shape (..., 3)
        The places.
    report : dict
        Counts, milliseconds and warnings.
    parameters : dict
        All parameters of the interpolator.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> grid = uvol.Interpolator(points, {"rho": points[:, 0]}).grid((3, 4, 5), box=([0.2] * 3, [0.8] * 3))
    >>> grid
    Lattice of 5 x 4 x 3 places: rho, rho_error, rho_gradient, support
    >>> grid["rho"].shape, grid["rho_gradient"].shape, grid.points.shape
    ((5, 4, 3), (5, 4, 3, 3), (5, 4, 3, 3))
    """

    def __init__(self, places, counts, steps, columns, report, parameters, short, ranges, samples):
        self.shape = tuple(count for count in reversed(counts) if count > 1) or (1,)
        self._file_form = (places[0].tolist(), steps, counts)
        self._short = short  # fields that are float32 in files
        self._ranges = ranges  # of the samples' values, by field
        self._samples = samples
        self.points = places.reshape(*self.shape, 3)
        self.report = report
        self.parameters = parameters
        self._steps = [step for step, count in zip(steps, counts) if count > 1][::-1]
        self._columns = {name: values.reshape(self.shape + values.shape[1:]) for name, values in columns.items()}

    def keys(self):
        """Names of the fields, those of errors and gradients, and `support`.

        Returns
        -------
        list of str

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> model = uvol.Interpolator(points, {"rho": points[:, 0]}, gradients=False)
        >>> model.line([0.2] * 3, [0.8] * 3).keys()
        ['rho', 'rho_error', 'support']
        """
        return list(self._columns)

    def __iter__(self):
        return iter(self._columns)

    def __getitem__(self, name):
        """The values of a field, in the shape of the lattice; of a gradient with an axis of
        three behind.

        Parameters
        ----------
        name : str

        Returns
        -------
        numpy.ndarray

        Raises
        ------
        FieldError
            For a name that is not among `keys()`.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> line = uvol.Interpolator(points, {"rho": points[:, 0]}).line([0.2] * 3, [0.8] * 3, n=3)
        >>> line["rho"].round(3).tolist(), line["support"].tolist()
        ([0.2, 0.5, 0.8], [1, 1, 1])
        """
        if not isinstance(name, str):
            raise TypeError(f"Fields are asked for by their names, not by {_parameters.shown(name)}.")
        if name not in self._columns:
            raise FieldError(describe_missing(str(name), self.keys()))
        return self._columns[name]

    def to_xarray(self):
        """The fields as an xarray.Dataset.

        Returns
        -------
        xarray.Dataset
            The dimensions are x, y and z along the axes, otherwise i, j and k with positions as coordinates.
            The last dimension of gradients is "axis".

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> grid = uvol.Interpolator(points, {"rho": points[:, 0]}).grid((3, 4, 5), box=([0.2] * 3, [0.8] * 3))
        >>> data = grid.to_xarray()
        >>> data["rho"].dims, data.sizes["y"]
        (('z', 'y', 'x'), 4)
        """
        import xarray
        axes = [self._axis_of(step) for step in self._steps]
        if None in axes:
            dims = ["k", "j", "i"][3 - len(self.shape):]
            coords = {axis: (dims, self.points[..., place]) for place, axis in enumerate("xyz")}
        else:
            dims = ["xyz"[axis] for axis in axes]
            coords = {}
            for place, axis in enumerate(axes):
                along = tuple(slice(None) if other == place else 0 for other in range(len(dims)))
                coords[dims[place]] = self.points[along + (axis,)]
            for axis in set(range(3)) - set(axes):
                coords["xyz"[axis]] = self.points[(0,) * len(dims) + (axis,)]
        return xarray.Dataset({name: (dims + ["axis"] * (values.ndim - len(dims)), values)
                               for name, values in self._columns.items()}, coords)

    @_parameters.with_proposals
    def save(self, path):
        """Write a file as uvol_probe does: vti, vts, nrrd or mha, by the ending of its name. The last two have
        one array per file: others are in further files next to it.

        Parameters
        ----------
        path : str or os.PathLike
            Values get the type of the samples, errors and gradients float32.

        Examples
        --------
        >>> import tempfile
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> grid = uvol.Interpolator(points, {"rho": points[:, 0]}).grid(8)
        >>> grid.save(tempfile.mkdtemp() + "/grid.vti")
        """
        from . import _io
        path = os.fsdecode(path)
        if not _io.is_lattice_file(os.fsencode(path)):
            raise ValueError(f"{path!r} is not a file of a lattice: its name must end in .vti, .vts, .nrrd or .mha.")
        arrays = []
        for name, values in self._columns.items():
            is_short = name in self._short or name.endswith(("_error", "_gradient"))
            values = np.ascontiguousarray(values, np.float32 if is_short else None)
            arrays.append((name, values.reshape(self._count(), -1)))
        _io.write_lattice(os.fsencode(path), *self._file_form, arrays)

    @_parameters.with_proposals
    def render(self, field="", *, contours=(), colormap="viridis", range=None, log=False, samples=None, label="",
               unit=""):
        """A picture of a slice, or of the values along a line with their errors, as uvol_probe draws it.

        Parameters
        ----------
        field : str
            Name of a field; "": the first one.
        contours : sequence of float
            In a slice: draw lines of these values.
        {colormap, range, log of Drawable.render}
        samples : float
            In a slice: draw the samples that are at most this far from it, in their colours.
        label, unit : str
            Title of the values, "": the field; unit of the coordinates.

        Returns
        -------
        Picture

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> interpolator = uvol.Interpolator(points, {"rho": points[:, 0] ** 2})
        >>> picture = interpolator.slice("z=0.5", 64).render(contours=[0.2, 0.4], unit="m")
        >>> picture.pixels.shape[2], picture.field
        (4, 'rho')
        """
        from . import _charts
        field = _parameters.text(field, "field") or next(iter(self._columns))
        unit, log = _parameters.text(unit, "unit"), _parameters.flag(log, "log")
        values = self[field]
        if len(self.shape) > 2 or values.ndim > len(self.shape):
            raise ValueError("A picture shows one number per place, along a line or in a slice.")
        title = _parameters.text(label, "label") or field
        lines = [] if _parameters.several(contours) == [] else _parameters.numbers(contours, "contours")
        parameters = dict(field=field, contours=lines, colormap=colormap, range=range, log=log,
                          samples=samples, label=title, unit=unit)
        if len(self.shape) == 1:
            errors = self._columns.get(field + "_error", np.empty(0))
            distances = np.arange(self.shape[0]) * np.linalg.norm(self._steps[0] if self._steps else 0.0)
            pixels = _charts.draw_line(distances, values, errors, _with_unit("distance", unit), title)
            limits = (float(np.nanmin(values)), float(np.nanmax(values))) if np.isfinite(values).any() else (0.0, 0.0)
        else:
            ends = None if range is None else _ends(range, log)
            bounds = self._ranges.get(field, (-np.inf, np.inf))
            near = [] if samples is None else self._find_samples(field, samples)
            pixels, *limits = _charts.draw_slice(values, self._picture_axis(1, unit), self._picture_axis(0, unit), title,
                                                 _parameters.text(colormap, "colormap"), ends, bounds, log, lines,
                                                 near)
        return Picture(pixels, field, limits, self.report, parameters)

    def _find_samples(self, field, distance):
        """Places across and up, and values, of samples that are near to a slice."""
        distance = _parameters.number(distance, "samples")
        if distance < 0:
            raise ValueError(f"samples is {distance:g}: it must be a distance from 0.")
        across, up = (np.asarray(self._steps[number]) / np.linalg.norm(self._steps[number]) for number in (1, 0))
        values = self._samples[field]
        offsets = (self._samples.points - self.points.reshape(-1, 3)[0]) @ np.cross(across, up)
        near = (np.abs(offsets) <= distance) & np.isfinite(values)
        places = self._samples.points[near]
        return np.stack([places @ across, places @ up, values[near]], axis=1).tolist()

    def _repr_png_(self):
        return self.render()._repr_png_() if len(self.shape) < 3 else None

    def _picture_axis(self, number, unit):
        """Coordinates at the ends of an axis of a slice, and its name."""
        step = np.asarray(self._steps[number])
        length = np.linalg.norm(step)
        direction = step / length
        low = float(direction @ self.points.reshape(-1, 3)[0])
        axis = self._axis_of(step)
        name = "xyz"[axis] if axis is not None else "along ({:.3g}, {:.3g}, {:.3g})".format(*direction)
        return low, low + length * (self.shape[number] - 1), _with_unit(name, unit)

    def _count(self):
        return int(np.prod(self.shape))

    @staticmethod
    def _axis_of(step):
        axes = np.flatnonzero(step)
        return int(axes[0]) if len(axes) == 1 else None

    def __repr__(self):
        return f"Lattice of {' x '.join(map(str, self.shape))} places: {', '.join(self.keys())}"


def _ends(values, is_logarithmic):
    """The values at the ends of colours."""
    ends = _parameters.numbers(values, "range")
    if len(ends) != 2 or not ends[0] < ends[1]:
        raise ValueError("The range of colours is two numbers, the lower one first.")
    if is_logarithmic and ends[0] <= 0:
        raise ValueError("The range of logarithmic colours is two numbers above 0.")
    return ends


def _with_unit(name, unit):
    return f"{name} ({unit})" if unit else name
