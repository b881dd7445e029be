// SPDX-License-Identifier: BSD-3-Clause
#include "io/cell_loader.h"

#include "filters/cell_locator.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/unpacked_file.h"
#include "io_vtk/solid_cells.h"
#include "io_vtk/vtk_data_reader.h"

#include <vtkDataSet.h>

namespace pcl_uvol {

std::shared_ptr<const detail::SampleCells>
loadCells(const std::string& path, const LoadOptions& options, const Dataset& samples)
{
  const bool is_read = io::findFormat(path, options) == io::FileFormat::Vtk &&
                       io::getEnding(path) != ".vtp" && !io::isPacked(path) &&
                       !io::isStandardStream(path);
  if (!is_read)
    return nullptr;
  const io::SolidCells cells =
      io::reading(path, [&] { return io::readSolidCells(path); });
  if (!cells.mesh || cells.mesh->GetNumberOfCells() == 0)
    return nullptr;
  const bool are_centers = options.cells || io::hasCellsOnly(path);
  const auto count = static_cast<std::size_t>(
      are_centers ? cells.samples : cells.mesh->GetNumberOfPoints());
  return std::make_shared<const CellLocator>(
      cells.mesh,
      are_centers ? CellLocator::Samples::Centers : CellLocator::Samples::Corners,
      count,
      samples.origin);
}

} // namespace pcl_uvol
