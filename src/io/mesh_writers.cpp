// SPDX-License-Identifier: BSD-3-Clause
// Meshes in the formats of modelling and printing.
#include "common/records.h"
#include "io/columns.h"
#include "io/files.h"
#include "io/formats.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace pcl_uvol {
namespace io {

namespace {

/** The columns of those names; none unless all are there. */
std::vector<Column>
chooseColumns(const std::vector<Column>& columns, const char* const (&names)[3])
{
  std::vector<Column> chosen;
  for (const char* const name : names)
    for (const Column& column : columns)
      if (column.name == name)
        chosen.push_back(column);
  if (chosen.size() != std::size(names))
    chosen.clear();
  return chosen;
}

/** A line of numbers for every point, each behind a word. */
void
writeLines(OutputFile& out,
           const Dataset& dataset,
           const std::vector<Column>& columns,
           const char* word,
           const SaveOptions& options)
{
  const auto& cloud = dataset.cloud;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  const std::uint8_t* point = cloud.data.data();
  WriteProgress progress(count, options);
  for (std::size_t i = 0; i < count; ++i, point += cloud.point_step) {
    std::string& text = out.buffer();
    text += word;
    for (const Column& column : columns) {
      appendNumber(text, column, point);
      text += ' ';
    }
    text.back() = '\n';
    out.flushFull();
    progress.advance();
  }
}

void
writeComments(OutputFile& out, const SaveOptions& options)
{
  for (std::string comment : options.comments) {
    std::replace(comment.begin(), comment.end(), '\n', ' ');
    out.buffer() += "# " + comment + '\n';
  }
}

std::vector<Column>
positionColumns(const Dataset& dataset)
{
  return chooseColumns(findColumns(dataset, savedFields(dataset)), {"x", "y", "z"});
}

} // namespace

void
writeObj(const std::string& file,
         const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options)
{
  OutputFile out(file, path);
  writeComments(out, options);
  writeLines(out, vertices, positionColumns(vertices), "v ", options);
  const std::vector<Column> normals =
      chooseColumns(findColumns(vertices, savedFields(vertices)),
                    {"normal_x", "normal_y", "normal_z"});
  if (!normals.empty())
    writeLines(out, vertices, normals, "vn ", options);
  for (const Triangle& triangle : triangles) {
    std::string& text = out.buffer();
    text += 'f';
    for (const std::uint32_t vertex : triangle) {
      const std::string number = std::to_string(std::uint64_t{vertex} + 1);
      text += ' ' + number;
      if (!normals.empty())
        text += "//" + number;
    }
    text += '\n';
    out.flushFull();
  }
  out.close();
}

void
writeOff(const std::string& file,
         const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options)
{
  OutputFile out(file, path);
  out.buffer() += "OFF\n";
  writeComments(out, options);
  out.buffer() += std::to_string(vertices.cloud.width) + ' ' +
                  std::to_string(triangles.size()) + " 0\n";
  writeLines(out, vertices, positionColumns(vertices), "", options);
  for (const Triangle& triangle : triangles) {
    out.buffer() += "3 " + std::to_string(triangle[0]) + ' ' +
                    std::to_string(triangle[1]) + ' ' + std::to_string(triangle[2]) +
                    '\n';
    out.flushFull();
  }
  out.close();
}

void
writeStl(const std::string& file,
         const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles)
{
  constexpr std::size_t header_bytes = 80;
  OutputFile out(file, path);
  out.buffer().append(header_bytes, ' ');
  const auto count = static_cast<std::uint32_t>(triangles.size());
  out.buffer().append(reinterpret_cast<const char*>(&count), sizeof(count));
  const CloudView view = viewOf(vertices.cloud);
  for (const Triangle& triangle : triangles) {
    const float* const corners[3] = {
        view.xyz(triangle[0]), view.xyz(triangle[1]), view.xyz(triangle[2])};
    double u[3], v[3];
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = static_cast<double>(corners[1][i]) - corners[0][i];
      v[i] = static_cast<double>(corners[2][i]) - corners[0][i];
    }
    const double normal[3] = {u[1] * v[2] - u[2] * v[1],
                              u[2] * v[0] - u[0] * v[2],
                              u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    std::string& bytes = out.buffer();
    for (const double part : normal) {
      const auto number = static_cast<float>(length > 0.0 ? part / length : 0.0);
      bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    }
    for (const float* const corner : corners)
      bytes.append(reinterpret_cast<const char*>(corner), 3 * sizeof(float));
    bytes.append(2, '\0'); // bytes of attributes, of which there are none
    out.flushFull();
  }
  out.close();
}

} // namespace io
} // namespace pcl_uvol
