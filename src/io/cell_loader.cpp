// SPDX-License-Identifier: BSD-3-Clause
#include "io/cell_loader.h"

#include "io/files.h"
#include "io/hdf5_names.h"
#include "io/unpacked_file.h"
#include "io/vtk_library.h"
#include <pcl_uvol/common/map_projection.h>

namespace pcl_uvol {

namespace {

bool
hasCells(const std::string& path, const LoadOptions& options)
{
  const io::FileFormat format = io::findFormat(path, options);
  return (format == io::FileFormat::Vtk && io::getEnding(path) != ".vtp") ||
         format == io::FileFormat::Plot3d ||
         io::getEnding(io::splitHdf5Name(path).file) == ".vtkhdf";
}

} // namespace

std::shared_ptr<const detail::SampleCells>
loadCells(const std::string& path, const LoadOptions& options, const Dataset& samples)
{
  if (!hasCells(path, options) || io::isPacked(path) || io::isStandardStream(path) ||
      findMap(samples))
    return nullptr;
  return io::reading(
      path, [&] { return io::vtkLibrary().readCells(path, options, samples); });
}

std::shared_ptr<const detail::SampleCells>
findCells(const std::string& path,
          const LoadOptions& options,
          const Dataset& samples,
          Report& report)
{
  try {
    return loadCells(path, options, samples);
  }
  catch (const IOError& error) {
    report.warn("cells_not_used", {{"reason", error.message()}});
    return nullptr;
  }
}

} // namespace pcl_uvol
