// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk_library.h"

#include <dlfcn.h>

namespace pcl_uvol {
namespace io {
namespace {

/** It is never unloaded: VTK's objects refer to it until the program ends. */
const VtkLibrary&
loadLibrary()
{
  void* const library =
      dlopen(PCL_UVOL_VTK_LIBRARY, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  const void* const functions =
      library == nullptr ? nullptr : dlsym(library, "pcl_uvol_vtk_library");
  if (functions == nullptr)
    throw IOError("vtk_library_not_loaded", {});
  return *static_cast<const VtkLibrary*>(functions);
}

} // namespace

const VtkLibrary&
vtkLibrary()
{
  static const VtkLibrary& library = loadLibrary();
  return library;
}

} // namespace io
} // namespace pcl_uvol
