// SPDX-License-Identifier: BSD-3-Clause
// The parts of the extension _charts: each adds its classes and functions to the
// module.
#pragma once

#include <pybind11/pybind11.h>

namespace pcl_uvol::python {

void
bindPictures(pybind11::module_& module);

void
bindScenes(pybind11::module_& module);

void
bindPages(pybind11::module_& module);

void
bindPlots(pybind11::module_& module);

} // namespace pcl_uvol::python
