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
  const char* name;
  std::uint8_t datatype;
  std::size_t offset;
  std::uint8_t shift = 0, mask = 0; ///< of the bits in a byte; 0: the whole number
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
};

LasHeader
readHeader(const InputFile& file, const std::string& path)
{
  const std::string bytes = file.head(long_header_bytes);
  if (bytes.rfind("LASF", 0) != 0)
    throwUnreadable(path, "it is no LAS file: it does not begin with 'LASF'");
  if (bytes.size() < las_header_bytes)
    throwUnreadable(path, "it is truncated: its header is not complete");
  const auto format = numberAt<std::uint8_t>(bytes, 104);
  const auto minor = numberAt<std::uint8_t>(bytes, 25);
  if (format & 0xc0)
    throwUnreadable(path,
                    "its points are packed (LAZ); laszip -i in.laz -o out.las "
                    "unpacks them");
  if (numberAt<std::uint8_t>(bytes, 24) != 1 || minor > 4 ||
      format >= format_bytes.size())
    throwUnreadable(path,
                    "its points have the format " + std::to_string(format) +
                        " of LAS " + std::to_string(numberAt<std::uint8_t>(bytes, 24)) +
                        '.' + std::to_string(minor) +
                        "; formats 0 to 10 of LAS 1.0 to 1.4 are "
                        "read");
  LasHeader header;
  header.format = format;
  header.point_bytes = numberAt<std::uint16_t>(bytes, 105);
  header.offset = numberAt<std::uint32_t>(bytes, 96);
  header.points = numberAt<std::uint32_t>(bytes, 107);
  if (minor == 4) {
    if (bytes.size() < long_header_bytes)
      throwUnreadable(path, "it is truncated: its header is not complete");
    header.points = numberAt<std::uint64_t>(bytes, 247);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = numberAt<double>(bytes, 131 + 8 * axis);
    header.shift[axis] = numberAt<double>(bytes, 155 + 8 * axis);
  }
  if (header.point_bytes < format_bytes[format])
    throwUnreadable(path,
                    "it is damaged: points of format " + std::to_string(format) +
                        " need " + std::to_string(format_bytes[format]) +
                        " bytes, but have " + std::to_string(header.point_bytes));
  if (header.offset > file.getSize() ||
      header.points > (file.getSize() - header.offset) / header.point_bytes)
    throwUnreadable(path,
                    "it is truncated or damaged: its header promises " +
                        std::to_string(header.points) + " points, but the file has " +
                        std::to_string(file.getSize()) + " bytes");
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
    for (const char* const axis : {"x", "y", "z"})
      appendField(info_.fields, axis, Type::FLOAT64);
    for (const Attribute& attribute : attributes_)
      appendField(info_.fields, attribute.name, attribute.datatype);
    if (header_.point_bytes > format_bytes[header_.format])
      info_.notes.push_back(
          {"extra_bytes",
           {{"bytes", header_.point_bytes - format_bytes[header_.format]}}});
  }

  void
  read(std::size_t count, std::uint8_t* records) override;

private:
  void
  convert(const std::uint8_t* point, std::uint8_t* record) const;

  const InputFile file_;
  const LasHeader header_;
  const std::vector<Attribute> attributes_;
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
