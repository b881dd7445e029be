// SPDX-License-Identifier: BSD-3-Clause
// From VTK's arrays to records of points and back.
#include "common/printable.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include "filters/point_arrays.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/point_data.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

using Type = pcl::PCLPointField;

constexpr const char* axis_names[] = {"x", "y", "z"};

std::uint8_t
datatypeOf(vtkDataArray& array)
{
  const auto integer = [&](bool has_sign) {
    switch (array.GetDataTypeSize()) {
    case 1:
      return has_sign ? Type::INT8 : Type::UINT8;
    case 2:
      return has_sign ? Type::INT16 : Type::UINT16;
    case 4:
      return has_sign ? Type::INT32 : Type::UINT32;
    default:
      return has_sign ? Type::INT64 : Type::UINT64;
    }
  };
  switch (array.GetDataType()) {
  case VTK_FLOAT:
    return Type::FLOAT32;
  case VTK_DOUBLE:
    return Type::FLOAT64;
  case VTK_CHAR:
  case VTK_SIGNED_CHAR:
  case VTK_SHORT:
  case VTK_INT:
  case VTK_LONG:
  case VTK_LONG_LONG:
  case VTK_ID_TYPE:
    return static_cast<std::uint8_t>(integer(true));
  default:
    return static_cast<std::uint8_t>(integer(false));
  }
}

/** The array with its numbers one behind the other in memory. */
vtkSmartPointer<vtkDataArray>
plainArray(vtkDataArray* array)
{
  const bool bits = array->GetDataType() == VTK_BIT;
  if (!bits && array->HasStandardMemoryLayout())
    return array;
  auto plain = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(bits ? VTK_UNSIGNED_CHAR : array->GetDataType()));
  plain->DeepCopy(array);
  plain->SetName(array->GetName());
  return plain;
}

vtkSmartPointer<vtkDataArray>
readCoordinates(vtkDataSet& data)
{
  auto* const set = vtkPointSet::SafeDownCast(&data);
  if (set && set->GetPoints())
    return plainArray(set->GetPoints()->GetData());
  vtkNew<vtkPoints> lattice; // which computes its points
  lattice->SetDataTypeToDouble();
  lattice->SetNumberOfPoints(data.GetNumberOfPoints());
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    double point[3];
    data.GetPoint(i, point);
    lattice->SetPoint(i, point);
  }
  return lattice->GetData();
}

/** Coordinates and point data of a data set, one array after another. */
class PointCollector {
public:
  explicit PointCollector(vtkDataSet& data)
      : data_(data)
  {
  }

  PointArrays
  collect();

private:
  void
  addCoordinates();
  void
  addPointData();
  void
  addNumbers(const std::string& name, vtkDataArray& array);
  void
  append(const std::string& name, vtkDataArray& array, std::size_t count);

  vtkDataSet& data_;
  PointArrays result_;
  RecordInfo info_;
  std::vector<vtkSmartPointer<vtkDataArray>> columns_;
};

void
PointCollector::append(const std::string& name, vtkDataArray& array, std::size_t count)
{
  appendField(info_.fields, name, datatypeOf(array), count);
}

void
PointCollector::addCoordinates()
{
  columns_.push_back(readCoordinates(data_));
  for (const char* const axis : axis_names)
    append(axis, *columns_.back(), 1);
}

void
PointCollector::addNumbers(const std::string& name, vtkDataArray& array)
{
  const std::size_t first = info_.fields.size();
  columns_.push_back(plainArray(&array));
  vtkDataArray& plain = *columns_.back();
  if (&array == data_.GetPointData()->GetNormals())
    for (const char* const axis : normal_names)
      append(axis, plain, 1);
  else {
    const bool taken = axisOf(name) >= 0 || name == "_";
    if (taken)
      info_.notes.push_back(
          {"renamed_array",
           {{"array", shortenText(name)}, {"name", shortenText(name + "_2")}}});
    append(taken ? name + "_2" : name,
           plain,
           static_cast<std::size_t>(plain.GetNumberOfComponents()));
  }
  result_.numbers.push_back({&array, first, info_.fields.size() - first});
}

void
PointCollector::addPointData()
{
  vtkPointData& point_data = *data_.GetPointData();
  for (int i = 0; i < point_data.GetNumberOfArrays(); ++i) {
    vtkAbstractArray* const array = point_data.GetAbstractArray(i);
    std::string name = array->GetName() ? array->GetName() : "";
    if (name.empty())
      name = "array_" + std::to_string(i);
    auto* const numbers = vtkDataArray::SafeDownCast(array);
    if (array->GetNumberOfTuples() != data_.GetNumberOfPoints() ||
        array->GetNumberOfComponents() < 1)
      info_.notes.push_back({"unfitting_array",
                             {{"array", shortenText(name)},
                              {"tuples", array->GetNumberOfTuples()},
                              {"points", data_.GetNumberOfPoints()}}});
    else if (numbers)
      addNumbers(name, *numbers);
    else
      result_.others.emplace_back(array);
  }
  if (point_data.GetNumberOfArrays() == 0 &&
      data_.GetCellData()->GetNumberOfArrays() > 0)
    info_.notes.push_back({"cell_data_left_out", {}});
}

/** Names of the data of cells. */
std::vector<std::string>
listCellFields(vtkDataSet& data)
{
  vtkCellData& cells = *data.GetCellData();
  std::vector<std::string> names;
  for (int i = 0; i < cells.GetNumberOfArrays(); ++i)
    if (const char* const name = cells.GetArrayName(i);
        name && *name != '\0' &&
        std::string(name) != vtkDataSetAttributes::GhostArrayName())
      names.emplace_back(name);
  return names;
}

PointArrays
PointCollector::collect()
{
  addCoordinates();
  addPointData();
  if (!vtkPointSet::SafeDownCast(&data_))
    info_.double_coordinates = false; // those of a lattice were computed here
  auto records =
      makeRecords(info_.fields, static_cast<std::uint64_t>(data_.GetNumberOfPoints()));
  std::size_t offset = 0;
  for (const auto& array : columns_) {
    const std::size_t bytes = static_cast<std::size_t>(array->GetDataTypeSize()) *
                              static_cast<std::size_t>(array->GetNumberOfComponents());
    const auto* from = static_cast<const std::uint8_t*>(array->GetVoidPointer(0));
    for (std::size_t i = 0; i < records.width; ++i)
      std::memcpy(
          &records.data[i * records.point_step + offset], from + i * bytes, bytes);
    offset += bytes;
  }
  result_.dataset = makeDataset(std::move(records), info_);
  result_.dataset.cell_fields = listCellFields(data_);
  return std::move(result_);
}

int
vtkTypeOf(std::uint8_t datatype)
{
  switch (datatype) {
  case Type::INT8:
    return VTK_TYPE_INT8;
  case Type::INT16:
    return VTK_TYPE_INT16;
  case Type::UINT16:
    return VTK_TYPE_UINT16;
  case Type::INT32:
    return VTK_TYPE_INT32;
  case Type::UINT32:
    return VTK_TYPE_UINT32;
  case Type::INT64:
    return VTK_TYPE_INT64;
  case Type::UINT64:
    return VTK_TYPE_UINT64;
  case Type::FLOAT32:
    return VTK_TYPE_FLOAT32;
  case Type::FLOAT64:
    return VTK_TYPE_FLOAT64;
  default: // UINT8, BOOL
    return VTK_TYPE_UINT8;
  }
}

/** Fills the components of one field in all tuples. */
void
fillTuples(const Dataset& dataset,
           const pcl::PCLPointField& field,
           std::uint8_t* to,
           std::size_t tuple_bytes)
{
  const auto& cloud = dataset.cloud;
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  const int axis = axisOf(field.name);
  const bool widened = axis >= 0 && field.datatype == Type::FLOAT64;
  const double origin = widened ? dataset.origin[static_cast<std::size_t>(axis)] : 0.0;
  const std::size_t bytes = fieldBytes(field);
  const std::uint8_t* from = cloud.data.data() + field.offset;
  for (std::size_t i = 0; i < count; ++i) {
    if (widened) {
      float relative;
      std::memcpy(&relative, from, sizeof(relative));
      const double value = origin + relative;
      std::memcpy(to, &value, sizeof(value));
    }
    else
      std::memcpy(to, from, bytes);
    from += cloud.point_step;
    to += tuple_bytes;
  }
}

/** An array from fields of one type, as savedFields() describes them. */
vtkSmartPointer<vtkDataArray>
makeDataArray(const Dataset& dataset, const std::string& name, const Fields& fields)
{
  std::size_t components = 0;
  for (const auto& field : fields)
    components += field.count;
  auto array = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(vtkTypeOf(fields.front().datatype)));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(dataset.cloud.width) *
                           dataset.cloud.height);
  auto* to = static_cast<std::uint8_t*>(array->GetVoidPointer(0));
  const std::size_t tuple_bytes =
      components * static_cast<std::size_t>(array->GetDataTypeSize());
  for (const auto& field : fields) {
    fillTuples(dataset, field, to, tuple_bytes);
    to += fieldBytes(field);
  }
  return array;
}

/** The names that labels stand for. */
vtkSmartPointer<vtkStringArray>
makeNameArray(const Dataset& dataset,
              const pcl::PCLPointField& field,
              const std::vector<std::string>& names)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(field.name.c_str());
  const std::size_t count = std::size_t{dataset.cloud.width} * dataset.cloud.height;
  array->SetNumberOfValues(static_cast<vtkIdType>(count));
  const FieldComponent label{field.offset, field.datatype};
  const std::uint8_t* point = dataset.cloud.data.data();
  for (std::size_t i = 0; i < count; ++i, point += dataset.cloud.point_step)
    array->SetValue(static_cast<vtkIdType>(i), nameOfLabel(names, label.read(point)));
  return array;
}

/** One vertex per point, so that ParaView shows and thresholds them. */
vtkSmartPointer<vtkCellArray>
makeVertices(vtkIdType count)
{
  vtkNew<vtkTypeInt64Array> offsets, points;
  offsets->SetNumberOfValues(count + 1);
  points->SetNumberOfValues(count);
  for (vtkIdType i = 0; i <= count; ++i)
    offsets->SetValue(i, i);
  for (vtkIdType i = 0; i < count; ++i)
    points->SetValue(i, i);
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, points);
  return vertices;
}

} // namespace

PointArrays
collectPoints(vtkDataSet& data)
{
  return PointCollector(data).collect();
}

Dataset
toPointCloud(vtkDataSet* data)
{
  if (!data)
    throw InvalidArgument("no_vtk_data", {});
  PointArrays points = collectPoints(*data);
  for (const auto& array : points.others)
    points.dataset.notes.push_back(
        {"array_of_texts",
         {{"array", shortenText(array->GetName() ? array->GetName() : "")},
          {"type", array->GetClassName()}}});
  return std::move(points.dataset);
}

vtkSmartPointer<vtkPolyData>
fromPointCloud(const Dataset& dataset)
{
  const Fields fields = savedFields(dataset);
  const Fields normals = findNormals(fields);
  Fields xyz;
  for (const char* const axis : axis_names)
    xyz.push_back(*findField(fields, axis));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(makeDataArray(dataset, "Points", xyz));
  data->SetPoints(points);
  data->SetVerts(makeVertices(points->GetNumberOfPoints()));
  if (!normals.empty())
    data->GetPointData()->SetNormals(makeDataArray(dataset, "Normals", normals));
  for (const auto& field : fields)
    if (const auto* const names =
            findLabels(dataset.cloud.fields, dataset.labels, field.name))
      data->GetPointData()->AddArray(makeNameArray(dataset, field, *names));
    else if (!findField(xyz, field.name) && !findField(normals, field.name))
      data->GetPointData()->AddArray(makeDataArray(dataset, field.name, {field}));
  return data;
}

vtkSmartPointer<vtkPolyData>
fromPointCloud(const pcl::PCLPointCloud2& cloud)
{
  checkComplete(cloud);
  pcl::PCLPointCloud2 records = cloud;
  records.width = cloud.width * cloud.height;
  records.height = 1;
  return fromPointCloud(makeDataset(std::move(records)));
}

} // namespace pcl_uvol
