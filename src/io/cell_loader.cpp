// SPDX-License-Identifier: BSD-3-Clause
#include "io/cell_loader.h"

#include "io/files.h"
#include "io/unpacked_file.h"
#include "io/vtk_library.h"
#include <pcl_uvol/common/map_projection.h>

namespace pcl_uvol {

std::shared_ptr<const detail::SampleCells>
loadCells(const std::string& path, const LoadOptions& options, const Dataset& samples)
{
  const bool is_read = io::findFormat(path, options) == io::FileFormat::Vtk &&
                       io::getEnding(path) != ".vtp" && !io::isPacked(path) &&
                       !io::isStandardStream(path) && !findMap(samples);
  if (!is_read)
    return nullptr;
  return io::reading(
      path, [&] { return io::vtkLibrary().readCells(path, options, samples); });
}

} // namespace pcl_uvol
