# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces straight from unstructured point-based volume data.

Samples of fields at scattered points go in as arrays or files; isosurfaces with normals
and all fields, meshes, level sets, interpolated values and pictures come out.
"""

from . import _described
from ._arrays import empty
from ._bridges import from_vtk
from ._core import __version__
from ._errors import DivergedError, FieldError, ResultWarning
from ._files import read, read_mesh, read_volume, write
from ._interpolation import Answers, Interpolator
from ._lattice import Lattice
from ._map import Map
from ._measures import (Comparison, Distances, FieldDifference, FieldMeasures, Figure, Measures, PieceMeasures, compare,
                        measure)
from ._pictures import Picture, raytrace
from ._samples import Samples
from ._stages import (Clusters, Projection, VoronoiGrid, cluster, info, level_set, normals, project,
                      splats, voronoi)
from ._surface import Extractor, Mesh, Surface, isosurface

__all__ = [
    "Answers",
    "Clusters",
    "Comparison",
    "Distances",
    "DivergedError",
    "Extractor",
    "FieldDifference",
    "FieldError",
    "FieldMeasures",
    "Figure",
    "Interpolator",
    "Lattice",
    "Map",
    "Measures",
    "Mesh",
    "Picture",
    "PieceMeasures",
    "Projection",
    "ResultWarning",
    "Samples",
    "Surface",
    "VoronoiGrid",
    "cluster",
    "compare",
    "empty",
    "from_vtk",
    "info",
    "isosurface",
    "level_set",
    "measure",
    "normals",
    "project",
    "raytrace",
    "read",
    "read_mesh",
    "read_volume",
    "splats",
    "voronoi",
    "write",
]

_described.complete(globals()[name] for name in __all__)
