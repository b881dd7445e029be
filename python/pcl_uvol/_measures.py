# SPDX-License-Identifier: BSD-3-Clause
"""Figures of surfaces: area, volume, axes, genus, integrals of fields, distances."""

from typing import NamedTuple

import numpy as np

from . import _arrays, _core, _parameters, _report
from ._progress import listening
from ._samples import Samples, as_samples


class Figure(NamedTuple):
    """A figure and how far from the truth it may be; NaN: not known.

    Examples
    --------
    >>> volume = uvol.Figure(0.113, 0.001)
    >>> volume.error, float(volume)
    (0.001, 0.113)
    """

    value: float  #: of lengths, areas or volumes in units of the coordinates
    error: float  #: in the same units

    def __float__(self):
        return float(self.value)

    def __str__(self):
        value, error = (f"{number:{form}}" if np.isfinite(number) else "unknown"
                        for number, form in ((self.value, ".6g"), (self.error, ".2g")))
        return f"{value} +- {error}" if np.isfinite(self.value) else value


class FieldMeasures(NamedTuple):
    """A field on a surface, or inside of it.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((20000, 3))
    >>> r = np.linalg.norm(points - 0.5, axis=1)
    >>> inside = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher").measure().inside["r"]
    >>> bool(abs(inside.mean - 0.75 * 0.3) < 0.01)  # of the distance to the centre of a ball
    True
    """

    mean: float  #: by area, or by volume
    integral: Figure  #: over the area, or over the volume
    sum: float  #: over the samples inside, of masses their mass; NaN on the surface


class PieceMeasures:
    """Figures of a surface or of a piece of it, in units of the coordinates.

    Attributes
    ----------
    isovalue : float
    vertices, triangles, rims, genus : int
        Rims are the closed lines along which it is open; genus counts handles, and is
        None of points.
    area, volume : Figure
        The volume is that enclosed, negative for the wall of a cavity, NaN where the
        surface is open.
    cap_area, capped_volume : float
        Of these, of caps that close the surface at the border of the samples, and of
        pieces that have caps.
    centroid : numpy.ndarray, shape (3,)
        Of the volume, or of the area where that is open.
    axes, half_axes : numpy.ndarray, shapes (3, 3) and (3,)
        Rows: principal axes, the longest first; and the half axes of the ellipsoid of
        the same second moments.
    low, high : numpy.ndarray, shape (3,)
        Bounds of the vertices.
    on_surface, inside : dict of str to FieldMeasures
        By field.
    samples : int
        Samples inside.
    samples_beyond : int or None
        Samples at the isovalue or on its inner side, wherever they are. Of an isovalue
        whose samples are known.
    sums_beyond : dict of str to float
        The sums of the fields of these samples: of masses, their mass.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((20000, 3))
    >>> r = np.linalg.norm(points - 0.5, axis=1)
    >>> shells = uvol.isosurface(points, {"r": r}, iso=[0.2, 0.4], outside="higher").measure()
    >>> [(piece.isovalue, round(piece.area.value / (4 * np.pi * piece.isovalue**2), 2)) for piece in shells.pieces]
    [(0.2, 1.0), (0.4, 1.0)]
    """

    def __init__(self, figures):
        for name in ("isovalue", "vertices", "triangles", "rims", "genus", "samples", "cap_area",
                     "capped_volume", "samples_beyond", "sums_beyond"):
            setattr(self, name, figures[name])
        for name in ("centroid", "axes", "half_axes", "low", "high"):
            setattr(self, name, np.asarray(figures[name]))
        self.area = Figure(*figures["area"])
        self.volume = Figure(*figures["volume"])
        self.on_surface = _fields(figures["on_surface"])
        self.inside = _fields(figures["inside"])

    def __repr__(self):
        return f"{type(self).__name__}: area {self.area}, volume {self.volume}, genus {self.genus}"


class Measures(PieceMeasures):
    """Figures of a mesh: those of all isovalues together where there is one.

    Attributes
    ----------
    isovalues, pieces : list of PieceMeasures
        Of each isovalue, and of each connected piece of it by falling size.
    vertex_areas : numpy.ndarray, shape (n,)
        Shares of the vertices in the area: sums over them are integrals.
    piece_of : numpy.ndarray, shape (n,)
        The piece of each vertex; -1 without a triangle.
    report : dict
        Counts, milliseconds, warnings, and triangles that intersect, if looked for.
    parameters : dict
        All that they were measured with.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((20000, 3))
    >>> r = np.linalg.norm(points - 0.5, axis=1)
    >>> figures = uvol.isosurface(points, {"r": r}, iso=0.3, outside="higher").measure()
    >>> figures.genus, len(figures.pieces), bool(np.isclose(figures.vertex_areas.sum(), figures.area.value))
    (0, 1, True)
    """

    def __init__(self, isovalues, pieces, vertex_areas, piece_of, report, parameters):
        super().__init__(isovalues[0])
        self.isovalues = [PieceMeasures(figures) for figures in isovalues]
        self.pieces = [PieceMeasures(figures) for figures in pieces]
        self.vertex_areas = vertex_areas
        self.piece_of = piece_of
        self.report = report
        self.parameters = parameters


def _fields(figures):
    return {name: FieldMeasures(field["mean"], Figure(*field["integral"]), field.get("sum", float("nan")))
            for name, field in figures.items()}


def _parts(surface, what):
    """Vertices and triangles of a mesh, of a pair of these, or of points."""
    if isinstance(surface, (tuple, list)) and len(surface) == 2 and np.ndim(surface[1]) == 2:
        vertices = as_samples(surface[0], None)
        return vertices, _arrays.as_triangles(surface[1], len(vertices))
    vertices = as_samples(surface, None)
    if len(vertices) == 0:
        raise ValueError(f"{what} has no points.")
    return vertices, getattr(surface, "triangles", np.empty((0, 3), np.uint32))


@_parameters.with_proposals
def measure(surface, *, samples=None, curved=True, find_intersections=False, drop_uncertain=False, threads=0,
            progress=None):
    """Area, volume, axes, genus and integrals of fields of a surface, each with its error.

    Parameters
    ----------
    surface : Mesh, points with normals, or a pair of vertices and triangles
        For example the result of `read_mesh`. Points have no genus and no integrals inside.
    samples : Samples
        Samples to find inside of the mesh. A `Mesh` knows its samples.
    curved : bool
        Curve the triangles according to the normals of their vertices.
    find_intersections : bool
        Find triangles that intersect.
    drop_uncertain : bool
        Remove pieces whose error is as large as the piece, such as debris.
    {threads, progress}

    Returns
    -------
    Measures
        The measures of the first isovalue. Its `isovalues` has all.

    Examples
    --------
    >>> corners = uvol.Samples(np.vstack([np.zeros(3), np.eye(3)]))
    >>> figures = uvol.measure((corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> round(figures.volume.value, 6), figures.genus
    (0.166667, 0)
    """
    vertices, triangles = _parts(surface, "surface")
    if samples is None:
        samples = getattr(surface, "_samples", None) if len(triangles) else None
    else:
        samples = as_samples(samples, None)._on_map_of(vertices)
    parameters = {"curved": _parameters.flag(curved, "curved"),
                  "find_intersections": _parameters.flag(find_intersections, "find_intersections"),
                  "drop_uncertain": _parameters.flag(drop_uncertain, "drop_uncertain")}
    made_with = getattr(surface, "parameters", {})
    if "isosurface" in made_with:  # so that the samples beyond the isovalue are known, and the periodic box
        parameters.update(field=made_with["isosurface"]["field"], outside=made_with["isosurface"]["outside"],
                          periodic=made_with["periodic"])
    with listening(progress) as listener:
        figures = _core.measure(vertices._dataset, triangles, None if samples is None else samples._dataset,
                                _parameters.to_json(parameters), _parameters.count(threads, "threads"), listener)
    if not figures[0]:
        raise ValueError("None of the triangles has three different corners: there is nothing to measure.")
    _report.warn(figures[-1]["warnings"])
    known = {np.float32(value): value for value in getattr(surface, "report", {}).get("isovalues", [])}
    for figure in figures[0] + figures[1]:  # vertices have them in single precision
        figure["isovalue"] = known.get(np.float32(figure["isovalue"]), figure["isovalue"])
    return Measures(*figures, _parameters.take(figures[-1]))


class FieldDifference(NamedTuple):
    """How much a field differs between two surfaces.

    Examples
    --------
    >>> triangles = [[0, 1, 2]]
    >>> low, high = (uvol.Samples(np.eye(3), {"T": values}) for values in ([1.0, 1.0, 1.0], [1.5, 1.5, 1.5]))
    >>> uvol.compare((low, triangles), (high, triangles)).forth.fields["T"]
    FieldDifference(mean=0.5, largest=0.5)
    """

    mean: float  #: of the absolute difference, by area, in units of the field
    largest: float  #: absolute difference


class Distances:
    """Distances of all points of a surface to another one, units of length.

    Attributes
    ----------
    mean, root_mean_square : float
        By area, or by points where there are no triangles.
    percentile_99_9, largest : float
        All but a thousandth of the surface lies no farther away; all of it.
    farthest : numpy.ndarray, shape (3,)
        The place that is so far away.
    fields : dict of str to FieldDifference
        Of fields that both have.
    at_vertices : numpy.ndarray of float32, shape (n,)
        Negative inside, where triangles tell.

    Examples
    --------
    >>> triangles = [[0, 1, 2]]
    >>> low, high = np.eye(3) * [1, 1, 0], np.eye(3) * [1, 1, 0] + [0, 0, 0.25]
    >>> forth = uvol.compare((low, triangles), (high, triangles)).forth
    >>> forth, forth.at_vertices.shape
    (Distances: mean 0.25, largest 0.25, (3,))
    """

    def __init__(self, found):
        for name in ("mean", "root_mean_square", "percentile_99_9", "largest", "farthest", "at_vertices"):
            setattr(self, name, found[name])
        self.fields = {name: FieldDifference(*figures) for name, figures in found["fields"].items()}

    def __repr__(self):
        return f"Distances: mean {self.mean:.3g}, largest {self.largest:.3g}"


class Comparison:
    """Distances between two surfaces.

    Attributes
    ----------
    forth, back : Distances
        From the first surface to the second one, and back.
    largest : float
        Largest distance of both ways: the Hausdorff distance.
    surface : Samples
        The vertices of the first surface with the field `distance` to the second one.

    Examples
    --------
    >>> triangles = [[0, 1, 2]]
    >>> low, high = np.eye(3) * [1, 1, 0], np.eye(3) * [1, 1, 0] + [0, 0, 0.25]
    >>> uvol.compare((low, triangles), (high, triangles))
    Comparison: mean distances 0.25 and 0.25, largest 0.25
    """

    def __init__(self, forth, back, surface):
        self.forth = forth
        self.back = back
        self.largest = max(forth.largest, back.largest)
        self.surface = surface

    def __repr__(self):
        return f"Comparison: mean distances {self.forth.mean:.3g} and {self.back.mean:.3g}, largest {self.largest:.3g}"


@_parameters.with_proposals
def compare(a, b, *, threads=0, progress=None):
    """Measure the distances between two surfaces, both ways, and the differences of their common fields.

    Parameters
    ----------
    a, b : Mesh, Surface, Samples, or a pair of vertices and triangles
        For example the result of `read_mesh`. Distances to a surface without triangles are measured
        to its points, so they are limited by the point spacing.
    {threads, progress}

    Returns
    -------
    Comparison

    Examples
    --------
    >>> triangles = [[0, 1, 2]]
    >>> low, high = np.eye(3) * [1, 1, 0], np.eye(3) * [1, 1, 0] + [0, 0, 0.25]
    >>> found = uvol.compare((low, triangles), (high, triangles))
    >>> found.largest, found.surface["distance"].tolist()
    (0.25, [-0.25, -0.25, -0.25])
    """
    (first, first_triangles), (second, second_triangles) = _parts(a, "a"), _parts(b, "b")
    second = second._on_map_of(first)
    with listening(progress) as listener:
        forth, back, surface, warnings = _core.compare(first._dataset, first_triangles, second._dataset,
                                                       second_triangles, _parameters.count(threads, "threads"), listener)
    _report.warn(warnings)
    return Comparison(Distances(forth), Distances(back), Samples._of(surface))
