# SPDX-License-Identifier: BSD-3-Clause
"""Figures of meshes: area, volume, axes, genus, integrals of fields."""

from typing import NamedTuple

import numpy as np

from . import _core, _parameters, _report
from ._progress import listening


class Figure(NamedTuple):
    """A figure and how far from the truth it may be; NaN: not known."""

    value: float
    error: float

    def __float__(self):
        return float(self.value)


class FieldFigures(NamedTuple):
    """A field on a surface, or in what it encloses."""

    mean: float  #: by area, or by volume
    integral: Figure  #: over the area, or over the volume
    sum: float  #: over the samples inside, of masses their mass; NaN on the surface


class PieceFigures:
    """Figures of a surface or of a piece of it, in units of the coordinates.

    Attributes
    ----------
    isovalue : float
    vertices, triangles, rims, genus : int
        Rims are the closed lines along which it is open; genus counts handles.
    area, volume : Figure
        The volume is that enclosed, negative for the wall of a cavity, NaN where the
        surface is open.
    centroid : numpy.ndarray, shape (3,)
        Of the volume, or of the area where that is open.
    axes, half_axes : numpy.ndarray, shapes (3, 3) and (3,)
        Rows: principal axes, the longest first; and the half axes of the ellipsoid of
        the same second moments.
    low, high : numpy.ndarray, shape (3,)
        Bounds of the vertices.
    on_surface, inside : dict of str to FieldFigures
        By field.
    samples : int
        Samples inside.
    """

    def __init__(self, figures):
        for name in ("isovalue", "vertices", "triangles", "rims", "genus", "samples"):
            setattr(self, name, figures[name])
        for name in ("centroid", "axes", "half_axes", "low", "high"):
            setattr(self, name, np.asarray(figures[name]))
        self.area = Figure(*figures["area"])
        self.volume = Figure(*figures["volume"])
        self.on_surface = _fields(figures["on_surface"])
        self.inside = _fields(figures["inside"])

    def __repr__(self):
        return (f"{type(self).__name__}: area {self.area.value:.6g} +- {self.area.error:.2g}, "
                f"volume {self.volume.value:.6g} +- {self.volume.error:.2g}, genus {self.genus}")


class Measures(PieceFigures):
    """Figures of a mesh: those of all isovalues together where there is one.

    Attributes
    ----------
    isovalues, pieces : list of PieceFigures
        Of each isovalue, and of each connected piece of it by falling size.
    vertex_areas : numpy.ndarray, shape (n,)
        Shares of the vertices in the area: sums over them are integrals.
    piece_of : numpy.ndarray, shape (n,)
        The piece of each vertex; -1 without a triangle.
    report : dict
        Counts, milliseconds, warnings, and triangles that intersect, if looked for.
    """

    def __init__(self, isovalues, pieces, vertex_areas, piece_of, report):
        super().__init__(isovalues[0])
        self.isovalues = [PieceFigures(figures) for figures in isovalues]
        self.pieces = [PieceFigures(figures) for figures in pieces]
        self.vertex_areas = vertex_areas
        self.piece_of = piece_of
        self.report = report


def _fields(figures):
    return {name: FieldFigures(field["mean"], Figure(*field["integral"]), field.get("sum", float("nan")))
            for name, field in figures.items()}


def measure(mesh, samples, curved, find_intersections, threads, progress):
    """Figures of a mesh, see Mesh.measure."""
    parameters = {"curved": bool(curved), "find_intersections": bool(find_intersections)}
    with listening(progress) as listener:
        figures = _core.measure(mesh._dataset, mesh.triangles, None if samples is None else samples._dataset,
                                _parameters.to_json(parameters), _parameters.count(threads, "threads"), listener)
    _report.tell(figures[-1]["warnings"])
    return Measures(*figures)
