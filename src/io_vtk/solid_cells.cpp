// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/solid_cells.h"

#include "filters/cell_locator.h"
#include "io/files.h"
#include "io_vtk/cell_centers.h"

#include <vtkAppendFilter.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>

namespace pcl_uvol {
namespace io {
namespace {

constexpr const char* solid_axes[] = {"x", "y", "z"};

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
takeSolidCells(vtkDataSet& data)
{
  if (const auto lattice = keepLattice(data))
    return {lattice, data.GetNumberOfCells()};
  return SolidCollector(data).collect();
}

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
    const std::array<vtkSmartPointer<vtkDataArray>, 3> axes{
        x, arrays.GetArray("y"), arrays.GetArray("z")};
    int sizes[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      sizes[axis] = static_cast<int>(axes[axis]->GetNumberOfTuples());
    cells.mesh = makeGrid(sizes, axes);
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
