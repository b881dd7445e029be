// SPDX-License-Identifier: BSD-3-Clause
// Points with their point data by VTK's readers and writers.
#include "files.h"
#include "formats.h"
#include "vtk_messages.h"
#include <pcl_uvol/filters/point_data.h>

#include <vtkDataReader.h>
#include <vtkDataSet.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace pcl_uvol {
namespace io {
namespace {

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

/** "Float32", as VTK's XML files call it. */
std::string
xmlTypeOf(vtkDataArray& array)
{
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
  const auto data = fromPointCloud(dataset);
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
  return toPointCloud(points);
}

void
writeVtp(const std::string& file, const std::string& path, const Dataset& dataset)
{
  const auto data = fromPointCloud(dataset);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writeXml(*writer, file, path);
}

} // namespace io
} // namespace pcl_uvol
