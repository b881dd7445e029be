// SPDX-License-Identifier: BSD-3-Clause
// Loading and saving by the ending of the name.
#include "io/files.h"
#include "io/formats.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol {
namespace {

constexpr const char* text_endings[] = {".csv", ".txt", ".xyz", ".dat", ".tsv"};
constexpr const char* vtk_endings[] = {".vtk", ".vtp", ".vtu", ".vts"};

template <std::size_t N>
bool
isOneOf(const std::string& ending, const char* const (&endings)[N])
{
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

std::string
describeEnding(const std::string& ending)
{
  return ending.empty() ? "its name has no ending"
                        : "the ending '" + ending + "' is not known";
}

} // namespace

namespace io {

FileFormat
findFormat(const std::string& path, const LoadOptions& options)
{
  const std::string ending = getEnding(path);
  if (isOneOf(ending, text_endings))
    return FileFormat::Text;
  if (options.xyz_columns != LoadOptions().xyz_columns)
    throw InvalidArgument(
        "Columns of coordinates can be chosen in text files only, and '" + path +
        "' is none.");
  if (ending == ".pcd")
    return FileFormat::Pcd;
  if (ending == ".ply")
    return FileFormat::Ply;
  if (isOneOf(ending, vtk_endings))
    return FileFormat::Vtk;
  const InputFile exists(path); // a missing file matters more than its ending
  throwUnreadable(path,
                  describeEnding(ending) +
                      "; points are read from .pcd, .ply, .csv, .txt, .xyz, .dat, "
                      ".tsv, .vtk, .vtp, .vtu and .vts");
}

} // namespace io

Dataset
loadDataset(const std::string& path, const LoadOptions& options)
{
  const io::FileFormat format = io::findFormat(path, options);
  return io::reading(path, [&] {
    switch (format) {
    case io::FileFormat::Pcd:
      return io::readPcd(path);
    case io::FileFormat::Ply:
      return io::readPly(path);
    case io::FileFormat::Text:
      return io::readText(path, options);
    default:
      return io::readVtk(path);
    }
  });
}

void
saveDataset(const std::string& path, const Dataset& dataset, const SaveOptions& options)
{
  checkSavePath(path, dataset.cloud.fields);
  const std::string ending = io::getEnding(path);
  writeAtomically(path, [&](const std::string& file) {
    if (ending == ".pcd")
      io::writePcd(file, path, dataset, options);
    else if (ending == ".ply")
      io::writePly(file, path, dataset, {}, options);
    else if (ending == ".vtp")
      io::writeVtp(file, path, dataset, {});
    else
      io::writeCsv(file, path, dataset);
  });
}

void
checkSavePath(const std::string& path, const std::vector<pcl::PCLPointField>& fields)
{
  constexpr const char* endings[] = {".pcd", ".ply", ".vtp", ".csv"};
  const std::string ending = io::getEnding(path);
  if (!isOneOf(ending, endings))
    io::throwUnwritable(path,
                        describeEnding(ending) +
                            "; points are written as .pcd, .ply, .vtp or .csv");
  io::checkWritable(path);
  if (ending == ".ply")
    io::checkPlyFields(path, fields);
}

} // namespace pcl_uvol
