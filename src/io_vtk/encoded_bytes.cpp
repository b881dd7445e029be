// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/encoded_bytes.h"

#include <vtkDataCompressor.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

constexpr std::uint64_t block_bytes = std::uint64_t(1) << 16;
constexpr std::uint8_t no_digit = 64;

/** The values of the digits of base64. */
constexpr std::array<std::uint8_t, 256>
makeDigits()
{
  std::array<std::uint8_t, 256> values{};
  for (auto& value : values)
    value = no_digit;
  const char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::uint8_t i = 0; i < 64; ++i)
    values[static_cast<unsigned char>(digits[i])] = i;
  return values;
}

constexpr std::array<std::uint8_t, 256> digit_values = makeDigits();

[[noreturn]] void
throwTruncated(const std::string& path)
{
  throwUnreadable(path, {"truncated_part", "an array"});
}

} // namespace

std::uint64_t
EncodedBytes::left() const
{
  const std::uint64_t bytes = end_ - std::min(next_, end_);
  return base64_ ? (bytes + text_.size()) / 4 * 3 + decoded_.size() - taken_ : bytes;
}

/** Decodes the next piece of the file; padding may also stand between pieces that were
 * encoded one by one. */
void
EncodedBytes::decode()
{
  decoded_.clear();
  taken_ = 0;
  const std::size_t start = text_.size();
  text_.resize(start + std::min(block_bytes, end_ - std::min(next_, end_)));
  if (text_.size() == start)
    throwTruncated(path_);
  file_.read(next_, text_.data() + start, text_.size() - start);
  next_ += text_.size() - start;
  text_.erase(
      std::remove_if(text_.begin() + static_cast<std::ptrdiff_t>(start),
                     text_.end(),
                     [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }),
      text_.end());
  std::size_t at = 0;
  for (; at + 4 <= text_.size(); at += 4) {
    std::uint32_t bits = 0;
    std::size_t padding = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const char c = text_[at + i];
      const std::uint8_t digit = digit_values[static_cast<unsigned char>(c)];
      padding += c == '=';
      if ((digit == no_digit) != (padding > 0) || (c != '=' && padding > 0) ||
          padding > 2)
        throwUnreadable(path_, {"invalid_part", "the base64 text of an array"});
      bits = bits << 6 | (digit & 63);
    }
    const char bytes[] = {static_cast<char>(bits >> 16),
                          static_cast<char>(bits >> 8 & 255),
                          static_cast<char>(bits & 255)};
    decoded_.append(bytes, 3 - padding);
  }
  text_.erase(0, at);
}

void
EncodedBytes::read(void* bytes, std::uint64_t count)
{
  auto* to = static_cast<char*>(bytes);
  if (!base64_) {
    if (count > left())
      throwTruncated(path_);
    file_.read(next_, to, static_cast<std::size_t>(count));
    next_ += count;
    return;
  }
  while (count > 0) {
    if (taken_ == decoded_.size())
      decode();
    const std::size_t now = static_cast<std::size_t>(
        std::min<std::uint64_t>(count, decoded_.size() - taken_));
    std::memcpy(to, decoded_.data() + taken_, now);
    taken_ += now;
    to += now;
    count -= now;
  }
}

namespace {

/** One of the numbers in front of the bytes. */
std::uint64_t
readCount(EncodedBytes& source, const ArrayEncoding& encoding)
{
  std::uint8_t bytes[8] = {};
  const std::size_t size = encoding.wide_headers ? 8 : 4;
  source.read(bytes, size);
  if (encoding.big_endian)
    std::reverse(bytes, bytes + size);
  std::uint64_t value = 0;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

/** The numbers in front of packed blocks. */
struct PackedSizes {
  std::uint64_t block = 0;          ///< bytes of one that is unpacked
  std::vector<std::uint64_t> sizes; ///< of the blocks as they are packed
};

/** \param count bytes of all blocks */
PackedSizes
readSizes(const std::string& path,
          EncodedBytes& source,
          const ArrayEncoding& encoding,
          std::uint64_t count)
{
  const std::uint64_t blocks = readCount(source, encoding);
  const std::uint64_t block = readCount(source, encoding);
  const std::uint64_t last = readCount(source, encoding);
  // Blocks before the last one are whole; a last one of no bytes is whole as well.
  if (blocks > source.left() / 4 || (blocks > 0 && (block == 0 || last > block)) ||
      (blocks > 0 && (count == 0 || (count - 1) / block + 1 != blocks ||
                      (count - 1) % block + 1 != (last == 0 ? block : last))) ||
      (blocks == 0 && count > 0))
    throwTruncated(path);
  PackedSizes packed{block, std::vector<std::uint64_t>(blocks)};
  for (auto& size : packed.sizes)
    size = readCount(source, encoding);
  return packed;
}

void
readPacked(const std::string& path,
           EncodedBytes& source,
           const ArrayEncoding& encoding,
           std::uint64_t count,
           std::uint8_t* bytes)
{
  const auto [block, sizes] = readSizes(path, source, encoding, count);
  std::vector<unsigned char> packed;
  for (const std::uint64_t size : sizes) {
    if (size > source.left())
      throwTruncated(path);
    packed.resize(static_cast<std::size_t>(size));
    source.read(packed.data(), size);
    const auto now = static_cast<std::size_t>(std::min(block, count));
    if (encoding.compressor->Uncompress(packed.data(), packed.size(), bytes, now) !=
        now)
      throwUnreadable(path, "damaged_compression");
    bytes += now;
    count -= now;
  }
}

} // namespace

void
readBlocks(const std::string& path,
           EncodedBytes& source,
           const ArrayEncoding& encoding,
           std::uint64_t count,
           std::uint8_t* bytes)
{
  if (encoding.compressor)
    return readPacked(path, source, encoding, count, bytes);
  if (readCount(source, encoding) != count)
    throwTruncated(path);
  source.read(bytes, count);
}

void
checkBlocks(const std::string& path,
            EncodedBytes& source,
            const ArrayEncoding& encoding,
            std::uint64_t count)
{
  if (!encoding.compressor) {
    if (readCount(source, encoding) != count || count > source.left())
      throwTruncated(path);
    return;
  }
  const PackedSizes packed = readSizes(path, source, encoding, count);
  std::uint64_t left = source.left();
  for (const std::uint64_t size : packed.sizes) {
    if (size > left)
      throwTruncated(path);
    left -= size;
  }
}

} // namespace io
} // namespace pcl_uvol
