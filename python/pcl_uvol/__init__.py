# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces straight from unstructured point-based volume data.

Samples of fields at scattered points go in as arrays or files; isosurfaces with normals
and all fields, meshes, level sets, interpolated values and pictures come out.
"""

from ._errors import DivergedError, FieldError, ResultWarning
from ._samples import Samples
from ._surface import Extractor, Mesh, Surface, isosurface

__all__ = [
    "DivergedError",
    "Extractor",
    "FieldError",
    "Mesh",
    "ResultWarning",
    "Samples",
    "Surface",
    "isosurface",
]
