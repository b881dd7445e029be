// SPDX-License-Identifier: BSD-3-Clause
#include "common/scalar_field.h"
#include "filters/cell_locator.h"
#include "io/files.h"
#include "io/hdf5_names.h"
#include "io_vtk/cell_centers.h"
#include "io_vtk/entries.h"
#include "io_vtk/packed_cells.h"
#include "io_vtk/sample_topology.h"
#include "io_vtk/vtk_data_reader.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

namespace pcl_uvol {
namespace io {

namespace {

vtkSmartPointer<vtkPoints>
takePlaces(const CloudView& samples, std::size_t first, std::size_t count)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const float* const place = samples.xyz(first + i);
    points->SetPoint(static_cast<vtkIdType>(i), place[0], place[1], place[2]);
  }
  return points;
}

/** Points that PLOT3D's `iblank` counts out are no corners. */
void
blankPoints(const CloudView& samples, std::size_t first, vtkStructuredGrid& grid)
{
  constexpr const char* name = "iblank";
  if (!findField(samples.fields, name))
    return;
  const ScalarField blanking(samples.fields, name);
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i)
    if (blanking.read(samples.point(first + static_cast<std::size_t>(i))) == 0.0)
      grid.BlankPoint(i);
}

SolidCells
makeLattices(const CloudView& samples, const SampleTopology& topology)
{
  std::vector<SolidCells> parts;
  std::size_t first = 0;
  for (const auto& sizes : topology.lattices) {
    const std::size_t count = sizes[0] * sizes[1] * sizes[2];
    vtkNew<vtkStructuredGrid> grid;
    grid->SetDimensions(static_cast<int>(sizes[0]),
                        static_cast<int>(sizes[1]),
                        static_cast<int>(sizes[2]));
    grid->SetPoints(takePlaces(samples, first, count));
    blankPoints(samples, first, *grid);
    parts.push_back(takeSolidCells(*grid));
    first += count;
  }
  return joinSolidCells(parts);
}

/** Corners of a solid cell of VTK's types; 0 for other cells, and those whose faces
 * would have to be known. */
std::uint64_t
countCorners(unsigned char type)
{
  switch (type) {
  case VTK_TETRA:
    return 4;
  case VTK_PYRAMID:
    return 5;
  case VTK_WEDGE:
    return 6;
  case VTK_VOXEL:
  case VTK_HEXAHEDRON:
    return 8;
  case VTK_PENTAGONAL_PRISM:
  case VTK_QUADRATIC_TETRA:
    return 10;
  case VTK_HEXAGONAL_PRISM:
    return 12;
  case VTK_QUADRATIC_PYRAMID:
    return 13;
  case VTK_QUADRATIC_WEDGE:
    return 15;
  case VTK_QUADRATIC_HEXAHEDRON:
    return 20;
  case VTK_TRIQUADRATIC_HEXAHEDRON:
    return 27;
  default:
    return 0;
  }
}

/** \throws IOError for a cell that has another number of corners than its type */
SolidCells
makeListed(const std::string& path,
           const CloudView& samples,
           const SampleTopology& topology)
{
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < topology.types.size(); ++i) {
    const std::uint64_t end = topology.ends[i];
    const std::uint64_t corners = countCorners(topology.types[i]);
    if (corners == 0) {
      begin = end;
      continue;
    }
    if (corners != end - begin)
      throwUnreadable(path, {"wrong_count", "a cell", end - begin, "corners", corners});
    cells->InsertNextCell(static_cast<int>(end - begin));
    for (; begin < end; ++begin)
      cells->InsertCellPoint(static_cast<vtkIdType>(topology.corners[begin]));
    types->InsertNextValue(topology.types[i]);
  }
  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->SetPoints(takePlaces(samples, 0, samples.count));
  mesh->SetCells(types, cells);
  checkCells(path, *mesh);
  return takeSolidCells(*mesh);
}

/** \return null where the samples are not those of the file, or it has no such cells */
std::shared_ptr<const detail::SampleCells>
makeCells(const std::string& path,
          const SampleTopology& topology,
          const CloudView& samples)
{
  if (topology.points != samples.count || samples.count == 0)
    return nullptr;
  const SolidCells cells = topology.lattices.empty()
                               ? makeListed(path, samples, topology)
                               : makeLattices(samples, topology);
  if (cells.mesh->GetNumberOfCells() == 0)
    return nullptr;
  return std::make_shared<const CellLocator>(cells.mesh,
                                             CellLocator::Samples::Corners,
                                             samples.count,
                                             std::array<double, 3>{});
}

} // namespace

std::shared_ptr<const detail::SampleCells>
readCells(const std::string& path, const LoadOptions& options, const Dataset& samples)
{
  if (isPlot3d(path)) {
    SampleTopology topology;
    topology.lattices = readPlot3dSizes(path);
    for (const auto& sizes : topology.lattices)
      topology.points += sizes[0] * sizes[1] * sizes[2];
    return makeCells(path, topology, viewOf(samples.cloud));
  }
  if (getEnding(splitHdf5Name(path).file) == ".vtkhdf")
    return makeCells(path, readVtkHdfTopology(path), viewOf(samples.cloud));
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
