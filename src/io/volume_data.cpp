// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes, as text and zipped, out of one file or many.
#include "io/volume_data.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/file_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>
#include <zlib.h>

namespace pcl_uvol {
namespace io {
namespace {

/** Tangent of the angle up to which axes are parallel. */
constexpr double oblique = 1e-6;
/** Numbers that are converted while they are in the cache. */
constexpr std::size_t block_numbers = std::size_t(1) << 15;

/** Bytes of a file, unpacked if they are packed by zlib or gzip. */
class ByteSource {
public:
  ByteSource(const std::string& path, std::uint64_t offset, bool zipped)
      : path_(path)
      , file_(path, InputFile::Packing::Keep)
      , offset_(offset)
  {
    // 32: a header of zlib or gzip tells which of both it is
    if (zipped && inflateInit2(&stream_.emplace(), MAX_WBITS + 32) != Z_OK)
      throw std::bad_alloc();
  }
  ByteSource(const ByteSource&) = delete;
  ByteSource&
  operator=(const ByteSource&) = delete;
  ~ByteSource()
  {
    if (stream_)
      inflateEnd(&*stream_);
  }

  void
  read(std::uint8_t* bytes, std::size_t count)
  {
    if (stream_)
      return unpack(bytes, count);
    file_.read(offset_, bytes, count);
    offset_ += count;
  }

private:
  void
  unpack(std::uint8_t* bytes, std::size_t count);
  void
  fill();

  const std::string path_;
  const InputFile file_;
  std::uint64_t offset_;
  std::optional<z_stream> stream_;
  std::vector<std::uint8_t> packed_;
};

void
ByteSource::fill()
{
  constexpr std::uint64_t packed_bytes = 1u << 17;
  packed_.resize(std::min(packed_bytes, file_.getSize() - offset_));
  if (packed_.empty())
    throwUnreadable(path_, "damaged_compression");
  file_.read(offset_, packed_.data(), packed_.size());
  offset_ += packed_.size();
  stream_->next_in = packed_.data();
  stream_->avail_in = static_cast<uInt>(packed_.size());
}

void
ByteSource::unpack(std::uint8_t* bytes, std::size_t count)
{
  stream_->next_out = bytes;
  stream_->avail_out = static_cast<uInt>(count);
  while (stream_->avail_out > 0) {
    if (stream_->avail_in == 0)
      fill();
    const int state = inflate(&*stream_, Z_NO_FLUSH);
    if (state == Z_STREAM_END)
      inflateReset(&*stream_); // files of gzip may be joined
    else if (state != Z_OK && state != Z_BUF_ERROR)
      throwUnreadable(path_, "damaged_compression");
  }
}

/** One file of a volume. */
class ValueReader {
public:
  ValueReader(const std::string& path, const VolumeData& data, std::uint64_t count)
      : path_(path)
      , data_(data)
      , count_(count)
      , bytes_(datatypeSize(data.datatype))
      , cursor_(path, FileCursor::Content::Any, InputFile::Packing::Keep)
  {
    cursor_.seek({data.offset, 0});
    std::string_view line;
    for (std::uint64_t i = 0; i < data.skipped_lines; ++i)
      if (!cursor_.nextLine(line))
        throwTruncated();
    if (data.at_end && cursor_.left() / bytes_ >= count)
      cursor_.skip(cursor_.left() - bytes_ * count);
    checkSize();
  }

  void
  appendTo(std::vector<float>& values)
  {
    if (data_.encoding == VolumeData::Encoding::Ascii)
      appendTexts(values);
    else
      appendBytes(values);
  }

private:
  [[noreturn]] void
  throwTruncated() const
  {
    throwUnreadable(path_, {"truncated_data", count_, "numbers", cursor_.left()});
  }

  void
  checkSize();
  void
  appendTexts(std::vector<float>& values);
  void
  appendBytes(std::vector<float>& values);

  const std::string path_;
  const VolumeData& data_;
  const std::uint64_t count_;
  const std::size_t bytes_;
  FileCursor cursor_;
};

/** Before any memory is taken: can that many numbers follow at all? */
void
ValueReader::checkSize()
{
  const std::uint64_t left = cursor_.left();
  const bool enough = data_.encoding == VolumeData::Encoding::Raw
                          ? left >= data_.skipped_bytes &&
                                (left - data_.skipped_bytes) / bytes_ >= count_
                      : data_.encoding == VolumeData::Encoding::Ascii
                          ? (left + 1) / 2 >= count_
                          : left >= count_ / deflate_expansion;
  if (!enough)
    throwTruncated();
}

void
ValueReader::appendTexts(std::vector<float>& values)
{
  std::uint8_t bytes[8];
  const FieldComponent number{0, data_.datatype};
  std::string_view word;
  std::uint64_t taken = 0;
  while (taken < count_) {
    if (!cursor_.nextWord(word))
      throwTruncated();
    while (!word.empty() && taken < count_) { // commas may separate them, too
      const std::size_t comma = word.find(',');
      const std::string_view text = word.substr(0, comma);
      word.remove_prefix(comma == word.npos ? word.size() : comma + 1);
      if (text.empty())
        continue;
      if (!parseNumber(text, data_.datatype, bytes))
        throwUnreadable(path_,
                        cursor_.tell().line + 1,
                        {"unexpected_word",
                         shortenText(text),
                         "a number of the type in the header"});
      values.push_back(static_cast<float>(number.read(bytes)));
      ++taken;
    }
  }
}

void
ValueReader::appendBytes(std::vector<float>& values)
{
  ByteSource source(
      path_, cursor_.tell().offset, data_.encoding == VolumeData::Encoding::Zipped);
  std::vector<std::uint8_t> block(block_numbers * bytes_);
  for (std::uint64_t left = data_.skipped_bytes; left > 0;) {
    const auto now =
        static_cast<std::size_t>(std::min<std::uint64_t>(left, block.size()));
    source.read(block.data(), now);
    left -= now;
  }
  const FieldComponent number{0, data_.datatype};
  for (std::uint64_t done = 0; done < count_;) {
    const auto now =
        static_cast<std::size_t>(std::min<std::uint64_t>(count_ - done, block_numbers));
    source.read(block.data(), now * bytes_);
    for (std::uint8_t* at = block.data(); at < block.data() + now * bytes_;
         at += bytes_) {
      if (data_.big_endian)
        std::reverse(at, at + bytes_);
      values.push_back(static_cast<float>(number.read(at)));
    }
    done += now;
  }
}

/** Names from within a file may be of any length. */
void
checkExists(const std::string& path, const std::string& file)
{
  // The system would take what stands before a zero byte for the name.
  const bool is_name = file.find('\0') == std::string::npos;
  std::error_code ignored; // of a name that is too long
  if (!is_name || !std::filesystem::exists(file, ignored))
    throwUnreadable(path,
                    {"no_required_file",
                     shortenText(std::filesystem::path(file).filename().string())});
}

void
readFiles(const std::string& path, const VolumeData& data, Volume& volume)
{
  const std::uint64_t count =
      std::uint64_t(volume.dims[0]) * volume.dims[1] * volume.dims[2];
  if (data.files.empty() || volume.dims[2] % data.files.size() != 0)
    throwUnreadable(path, {"shared_layers", volume.dims[2], data.files.size()});
  const std::uint64_t part = count / data.files.size();
  for (const std::string& file : data.files) {
    checkExists(path, file);
    ValueReader(file, data, part);
  }
  // Reserved and then filled: memory that damaged data promise is not touched.
  volume.values.reserve(static_cast<std::size_t>(count));
  for (const std::string& file : data.files)
    ValueReader(file, data, part).appendTo(volume.values);
}

} // namespace

void
throwOblique(const std::string& path)
{
  throwUnreadable(path, "turned_axes");
}

void
setDims(const std::string& path,
        const std::vector<std::string_view>& words,
        Volume& volume)
{
  constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  if (words.size() != 3)
    throwUnreadable(path, "not_scalar_volume");
  std::uint64_t product = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint64_t size = 0;
    if (!parseCount(words[axis], size) || size < 1 || size > most ||
        product > std::numeric_limits<std::uint64_t>::max() / size)
      throwUnreadable(
          path,
          {"unexpected_word", shortenText(words[axis]), "a valid size of a volume"});
    product *= size;
    volume.dims[axis] = static_cast<std::size_t>(size);
  }
}

void
setDirection(const std::string& path,
             std::size_t axis,
             const std::array<double, 3>& direction,
             Volume& volume)
{
  for (std::size_t other = 0; other < 3; ++other)
    if (other != axis &&
        !(std::abs(direction[other]) <= oblique * std::abs(direction[axis])))
      throwOblique(path);
  volume.spacing[axis] = direction[axis];
}

std::string
besideFile(const std::string& path, std::string_view name)
{
  return (std::filesystem::path(path).parent_path() / name).string();
}

std::vector<std::string>
expandPattern(const std::string& path, const std::vector<std::string_view>& words)
{
  const std::string_view pattern = words[0];
  const std::size_t start = pattern.find('%'), end = pattern.find('d', start);
  int numbers[3] = {0, 0, 1}, width = 0;
  // The system would read names up to a zero byte, which the folder may be.
  bool valid = words.size() <= 4 && end != pattern.npos &&
               pattern.find('%', start + 1) == pattern.npos && end - start <= 3 &&
               pattern.find('\0') == pattern.npos;
  const auto parse = [&](std::string_view text, int& value) {
    const char* const last = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), last, value);
    valid = valid && parsed.ec == std::errc() && parsed.ptr == last;
  };
  if (valid && end > start + 1)
    parse(pattern.substr(start + 1, end - start - 1), width);
  for (std::size_t i = 1; i < words.size() && valid; ++i)
    parse(words[i], numbers[i - 1]);
  const auto [first, last, step] = numbers;
  if (!valid || first < 0 || last < first || step < 1)
    throwUnreadable(path, {"slice_pattern", shortenText(pattern)});
  const char fill = pattern[start + 1] == '0' ? '0' : ' ';
  std::vector<std::string> files;
  for (std::int64_t i = first; i <= last; i += step) {
    std::string number = std::to_string(i);
    if (const auto digits = static_cast<std::size_t>(width); number.size() < digits)
      number.insert(0, digits - number.size(), fill);
    std::string name(pattern.substr(0, start));
    name += number;
    name += pattern.substr(end + 1);
    files.push_back(besideFile(path, name));
    checkExists(path, files.back()); // a list is no longer than its folder
  }
  return files;
}

void
readValues(const std::string& path, const VolumeData& data, Volume& volume)
{
  try {
    readFiles(path, data, volume);
  }
  catch (const IOError& error) {
    if (error.message().find(path) != std::string::npos)
      throw;
    throw IOError("data_elsewhere",
                  {{"path", printable(path)}, {"reason", error.message()}});
  }
}

} // namespace io
} // namespace pcl_uvol
