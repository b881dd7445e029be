// SPDX-License-Identifier: BSD-3-Clause
// Writes .npz: a zip of arrays of NumPy, one per field, not packed.
#include "io/columns.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/little_endian.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <zlib.h>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t block_points = 1u << 14;

/** "<f4" and the like; files are written in the order of this machine's bytes. */
std::string
numpyType(std::uint8_t datatype)
{
  if (datatype == Type::BOOL)
    return "|b1";
  const std::size_t bytes = datatypeSize(datatype);
  const char kind = datatype == Type::FLOAT32 || datatype == Type::FLOAT64 ? 'f'
                    : datatype == Type::UINT8 || datatype == Type::UINT16 ||
                            datatype == Type::UINT32 || datatype == Type::UINT64
                        ? 'u'
                        : 'i';
  return (bytes == 1 ? "|" : "<") + std::string(1, kind) + std::to_string(bytes);
}

/** Header of an array; the numbers behind it are aligned. */
std::string
makeHeader(std::uint8_t datatype, std::size_t points, std::size_t components)
{
  std::string text =
      "{'descr': '" + numpyType(datatype) + "', 'fortran_order': False, 'shape': (" +
      std::to_string(points) + "," +
      (components > 1 ? " " + std::to_string(components) : std::string()) + "), }";
  constexpr std::size_t front = 10, alignment = 64;
  while ((front + text.size() + 1) % alignment != 0)
    text += ' ';
  text += '\n';
  std::string header("\x93NUMPY\1\0", 8);
  appendLittle(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

/** Writes the entries of a zip, then its directory. */
class ZipWriter {
public:
  ZipWriter(const std::string& file, const std::string& path)
      : path_(path)
      , out_(file, path)
  {
  }

  void
  add(const std::string& name,
      const Dataset& dataset,
      const std::vector<Column>& columns);

  void
  close();

private:
  void
  put(const std::string& bytes)
  {
    out_.write(bytes.data(), bytes.size());
    offset_ += bytes.size();
  }

  const std::string& path_;
  OutputFile out_;
  std::uint64_t offset_ = 0;
  std::uint16_t entries_ = 0;
  std::string directory_;
};

void
ZipWriter::add(const std::string& name,
               const Dataset& dataset,
               const std::vector<Column>& columns)
{
  const std::size_t points = dataset.cloud.width * dataset.cloud.height;
  const std::string header = makeHeader(columns[0].datatype, points, columns.size());
  const std::uint64_t bytes =
      header.size() + points * columns.size() * datatypeSize(columns[0].datatype);
  if (offset_ + bytes > UINT32_MAX - (1u << 20) || entries_ == UINT16_MAX)
    throwUnwritable(path_, "large_npz");
  const auto for_each_block = [&](const auto& take) {
    take(header);
    for (std::size_t first = 0; first < points; first += block_points)
      take(
          packRecords(dataset, columns, first, std::min(block_points, points - first)));
  };
  uLong checksum = crc32(0, nullptr, 0);
  for_each_block([&](const std::string& block) {
    checksum = crc32(checksum,
                     reinterpret_cast<const Bytef*>(block.data()),
                     static_cast<uInt>(block.size()));
  });
  const std::string entry = name + ".npy";
  std::string common;                            // of both headers
  appendLittle(common, std::uint16_t(20));       // version that is needed
  appendLittle(common, std::uint16_t(0x800));    // names are UTF-8
  appendLittle(common, std::uint16_t(0));        // not packed
  appendLittle(common, std::uint32_t(0x210000)); // 1980-01-01: same input, same bytes
  appendLittle(common, static_cast<std::uint32_t>(checksum));
  appendLittle(common, static_cast<std::uint32_t>(bytes));
  appendLittle(common, static_cast<std::uint32_t>(bytes));
  appendLittle(common, static_cast<std::uint16_t>(entry.size()));
  appendLittle(common, std::uint16_t(0));
  directory_ += "PK\1\2";
  appendLittle(directory_, std::uint16_t(20));
  directory_ += common + std::string(10, '\0');
  appendLittle(directory_, static_cast<std::uint32_t>(offset_));
  directory_ += entry;
  ++entries_;
  put("PK\3\4" + common + entry);
  for_each_block([&](const std::string& block) { put(block); });
}

void
ZipWriter::close()
{
  std::string end("PK\5\6\0\0\0\0", 8);
  appendLittle(end, entries_);
  appendLittle(end, entries_);
  appendLittle(end, static_cast<std::uint32_t>(directory_.size()));
  appendLittle(end, static_cast<std::uint32_t>(offset_));
  appendLittle(end, std::uint16_t(0));
  put(directory_ + end);
  out_.close();
}

} // namespace

void
writeNpz(const std::string& file, const std::string& path, const Dataset& dataset)
{
  ZipWriter zip(file, path);
  for (const pcl::PCLPointField& field : savedFields(dataset)) {
    std::string name = field.name;
    std::replace(name.begin(), name.end(), '/', '_'); // a folder within the zip
    zip.add(name, dataset, findColumns(dataset, {field}));
  }
  zip.close();
}

} // namespace io
} // namespace pcl_uvol
