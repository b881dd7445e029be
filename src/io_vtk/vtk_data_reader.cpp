// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/vtk_data_reader.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"
#include "io/folder.h"
#include "io/volume_data.h"
#include "io/xml_scanner.h"
#include "io_vtk/child_process.h"
#include "io_vtk/entries.h"
#include "io_vtk/vtk_messages.h"
#include <pcl_uvol/io/dataset.h>

#include <vtkDataSet.h>
#include <vtkExodusIIReader.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkGenericEnSightReader.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLGenericDataObjectReader.h>
#include <vtkXMLHyperTreeGridReader.h>
#include <vtkXMLUniformGridAMRReader.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

namespace pcl_uvol {
namespace io {
namespace {

constexpr const char* exodus_endings[] = {".ex2", ".exo", ".e", ".exii"};
/** Adaptive meshes and octrees, whose data are those of cells. */
constexpr const char* cell_endings[] = {".vthb", ".htg"};
/** Lists may name lists, but not without end, nor one another again and again. */
constexpr std::size_t most_open_lists = 8, most_lists = 1000;

template <std::size_t count>
bool
isAmong(const char* const (&endings)[count], const std::string& ending)
{
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

/** What is no file, and no Exodus, which is NetCDF in one of its formats, is told
 * before libraries print what they think of it. */
void
checkBeginning(const std::string& path)
{
  const std::string head = InputFile(path).head(4);
  if (isAmong(exodus_endings, getEnding(path)) && head.rfind("CDF", 0) != 0 &&
      head != "\x89HDF")
    throwUnreadable(path,
                    {"not_format", "an Exodus file, which begins like NetCDF or HDF5"});
}

vtkSmartPointer<vtkAlgorithm>
makeReader(const std::string& path, DataPlace place)
{
  const std::string ending = getEnding(path);
  if (ending == ".vthb") {
    auto reader = vtkSmartPointer<vtkXMLUniformGridAMRReader>::New();
    reader->SetFileName(path.c_str());
    reader->SetMaximumLevelsToReadByDefault(0); // all
    return reader;
  }
  if (ending == ".htg") {
    auto reader = vtkSmartPointer<vtkXMLHyperTreeGridReader>::New();
    reader->SetFileName(path.c_str());
    return reader;
  }
  if (ending == ".vtk") {
    auto reader = vtkSmartPointer<vtkGenericDataObjectReader>::New();
    reader->SetFileName(path.c_str());
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllTensorsOn();
    reader->ReadAllFieldsOn();
    return reader;
  }
  if (ending.rfind(".vt", 0) == 0) {
    auto reader = vtkSmartPointer<vtkXMLGenericDataObjectReader>::New();
    reader->SetFileName(path.c_str());
    return reader;
  }
  if (ending == ".case") {
    auto reader = vtkSmartPointer<vtkGenericEnSightReader>::New();
    reader->SetCaseFileName(path.c_str());
    reader->ReadAllVariablesOn();
    return reader;
  }
  if (ending == ".foam") {
    auto reader = vtkSmartPointer<vtkOpenFOAMReader>::New();
    reader->SetFileName(path.c_str());
    reader->SetCreateCellToPoint(place == DataPlace::Points);
    reader->UpdateInformation();
    reader->EnableAllCellArrays();
    reader->EnableAllPointArrays();
    return reader;
  }
  auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  reader->SetFileName(path.c_str());
  reader->SetApplyDisplacements(0); // coordinates stay those of the file
  reader->UpdateInformation();
  reader->SetAllArrayStatus(place == DataPlace::Points ? vtkExodusIIReader::NODAL
                                                       : vtkExodusIIReader::ELEM_BLOCK,
                            1);
  return reader;
}

/** Read the last of several times.
 * \return what to say of it */
std::optional<Message>
updateAtLastTime(vtkAlgorithm& reader)
{
  reader.UpdateInformation();
  vtkInformation* const about = reader.GetOutputInformation(0);
  auto* const key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  const int times = about->Has(key) != 0 ? about->Length(key) : 0;
  if (times == 0) {
    reader.Update();
    return std::nullopt;
  }
  const double last = about->Get(key, times - 1);
  reader.UpdateTimeStep(last);
  if (times == 1)
    return std::nullopt;
  return Message("last_time", {{"times", times}, {"last", last}});
}

/** A file of a list. */
struct ListedFile {
  std::string path, time;
};

/** The file of a name in a list. A list that came from another machine may have whole
 * paths of that: then the file is beside the list. */
std::string
findListed(const std::filesystem::path& folder, std::string name)
{
  const bool is_whole = name[0] == '/' || name.find(":\\") == 1;
  std::error_code error;
  if (!is_whole || std::filesystem::exists(name, error)) {
    if (!std::filesystem::exists(folder / name, error))
      std::replace(name.begin(), name.end(), '\\', '/');
    return (folder / name).string();
  }
  const auto beside = folder / name.substr(name.find_last_of("/\\") + 1);
  return std::filesystem::exists(beside, error) ? beside.string() : name;
}

std::vector<ListedFile>
listFiles(const std::string& path)
{
  XmlScanner scanner(path, FileCursor::Content::Text);
  XmlTag tag;
  std::vector<ListedFile> files;
  const auto folder = std::filesystem::path(path).parent_path();
  while (scanner.next(tag)) {
    if (tag.closes || (tag.name != "DataSet" && tag.name != "Piece"))
      continue;
    const std::string* const name = tag.find(tag.name == "Piece" ? "Source" : "file");
    const std::string* const time = tag.find("timestep");
    if (name && !name->empty())
      files.push_back({findListed(folder, *name), time ? *time : ""});
  }
  if (!scanner.getOpen().empty())
    throwUnreadable(path, {"not_format", "a list of files"});
  if (files.empty())
    throwUnreadable(path, {"nothing_inside", "files"});
  return files;
}

/** By their times, if both are numbers. */
bool
isEarlier(const ListedFile& a, const ListedFile& b)
{
  double time_of_a = 0.0, time_of_b = 0.0;
  return parseNumber(a.time, time_of_a) && parseNumber(b.time, time_of_b) &&
         time_of_a < time_of_b;
}

/** Bytes of the files in a folder and in those below. */
std::uint64_t
countFolderBytes(const std::string& folder)
{
  namespace fs = std::filesystem;
  std::uint64_t bytes = 0;
  for (const std::string& name : listFolder(folder)) {
    const std::string path = (fs::path(folder) / name).string();
    std::error_code error;
    if (fs::is_directory(fs::symlink_status(path, error)))
      bytes += countFolderBytes(path);
    else if (fs::is_regular_file(path, error))
      if (const std::uint64_t size = fs::file_size(path, error); !error)
        bytes += size;
  }
  return bytes;
}

/** Bytes of a file, or of the folder of a file that names others. */
std::uint64_t
countBytes(const std::string& path)
{
  const std::string ending = getEnding(path);
  if (ending != ".foam" && ending != ".case" && ending != ".vthb")
    return InputFile(path).getSize();
  return countFolderBytes(std::filesystem::absolute(path).parent_path().string());
}

/** Read a file by VTK's own reader. */
VtkContent
readHere(const std::string& path, DataPlace place, const VtkMessages& messages)
{
  const std::string ending = getEnding(path);
  if (ending == ".vtk")
    checkVtkLegacy(path);
  else if (ending.rfind(".vt", 0) == 0 && !isAmong(cell_endings, ending))
    checkVtkXml(path);
  const auto check = [&] {
    if (!messages.getError().empty())
      throwUnreadable(path, {"library_error", "VTK", shortenText(messages.getError())});
  };
  const auto reader = makeReader(path, place);
  const auto note = updateAtLastTime(*reader);
  check();
  PointJoiner points(path, place);
  if (vtkDataObject* const output = reader->GetOutputDataObject(0))
    points.add(*output);
  check();
  if (points.isEmpty()) {
    vtkNew<vtkPolyData> none;
    none->SetPoints(vtkNew<vtkPoints>());
    return {none, {}};
  }
  VtkContent content = points.join();
  if (note)
    content.notes.push_back(*note);
  return content;
}

/** The same in a process of its own: VTK believes what a damaged file says. No other
 * thread has VTK's messages meanwhile, so that the child finds them free. */
VtkContent
readApart(const std::string& path, DataPlace place)
{
  const VtkMessages messages;
  return readInChild(
      path, countBytes(path), [&] { return readHere(path, place, messages); });
}

/** The lists that are read. */
struct ReadLists {
  std::string first;
  std::size_t open = 0; ///< each named by the one before
  std::size_t all = 0;
  std::set<std::string> files; ///< that are no lists
  std::size_t repeats = 0;     ///< of these
};

/** Goes through the files that a list names, and the lists in it.
 * \param take called once for each file that is no list */
void
visitFiles(const std::string& path,
           ReadLists& lists,
           std::vector<Message>& notes,
           const std::function<void(const std::string& file)>& take)
{
  if (lists.open == most_open_lists)
    throwUnreadable(lists.first, "endless_lists");
  if (lists.all == most_lists)
    throwUnreadable(lists.first,
                    {"too_many_parts",
                     "it",
                     most_lists,
                     "lists, counted as often as they are named"});
  ++lists.open;
  ++lists.all;
  std::vector<ListedFile> files = listFiles(path);
  const std::string first =
      std::min_element(files.begin(), files.end(), isEarlier)->time;
  const std::size_t all = files.size();
  files.erase(std::remove_if(files.begin(),
                             files.end(),
                             [&](const ListedFile& f) { return f.time != first; }),
              files.end());
  if (files.size() < all)
    notes.push_back({"first_listed_time",
                     {{"list", shortenText(path)}, {"time", printable(first)}}});
  for (const ListedFile& file : files)
    if (isFileList(file.path))
      visitFiles(file.path, lists, notes, take);
    else if (std::error_code error;
             lists.files
                 .insert(std::filesystem::weakly_canonical(file.path, error).string())
                 .second)
      take(file.path);
    else
      ++lists.repeats;
  --lists.open;
}

/** Adds the names that a list has, of files and lists of all times, each list once. */
void
addNames(const std::string& path,
         std::vector<std::string>& files,
         std::set<std::string>& lists)
{
  if (lists.size() == most_lists || !lists.insert(path).second)
    return;
  for (const ListedFile& file : listFiles(path)) {
    files.push_back(file.path);
    if (isFileList(file.path))
      addNames(file.path, files, lists);
  }
}

} // namespace

bool
isReadByVtk(const std::string& path)
{
  const std::string ending = getEnding(path);
  return ending == ".case" || ending == ".foam" || isAmong(exodus_endings, ending) ||
         isAmong(cell_endings, ending);
}

bool
hasCellsOnly(const std::string& path)
{
  return isAmong(cell_endings, getEnding(path));
}

VtkContent
readByVtk(const std::string& path, DataPlace place)
{
  checkBeginning(path);
  if (hasCellsOnly(path))
    place = DataPlace::Cells;
  VtkContent content = readApart(path, place);
  if (content.data->GetNumberOfPoints() == 0)
    throwUnreadable(
        path, {"nothing_inside", place == DataPlace::Points ? "points" : "cells"});
  return content;
}

std::vector<std::string>
findListedFiles(const std::string& path)
{
  std::vector<std::string> files;
  std::set<std::string> lists;
  try {
    addNames(path, files, lists);
  }
  catch (const IOError&) {
    // Whoever reads the list tells what is wrong with it.
  }
  return files;
}

VtkContent
readFileList(const std::string& path, DataPlace place)
{
  PointJoiner points(path, place);
  ReadLists lists;
  lists.first = path;
  std::vector<Message> notes;
  visitFiles(path, lists, notes, [&](const std::string& file) {
    if (place == DataPlace::Cells)
      points.addPoints(*vtkPolyData::SafeDownCast(readApart(file, place).data));
    else
      points.add(
          *(getEnding(file) == ".vtk" ? readVtkLegacy(file) : readVtkXml(file)).data);
  });
  if (lists.repeats > 0)
    notes.push_back(
        {"repeated_files", {{"list", shortenText(path)}, {"times", lists.repeats}}});
  VtkContent content = points.join();
  content.notes.insert(content.notes.begin(), notes.begin(), notes.end());
  return content;
}

SolidCells
readSolidCells(const std::string& path)
{
  const auto read = [](const std::string& file) {
    const VtkContent content = readApart(file, DataPlace::Solids);
    return unpackCells(file, *vtkPolyData::SafeDownCast(content.data));
  };
  if (!isFileList(path)) {
    checkBeginning(path);
    return read(path);
  }
  std::vector<SolidCells> parts;
  ReadLists lists;
  lists.first = path;
  std::vector<Message> notes;
  visitFiles(path, lists, notes, [&](const std::string& file) {
    if (SolidCells part = read(file); part.mesh)
      parts.push_back(std::move(part));
  });
  return joinSolidCells(parts);
}

} // namespace io

} // namespace pcl_uvol
