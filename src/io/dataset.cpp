// SPDX-License-Identifier: BSD-3-Clause
// Loading and saving by the ending of the name, and the origin of large coordinates.
#include "files.h"
#include "formats.h"
#include "numbers.h"
#include "records.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

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

/** \param values four bytes each */
void
replaceField(Dataset& dataset,
             const std::string& name,
             std::uint8_t datatype,
             const void* values,
             std::size_t count)
{
  pcl::PCLPointCloud2& cloud = dataset.cloud;
  if (count != std::size_t{cloud.width} * cloud.height)
    throw InvalidArgument("The field '" + name + "' has " + std::to_string(count) +
                          " values for " + std::to_string(cloud.width) + " points.");
  if (io::axisOf(name) >= 0)
    throw InvalidArgument("The field '" + name + "' is a coordinate.");
  // The old one becomes padding, which goes when the new one is packed.
  for (auto& field : cloud.fields)
    if (field.name == name)
      field.name = "_";
  pcl::PCLPointCloud2 packed = io::repack(cloud, true);
  const std::size_t old_step = packed.point_step, new_step = old_step + 4;
  io::appendField(packed.fields, name, datatype);
  packed.fields.back().offset = static_cast<pcl::uindex_t>(old_step);
  std::vector<std::uint8_t> data(new_step * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&data[i * new_step], &packed.data[i * old_step], old_step);
    std::memcpy(&data[i * new_step + old_step],
                static_cast<const std::uint8_t*>(values) + 4 * i,
                4);
  }
  packed.data = std::move(data);
  packed.point_step = static_cast<pcl::uindex_t>(new_step);
  packed.row_step = static_cast<pcl::uindex_t>(new_step * count);
  cloud = std::move(packed);
}

} // namespace

namespace io {

FileFormat
formatOf(const std::string& path, const LoadOptions& options)
{
  const std::string ending = endingOf(path);
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
  const io::FileFormat format = io::formatOf(path, options);
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
  const std::string ending = io::endingOf(path);
  writeAtomically(path, [&](const std::string& file) {
    if (ending == ".pcd")
      io::writePcd(file, path, dataset, options);
    else if (ending == ".ply")
      io::writePly(file, path, dataset, {}, options);
    else if (ending == ".vtp")
      io::writeVtp(file, path, dataset);
    else
      io::writeCsv(file, path, dataset);
  });
}

void
checkSavePath(const std::string& path, const std::vector<pcl::PCLPointField>& fields)
{
  constexpr const char* endings[] = {".pcd", ".ply", ".vtp", ".csv"};
  const std::string ending = io::endingOf(path);
  if (!isOneOf(ending, endings))
    io::throwUnwritable(path,
                        describeEnding(ending) +
                            "; points are written as .pcd, .ply, .vtp or .csv");
  io::checkWritable(path);
  if (ending == ".ply")
    io::checkPlyFields(path, fields);
}

void
setCoordinates(Dataset& dataset, const std::vector<double>& xyz)
{
  auto& cloud = dataset.cloud;
  const std::size_t count = xyz.size() / 3;
  if (xyz.size() % 3 != 0 || count > std::numeric_limits<pcl::uindex_t>::max())
    throw InvalidArgument("There are " + std::to_string(xyz.size()) +
                          " coordinates, which are not three for each point.");
  if (cloud.fields.empty()) {
    cloud.height = 1;
    cloud.width = static_cast<pcl::uindex_t>(count);
  }
  else if (static_cast<std::size_t>(cloud.width) * cloud.height != count)
    throw InvalidArgument("There are coordinates of " + std::to_string(count) +
                          " points for a cloud of " +
                          std::to_string(cloud.width * cloud.height) + ".");
  io::CoordinateRange range;
  for (std::size_t i = 0; i < xyz.size(); ++i)
    range.add(i % 3, xyz[i]);
  dataset.origin = range.origin();
  cloud = io::repack(cloud, false);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      io::putCoordinate(xyz[3 * i + axis] - dataset.origin[axis],
                        axis,
                        cloud.data.data() + i * cloud.point_step);
}

void
setField(Dataset& dataset, const std::string& name, const std::vector<float>& values)
{
  replaceField(
      dataset, name, pcl::PCLPointField::FLOAT32, values.data(), values.size());
}

void
setField(Dataset& dataset,
         const std::string& name,
         const std::vector<std::int32_t>& values)
{
  replaceField(dataset, name, pcl::PCLPointField::INT32, values.data(), values.size());
}

} // namespace pcl_uvol
