// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/cell_centers.h"

#include "filters/solid_cells.h"
#include "io/files.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellCenters.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkGenericCell.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredData.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>

namespace pcl_uvol {
namespace io {
namespace {

void
checkTuples(const std::string& path,
            vtkDataSetAttributes& data,
            vtkIdType count,
            const std::string& places)
{
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (const vtkIdType tuples = data.GetAbstractArray(i)->GetNumberOfTuples();
        tuples != count)
      throwUnreadable(
          path, {"wrong_count", "an array of its " + places, tuples, "values", count});
}

/** Corners that a cell of a type has at least, -1 for no type. */
vtkIdType
countCornersOf(int type)
{
  const auto cell =
      vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  if (!cell)
    return -1;
  // Those of any number have none yet; cells of any order say so by themselves.
  return cell->GetNumberOfPoints();
}

/** Cells whose corners are points, as many as their types need.
 * \param types null: of polygons, which may have any number */
void
checkCorners(const std::string& path,
             vtkCellArray& cells,
             vtkIdType points,
             vtkUnsignedCharArray* types)
{
  std::array<vtkIdType, 256> least{};
  for (std::size_t type = 0; type < least.size() && types; ++type)
    least[type] = countCornersOf(static_cast<int>(type));
  const vtkIdType count = cells.GetNumberOfCells();
  if (types && types->GetNumberOfTuples() != count)
    throwUnreadable(path,
                    {"wrong_count",
                     "the table of types of cells",
                     types->GetNumberOfTuples(),
                     "types",
                     count});
  const vtkIdType corners = cells.GetNumberOfConnectivityIds();
  const auto check = [&](const auto* end, const auto* id) {
    for (vtkIdType i = 0; i < count; ++i) {
      if (end[0] != 0 || end[i + 1] < end[i] || end[i + 1] > corners)
        throwUnreadable(path, {"disagreeing_parts", "the offsets of its cells"});
      if (types && least[types->GetValue(i)] < 0)
        throwUnreadable(
            path,
            {"unexpected_word", std::to_string(types->GetValue(i)), "a type of cells"});
      if (types && end[i + 1] - end[i] < least[types->GetValue(i)])
        throwUnreadable(path,
                        {"wrong_count",
                         "a cell",
                         end[i + 1] - end[i],
                         "corners",
                         std::to_string(least[types->GetValue(i)]) + " or more"});
    }
    for (vtkIdType i = 0; i < corners; ++i)
      if (id[i] < 0 || id[i] >= points)
        throwUnreadable(path, {"missing_target", "a cell", "a point"});
  };
  if (cells.IsStorage64Bit())
    check(cells.GetOffsetsArray64()->GetPointer(0),
          cells.GetConnectivityArray64()->GetPointer(0));
  else
    check(cells.GetOffsetsArray32()->GetPointer(0),
          cells.GetConnectivityArray32()->GetPointer(0));
}

/** Without the points whose cells do not count. */
vtkSmartPointer<vtkPolyData>
dropGhosts(vtkPolyData& centers)
{
  vtkPointData& data = *centers.GetPointData();
  const char* const name = vtkDataSetAttributes::GhostArrayName();
  const vtkSmartPointer<vtkUnsignedCharArray> ghosts =
      vtkUnsignedCharArray::SafeDownCast(data.GetArray(name));
  if (!ghosts)
    return &centers;
  data.RemoveArray(name);
  auto kept = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkPointData& kept_data = *kept->GetPointData();
  kept_data.CopyAllOn();
  kept_data.CopyAllocate(&data);
  for (vtkIdType i = 0; i < centers.GetNumberOfPoints(); ++i)
    if (!isLeftOut(ghosts->GetValue(i)))
      kept_data.CopyData(&data, i, points->InsertNextPoint(centers.GetPoint(i)));
  kept->SetPoints(points);
  return kept;
}

/** Goes down one tree after the other: vtkHyperTreeGridCellCenters of VTK 9.1 leaves
 * the data of cells behind. */
class LeafCollector {
public:
  explicit LeafCollector(vtkHyperTreeGrid& trees)
      : from_(*trees.GetCellData())
      , leaves_(vtkSmartPointer<vtkPolyData>::New())
  {
    points_->SetDataTypeToDouble();
    leaves_->GetPointData()->CopyAllOn();
    leaves_->GetPointData()->CopyAllocate(&from_);
  }

  void
  addBelow(vtkHyperTreeGridNonOrientedGeometryCursor& cursor)
  {
    if (cursor.IsMasked())
      return;
    if (!cursor.IsLeaf()) {
      for (unsigned char child = 0; child < cursor.GetNumberOfChildren(); ++child) {
        cursor.ToChild(child);
        addBelow(cursor);
        cursor.ToParent();
      }
      return;
    }
    double place[3];
    cursor.GetPoint(place);
    const vtkIdType point = points_->InsertNextPoint(place);
    leaves_->GetPointData()->CopyData(&from_, cursor.GetGlobalNodeIndex(), point);
  }

  vtkPolyData&
  finish()
  {
    leaves_->SetPoints(points_);
    return *leaves_;
  }

private:
  vtkCellData& from_;
  vtkNew<vtkPoints> points_;
  vtkSmartPointer<vtkPolyData> leaves_;
};

} // namespace

void
checkCells(const std::string& path, vtkDataSet& data)
{
  checkTuples(path, *data.GetPointData(), data.GetNumberOfPoints(), "points");
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(&data)) {
    vtkDataArray* const axes[] = {
        grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()};
    for (int axis = 0; axis < 3; ++axis)
      if (!axes[axis] || axes[axis]->GetNumberOfTuples() != grid->GetDimensions()[axis])
        throwUnreadable(
            path, {"disagreeing_parts", "the coordinates and the points of its grid"});
  }
  if (auto* const grid = vtkStructuredGrid::SafeDownCast(&data))
    if (grid->GetPoints()->GetNumberOfPoints() !=
        vtkStructuredData::GetNumberOfPoints(grid->GetExtent()))
      throwUnreadable(path,
                      {"disagreeing_parts", "the points and the extent of its grid"});
  const vtkIdType points = data.GetNumberOfPoints();
  if (auto* const polygons = vtkPolyData::SafeDownCast(&data))
    for (vtkCellArray* const cells : {polygons->GetVerts(),
                                      polygons->GetLines(),
                                      polygons->GetPolys(),
                                      polygons->GetStrips()})
      checkCorners(path, *cells, points, nullptr);
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data))
    checkCorners(path, *grid->GetCells(), points, grid->GetCellTypesArray());
  checkTuples(path, *data.GetCellData(), data.GetNumberOfCells(), "cells");
}

vtkSmartPointer<vtkPolyData>
takeCellCenters(vtkDataSet& data)
{
  vtkNew<vtkCellCenters> filter;
  filter->SetInputData(&data);
  filter->Update();
  return dropGhosts(*filter->GetOutput());
}

vtkSmartPointer<vtkPolyData>
takeCellCenters(vtkHyperTreeGrid& trees)
{
  LeafCollector leaves(trees);
  vtkHyperTreeGrid::vtkHyperTreeGridIterator iterator;
  trees.InitializeTreeIterator(iterator);
  vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
  vtkIdType tree = 0;
  while (iterator.GetNextTree(tree) != nullptr) {
    trees.InitializeNonOrientedGeometryCursor(cursor, tree);
    leaves.addBelow(*cursor);
  }
  return dropGhosts(leaves.finish());
}

} // namespace io
} // namespace pcl_uvol
