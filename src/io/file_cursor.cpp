// SPDX-License-Identifier: BSD-3-Clause
// Bytes and lines of a file through a buffer that slides over it.
#include "io/file_cursor.h"

#include <algorithm>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

/** Fits a cache of the second level, and calls of the system cost nothing beside it. */
constexpr std::size_t cursor_bytes = std::size_t(1) << 18;

/** Lines of 100,000 columns have a few of them. What goes on for longer is no text, or
 * fills the memory. */
constexpr std::size_t most_line_bytes = std::size_t(16) << 20;

bool
isBlank(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

} // namespace

FileCursor::FileCursor(const std::string& path,
                       Content content,
                       InputFile::Packing packing)
    : path_(path)
    , file_(path, packing)
    , content_(content)
{
}

void
FileCursor::seek(const Place& place)
{
  line_ = place.line;
  if (place.offset >= start_ && place.offset <= start_ + end_) {
    begin_ = static_cast<std::size_t>(place.offset - start_);
    return;
  }
  start_ = place.offset;
  begin_ = end_ = 0;
}

/** Reads on behind what the buffer holds.
 * \return false at the end of the file */
bool
FileCursor::fill()
{
  const std::uint64_t behind = file_.getSize() - start_ - end_;
  if (behind == 0)
    return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    start_ += begin_;
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) // more than a block belongs together: a long line
    buffer_.resize(std::max(
        2 * end_, std::size_t(std::min<std::uint64_t>(cursor_bytes, file_.getSize()))));
  const auto bytes =
      static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - end_, behind));
  char* const to = buffer_.data() + end_;
  file_.read(start_ + end_, to, bytes);
  if (content_ == Content::Text && std::memchr(to, 0, bytes))
    throwUnreadable(path_, {"not_text_file", 0});
  end_ += bytes;
  return true;
}

const char*
FileCursor::take(std::size_t bytes)
{
  while (end_ - begin_ < bytes)
    if (!fill())
      return nullptr;
  const char* const taken = buffer_.data() + begin_;
  begin_ += bytes;
  return taken;
}

bool
FileCursor::skip(std::uint64_t bytes)
{
  if (bytes > left())
    return false;
  seek({start_ + begin_ + bytes, line_});
  return true;
}

void
FileCursor::checkLength(std::size_t bytes) const
{
  if (bytes > most_line_bytes)
    throwUnreadable(
        path_, line_ + 1, {"too_many_parts", "the line", most_line_bytes, "bytes"});
}

bool
FileCursor::nextLine(std::string_view& line)
{
  std::size_t searched = 0;
  const char* found = nullptr;
  do {
    const char* const from = buffer_.data() + begin_;
    found = static_cast<const char*>(
        std::memchr(from + searched, '\n', end_ - begin_ - searched));
    searched = end_ - begin_;
    checkLength(found ? static_cast<std::size_t>(found - from) : searched);
  } while (!found && fill());
  if (searched == 0)
    return false;
  const char* const from = buffer_.data() + begin_;
  const std::size_t bytes = found ? static_cast<std::size_t>(found - from) : searched;
  begin_ += bytes + (found ? 1 : 0);
  line = std::string_view(from, bytes);
  ++line_;
  if (!line.empty() && line.back() == '\r')
    line.remove_suffix(1);
  return true;
}

bool
FileCursor::nextWords(std::vector<std::string_view>& words)
{
  std::string_view line;
  while (nextLine(line)) {
    splitWords(line, words);
    if (!words.empty())
      return true;
  }
  return false;
}

bool
FileCursor::nextWord(std::string_view& word)
{
  if (!skipBlanks())
    return false;
  std::size_t bytes = 1;
  do {
    while (begin_ + bytes < end_ && !isBlank(buffer_[begin_ + bytes]))
      ++bytes;
    checkLength(bytes);
  } while (begin_ + bytes == end_ && fill());
  word = std::string_view(buffer_.data() + begin_, bytes);
  begin_ += bytes;
  return true;
}

bool
FileCursor::skipTo(char byte)
{
  do {
    const char* const from = buffer_.data() + begin_;
    const auto* const found =
        static_cast<const char*>(std::memchr(from, byte, end_ - begin_));
    if (found) {
      begin_ += static_cast<std::size_t>(found - from);
      return true;
    }
    begin_ = end_;
  } while (fill());
  return false;
}

bool
FileCursor::skipBlanks()
{
  do
    for (; begin_ < end_; ++begin_) {
      if (!isBlank(buffer_[begin_]))
        return true;
      line_ += buffer_[begin_] == '\n';
    }
  while (fill());
  return false;
}

} // namespace io
} // namespace pcl_uvol
