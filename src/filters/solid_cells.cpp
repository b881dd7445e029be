// SPDX-License-Identifier: BSD-3-Clause
#include "filters/solid_cells.h"

#include "filters/cell_locator.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>

namespace pcl_uvol {
namespace {

/** The type of a lattice's cells that lie in space. */
bool
isSolid(const int (&counts)[3])
{
  return counts[0] > 1 && counts[1] > 1 && counts[2] > 1;
}

vtkSmartPointer<vtkPoints>
copyPoints(vtkDataSet& data)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(data.GetNumberOfPoints());
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    points->SetPoint(i, data.GetPoint(i));
  return points;
}

vtkSmartPointer<vtkRectilinearGrid>
makeGrid(const int (&counts)[3],
         const std::array<vtkSmartPointer<vtkDataArray>, 3>& axes)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(counts);
  grid->SetXCoordinates(axes[0]);
  grid->SetYCoordinates(axes[1]);
  grid->SetZCoordinates(axes[2]);
  return grid;
}

/** An image along the axes as a grid with a coordinate per plane. */
vtkSmartPointer<vtkRectilinearGrid>
toGrid(vtkImageData& image)
{
  int counts[3];
  image.GetDimensions(counts);
  std::array<vtkSmartPointer<vtkDataArray>, 3> axes;
  for (int axis = 0; axis < 3; ++axis) {
    axes[static_cast<std::size_t>(axis)] = vtkSmartPointer<vtkDoubleArray>::New();
    for (int i = 0; i < counts[axis]; ++i)
      axes[static_cast<std::size_t>(axis)]->InsertNextTuple1(
          image.GetOrigin()[axis] +
          image.GetSpacing()[axis] * (image.GetExtent()[2 * axis] + i));
  }
  return makeGrid(counts, axes);
}

/** A lattice that is kept as such, or null. */
vtkSmartPointer<vtkDataSet>
keepLattice(vtkDataSet& data)
{
  if (data.GetCellGhostArray() != nullptr || data.GetPointGhostArray() != nullptr)
    return nullptr;
  int counts[3];
  if (auto* const image = vtkImageData::SafeDownCast(&data)) {
    image->GetDimensions(counts);
    const double* const spacing = image->GetSpacing();
    const bool ascends = spacing[0] > 0.0 && spacing[1] > 0.0 && spacing[2] > 0.0;
    return isSolid(counts) && ascends && image->GetDirectionMatrix()->IsIdentity()
               ? toGrid(*image)
               : nullptr;
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(&data)) {
    grid->GetDimensions(counts);
    if (!isSolid(counts))
      return nullptr;
    return makeGrid(
        counts,
        {grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()});
  }
  if (auto* const grid = vtkStructuredGrid::SafeDownCast(&data)) {
    grid->GetDimensions(counts);
    if (!isSolid(counts))
      return nullptr;
    auto kept = vtkSmartPointer<vtkStructuredGrid>::New();
    kept->SetDimensions(counts);
    kept->SetPoints(grid->GetPoints());
    return kept;
  }
  return nullptr;
}

/** Takes one cell after another. */
class SolidCollector {
public:
  explicit SolidCollector(vtkDataSet& data)
      : data_(data)
      , ghosts_(data.GetCellGhostArray())
      , hidden_(data.GetPointGhostArray())
  {
    samples_->SetName(CellLocator::sample_array);
  }

  SolidCells
  collect()
  {
    vtkIdType sample = 0;
    for (vtkIdType i = 0; i < data_.GetNumberOfCells(); ++i) {
      if (ghosts_ && isLeftOut(ghosts_->GetValue(i)))
        continue;
      data_.GetCell(i, cell_);
      if (cell_->GetCellDimension() == 3 && isVisible())
        add(sample);
      ++sample;
    }
    auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
    mesh->SetPoints(copyPoints(data_));
    mesh->SetCells(types_, cells_);
    mesh->GetCellData()->AddArray(samples_);
    return {mesh, sample};
  }

private:
  bool
  isVisible() const
  {
    vtkIdList& corners = *cell_->GetPointIds();
    for (vtkIdType i = 0; hidden_ && i < corners.GetNumberOfIds(); ++i)
      if ((hidden_->GetValue(corners.GetId(i)) & vtkDataSetAttributes::HIDDENPOINT) !=
          0)
        return false;
    return true;
  }

  void
  addCell(int type, vtkIdType count, const vtkIdType* corners, vtkIdType sample)
  {
    cells_->InsertNextCell(count, corners);
    types_->InsertNextValue(static_cast<unsigned char>(type));
    samples_->InsertNextValue(sample);
  }

  void
  add(vtkIdType sample)
  {
    if (cell_->GetCellType() < VTK_CONVEX_POINT_SET)
      return addCell(cell_->GetCellType(),
                     cell_->GetNumberOfPoints(),
                     cell_->GetPointIds()->GetPointer(0),
                     sample);
    cell_->Triangulate(0, corners_, places_);
    for (vtkIdType i = 0; i + 4 <= corners_->GetNumberOfIds(); i += 4)
      addCell(VTK_TETRA, 4, corners_->GetPointer(i), sample);
  }

  vtkDataSet& data_;
  vtkUnsignedCharArray *ghosts_, *hidden_;
  vtkNew<vtkGenericCell> cell_;
  vtkNew<vtkIdList> corners_;
  vtkNew<vtkPoints> places_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkUnsignedCharArray> types_;
  vtkNew<vtkIdTypeArray> samples_;
};

} // namespace

bool
isLeftOut(unsigned char ghost)
{
  return (ghost &
          (vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
           vtkDataSetAttributes::HIDDENCELL)) != 0;
}

SolidCells
takeSolidCells(vtkDataSet& data)
{
  if (const auto lattice = keepLattice(data))
    return {lattice, data.GetNumberOfCells()};
  return SolidCollector(data).collect();
}

} // namespace pcl_uvol
