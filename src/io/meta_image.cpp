// SPDX-License-Identifier: BSD-3-Clause
// Reads MetaImage: MetaIO, which VTK has, reads behind its buffers where headers lie.
#include "common/numbers.h"
#include "common/printable.h"
#include "io/volume_header.h"

#include <pcl/PCLPointField.h>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

std::uint8_t
parseDatatype(std::string_view name)
{
  constexpr struct {
    std::string_view name;
    Type::PointFieldTypes datatype;
  } types[] = {{"MET_CHAR", Type::INT8},
               {"MET_UCHAR", Type::UINT8},
               {"MET_SHORT", Type::INT16},
               {"MET_USHORT", Type::UINT16},
               {"MET_INT", Type::INT32},
               {"MET_UINT", Type::UINT32},
               {"MET_LONG", Type::INT32}, // of four bytes in files
               {"MET_ULONG", Type::UINT32},
               {"MET_LONG_LONG", Type::INT64},
               {"MET_ULONG_LONG", Type::UINT64},
               {"MET_FLOAT", Type::FLOAT32},
               {"MET_DOUBLE", Type::FLOAT64}};
  for (const auto& type : types)
    if (type.name == name)
      return static_cast<std::uint8_t>(type.datatype);
  return 0;
}

/** Takes lines of the form "Key = value" up to ElementDataFile. */
class HeaderParser final : public VolumeHeader {
public:
  using VolumeHeader::VolumeHeader;

private:
  void
  take(std::string_view key, std::string_view value);
  bool
  isTrue(std::string_view value) const;
  std::vector<double>
  numbersIn(std::size_t count) const;
  void
  takeNumbers(std::string_view value);
  void
  parse() override;
  void
  finish() override;

  std::uint64_t dimensions_ = 0, channels_ = 1;
  bool has_spacing_ = false, compressed_ = false;
  std::vector<double> matrix_;
};

bool
HeaderParser::isTrue(std::string_view value) const
{
  const std::string lower = lowerCase(value);
  if (lower != "true" && lower != "false" && lower != "1" && lower != "0")
    throwInLine({"unsupported_value", "a truth", shortenText(value), "True and False"});
  return lower == "true" || lower == "1";
}

std::vector<double>
HeaderParser::numbersIn(std::size_t count) const
{
  std::vector<double> numbers(count);
  if (words_.size() != count)
    throwInLine({"wrong_count", "the line", words_.size(), "numbers", count});
  for (std::size_t i = 0; i < count; ++i)
    numbers[i] = parseWord(words_[i]);
  return numbers;
}

void
HeaderParser::take(std::string_view key, std::string_view value)
{
  if (key == "NDims") {
    if (!parseCount(value, dimensions_) || dimensions_ < 2 || dimensions_ > 3)
      throwInLine("not_scalar_volume");
  }
  else if (key == "DimSize") {
    if (words_.size() == 2 && dimensions_ == 2)
      words_.push_back("1");
    setDims(path_, words_, volume_);
    has_sizes_ = true;
  }
  else if (key == "ElementSpacing" || (key == "ElementSize" && !has_spacing_)) {
    const auto spacing = numbersIn(dimensions_);
    std::copy(spacing.begin(), spacing.end(), volume_.spacing.begin());
    has_spacing_ = has_spacing_ || key == "ElementSpacing";
  }
  else if (key == "Offset" || key == "Position" || key == "Origin") {
    const auto origin = numbersIn(dimensions_);
    std::copy(origin.begin(), origin.end(), volume_.origin.begin());
  }
  else if (key == "TransformMatrix" || key == "Rotation" || key == "Orientation")
    matrix_ = numbersIn(dimensions_ * dimensions_);
  else if (key == "ElementNumberOfChannels") {
    if (!parseCount(value, channels_) || channels_ != 1)
      throwInLine("not_scalar_volume");
  }
  else if (key == "ElementType") {
    data_.datatype = parseDatatype(value);
    if (data_.datatype == 0)
      throwInLine({"unexpected_word", shortenText(value), "a number type"});
  }
  else if (key == "BinaryData")
    data_.encoding =
        isTrue(value) ? VolumeData::Encoding::Raw : VolumeData::Encoding::Ascii;
  else if (key == "CompressedData")
    compressed_ = isTrue(value);
  else if (key == "BinaryDataByteOrderMSB" || key == "ElementByteOrderMSB")
    data_.big_endian = isTrue(value);
  else if (key == "HeaderSize") {
    data_.at_end = value == "-1";
    if (!data_.at_end && !parseCount(value, data_.skipped_bytes))
      throwInLine({"unexpected_word", shortenText(value), "the size of a header"});
  }
}

void
HeaderParser::takeNumbers(std::string_view value)
{
  if (value != "LOCAL")
    return takeFiles(value);
  data_.files = {path_};
  data_.offset = cursor_.tell().offset;
  data_.skipped_bytes = 0;
}

void
HeaderParser::finish()
{
  if (!has_sizes_ || data_.datatype == 0)
    throwUnreadable(path_,
                    {"missing_part", "NDims, DimSize or ElementType of its header"});
  if (compressed_)
    data_.encoding = VolumeData::Encoding::Zipped;
  for (std::size_t axis = 0; axis < 3 && !matrix_.empty(); ++axis) {
    std::array<double, 3> direction{};
    direction[axis] = 1.0;
    if (axis < dimensions_)
      std::copy_n(matrix_.begin() + static_cast<int>(axis * dimensions_),
                  dimensions_,
                  direction.begin());
    for (double& component : direction)
      component *= volume_.spacing[axis];
    setDirection(path_, axis, direction, volume_);
  }
}

void
HeaderParser::parse()
{
  std::string_view line;
  while (cursor_.nextLine(line)) {
    if (trimmed(line).empty())
      continue;
    const std::size_t equals = line.find_first_of("=:");
    if (equals == line.npos)
      throwInLine({"foreign_line", "a MetaImage header"});
    const std::string key(trimmed(line.substr(0, equals)));
    const std::string value(trimmed(line.substr(equals + 1)));
    splitWords(value, words_);
    if (key == "ElementDataFile" && !words_.empty())
      return takeNumbers(value);
    take(key, value);
  }
  throwUnreadable(path_, {"missing_part", "ElementDataFile of its header"});
}

} // namespace

Volume
readMetaImage(const std::string& path)
{
  return HeaderParser(path).read();
}

std::vector<std::string>
findMetaImageFiles(const std::string& path)
{
  return HeaderParser(path).findFiles();
}

} // namespace io
} // namespace pcl_uvol
