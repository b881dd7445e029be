// SPDX-License-Identifier: BSD-3-Clause
#include "io/zip_reader.h"

#include "io/unpacked_file.h"

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

constexpr std::uint64_t most_entries = 1u << 16;

template <typename T>
T
littleAt(const std::string& bytes, std::size_t offset)
{
  T value = 0;
  for (std::size_t i = sizeof(T); i-- > 0;)
    value = static_cast<T>(value << 8 | static_cast<std::uint8_t>(bytes[offset + i]));
  return value;
}

/** What lies in a zip, by the directory at its end. */
class ZipReader {
public:
  ZipReader(const std::string& path, const std::string& ending)
      : path_(path)
      , ending_(ending)
      , file_(std::make_shared<const InputFile>(path))
  {
  }

  std::vector<ZipPart>
  read();

private:
  struct Entry {
    std::string name;
    std::uint16_t method;
    std::uint64_t packed, bytes, header;
  };
  std::vector<Entry>
  listEntries() const;
  ZipPart
  open(const Entry& entry) const;
  std::string
  bytesAt(std::uint64_t offset, std::uint64_t count) const;
  [[noreturn]] void
  fail() const
  {
    throwUnreadable(path_, {"not_format", "a complete zip archive"});
  }

  const std::string& path_;
  const std::string& ending_;
  std::shared_ptr<const InputFile> file_;
};

std::string
ZipReader::bytesAt(std::uint64_t offset, std::uint64_t count) const
{
  if (offset > file_->getSize() || count > file_->getSize() - offset)
    fail();
  std::string bytes(count, '\0');
  file_->read(offset, bytes.data(), bytes.size());
  return bytes;
}

std::vector<ZipReader::Entry>
ZipReader::listEntries() const
{
  constexpr std::uint64_t end_bytes = 22, locator_bytes = 20, most_comment = 1u << 16;
  const std::uint64_t size = file_->getSize();
  const std::uint64_t tail = std::min(size, most_comment + end_bytes);
  const std::string end = bytesAt(size - tail, tail);
  const std::size_t at = end.rfind("PK\5\6");
  if (at == std::string::npos || end.size() - at < end_bytes)
    fail();
  std::uint64_t count = littleAt<std::uint16_t>(end, at + 10),
                offset = littleAt<std::uint32_t>(end, at + 16);
  if (count == UINT16_MAX || offset == UINT32_MAX) { // zip64
    const std::uint64_t place = size - tail + at;
    if (place < locator_bytes)
      fail();
    const std::string locator = bytesAt(place - locator_bytes, locator_bytes);
    const std::string wide = bytesAt(littleAt<std::uint64_t>(locator, 8), 56);
    count = littleAt<std::uint64_t>(wide, 32);
    offset = littleAt<std::uint64_t>(wide, 48);
  }
  if (count > most_entries)
    fail();
  std::vector<Entry> entries;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string head = bytesAt(offset, 46);
    if (head.rfind("PK\1\2", 0) != 0)
      fail();
    const auto name_bytes = littleAt<std::uint16_t>(head, 28),
               extra_bytes = littleAt<std::uint16_t>(head, 30),
               comment_bytes = littleAt<std::uint16_t>(head, 32);
    Entry entry{bytesAt(offset + 46, name_bytes),
                littleAt<std::uint16_t>(head, 10),
                littleAt<std::uint32_t>(head, 20),
                littleAt<std::uint32_t>(head, 24),
                littleAt<std::uint32_t>(head, 42)};
    const std::string extra = bytesAt(offset + 46 + name_bytes, extra_bytes);
    for (std::size_t field = 0; field + 4 <= extra.size();
         field += 4 + littleAt<std::uint16_t>(extra, field + 2)) {
      std::size_t number = field + 4;
      if (littleAt<std::uint16_t>(extra, field) != 1)
        continue;
      for (std::uint64_t* const wide : {&entry.bytes, &entry.packed, &entry.header})
        if (*wide == UINT32_MAX && number + 8 <= extra.size()) {
          *wide = littleAt<std::uint64_t>(extra, number);
          number += 8;
        }
    }
    entries.push_back(entry);
    offset += 46u + name_bytes + extra_bytes + comment_bytes;
  }
  return entries;
}

ZipPart
ZipReader::open(const Entry& entry) const
{
  const std::string head = bytesAt(entry.header, 30);
  if (head.rfind("PK\3\4", 0) != 0)
    fail();
  const std::uint64_t start = entry.header + 30 + littleAt<std::uint16_t>(head, 26) +
                              littleAt<std::uint16_t>(head, 28);
  if (start > file_->getSize() || entry.packed > file_->getSize() - start)
    fail();
  if (entry.method == 0)
    return {entry.name, file_, start, entry.packed};
  if (entry.method != 8)
    fail();
  const auto unpacked = std::make_shared<const InputFile>(
      path_,
      inflatePart(path_, file_->getDescriptor(), start, entry.packed, entry.bytes));
  return {entry.name, unpacked, 0, unpacked->getSize()};
}

std::vector<ZipPart>
ZipReader::read()
{
  std::vector<ZipPart> parts;
  std::uint64_t packed = 0;
  for (const Entry& entry : listEntries()) {
    if (entry.name.size() <= ending_.size() ||
        entry.name.compare(
            entry.name.size() - ending_.size(), ending_.size(), ending_) != 0)
      continue;
    if (entry.packed > file_->getSize() - packed) // one part under many names
      fail();
    packed += entry.packed;
    parts.push_back(open(entry));
  }
  return parts;
}

} // namespace

std::vector<ZipPart>
openZip(const std::string& path, const std::string& ending)
{
  return ZipReader(path, ending).read();
}

} // namespace io
} // namespace pcl_uvol
