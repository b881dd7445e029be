// SPDX-License-Identifier: BSD-3-Clause
// Loading and saving by the ending of the name.
#include "io/files.h"
#include "io/formats.h"
#include "io/hdf5_file.h"
#include "io/record_source.h"
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

namespace {

FileFormat
formatOf(const std::string& path, const LoadOptions& options)
{
  if (hasHdf5Ending(splitHdf5Name(path).file))
    return FileFormat::Hdf5;
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
  if (isGadget(path)) // a missing file matters more than its ending
    return FileFormat::Gadget;
  if (isHdf5(path))
    return FileFormat::Hdf5;
  throwUnreadable(path,
                  describeEnding(ending) +
                      "; points are read from .pcd, .ply, .csv, .txt, .xyz, .dat, "
                      ".tsv, .vtk, .vtp, .vtu, .vts, files of HDF5 and snapshots of "
                      "Gadget");
}

} // namespace

FileFormat
findFormat(const std::string& path, const LoadOptions& options)
{
  const FileFormat format = formatOf(path, options);
  if (!options.particles.empty() && format != FileFormat::Gadget &&
      format != FileFormat::Hdf5)
    throw InvalidArgument("Particles can be chosen in snapshots only, and '" + path +
                          "' is none.");
  return format;
}

std::unique_ptr<RecordSource>
openRecords(const std::string& path, FileFormat format, const LoadOptions& options)
{
  switch (format) {
  case FileFormat::Pcd:
    return openPcd(path);
  case FileFormat::Ply:
    return openPly(path);
  case FileFormat::Text:
    return openText(path, options);
  case FileFormat::Gadget:
    return openGadget(path, options);
  case FileFormat::Hdf5:
    return openHdf5(path, options);
  default:
    return nullptr;
  }
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
    case io::FileFormat::Text:
      return io::readText(path, options);
    case io::FileFormat::Vtk:
      return io::readVtk(path);
    default:
      return io::readWhole(io::openRecords(path, format, options));
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
