// SPDX-License-Identifier: BSD-3-Clause
// Writes CSV: a header line, missing values as empty cells, labels as names.
#include "io/columns.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/table_file.h"

namespace pcl_uvol {
namespace io {
namespace {

void
appendCell(std::string& text, const Column& column, const std::uint8_t* point)
{
  if (column.labels) {
    const FieldComponent label{column.offset, column.datatype};
    text += quotedCell(nameOfLabel(*column.labels, label.read(point)));
    return;
  }
  const std::size_t start = text.size();
  appendNumber(text, column, point);
  if (text.compare(start, std::string::npos, "nan") == 0)
    text.resize(start); // a missing value is an empty cell
}

} // namespace

void
writeCsv(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const SaveOptions& options)
{
  const std::vector<Column> columns = findColumns(dataset, savedFields(dataset));
  OutputFile out(file, path);
  std::string& text = out.buffer();
  for (const auto& column : columns)
    text += quotedCell(column.name) + ',';
  text.back() = '\n';
  const auto& cloud = dataset.cloud;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  const std::uint8_t* point = cloud.data.data();
  WriteProgress progress(count, options);
  for (std::size_t i = 0; i < count; ++i, point += cloud.point_step) {
    for (const auto& column : columns) {
      appendCell(text, column, point);
      text += ',';
    }
    text.back() = '\n';
    out.flushFull();
    progress.advance();
  }
  out.close();
}

} // namespace io
} // namespace pcl_uvol
