// SPDX-License-Identifier: BSD-3-Clause
// Points with their point data by VTK's readers and writers.
#include "columns.h"
#include "files.h"
#include "formats.h"
#include "vtk_messages.h"
#include <pcl_uvol/common/scalar_field.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataReader.h>
#include <vtkFloatArray.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr const char* normal_names[] = {"normal_x", "normal_y", "normal_z"};

template <typename Reader>
vtkSmartPointer<vtkDataObject>
readBy(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  if constexpr (std::is_base_of_v<vtkDataReader, Reader>) {
    // Legacy files: without these the reader takes the first array of each kind only.
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllNormalsOn();
    reader->ReadAllTensorsOn();
    reader->ReadAllTCoordsOn();
    reader->ReadAllColorScalarsOn();
    reader->ReadAllFieldsOn();
  }
  reader->Update();
  if (reader->GetErrorCode() != 0)
    return nullptr;
  return reader->GetOutputDataObject(0);
}

/** VTK does not miss the end of a truncated file if it had found the points before. */
void
checkEnd(const InputFile& file, const std::string& path)
{
  const std::uint64_t size = std::min<std::uint64_t>(file.getSize(), 256);
  std::string end(size, '\0');
  file.read(file.getSize() - size, end.data(), end.size());
  if (end.find("</VTKFile>") == std::string::npos)
    throwUnreadable(path,
                    "it is truncated or no VTK file: it does not end with </VTKFile>");
}

vtkSmartPointer<vtkDataSet>
readPoints(const std::string& path, const std::string& ending)
{
  const InputFile file(path);
  if (ending != ".vtk")
    checkEnd(file, path);
  vtkSmartPointer<vtkDataObject> object;
  std::string error;
  {
    const VtkMessages messages;
    if (ending == ".vtp")
      object = readBy<vtkXMLPolyDataReader>(path);
    else if (ending == ".vtu")
      object = readBy<vtkXMLUnstructuredGridReader>(path);
    else if (ending == ".vts")
      object = readBy<vtkXMLStructuredGridReader>(path);
    else
      object = readBy<vtkGenericDataObjectReader>(path);
    error = messages.getError();
  }
  if (!error.empty())
    throwUnreadable(path, "VTK says: " + error);
  if (!object)
    throwUnreadable(path, "VTK cannot make sense of it");
  auto* const points = vtkDataSet::SafeDownCast(object);
  if (!points)
    throwUnreadable(path,
                    "it holds no points but " + std::string(object->GetClassName()));
  return points;
}

std::uint8_t
datatypeOf(const vtkDataArray& array)
{
  const int type = const_cast<vtkDataArray&>(array).GetDataType();
  const auto integer = [&](bool has_sign) {
    switch (const_cast<vtkDataArray&>(array).GetDataTypeSize()) {
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
  switch (type) {
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

/** Coordinates and point data of a data set, one array after another. */
class PointCollector {
public:
  PointCollector(const std::string& path, vtkDataSet& points)
      : path_(path)
      , points_(points)
  {
  }

  Dataset
  collect();

private:
  void
  addCoordinates();
  void
  addPointData();

  const std::string& path_;
  vtkDataSet& points_;
  Fields fields_;
  std::vector<vtkSmartPointer<vtkDataArray>> arrays_;
  std::vector<std::string> notes_;
};

void
PointCollector::addCoordinates()
{
  vtkSmartPointer<vtkDataArray> xyz;
  auto* const set = vtkPointSet::SafeDownCast(&points_);
  if (set && set->GetPoints())
    xyz = plainArray(set->GetPoints()->GetData());
  else { // lattices compute their points
    vtkNew<vtkPoints> lattice;
    lattice->SetDataTypeToDouble();
    lattice->SetNumberOfPoints(points_.GetNumberOfPoints());
    for (vtkIdType i = 0; i < points_.GetNumberOfPoints(); ++i) {
      double point[3];
      points_.GetPoint(i, point);
      lattice->SetPoint(i, point);
    }
    xyz = lattice->GetData();
  }
  for (const char* const axis : {"x", "y", "z"})
    appendField(fields_, axis, datatypeOf(*xyz));
  arrays_.push_back(xyz);
}

void
PointCollector::addPointData()
{
  auto* const data = points_.GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    auto* const any = data->GetAbstractArray(i);
    std::string name = any->GetName() ? any->GetName() : "";
    if (name.empty())
      name = "array_" + std::to_string(i);
    auto* const array = vtkDataArray::SafeDownCast(any);
    if (!array || array->GetNumberOfTuples() != points_.GetNumberOfPoints() ||
        array->GetNumberOfComponents() < 1) {
      notes_.push_back("The array '" + name +
                       "' does not hold numbers for every point and is left out.");
      continue;
    }
    const auto plain = plainArray(array);
    if (array == data->GetNormals())
      for (const char* const axis : normal_names)
        appendField(fields_, axis, datatypeOf(*plain));
    else {
      const bool taken = name == "x" || name == "y" || name == "z" || name == "_";
      if (taken)
        notes_.emplace_back("The array '")
            .append(name)
            .append("' is called '")
            .append(name)
            .append("_2'.");
      appendField(fields_,
                  taken ? name + "_2" : name,
                  datatypeOf(*plain),
                  static_cast<std::size_t>(plain->GetNumberOfComponents()));
    }
    arrays_.push_back(plain);
  }
  if (data->GetNumberOfArrays() == 0 && points_.GetCellData()->GetNumberOfArrays() > 0)
    notes_.emplace_back("There are data of cells only, which are left out.");
}

Dataset
PointCollector::collect()
{
  addCoordinates();
  addPointData();
  RecordInfo info;
  info.fields = fields_;
  info.count = static_cast<std::uint64_t>(points_.GetNumberOfPoints());
  info.notes = notes_;
  if (!vtkPointSet::SafeDownCast(&points_))
    info.double_coordinates = false; // those of a lattice were computed here
  auto records = makeRecords(path_, fields_, info.count);
  std::size_t offset = 0;
  for (const auto& array : arrays_) {
    const std::size_t bytes = static_cast<std::size_t>(array->GetDataTypeSize()) *
                              static_cast<std::size_t>(array->GetNumberOfComponents());
    const auto* from = static_cast<const std::uint8_t*>(array->GetVoidPointer(0));
    std::uint8_t* to = records.data.data() + offset;
    for (std::size_t i = 0; i < records.width; ++i) {
      std::memcpy(to, from, bytes);
      from += bytes;
      to += records.point_step;
    }
    offset += bytes;
  }
  return makeDataset(path_, info, std::move(records));
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

/** An array from the columns of some fields of one type. */
vtkSmartPointer<vtkDataArray>
arrayOf(const Dataset& dataset, const std::string& name, const Fields& fields)
{
  const auto& cloud = dataset.cloud;
  const std::vector<Column> columns = columnsOf(dataset, fields);
  auto array = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(vtkTypeOf(columns.front().datatype)));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(columns.size()));
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  unpackRecords(dataset, columns, static_cast<std::uint8_t*>(array->GetVoidPointer(0)));
  return array;
}

/** One vertex per point, so that ParaView shows and thresholds them. */
vtkSmartPointer<vtkCellArray>
verticesOf(std::size_t count)
{
  vtkNew<vtkTypeInt64Array> offsets, points;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(count) + 1);
  points->SetNumberOfValues(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i <= count; ++i)
    offsets->SetValue(static_cast<vtkIdType>(i), static_cast<vtkTypeInt64>(i));
  for (std::size_t i = 0; i < count; ++i)
    points->SetValue(static_cast<vtkIdType>(i), static_cast<vtkTypeInt64>(i));
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, points);
  return vertices;
}

bool
isAnyOf(const std::string& name, const Fields& fields)
{
  return findField(fields, name) != nullptr;
}

vtkSmartPointer<vtkPolyData>
polyDataOf(const Dataset& dataset)
{
  const Fields fields = savedFields(dataset);
  Fields xyz, normals;
  for (const char* const axis : {"x", "y", "z"})
    xyz.push_back(*findField(fields, axis));
  for (const char* const axis : normal_names)
    if (const auto* const field = findField(fields, axis))
      if (field->count == 1 &&
          (normals.empty() || normals.front().datatype == field->datatype))
        normals.push_back(*field);
  if (normals.size() < 3 || findField(fields, "Normals"))
    normals.clear();
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(arrayOf(dataset, "Points", xyz));
  data->SetPoints(points);
  data->SetVerts(
      verticesOf(static_cast<std::size_t>(dataset.cloud.width) * dataset.cloud.height));
  if (!normals.empty())
    data->GetPointData()->SetNormals(arrayOf(dataset, "Normals", normals));
  for (const auto& field : fields)
    if (!isAnyOf(field.name, xyz) && !isAnyOf(field.name, normals))
      data->GetPointData()->AddArray(arrayOf(dataset, field.name, {field}));
  return data;
}

/** "Float32", as VTK's XML files call it. */
std::string
xmlTypeOf(const vtkDataArray& array)
{
  const std::uint8_t type = datatypeOf(array);
  const std::size_t bits = 8 * datatypeSize(type);
  const bool has_sign = type == Type::INT8 || type == Type::INT16 ||
                        type == Type::INT32 || type == Type::INT64;
  const bool is_float = type == Type::FLOAT32 || type == Type::FLOAT64;
  return (is_float ? "Float" : has_sign ? "Int" : "UInt") + std::to_string(bits);
}

/** An element of an XML file, inside another one. */
vtkSmartPointer<vtkXMLDataElement>
addElement(const char* name, vtkXMLDataElement* parent)
{
  auto element = vtkSmartPointer<vtkXMLDataElement>::New();
  element->SetName(name);
  element->SetAttributeEncoding(VTK_ENCODING_UTF_8);
  if (parent != nullptr)
    parent->AddNestedElement(element);
  return element;
}

void
addArray(vtkDataArray& array, const char* name, vtkXMLDataElement* parent)
{
  const auto element = addElement("PDataArray", parent);
  element->SetAttribute("type", xmlTypeOf(array).c_str());
  element->SetAttribute("Name", name);
  element->SetIntAttribute("NumberOfComponents", array.GetNumberOfComponents());
}

} // namespace

std::vector<std::string>
readPieceList(const std::string& path)
{
  const InputFile file(path);
  const auto throwNoList = [&] {
    throwUnreadable(path, "it is truncated or no list of pieces of polygonal data");
  };
  vtkSmartPointer<vtkXMLDataElement> root;
  {
    const VtkMessages messages;
    std::istringstream text(file.head(file.getSize()));
    root.TakeReference(vtkXMLUtilities::ReadElementFromStream(text));
  }
  vtkXMLDataElement* const list =
      root ? root->FindNestedElementWithName("PPolyData") : nullptr;
  if (list == nullptr)
    throwNoList();
  std::vector<std::string> pieces;
  for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* const element = list->GetNestedElement(i);
    if (std::string(element->GetName()) != "Piece")
      continue;
    const char* const source = element->GetAttribute("Source");
    if (source == nullptr)
      throwNoList();
    pieces.push_back((std::filesystem::path(path).parent_path() / source).string());
  }
  if (pieces.empty())
    throwUnreadable(path, "it lists no pieces");
  return pieces;
}

void
writePieceList(const std::string& file,
               const std::string& path,
               const Dataset& dataset,
               const std::vector<std::string>& pieces)
{
  const auto data = polyDataOf(dataset);
  const auto root = addElement("VTKFile", nullptr);
  root->SetAttribute("type", "PPolyData");
  root->SetAttribute("version", "1.0");
  root->SetAttribute("byte_order", "LittleEndian");
  const auto list = addElement("PPolyData", root);
  list->SetIntAttribute("GhostLevel", 0);
  auto* const arrays = data->GetPointData();
  const auto point_data = addElement("PPointData", list);
  if (arrays->GetNormals() != nullptr)
    point_data->SetAttribute("Normals", arrays->GetNormals()->GetName());
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    addArray(*arrays->GetArray(i), arrays->GetArrayName(i), point_data);
  addArray(*data->GetPoints()->GetData(), "Points", addElement("PPoints", list));
  for (const std::string& piece : pieces)
    addElement("Piece", list)
        ->SetAttribute("Source",
                       std::filesystem::path(piece).filename().string().c_str());
  std::ofstream out(file);
  root->PrintXML(out, vtkIndent());
  if (!out.flush())
    throwUnwritable(path, "is the disk full?");
}

Dataset
readVtk(const std::string& path)
{
  const auto points = readPoints(path, endingOf(path));
  return PointCollector(path, *points).collect();
}

void
writeVtp(const std::string& file, const std::string& path, const Dataset& dataset)
{
  const auto data = polyDataOf(dataset);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writeXml(*writer, file, path);
}

} // namespace io
} // namespace pcl_uvol
