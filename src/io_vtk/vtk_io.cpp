// SPDX-License-Identifier: BSD-3-Clause
// Points with their point data in VTK's files.
#include "common/records.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/xml_scanner.h"
#include "io/xml_text.h"
#include "io_vtk/vtk_data_reader.h"
#include "io_vtk/vtk_messages.h"
#include "io_vtk/vtk_readers.h"
#include <pcl_uvol/filters/point_data.h>

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataWriter.h>

#include <filesystem>
#include <fstream>

namespace pcl_uvol {
namespace io {
namespace {

/** "Float32" or "String", as VTK's XML files call it. */
std::string
nameXmlType(vtkAbstractArray& values)
{
  auto* const numbers = vtkDataArray::SafeDownCast(&values);
  if (numbers == nullptr)
    return "String";
  vtkDataArray& array = *numbers;
  const int type = array.GetDataType();
  const bool is_float = type == VTK_FLOAT || type == VTK_DOUBLE;
  const bool has_sign = array.GetDataTypeMin() < 0.0;
  return (is_float   ? "Float"
          : has_sign ? "Int"
                     : "UInt") +
         std::to_string(8 * array.GetDataTypeSize());
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
addArray(vtkAbstractArray& array, const char* name, vtkXMLDataElement* parent)
{
  const auto element = addElement("PDataArray", parent);
  element->SetAttribute("type", nameXmlType(array).c_str());
  element->SetAttribute("Name", name);
  element->SetIntAttribute("NumberOfComponents", array.GetNumberOfComponents());
}

/** A cloud as VTK data with names as XML has them, each of them once. */
vtkSmartPointer<vtkPolyData>
makeWritable(const Dataset& dataset)
{
  auto data = fromPointCloud(dataset);
  auto* const arrays = data->GetPointData();
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(arrays->GetNumberOfArrays()));
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    names.push_back(escapeAttribute(arrays->GetArrayName(i)));
  makeUnique(names);
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    arrays->GetAbstractArray(i)->SetName(names[static_cast<std::size_t>(i)].c_str());
  return data;
}

} // namespace

std::vector<std::string>
readPieceList(const std::string& path)
{
  XmlScanner scanner(path, FileCursor::Content::Text);
  XmlTag tag;
  std::vector<std::string> pieces;
  bool is_list = false;
  while (scanner.next(tag)) {
    is_list = is_list || tag.name == "PPolyData";
    if (!is_list || tag.closes || tag.name != "Piece")
      continue;
    const std::string* const source = tag.find("Source");
    if (!source)
      throwUnreadable(path, {"missing_part", "the Source of a piece"});
    pieces.push_back((std::filesystem::path(path).parent_path() / *source).string());
  }
  if (!is_list || !scanner.getOpen().empty())
    throwUnreadable(path, {"not_format", "a list of pieces of polygonal data"});
  if (pieces.empty())
    throwUnreadable(path, {"nothing_inside", "pieces"});
  return pieces;
}

void
writePieceList(const std::string& file,
               const std::string& path,
               const Dataset& dataset,
               const std::vector<std::string>& pieces)
{
  const auto data = makeWritable(dataset);
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
    addArray(*arrays->GetAbstractArray(i), arrays->GetArrayName(i), point_data);
  addArray(*data->GetPoints()->GetData(), "Points", addElement("PPoints", list));
  for (const std::string& piece : pieces)
    addElement("Piece", list)
        ->SetAttribute(
            "Source",
            escapeAttribute(std::filesystem::path(piece).filename().string()).c_str());
  std::ofstream out(file);
  root->PrintXML(out, vtkIndent());
  if (!out.flush())
    throwUnwritable(path, "full_disk");
}

Dataset
readVtk(const std::string& path, const LoadOptions& options)
{
  const DataPlace place = options.cells ? DataPlace::Cells : DataPlace::Points;
  const auto content = isFileList(path)                     ? readFileList(path, place)
                       : isReadByVtk(path) || options.cells ? readByVtk(path, place)
                       : getEnding(path) == ".vtk"          ? readVtkLegacy(path)
                                                            : readVtkXml(path);
  Dataset dataset = toPointCloud(content.data);
  dataset.notes.insert(dataset.notes.end(), content.notes.begin(), content.notes.end());
  return dataset;
}

void
checkVtpFields(const std::string& path, const std::vector<pcl::PCLPointField>& fields)
{
  if (fields.size() > most_vtk_arrays)
    throwUnwritable(path, {"many_vtp_fields", fields.size(), most_vtk_arrays});
}

void
writeVtp(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const std::vector<Triangle>& triangles)
{
  checkVtpFields(path, dataset.cloud.fields);
  const auto data = makeWritable(dataset);
  if (!triangles.empty()) {
    vtkNew<vtkCellArray> faces;
    for (const Triangle& triangle : triangles)
      faces->InsertNextCell({triangle[0], triangle[1], triangle[2]});
    data->SetVerts(nullptr);
    data->SetPolys(faces);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writeXml(*writer, file, path);
}

} // namespace io
} // namespace pcl_uvol
