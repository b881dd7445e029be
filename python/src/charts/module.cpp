// SPDX-License-Identifier: BSD-3-Clause
// The extension _charts: pictures with what explains them, written by VTK's letters,
// plots, and web pages.
#include "charts/bindings.h"

PYBIND11_MODULE(_charts, module)
{
  using namespace pcl_uvol::python;
  pybind11::module_::import("pcl_uvol._core"); // the dataset's class
  bindPictures(module);
  bindScenes(module);
  bindPages(module);
  bindPlots(module);
}
