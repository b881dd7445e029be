// SPDX-License-Identifier: BSD-3-Clause
#include "io/table_file.h"

#include "io/files.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cstring>

namespace pcl_uvol {

std::string
quotedCell(const std::string& name)
{
  const bool plain = std::none_of(name.begin(), name.end(), [](char c) {
    return (c >= '\0' && c < ' ') || std::strchr(",;\"#", c) != nullptr;
  });
  if (plain)
    return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"')
      text += '"';
    text += c == '\n' || c == '\r' || c == '\0' ? ' ' : c; // lines and texts end there
  }
  return text + '"';
}

void
saveTable(const std::string& path, const std::string& text)
{
  checkTablePath(path);
  writeAtomically(path, [&](const std::string& temporary_path) {
    io::OutputFile file(temporary_path, path);
    file.buffer() = text;
    file.close();
  });
}

void
checkTablePath(const std::string& path)
{
  if (io::getEnding(path) != ".csv")
    io::throwUnwritable(path, {"unwritten_ending", "tables", ".csv"});
  io::checkWritable(path);
}

} // namespace pcl_uvol
