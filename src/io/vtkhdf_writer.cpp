// SPDX-License-Identifier: BSD-3-Clause
// Writes VTKHDF, version 2.0: PolyData in one part, with a vertex per point or with
// polygons, not packed.
#include "io/columns.h"
#include "io/formats.h"
#include "io/hdf5_names.h"
#include "io/hdf5_writer.h"
#include "io/little_endian.h"

#include <pcl/PCLPointField.h>

namespace pcl_uvol {
namespace io {
namespace {

/** A count of every row. */
using MakeCount = std::function<std::uint64_t(std::uint64_t row)>;

void
addCounts(Hdf5Writer& writer,
          const std::string& name,
          std::uint64_t rows,
          const MakeCount& make)
{
  writer.addTable(name,
                  pcl::PCLPointField::INT64,
                  rows,
                  1,
                  [make](std::uint64_t first, std::uint64_t count) {
                    std::string bytes;
                    for (std::uint64_t row = first; row < first + count; ++row)
                      appendLittle(bytes, make(row));
                    return bytes;
                  });
}

void
addCount(Hdf5Writer& writer, const std::string& name, std::uint64_t count)
{
  addCounts(writer, name, 1, [count](std::uint64_t) { return count; });
}

/** Cells of one kind.
 * \param corners of every cell
 * \param corner number of its point */
void
addCells(Hdf5Writer& writer,
         const std::string& group,
         std::uint64_t cells,
         std::uint64_t corners,
         const MakeCount& corner)
{
  writer.addGroup(group);
  addCount(writer, joinNames(group, "NumberOfCells"), cells);
  addCount(writer, joinNames(group, "NumberOfConnectivityIds"), cells * corners);
  addCounts(writer, joinNames(group, "Connectivity"), cells * corners, corner);
  addCounts(writer,
            joinNames(group, "Offsets"),
            cells + 1,
            [corners](std::uint64_t cell) { return cell * corners; });
}

/** Names as HDF5 has them, each of them once. */
std::vector<std::string>
makeNames(const Fields& fields)
{
  std::vector<std::string> names;
  for (const auto& field : fields) {
    names.push_back(field.name == "." ? "_" : field.name);
    for (char& c : names.back())
      if (c == '/' || c == '\0') // a group within the group, the end of the name
        c = '_';
  }
  makeUnique(names);
  return names;
}

} // namespace

void
writeVtkHdf(const std::string& file,
            const std::string& path,
            const Dataset& dataset,
            const std::vector<Triangle>& triangles)
{
  const std::uint64_t points =
      std::uint64_t{dataset.cloud.width} * dataset.cloud.height;
  const std::string group = vtkhdf_group;
  Hdf5Writer writer(path);
  const auto add_array = [&](const std::string& name, const Fields& fields) {
    const auto columns = findColumns(dataset, fields);
    writer.addTable(name,
                    columns[0].datatype,
                    points,
                    columns.size(),
                    [&dataset, columns](std::uint64_t first, std::uint64_t count) {
                      return packRecords(dataset, columns, first, count);
                    });
  };
  writer.addGroup(group);
  writer.addAttribute(group, "Version", std::vector<std::int64_t>{2, 0});
  writer.addAttribute(group, "Type", "PolyData");
  const auto same = [](std::uint64_t i) { return i; };
  addCount(writer, joinNames(group, "NumberOfPoints"), points);
  addCells(
      writer, joinNames(group, "Vertices"), triangles.empty() ? points : 0, 1, same);
  addCells(writer, joinNames(group, "Lines"), 0, 1, same);
  addCells(writer,
           joinNames(group, "Polygons"),
           triangles.size(),
           3,
           [&](std::uint64_t corner) { return triangles[corner / 3][corner % 3]; });
  addCells(writer, joinNames(group, "Strips"), 0, 1, same);
  const Fields fields = savedFields(dataset), normals = findNormals(fields);
  Fields axes, others;
  for (const auto& field : fields)
    if (axisOf(field.name) >= 0)
      axes.push_back(field);
    else if (!findField(normals, field.name))
      others.push_back(field);
  add_array(joinNames(group, "Points"), axes);
  const std::string data = joinNames(group, "PointData");
  writer.addGroup(data);
  if (!normals.empty()) {
    add_array(joinNames(data, "Normals"), normals);
    writer.addAttribute(joinNames(data, "Normals"), "Attribute", "Normals");
  }
  const std::vector<std::string> names = makeNames(others);
  for (std::size_t i = 0; i < others.size(); ++i)
    add_array(joinNames(data, names[i]), {others[i]});
  writer.save(file);
}

} // namespace io
} // namespace pcl_uvol
