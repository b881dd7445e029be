// SPDX-License-Identifier: BSD-3-Clause
#include "io/volume_header.h"

#include "common/numbers.h"
#include "common/printable.h"

namespace pcl_uvol {
namespace io {

Volume
VolumeHeader::read()
{
  parse();
  finish();
  readValues(path_, data_, volume_);
  return std::move(volume_);
}

std::vector<std::string>
VolumeHeader::findFiles()
{
  parse();
  return data_.files;
}

void
VolumeHeader::takeFiles(std::string_view value)
{
  if (words_.empty())
    throwInLine({"incomplete_entry", "the line", "the name of a file of numbers"});
  // "LIST" or "LIST 2", where the number is the dimension of each file.
  if (words_[0] == "LIST" && words_.size() <= 2) {
    std::string_view line;
    while (cursor_.nextLine(line))
      if (!trimmed(line).empty())
        data_.files.push_back(besideFile(path_, trimmed(line)));
  }
  else if (value.find('%') != value.npos)
    data_.files = expandPattern(path_, words_);
  else
    data_.files = {besideFile(path_, value)};
}

double
VolumeHeader::parseWord(std::string_view word) const
{
  double number = 0.0;
  if (!parseNumber(word, number))
    throwInLine({"unexpected_word", shortenText(word), "a number"});
  return number;
}

void
VolumeHeader::throwInLine(const FileReason& reason) const
{
  throwUnreadable(path_, cursor_.tell().line, reason);
}

} // namespace io
} // namespace pcl_uvol
