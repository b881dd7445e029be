// SPDX-License-Identifier: BSD-3-Clause
// Points with their point data by VTK's readers and writers.
#include "files.h"
#include "formats.h"
#include "vtk_messages.h"
#include <pcl_uvol/filters/point_data.h>

#include <vtkDataReader.h>
#include <vtkDataSet.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
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

} // namespace

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
