# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces straight from unstructured point-based volume data.

Samples of fields at scattered points go in as arrays or files; isosurfaces with normals
and all fields, meshes, level sets, interpolated values and pictures come out.
"""

from ._bridges import from_vtk
from ._errors import DivergedError, FieldError, ResultWarning
from ._files import read, read_volume, write
from ._interpolation import Answers, Interpolator
from ._lattice import Lattice
from ._pictures import Picture
from ._samples import Samples
from ._stages import (Clusters, Projection, VoronoiGrid, cluster, info, level_set, normals, project,
                      splats, voronoi)
from ._surface import Extractor, Mesh, Surface, isosurface

__all__ = [
    "Answers",
    "Clusters",
    "DivergedError",
    "Extractor",
    "FieldError",
    "Interpolator",
    "Lattice",
    "Mesh",
    "Picture",
    "Projection",
    "ResultWarning",
    "Samples",
    "Surface",
    "VoronoiGrid",
    "cluster",
    "from_vtk",
    "info",
    "isosurface",
    "level_set",
    "normals",
    "project",
    "read",
    "read_volume",
    "splats",
    "voronoi",
    "write",
]
