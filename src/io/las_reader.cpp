// SPDX-License-Identifier: BSD-3-Clause
// Points of laser scans in LAS 1.0 to 1.4, formats 0 to 10, not packed (ASPRS, LAS
// Specification 1.4 - R15).
#include "common/printable.h"
#include "io/formats.h"
#include "io/record_source.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t las_header_bytes = 227, long_header_bytes = 375;
constexpr std::size_t block_points = 4096;
/** Bytes of a point by its format. */
constexpr std::array<std::size_t, 11> format_bytes{
    {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67}};

template <typename T>
T
numberAt(const std::string& bytes, std::size_t offset)
{
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/** A number of a point, at its place in the file; some share a byte. */
struct Attribute {
  std::string name;
  std::uint8_t datatype;
  std::size_t offset;
  std::uint8_t shift = 0, mask = 0; ///< of the bits in a byte; 0: the whole number
  /** Of a number that stands for another one, a double. */
  bool is_scaled = false;
  double factor = 1.0, added = 0.0;
  std::optional<double> missing = std::nullopt; ///< the number that stands for NaN
};

std::vector<Attribute>
listAttributes(std::size_t format)
{
  std::vector<Attribute> attributes{{"intensity", Type::UINT16, 12}};
  const auto add = [&](std::initializer_list<Attribute> more) {
    attributes.insert(attributes.end(), more);
  };
  const auto add_colors = [&](std::size_t offset) {
    add({{"red", Type::UINT16, offset},
         {"green", Type::UINT16, offset + 2},
         {"blue", Type::UINT16, offset + 4}});
  };
  if (format < 6) {
    add({{"return_number", Type::UINT8, 14, 0, 7},
         {"number_of_returns", Type::UINT8, 14, 3, 7},
         {"classification", Type::UINT8, 15, 0, 31},
         {"scan_angle", Type::INT8, 16},
         {"user_data", Type::UINT8, 17},
         {"point_source_id", Type::UINT16, 18}});
    if (format == 1 || format >= 3)
      add({{"gps_time", Type::FLOAT64, 20}});
    if (format == 2 || format == 3 || format == 5)
      add_colors(format == 2 ? 20 : 28);
    return attributes;
  }
  add({{"return_number", Type::UINT8, 14, 0, 15},
       {"number_of_returns", Type::UINT8, 14, 4, 15},
       {"classification", Type::UINT8, 16},
       {"user_data", Type::UINT8, 17},
       {"scan_angle", Type::INT16, 18},
       {"point_source_id", Type::UINT16, 20},
       {"gps_time", Type::FLOAT64, 22}});
  if (format == 7 || format == 8 || format == 10)
    add_colors(30);
  if (format == 8 || format == 10)
    add({{"nir", Type::UINT16, 36}});
  return attributes;
}

struct LasHeader {
  std::size_t format = 0, point_bytes = 0;
  std::uint64_t points = 0, offset = 0;
  std::array<double, 3> scale{}, shift{};
  std::uint64_t records = 0; ///< where the variable length records begin
  std::size_t record_count = 0;
};

/** The datatypes of extra bytes, from 1 on (LAS 1.4, table 24). */
constexpr std::array<std::uint8_t, 11> extra_types{{0,
                                                    Type::UINT8,
                                                    Type::INT8,
                                                    Type::UINT16,
                                                    Type::INT16,
                                                    Type::UINT32,
                                                    Type::INT32,
                                                    Type::UINT64,
                                                    Type::INT64,
                                                    Type::FLOAT32,
                                                    Type::FLOAT64}};

double
readNumber(std::uint8_t datatype, const char* bytes)
{
  const auto read = [bytes](auto number) {
    std::memcpy(&number, bytes, sizeof(number));
    return static_cast<double>(number);
  };
  switch (datatype) {
  case Type::UINT8:
    return read(std::uint8_t());
  case Type::INT8:
    return read(std::int8_t());
  case Type::UINT16:
    return read(std::uint16_t());
  case Type::INT16:
    return read(std::int16_t());
  case Type::UINT32:
    return read(std::uint32_t());
  case Type::INT32:
    return read(std::int32_t());
  case Type::UINT64:
    return read(std::uint64_t());
  case Type::INT64:
    return read(std::int64_t());
  case Type::FLOAT32:
    return read(0.0f);
  default:
    return read(0.0);
  }
}

/** A text of that many bytes at most, which may end with zeros. */
std::string
textAt(const std::string& bytes, std::size_t offset, std::size_t most)
{
  const std::string text = bytes.substr(offset, most);
  return text.substr(0, text.find('\0'));
}

/** One description of 192 bytes: what is at a place of the extra bytes.
 * \param offset is moved behind it
 * \param attributes get it, unless its bytes have no type */
void
addExtra(const std::string& bytes,
         std::size_t& offset,
         std::vector<Attribute>& attributes)
{
  constexpr unsigned has_missing = 1, has_scale = 8, has_offset = 16;
  const auto type = numberAt<std::uint8_t>(bytes, 2);
  const unsigned options = numberAt<std::uint8_t>(bytes, 3);
  if (type == 0 || type > 30) {
    offset += options; // that many bytes without a type
    return;
  }
  const std::size_t count = 1 + (type - 1) / 10; // numbers of vectors follow each other
  const std::uint8_t datatype = extra_types[1 + (type - 1) % 10];
  for (std::size_t i = 0; i < count; ++i, offset += datatypeSize(datatype)) {
    Attribute extra;
    extra.name = textAt(bytes, 4, 32);
    if (count > 1)
      extra.name += '_' + std::to_string(i);
    extra.datatype = datatype;
    extra.offset = offset;
    if (options & has_missing) // of the widest type of its kind
      extra.missing =
          datatype == Type::FLOAT32 || datatype == Type::FLOAT64
              ? numberAt<double>(bytes, 40 + 8 * i)
          : (type - 1) % 2 == 0 // unsigned
              ? static_cast<double>(numberAt<std::uint64_t>(bytes, 40 + 8 * i))
              : static_cast<double>(numberAt<std::int64_t>(bytes, 40 + 8 * i));
    if (options & has_scale)
      extra.factor = numberAt<double>(bytes, 112 + 8 * i);
    if (options & has_offset)
      extra.added = numberAt<double>(bytes, 136 + 8 * i);
    extra.is_scaled = (options & (has_missing | has_scale | has_offset)) != 0;
    attributes.push_back(extra);
  }
}

/** The extra bytes that a variable length record describes.
 * \param end is moved behind them */
std::vector<Attribute>
listExtras(const InputFile& file, const LasHeader& header, std::size_t& end)
{
  constexpr std::size_t record_bytes = 54, description_bytes = 192;
  std::vector<Attribute> extras;
  std::uint64_t at = header.records;
  for (std::size_t i = 0; i < header.record_count; ++i) {
    if (at + record_bytes > header.offset)
      break;
    std::string record(record_bytes, '\0');
    file.read(at, record.data(), record.size());
    const auto length = numberAt<std::uint16_t>(record, 20);
    at += record_bytes;
    if (textAt(record, 2, 16) == "LASF_Spec" &&
        numberAt<std::uint16_t>(record, 18) == 4 && at + length <= header.offset)
      for (std::size_t from = 0; from + description_bytes <= length;
           from += description_bytes) {
        std::string description(description_bytes, '\0');
        file.read(at + from, description.data(), description.size());
        addExtra(description, end, extras);
      }
    at += length;
  }
  if (end > header.point_bytes) // which says something else
    extras.clear();
  return extras;
}

LasHeader
readHeader(const InputFile& file, const std::string& path)
{
  const std::string bytes = file.head(long_header_bytes);
  if (bytes.rfind("LASF", 0) != 0)
    throwUnreadable(path, {"wrong_start", "a LAS file", "'LASF'"});
  if (bytes.size() < las_header_bytes)
    throwUnreadable(path, {"truncated_part", "its header"});
  const auto format = numberAt<std::uint8_t>(bytes, 104);
  const auto minor = numberAt<std::uint8_t>(bytes, 25);
  if (format & 0xc0)
    throwUnreadable(path, "packed_points");
  if (numberAt<std::uint8_t>(bytes, 24) != 1 || minor > 4 ||
      format >= format_bytes.size())
    throwUnreadable(path,
                    {"unsupported_value",
                     "the format of its points",
                     shortenText(std::to_string(format) + " of LAS " +
                                 std::to_string(numberAt<std::uint8_t>(bytes, 24)) +
                                 '.' + std::to_string(minor)),
                     "formats 0 to 10 of LAS 1.0 to 1.4"});
  LasHeader header;
  header.format = format;
  header.point_bytes = numberAt<std::uint16_t>(bytes, 105);
  header.offset = numberAt<std::uint32_t>(bytes, 96);
  header.records = numberAt<std::uint16_t>(bytes, 94);
  header.record_count = numberAt<std::uint32_t>(bytes, 100);
  header.points = numberAt<std::uint32_t>(bytes, 107);
  if (minor == 4) {
    if (bytes.size() < long_header_bytes)
      throwUnreadable(path, {"truncated_part", "its header"});
    header.points = numberAt<std::uint64_t>(bytes, 247);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = numberAt<double>(bytes, 131 + 8 * axis);
    header.shift[axis] = numberAt<double>(bytes, 155 + 8 * axis);
  }
  if (header.point_bytes < format_bytes[format])
    throwUnreadable(path,
                    {"wrong_count",
                     "a point of format " + std::to_string(format),
                     header.point_bytes,
                     "bytes",
                     std::to_string(format_bytes[format]) + " or more"});
  if (header.offset > file.getSize() ||
      header.points > (file.getSize() - header.offset) / header.point_bytes)
    throwUnreadable(path, {"truncated_data", header.points, "points", file.getSize()});
  return header;
}

class LasSource : public NumberedSource {
public:
  explicit LasSource(const std::string& path)
      : file_(path)
      , header_(readHeader(file_, path))
      , attributes_(listAttributes(header_.format))
  {
    info_.count = header_.points;
    const std::size_t known = format_bytes[header_.format];
    std::size_t end = known;
    const std::vector<Attribute> extras = listExtras(file_, header_, end);
    attributes_.insert(attributes_.end(), extras.begin(), extras.end());
    for (const char* const axis : {"x", "y", "z"})
      appendField(info_.fields, axis, Type::FLOAT64);
    std::vector<std::string> names{"x", "y", "z"};
    for (const Attribute& attribute : attributes_)
      names.push_back(attribute.name);
    makeUnique(names);
    for (std::size_t i = 0; i < attributes_.size(); ++i)
      appendField(info_.fields,
                  names[3 + i],
                  attributes_[i].is_scaled ? std::uint8_t{Type::FLOAT64}
                                           : attributes_[i].datatype);
    if (header_.point_bytes > known && extras.empty())
      info_.notes.push_back({"extra_bytes", {{"bytes", header_.point_bytes - known}}});
  }

  void
  read(std::size_t count, std::uint8_t* records) override;

private:
  void
  convert(const std::uint8_t* point, std::uint8_t* record) const;

  const InputFile file_;
  const LasHeader header_;
  std::vector<Attribute> attributes_;
  std::vector<std::uint8_t> block_;
};

void
LasSource::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t step = recordBytes(info_.fields);
  while (count > 0) {
    const std::size_t now = std::min(count, block_points);
    block_.resize(now * header_.point_bytes);
    file_.read(
        header_.offset + next_ * header_.point_bytes, block_.data(), block_.size());
    for (std::size_t i = 0; i < now; ++i, records += step)
      convert(block_.data() + i * header_.point_bytes, records);
    next_ += now;
    count -= now;
  }
}

void
LasSource::convert(const std::uint8_t* point, std::uint8_t* record) const
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t steps;
    std::memcpy(&steps, point + 4 * axis, sizeof(steps));
    const double coordinate = steps * header_.scale[axis] + header_.shift[axis];
    std::memcpy(record + 8 * axis, &coordinate, sizeof(coordinate));
  }
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    const Attribute& attribute = attributes_[i];
    const pcl::PCLPointField& field = info_.fields[3 + i];
    if (attribute.is_scaled) {
      const double raw = readNumber(
          attribute.datatype, reinterpret_cast<const char*>(point) + attribute.offset);
      const double value = attribute.missing && raw == *attribute.missing
                               ? std::numeric_limits<double>::quiet_NaN()
                               : raw * attribute.factor + attribute.added;
      std::memcpy(record + field.offset, &value, sizeof(value));
      continue;
    }
    std::memcpy(record + field.offset, point + attribute.offset, fieldBytes(field));
    if (attribute.mask != 0)
      record[field.offset] =
          static_cast<std::uint8_t>(record[field.offset] >> attribute.shift) &
          attribute.mask;
  }
}

} // namespace

std::unique_ptr<RecordSource>
openLas(const std::string& path)
{
  return std::make_unique<LasSource>(path);
}

} // namespace io
} // namespace pcl_uvol
