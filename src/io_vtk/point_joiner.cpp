// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/point_joiner.h"

#include "common/printable.h"
#include "io/files.h"
#include "io_vtk/cell_centers.h"

#include <vtkAMRUtilities.h>
#include <vtkAppendFilter.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkHyperTreeGrid.h>
#include <vtkNew.h>
#include <vtkOverlappingAMR.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace pcl_uvol {
namespace io {
namespace {

/** Points and their data, without the cells. */
vtkSmartPointer<vtkPolyData>
takePoints(vtkDataSet& data)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(data.GetNumberOfPoints());
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    double place[3];
    data.GetPoint(i, place);
    points->SetPoint(i, place);
  }
  result->SetPoints(points);
  result->GetPointData()->ShallowCopy(data.GetPointData());
  return result;
}

} // namespace

PointJoiner::PointJoiner(const std::string& path, DataPlace place)
    : path_(path)
    , place_(place)
{
}

void
PointJoiner::add(vtkDataObject& object)
{
  if (auto* const data = vtkDataSet::SafeDownCast(&object)) {
    if (place_ == DataPlace::Points)
      return addPoints(*takePoints(*data));
    // Cells are asked of data, not of points that are left.
    checkCells(path_, *data);
    if (place_ == DataPlace::Cells)
      return addPoints(*takeCellCenters(*data));
    if (data->GetNumberOfPoints() > 0)
      solids_.push_back(takeSolidCells(*data));
    return;
  }
  if (auto* const trees = vtkHyperTreeGrid::SafeDownCast(&object)) {
    if (place_ != DataPlace::Solids)
      addPoints(*takeCellCenters(*trees));
    return;
  }
  if (auto* const levels = vtkOverlappingAMR::SafeDownCast(&object))
    vtkAMRUtilities::BlankCells(levels);
  if (auto* const blocks = vtkCompositeDataSet::SafeDownCast(&object)) {
    const auto iterator =
        vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal();
         iterator->GoToNextItem())
      if (vtkDataObject* const block = iterator->GetCurrentDataObject())
        add(*block);
  }
}

void
PointJoiner::addPoints(vtkPolyData& points)
{
  if (points.GetNumberOfPoints() == 0)
    return;
  vtkPointData& data = *points.GetPointData();
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (const char* const name = data.GetArrayName(i))
      names_.insert(name);
  blocks_.emplace_back(&points);
}

VtkContent
PointJoiner::join() const
{
  if (isEmpty())
    throwUnreadable(
        path_, {"nothing_inside", place_ == DataPlace::Points ? "points" : "cells"});
  if (place_ == DataPlace::Solids)
    return {packCells(joinSolidCells(solids_)), {}};
  vtkNew<vtkAppendFilter> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const auto& block : blocks_)
    append->AddInputData(block);
  append->Update();
  VtkContent content{append->GetOutput(), {}};
  content.data->GetFieldData()->Initialize(); // of the file, which nobody asks for
  for (const std::string& name : names_)
    if (content.data->GetPointData()->HasArray(name.c_str()) == 0)
      content.notes.push_back({"field_of_some_parts", {{"field", shortenText(name)}}});
  return content;
}

} // namespace io
} // namespace pcl_uvol
