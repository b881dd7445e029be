// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/packed_cells.h"

#include "filters/cell_locator.h"
#include "io/files.h"
#include "io_vtk/cell_centers.h"

#include <vtkAppendFilter.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>

namespace pcl_uvol {
namespace io {
namespace {

constexpr const char* solid_axes[] = {"x", "y", "z"};

vtkSmartPointer<vtkIdTypeArray>
toIds(vtkDataArray& array, const char* name)
{
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->DeepCopy(&array);
  ids->SetName(name);
  return ids;
}

vtkSmartPointer<vtkIdTypeArray>
makeIds(const char* name, std::initializer_list<vtkIdType> numbers)
{
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetName(name);
  for (const vtkIdType number : numbers)
    ids->InsertNextValue(number);
  return ids;
}

/** The samples of cells, which other meshes come before.
 * \param first of these samples */
void
numberSamples(vtkDataSet& mesh, vtkIdType first)
{
  const vtkSmartPointer<vtkIdTypeArray> before = vtkIdTypeArray::SafeDownCast(
      mesh.GetCellData()->GetArray(CellLocator::sample_array));
  vtkNew<vtkIdTypeArray> samples;
  samples->SetName(CellLocator::sample_array);
  for (vtkIdType i = 0; i < mesh.GetNumberOfCells(); ++i)
    samples->InsertNextValue(first + (before ? before->GetValue(i) : i));
  mesh.GetCellData()->AddArray(samples);
}

} // namespace

SolidCells
joinSolidCells(const std::vector<SolidCells>& parts)
{
  if (parts.empty())
    return {};
  if (parts.size() == 1)
    return parts.front();
  vtkNew<vtkAppendFilter> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkIdType samples = 0;
  for (const SolidCells& part : parts) {
    numberSamples(*part.mesh, samples);
    samples += part.samples;
    append->AddInputData(part.mesh);
  }
  append->Update();
  return {append->GetOutput(), samples};
}

vtkSmartPointer<vtkPolyData>
packCells(const SolidCells& cells)
{
  auto packed = vtkSmartPointer<vtkPolyData>::New();
  packed->SetPoints(vtkNew<vtkPoints>());
  vtkFieldData& arrays = *packed->GetFieldData();
  arrays.AddArray(makeIds("samples", {cells.samples}));
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(cells.mesh)) {
    vtkDataArray* const axes[] = {
        grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vtkNew<vtkDoubleArray> named;
      named->DeepCopy(axes[axis]);
      named->SetName(solid_axes[axis]);
      arrays.AddArray(named);
    }
    return packed;
  }
  packed->SetPoints(vtkPointSet::SafeDownCast(cells.mesh)->GetPoints());
  if (auto* const grid = vtkStructuredGrid::SafeDownCast(cells.mesh)) {
    int counts[3];
    grid->GetDimensions(counts);
    arrays.AddArray(makeIds("counts", {counts[0], counts[1], counts[2]}));
    return packed;
  }
  auto& mesh = *vtkUnstructuredGrid::SafeDownCast(cells.mesh);
  mesh.GetCellTypesArray()->SetName("types");
  arrays.AddArray(mesh.GetCellTypesArray());
  arrays.AddArray(toIds(*mesh.GetCells()->GetOffsetsArray(), "offsets"));
  arrays.AddArray(toIds(*mesh.GetCells()->GetConnectivityArray(), "corners"));
  arrays.AddArray(mesh.GetCellData()->GetArray(CellLocator::sample_array));
  return packed;
}

SolidCells
unpackCells(const std::string& path, vtkPolyData& packed)
{
  vtkFieldData& arrays = *packed.GetFieldData();
  const auto findIds = [&](const char* name) {
    return vtkIdTypeArray::SafeDownCast(arrays.GetArray(name));
  };
  vtkIdTypeArray* const samples = findIds("samples");
  if (samples == nullptr)
    return {};
  SolidCells cells{nullptr, samples->GetValue(0)};
  if (vtkIdTypeArray* const counts = findIds("counts")) {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    grid->SetDimensions(static_cast<int>(counts->GetValue(0)),
                        static_cast<int>(counts->GetValue(1)),
                        static_cast<int>(counts->GetValue(2)));
    grid->SetPoints(packed.GetPoints());
    cells.mesh = grid;
  }
  else if (vtkDataArray* const x = arrays.GetArray("x")) {
    vtkDataArray &y = *arrays.GetArray("y"), &z = *arrays.GetArray("z");
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    grid->SetDimensions(static_cast<int>(x->GetNumberOfTuples()),
                        static_cast<int>(y.GetNumberOfTuples()),
                        static_cast<int>(z.GetNumberOfTuples()));
    grid->SetXCoordinates(x);
    grid->SetYCoordinates(&y);
    grid->SetZCoordinates(&z);
    cells.mesh = grid;
  }
  else {
    auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkCellArray> list;
    list->SetData(findIds("offsets"), findIds("corners"));
    list->ConvertToSmallestStorage();
    mesh->SetPoints(packed.GetPoints());
    mesh->SetCells(vtkUnsignedCharArray::SafeDownCast(arrays.GetArray("types")), list);
    mesh->GetCellData()->AddArray(findIds(CellLocator::sample_array));
    cells.mesh = mesh;
  }
  checkCells(path, *cells.mesh);
  return cells;
}

} // namespace io
} // namespace pcl_uvol
