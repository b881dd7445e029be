// SPDX-License-Identifier: BSD-3-Clause
#include "filters/cell_locator.h"
#include "io_vtk/entries.h"
#include "io_vtk/packed_cells.h"
#include "io_vtk/vtk_data_reader.h"

#include <vtkDataSet.h>

namespace pcl_uvol {
namespace io {

std::shared_ptr<const detail::SampleCells>
readCells(const std::string& path, const LoadOptions& options, const Dataset& samples)
{
  const SolidCells cells = readSolidCells(path);
  if (!cells.mesh || cells.mesh->GetNumberOfCells() == 0)
    return nullptr;
  const bool are_centers = options.cells || hasCellsOnly(path);
  const auto count = static_cast<std::size_t>(
      are_centers ? cells.samples : cells.mesh->GetNumberOfPoints());
  return std::make_shared<const CellLocator>(
      cells.mesh,
      are_centers ? CellLocator::Samples::Centers : CellLocator::Samples::Corners,
      count,
      samples.origin);
}

} // namespace io
} // namespace pcl_uvol
