// SPDX-License-Identifier: BSD-3-Clause
// Reads NRRD: Teem writes behind its buffers where lines of the header are long.
#include "common/numbers.h"
#include "common/printable.h"
#include "io/volume_header.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Vector = std::array<double, 3>;

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

std::uint8_t
parseDatatype(const std::string& name)
{
  const std::string words = ' ' + name + ' ';
  constexpr struct {
    std::string_view names;
    Type::PointFieldTypes datatype;
  } types[] = {
      {" signed char | int8 | int8_t ", Type::INT8},
      {" uchar | unsigned char | uint8 | uint8_t ", Type::UINT8},
      {" short | short int | signed short | signed short int | int16 | int16_t ",
       Type::INT16},
      {" ushort | unsigned short | unsigned short int | uint16 | uint16_t ",
       Type::UINT16},
      {" int | signed int | int32 | int32_t ", Type::INT32},
      {" uint | unsigned int | uint32 | uint32_t ", Type::UINT32},
      {" longlong | long long | long long int | signed long long | signed long long "
       "int | int64 | int64_t ",
       Type::INT64},
      {" ulonglong | unsigned long long | unsigned long long int | uint64 | uint64_t ",
       Type::UINT64},
      {" float ", Type::FLOAT32},
      {" double ", Type::FLOAT64}};
  for (const auto& type : types)
    if (type.names.find(words) != std::string_view::npos)
      return static_cast<std::uint8_t>(type.datatype);
  return 0;
}

/** Takes lines of the form "field: value" up to an empty one. */
class NrrdParser final : public VolumeHeader {
public:
  using VolumeHeader::VolumeHeader;

private:
  void
  take(const std::string& field, std::string_view value);
  void
  takeEncoding(const std::string& value);
  std::vector<Vector>
  vectorsIn(std::string_view value) const;
  std::uint64_t
  countIn(std::string_view value) const;
  void
  parse() override;
  void
  finish() override;

  bool has_order_ = false;
  std::vector<double> spacings_;
  std::vector<Vector> directions_, origin_;
};

std::uint64_t
NrrdParser::countIn(std::string_view value) const
{
  std::uint64_t count = 0;
  if (!parseCount(value, count))
    throwInLine({"unexpected_word", shortenText(value), "a count"});
  return count;
}

/** "(1,0,0) none (0,0,2)" */
std::vector<Vector>
NrrdParser::vectorsIn(std::string_view value) const
{
  std::vector<Vector> vectors;
  while (!(value = trimmed(value)).empty()) {
    Vector vector{not_given, not_given, not_given};
    std::size_t end = 4;
    if (value.substr(0, end) != "none") {
      end = std::min(value.find(')'), value.size());
      const std::string_view inside = value.substr(1, end - 1);
      std::size_t start = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t comma = std::min(inside.find(',', start), inside.size());
        vector[i] = parseWord(trimmed(inside.substr(start, comma - start)));
        start = std::min(comma + 1, inside.size());
      }
      if (value[0] != '(' || end == value.size() || start != inside.size())
        throwInLine({"incomplete_entry", "a vector", "three numbers, as in (1,0,0)"});
      ++end;
    }
    vectors.push_back(vector);
    value.remove_prefix(end);
  }
  return vectors;
}

void
NrrdParser::takeEncoding(const std::string& value)
{
  if (value == "raw")
    data_.encoding = VolumeData::Encoding::Raw;
  else if (value == "gz" || value == "gzip")
    data_.encoding = VolumeData::Encoding::Zipped;
  else if (value == "txt" || value == "text" || value == "ascii")
    data_.encoding = VolumeData::Encoding::Ascii;
  else
    throwInLine({"unsupported_value",
                 "the encoding",
                 shortenText(value),
                 "raw, gzip and ascii"});
}

void
NrrdParser::take(const std::string& field, std::string_view value)
{
  if (field == "type") {
    data_.datatype = parseDatatype(std::string(value));
    if (data_.datatype == 0)
      throwInLine({"unexpected_word", shortenText(value), "a number type"});
  }
  else if (field == "dimension") {
    if (countIn(value) != 3)
      throwInLine("not_scalar_volume");
  }
  else if (field == "sizes") {
    setDims(path_, words_, volume_);
    has_sizes_ = true;
  }
  else if (field == "spacings")
    for (const std::string_view word : words_)
      spacings_.push_back(parseWord(word));
  else if (field == "space directions")
    directions_ = vectorsIn(value);
  else if (field == "space origin")
    origin_ = vectorsIn(value);
  else if (field == "endian") {
    data_.big_endian = value == "big";
    has_order_ = value == "big" || value == "little";
  }
  else if (field == "encoding")
    takeEncoding(lowerCase(value));
  else if (field == "line skip" || field == "lineskip")
    data_.skipped_lines = countIn(value);
  else if (field == "byte skip" || field == "byteskip") {
    data_.at_end = value == "-1";
    data_.skipped_bytes = data_.at_end ? 0 : countIn(value);
  }
  else if (field == "data file" || field == "datafile")
    takeFiles(value);
}

void
NrrdParser::finish()
{
  if (!has_sizes_ || data_.datatype == 0)
    throwUnreadable(path_, {"missing_part", "type or sizes of its header"});
  const bool has_bytes = data_.encoding != VolumeData::Encoding::Ascii &&
                         data_.datatype != Type::INT8 && data_.datatype != Type::UINT8;
  if (has_bytes && !has_order_)
    throwUnreadable(path_, {"missing_part", "the endian of its numbers"});
  if (data_.at_end && data_.encoding != VolumeData::Encoding::Raw)
    throwUnreadable(path_,
                    {"incomplete_entry", "a byte skip of -1", "the encoding raw"});
  for (std::size_t axis = 0; axis < std::min<std::size_t>(3, spacings_.size()); ++axis)
    if (std::isfinite(spacings_[axis]))
      volume_.spacing[axis] = spacings_[axis];
  for (std::size_t axis = 0; axis < std::min<std::size_t>(3, directions_.size());
       ++axis)
    if (std::isfinite(directions_[axis][axis]))
      setDirection(path_, axis, directions_[axis], volume_);
  for (std::size_t axis = 0; axis < 3 && !origin_.empty(); ++axis)
    if (std::isfinite(origin_[0][axis]))
      volume_.origin[axis] = origin_[0][axis];
}

void
NrrdParser::parse()
{
  std::string_view line;
  if (!cursor_.nextLine(line) || line.substr(0, 4) != "NRRD")
    throwUnreadable(path_, {"wrong_start", "a NRRD file", "'NRRD'"});
  while (cursor_.nextLine(line) && !line.empty()) {
    const std::size_t colon = line.find(':');
    if (line[0] == '#' || line.substr(std::min(colon, line.size()), 2) == ":=")
      continue;
    if (colon == line.npos)
      throwInLine({"foreign_line", "a NRRD header"});
    const std::string field = lowerCase(trimmed(line.substr(0, colon)));
    const std::string value(trimmed(line.substr(colon + 1)));
    splitWords(value, words_);
    take(field, value);
  }
  if (data_.files.empty()) {
    data_.files = {path_};
    data_.offset = cursor_.tell().offset;
  }
}

} // namespace

Volume
readNrrd(const std::string& path)
{
  return NrrdParser(path).read();
}

std::vector<std::string>
findNrrdFiles(const std::string& path)
{
  return NrrdParser(path).findFiles();
}

} // namespace io
} // namespace pcl_uvol
