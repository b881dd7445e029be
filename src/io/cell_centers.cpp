// SPDX-License-Identifier: BSD-3-Clause
#include "io/cell_centers.h"

#include <vtkCellCenters.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

namespace pcl_uvol {
namespace io {
namespace {

constexpr unsigned char left_out = vtkDataSetAttributes::DUPLICATECELL |
                                   vtkDataSetAttributes::REFINEDCELL |
                                   vtkDataSetAttributes::HIDDENCELL;

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
    if ((ghosts->GetValue(i) & left_out) == 0)
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
