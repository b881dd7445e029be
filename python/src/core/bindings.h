// SPDX-License-Identifier: BSD-3-Clause
// The parts of the extension _core: each adds its classes and functions to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace pcl_uvol::python {

/** \brief From exceptions of the library to Python's. */
void
bindErrors(pybind11::module_& module);

void
bindDataset(pybind11::module_& module);

void
bindBoxes(pybind11::module_& module);

void
bindIsosurface(pybind11::module_& module);

void
bindInterpolation(pybind11::module_& module);

void
bindSurfaceStages(pybind11::module_& module);

void
bindClusterStages(pybind11::module_& module);

void
bindSamplingStages(pybind11::module_& module);

void
bindMeasures(pybind11::module_& module);

} // namespace pcl_uvol::python
