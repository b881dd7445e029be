# SPDX-License-Identifier: BSD-3-Clause
"""The field between the samples: at any places, along lines, in slices and grids."""

import functools
from collections.abc import Iterable

import numpy as np

from . import _arrays, _core, _parameters, _report
from ._lattice import Lattice
from ._points import Points
from ._progress import listening
from ._samples import Samples, as_samples


class Answers:
    """Values of fields at queries, from an `Interpolator`.

    Attributes
    ----------
    values : numpy.ndarray
        In units of the field; NaN: no value. One field: the shape of the queries; several: the
        field is the first axis.
    errors : numpy.ndarray or None
        Standard errors of the values, in units of the field; None without `errors=True`.
    gradients : numpy.ndarray or None
        Per unit of length, with an axis of three at the end; None without `gradients=True`.
    support : numpy.ndarray of uint8
        Data coverage: 1 samples all around; 2 in a gap of the sampling; 3 at the rim of a gap or of
        the data; 5 samples that do not determine the model; 6 position not finite; 7 outside.
    report : dict
        Counts, milliseconds and warnings.
    parameters : dict
        All parameters of the interpolator.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((2000, 3))
    >>> fields = {"rho": points[:, 0], "T": points[:, 1]}
    >>> answers = uvol.Interpolator(points, fields, field=["rho", "T"]).evaluate(np.full((5, 7, 3), 0.5))
    >>> answers.values.shape, answers.gradients.shape, answers.support.shape
    ((2, 5, 7), (2, 5, 7, 3), (5, 7))
    >>> bool(np.allclose(answers.values, 0.5, atol=1e-5))
    True
    """

    def __init__(self, found, shape, is_single, parameters):
        def shaped(array, *more):
            if array is None:
                return None
            return array.reshape((() if is_single else array.shape[:1]) + shape + more)

        self.values = shaped(found["values"])
        self.errors = shaped(found.get("errors"))
        self.gradients = shaped(found.get("gradients"), 3)
        self.support = found["support"].reshape(shape)
        self.report = found["report"]
        self.parameters = parameters

    def __repr__(self):
        return f"Answers to {self.support.size} queries, {int(np.isnan(self.values).sum())} of the values missing"


class Interpolator:
    """Interpolates fields of scattered samples at any position.

    Parameters
    ----------
    {points, fields}
    field : str or sequence of str
        Fields or expressions. "": `intensity`, otherwise the only candidate. A sequence gives arrays
        with an axis of fields in front; `scale="auto"` is estimated from its first field.
    model : {"fit", "natural", "laplace", "kriging", "sph", "shepard", "nearest", "auto"}
        "auto" selects the model with the smallest error at held-out samples.
    extrapolate : bool
        Extrapolate outside of the data. By default, values there are NaN.
    cell_mask : bool
        For samples that `read` took from a file with cells of three dimensions: give values inside
        of the cells, and NaN outside of all.
    gradients, errors : bool
        Compute the gradients and the standard errors, too.
    {scale, rotate}
    kriging, sph, shepard : dict
        Parameters of these models, by the library's names: `kriging={"variogram": "gaussian",
        "nugget": 0.1}`. "psill" is the partial sill, without the nugget.
    periodic : sequence of three float, or "header"
        Sides of the periodic box, in units of length; 0 along an axis that is not periodic.
        "header": the sides that the file names (`Samples.box`). Queries can be in any of the boxes.
    {threads, progress}

    Attributes
    ----------
    samples : Samples
    fields : list of str
        In the order of the answers.
    parameters : dict
        With the model that was chosen; print() has a line for each.
    variograms : dict
        Of kriging.

    Examples
    --------
    >>> import numpy as np, pcl_uvol as uvol
    >>> points = np.random.default_rng(1).random((5000, 3))
    >>> interpolator = uvol.Interpolator(points, {"rho": points[:, 0] ** 2})
    >>> values, errors = interpolator([[0.5, 0.5, 0.5], [0.25, 0.5, 0.5]])
    >>> [round(float(value), 4) for value in values]
    [0.25, 0.0625]
    """

    @_parameters.with_proposals
    def __init__(self, points, fields=None, *, field="", model="fit", extrapolate=False, cell_mask=True, gradients=True,
                 errors=True, scale=(1.0, 1.0, 1.0), rotate=None, kriging=None, sph=None, shepard=None, periodic=None, threads=0,
                 progress=None):
        samples = as_samples(points, fields)
        self._made_of = functools.partial(Interpolator, samples, field=field, model=model, extrapolate=extrapolate,
                                          cell_mask=cell_mask, gradients=gradients, errors=errors, scale=scale, rotate=rotate, kriging=kriging, sph=sph,
                                          shepard=shepard, periodic=periodic, threads=threads)
        self.samples = samples
        self._sides = samples._find_box(periodic)
        self._own = len(samples)
        cells = samples._find_cells() if _parameters.flag(cell_mask, "cell_mask") and not any(self._sides) else None
        if any(self._sides):
            samples = Samples._of(samples._with_images(self._sides, (1.0, 1.0, 1.0), threads, progress).samples)
        self._is_single = isinstance(field, str)
        self._threads = _parameters.count(threads, "threads")
        wanted = [field] if self._is_single else _names(field)
        names = []
        for name in wanted:
            samples, found = samples._with_numbers(name, threads, progress)
            names += [found] if found else []
        self._placed = samples  # with expressions, and images behind the others
        if not any(self._sides):
            self.samples = samples
        stretch = _parameters.Stretch(scale, rotate)
        parameters = {
            "fields": names,
            "model": model,
            "extrapolate": extrapolate,
            "gradients": gradients,
            "errors": errors,
            "scale": stretch.resolve(samples._dataset, names[0] if names else "", self._threads),
            "rotation": stretch.rotation,
            "kriging": _parameters.mapping(kriging, "kriging"),
            "sph": _parameters.mapping(sph, "sph"),
            "shepard": _parameters.mapping(shepard, "shepard"),
        }
        with listening(progress) as listener:
            self._core = _core.Interpolator(samples._dataset, self._own, self._sides, _parameters.to_json(parameters),
                                            cells, self._threads, listener)
        self.fields = self._core.names
        _report.warn(self._core.report["warnings"])

    @property
    def parameters(self):
        """dict: the library's parameters, with the model that was chosen.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> model = uvol.Interpolator(points, {"rho": points[:, 0]}, model="shepard", shepard={"k": 5})
        >>> model.parameters["model"], model.parameters["shepard"]["k"]
        ('shepard', 5)
        """
        return _parameters.from_json(self._core.parameters)

    @property
    def variograms(self):
        """dict: of kriging, by field: kind, nugget, psill (the partial sill: without the
        nugget) and range. They are fitted to half the mean squares of differences (values),
        by distance, with the number of pairs of samples. Empty with other models.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> model = uvol.Interpolator(points, {"rho": np.sin(3 * points[:, 0])}, model="kriging")
        >>> found = model.variograms["rho"]
        >>> found["kind"], len(found["distances"]) == len(found["pairs"]), found["range"] > 0.3
        ('spherical', True, True)
        """
        return self._core.variograms

    @_parameters.with_proposals
    def evaluate(self, queries, threads=None, progress=None):
        """Answer queries.

        Parameters
        ----------
        queries : array_like, shape (..., 3), Samples or Surface
            Positions in the coordinates of the samples.
        threads : int
            Number of threads; 0 uses all cores. By default, that of the interpolator.
        {progress}

        Returns
        -------
        Answers

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> answers = uvol.Interpolator(points, {"rho": 2 * points[:, 0]}).evaluate([[0.5, 0.5, 0.5], [9, 9, 9]])
        >>> answers.values.round(4), answers.gradients[0].round(3) + 0.0, answers.support
        (array([ 1., nan]), array([2., 0., 0.]), array([1, 7], dtype=uint8))
        """
        if isinstance(queries, Points):
            queries = queries._on_map_of(self._placed)
        places = _arrays.as_array(queries.points if isinstance(queries, Points) else queries, "queries")
        if places.ndim == 0 or places.shape[-1] != 3:
            raise ValueError(f"queries has the shape {places.shape}: it must be (..., 3), a row for each place.")
        with listening(progress) as listener:
            found = self._core.answer(places.reshape(-1, 3), self._threads_of(threads), listener)
        _report.warn(found["report"]["warnings"])
        return Answers(found, places.shape[:-1], self._is_single, self.parameters)

    @_parameters.with_proposals
    def __call__(self, queries, threads=None, progress=None):
        """Values and standard errors at queries; `evaluate` also gives gradients and `support`.

        Parameters
        ----------
        {others of Interpolator.evaluate}

        Returns
        -------
        values : numpy.ndarray
            In units of the field; NaN: no value.
        errors : numpy.ndarray or None
            Standard errors of the values; None without `errors=True`.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> values, errors = uvol.Interpolator(points, {"rho": points[:, 0]})([0.5, 0.5, 0.5])
        >>> round(float(values), 4), bool(errors < 1e-3)
        (0.5, True)
        """
        answers = self.evaluate(queries, threads, progress)
        return answers.values, answers.errors

    @_parameters.with_proposals
    def probe(self, points, threads=None, progress=None):
        """Points with the interpolated fields after their own, as uvol_probe writes them.

        Parameters
        ----------
        points : Samples, Surface or array_like, shape (n, 3)
        {others of Interpolator.evaluate}

        Returns
        -------
        Samples
            With their own fields, and for a field `rho` of the model: `rho` (`rho_2` if they have
            a `rho`), `rho_error` (its standard error), `rho_gradient`, and `support` (data coverage,
            see `Answers`).

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> uvol.Interpolator(points, {"rho": points[:, 0]}).probe([[0.5, 0.5, 0.5]]).keys()
        ['rho', 'rho_error', 'rho_gradient', 'support']
        """
        points = as_samples(points, None)._on_map_of(self._placed)
        with listening(progress) as listener:
            dataset, report = self._core.probe(points._dataset, self._threads_of(threads), listener)
        _report.warn(report["warnings"])
        return Samples._of(dataset, report, self.parameters)

    @_parameters.with_proposals
    def validate(self, folds=10, by="random", threads=None, progress=None):
        """Cross-validation: hold out each part of the samples, and compare its values with those from
        the other parts.

        Parameters
        ----------
        folds : int
            Number of parts, at least 2.
        by : str
            Parts are "random", compact "blocks", or the samples that share a value of the field of this
            name, such as drill holes.
        {others of Interpolator.evaluate}

        Returns
        -------
        dict
            By field: `tested` and `covered` samples, `rms` and `bias` in units of the field, and
            `within_error`, the proportion of samples whose deviation is at most their error.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((2000, 3))
        >>> scores = uvol.Interpolator(points, {"rho": points[:, 0]}).validate()
        >>> scores["rho"]["tested"], scores["rho"]["rms"] < 1e-5
        (2000, True)
        """
        with listening(progress) as listener:
            scores, report = self._core.validate(_parameters.count(folds, "folds"), _parameters.text(by, "by"), self._threads_of(threads),
                                                 listener)
        _report.warn(report["warnings"])
        return scores

    @_parameters.with_proposals
    def line(self, start, end, n=500, threads=None, progress=None):
        """The fields at equal distances along a line.

        Parameters
        ----------
        start, end : array_like, shape (3,)
            Positions in the coordinates of the samples.
        n : int
            Number of positions, with both ends.
        {others of Interpolator.evaluate}

        Returns
        -------
        Lattice
            Of shape (n,).

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> line = uvol.Interpolator(points, {"rho": points[:, 0]}).line([0.2, 0.5, 0.5], [0.8, 0.5, 0.5], n=4)
        >>> line["rho"].round(3).tolist()
        [0.2, 0.4, 0.6, 0.8]
        """
        return self._fill(*_core.line(_place(start, "start"), _place(end, "end"), _parameters.count(n, "n")),
                          threads, progress)

    @_parameters.with_proposals
    def slice(self, plane, size=512, box=None, threads=None, progress=None):
        """The fields in a plane.

        Parameters
        ----------
        plane : str, or a pair of array_like
            Such as "z=0.5", or a point and a normal.
        size : int or pair of int
            Number of positions along the longer side, or the largest number along each side.
        box : pair of array_like
            Low and high corner; by default the bounding box of the samples.
        {others of Interpolator.evaluate}

        Returns
        -------
        Lattice
            Of shape (n, m): rows go upwards, columns across.

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> interpolator = uvol.Interpolator(points, {"rho": points[:, 0]})
        >>> interpolator.slice("z=0.5", 32, box=([0, 0, 0], [1, 0.5, 1])).shape
        (16, 32)
        >>> oblique = interpolator.slice(([0.5, 0.5, 0.5], [1, 1, 0]), 32)
        >>> bool(np.allclose(oblique.points @ [1, 1, 0], 1))
        True
        """
        point, normal = _plane(plane)
        sides = _parameters.several(size) or [size, size]
        if len(sides) != 2:
            raise ValueError(f"size has {len(sides)} numbers: it must be one, or two.")
        counts = [_parameters.count(side, "size") for side in sides]
        lattice, _, _ = _core.slice(point, normal, *self._box(box), counts)
        return self._fill(*lattice, threads, progress)

    @_parameters.with_proposals
    def grid(self, n=128, box=None, threads=None, progress=None):
        """The fields in a grid.

        Parameters
        ----------
        n : int or three int
            Number of positions along the longest side of a grid of cubes; or along x, y and z.
        {box of Interpolator.slice}
        {others of Interpolator.evaluate}

        Returns
        -------
        Lattice
            Of shape (nz, ny, nx).

        Examples
        --------
        >>> points = np.random.default_rng(1).random((5000, 3))
        >>> grid = uvol.Interpolator(points, {"rho": points[:, 0]}).grid((3, 4, 5), box=([0.2] * 3, [0.8] * 3))
        >>> grid["rho"].shape
        (5, 4, 3)
        """
        sides = _parameters.several(n)
        if sides is None:
            return self._fill(*_core.cubic_grid(*self._box(box), _parameters.count(n, "n")), threads, progress)
        counts = [_parameters.count(side, "n") for side in sides]
        if len(counts) != 3:
            raise ValueError(f"n has {len(counts)} numbers: it must be one, or three.")
        return self._fill(*_core.grid(*self._box(box), counts), threads, progress)

    def _box(self, box):
        if box is None:
            return _core.bounds(self._placed._dataset, self._sides)
        corners = _parameters.several(box) or []
        if len(corners) != 2:
            raise ValueError("box is a pair: its low and its high corner.")
        return _place(corners[0], "box"), _place(corners[1], "box")

    def _fill(self, places, counts, steps, threads, progress):
        with listening(progress) as listener:
            found = self._core.answer(places, self._threads_of(threads), listener)
        _report.warn(found["report"]["warnings"])
        columns = {}
        for number, name in enumerate(self.fields):
            columns[name] = found["values"][number]
            if "errors" in found:
                columns[name + "_error"] = found["errors"][number]
            if "gradients" in found:
                columns[name + "_gradient"] = found["gradients"][number]
        columns["support"] = found["support"]
        if self._placed.map is not None:
            columns["longitude"], columns["latitude"] = self._placed.map.to_globe(places[:, 0], places[:, 1])
        short = [name for name in self.fields if self._core.is_short(name)]
        return Lattice(places, counts, steps, columns, found["report"], self.parameters, short, self._find_ranges(),
                       self._placed)

    def _find_ranges(self):
        """The lowest and the highest finite value of every field, images left out: derivatives of the outermost are
        one-sided."""
        ranges = {}
        for name in self.fields:
            values = self._placed[name][:self._own]
            values = values[np.isfinite(values)]
            ranges[name] = (float(values.min()), float(values.max())) if len(values) else (-np.inf, np.inf)
        return ranges

    def _threads_of(self, threads):
        return self._threads if threads is None else _parameters.count(threads, "threads")

    def __reduce__(self):
        return self._made_of, ()

    def __repr__(self):
        return f"Interpolator of {', '.join(self.fields)} by {self.parameters['model']} from {len(self.samples)} points"


def _names(field):
    """Several fields."""
    if not isinstance(field, Iterable) or not list(field):
        raise TypeError(f"field is {_parameters.shown(field)}: it must be the name of a field, or a sequence of names.")
    return list(field)


def _place(values, what):
    place = _parameters.numbers(values, what)
    if len(place) != 3:
        raise ValueError(f"{what} has {len(place)} numbers: there must be three, x, y and z.")
    return place


def _plane(plane):
    """A point and a normal; those of "z=0.5" as well."""
    if not isinstance(plane, str):
        place = _parameters.several(plane) or []
        if len(place) != 2:
            raise ValueError(f"plane is {_parameters.shown(plane)}: it must be x=, y= or z= and a number, or a point and a normal.")
        point, normal = place
        return _place(point, "plane"), _place(normal, "plane")
    axis, _, value = plane.partition("=")
    try:
        place = "xyz".index(axis.strip() or "-")
        number = _parameters.number(float(value), "plane")
    except ValueError:
        raise ValueError(f"plane is {_parameters.shown(plane)}: it must be x=, y= or z= and a number, "
                         "or a point and a normal.") from None
    point, normal = [0.0] * 3, [0.0] * 3
    point[place], normal[place] = number, 1.0
    return point, normal
