// SPDX-License-Identifier: BSD-3-Clause
// The extension _core: everything but files, without VTK. Its face is for the Python
// files beside it, not for users.
#include "core/bindings.h"

PYBIND11_MODULE(_core, module)
{
  using namespace pcl_uvol::python;
  module.attr("__version__") = PCL_UVOL_VERSION;
  bindErrors(module);
  bindDataset(module);
  bindBoxes(module);
  bindIsosurface(module);
  bindInterpolation(module);
  bindSurfaceStages(module);
  bindClusterStages(module);
  bindSamplingStages(module);
  bindMeasures(module);
}
