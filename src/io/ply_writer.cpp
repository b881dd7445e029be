// SPDX-License-Identifier: BSD-3-Clause
// Writes points as vertices of PLY files, with the names and types of that format.
#include "io/columns.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/held_fields.h"
#include "io/label_comments.h"
#include "io/ply_types.h"

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

/** Packed colours are three or four numbers to every program but PCL. */
std::vector<Column>
unpackColors(const std::vector<Column>& columns)
{
  std::vector<Column> unpacked;
  for (const auto& column : columns) {
    const bool alpha = column.name == "rgba";
    if ((column.name != "rgb" && !alpha) ||
        (column.datatype != Type::FLOAT32 && column.datatype != Type::UINT32)) {
      unpacked.push_back(column);
      continue;
    }
    // PCL keeps them as the bytes blue, green, red, alpha
    const auto append = [&](const char* name, std::size_t byte) {
      unpacked.push_back({name, Type::UINT8, column.offset + byte, Type::UINT8, 0.0});
    };
    append("red", 2);
    append("green", 1);
    append("blue", 0);
    if (alpha)
      append("alpha", 3);
  }
  return unpacked;
}

void
writeFaces(OutputFile& out, const std::vector<Triangle>& triangles, bool ascii)
{
  for (const Triangle& triangle : triangles) {
    std::string& buffer = out.buffer();
    if (ascii)
      buffer += "3 " + std::to_string(triangle[0]) + ' ' + std::to_string(triangle[1]) +
                ' ' + std::to_string(triangle[2]) + '\n';
    else {
      buffer += '\3';
      buffer.append(reinterpret_cast<const char*>(triangle.data()), sizeof(triangle));
    }
    out.flushFull();
  }
}

} // namespace

std::uint8_t
plyDatatype(std::string_view name)
{
  constexpr struct {
    const char *name, *other_name;
    Type::PointFieldTypes datatype;
  } types[] = {{"char", "int8", Type::INT8},
               {"uchar", "uint8", Type::UINT8},
               {"short", "int16", Type::INT16},
               {"ushort", "uint16", Type::UINT16},
               {"int", "int32", Type::INT32},
               {"uint", "uint32", Type::UINT32},
               {"float", "float32", Type::FLOAT32},
               {"double", "float64", Type::FLOAT64}};
  for (const auto& known : types)
    if (name == known.name || name == known.other_name)
      return static_cast<std::uint8_t>(known.datatype);
  return 0;
}

const char*
plyTypeName(std::uint8_t datatype)
{
  switch (datatype) {
  case Type::INT8:
    return "char";
  case Type::UINT8:
  case Type::BOOL:
    return "uchar";
  case Type::INT16:
    return "short";
  case Type::UINT16:
    return "ushort";
  case Type::INT32:
    return "int";
  case Type::UINT32:
    return "uint";
  case Type::FLOAT32:
    return "float";
  case Type::FLOAT64:
    return "double";
  default:
    return nullptr;
  }
}

void
writePly(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options)
{
  Fields fields = heldFields(".ply", dataset);
  renameFields(fields, cloud_normals, ply_normals);
  std::vector<Column> columns = unpackColors(findColumns(dataset, fields));
  std::vector<std::string> names, comments = options.comments;
  for (const auto& column : columns)
    names.push_back(column.name);
  const std::vector<std::string> originals = names;
  makeWords(names, comments);
  addLabelComments(dataset, originals, names, comments);
  OutputFile out(file, path);
  std::string& header = out.buffer();
  header = std::string("ply\nformat ") +
           (options.ascii ? "ascii" : "binary_little_endian") + " 1.0\n";
  for (std::string comment : comments) {
    std::replace(comment.begin(), comment.end(), '\n', ' ');
    header += "comment " + comment + '\n';
  }
  const std::size_t count =
      static_cast<std::size_t>(dataset.cloud.width) * dataset.cloud.height;
  header += "element vertex " + std::to_string(count) + '\n';
  for (std::size_t i = 0; i < columns.size(); ++i)
    header += std::string("property ") + plyTypeName(columns[i].datatype) + ' ' +
              names[i] + '\n';
  if (!triangles.empty())
    header += "element face " + std::to_string(triangles.size()) +
              "\nproperty list uchar int vertex_indices\n";
  header += "end_header\n";
  writeRecords(out, dataset, columns, options);
  writeFaces(out, triangles, options.ascii);
  out.close();
}

} // namespace io
} // namespace pcl_uvol
