// SPDX-License-Identifier: BSD-3-Clause
// Reading and writing of files by POSIX calls, whose errors are exact.
#include "io/files.h"

#include "common/message_texts.h"
#include "common/numbers.h"
#include "common/printable.h"
#include "io/unpacked_file.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace pcl_uvol {
namespace io {
namespace {

constexpr std::size_t block_bytes = std::size_t(1) << 20;

/** \param line 0: of none */
[[noreturn]] void
throwAbout(const char* verb, const std::string& path, std::size_t line, Message message)
{
  message.about = printable(std::string("Cannot ") + verb + " '" + path + "'");
  message.values.emplace_back("path", path);
  if (line > 0) {
    message.about += ", line " + std::to_string(line);
    message.values.emplace_back("line", line);
  }
  for (MessageValue& value : message.values)
    if (auto* const word = std::get_if<std::string>(&value.value))
      *word = printable(*word);
  throw IOError(std::move(message));
}

} // namespace

void
FileReason::nameValues()
{
  const auto names = detail::listValues(message.code);
  for (std::size_t i = 0; i < message.values.size(); ++i)
    message.values[i].name = names.at(i);
}

FileReason
systemError()
{
  return {"system_error", std::strerror(errno)};
}

void
throwUnreadable(const std::string& path, const FileReason& reason)
{
  throwAbout("read", path, 0, reason.message);
}

void
throwUnreadable(const std::string& path, std::size_t line, const FileReason& reason)
{
  throwAbout("read", path, line, reason.message);
}

void
throwUnwritable(const std::string& path, const FileReason& reason)
{
  throwAbout("write", path, 0, reason.message);
}

std::string
getEnding(const std::string& path)
{
  if (path == "-")
    return ".ply";
  const std::string ending =
      std::filesystem::path(withoutPacking(path)).extension().string();
  return lowerCase(ending.empty() ? std::filesystem::path(path).extension().string()
                                  : ending);
}

void
checkWritable(const std::string& path)
{
  namespace fs = std::filesystem;
  if (isStandardStream(path))
    return;
  if (isPacked(path))
    throwUnwritable(path, "packed_output");
  std::error_code error, ignored;
  if (fs::is_directory(path, error))
    throwUnwritable(path, "is_directory");
  if (error == std::errc::too_many_symbolic_link_levels)
    throwUnwritable(path, {"system_error", error.message()});
  fs::path folder = fs::path(resolveLinks(path)).parent_path();
  if (folder.empty())
    folder = ".";
  const fs::file_status status = fs::status(folder, ignored);
  if (!fs::exists(status))
    throwUnwritable(path, {"no_folder", folder.string()});
  if (!fs::is_directory(status))
    throwUnwritable(path, {"not_a_folder", folder.string()});
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throwUnwritable(path, systemError());
}

InputFile::InputFile(const std::string& path, Packing packing)
    : path_(path)
    , descriptor_(-1)
    , size_(0)
{
  if (isStandardStream(path)) {
    descriptor_ = openStandardInput();
    takeSize();
    return;
  }
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throwUnreadable(path, errno == ENOENT ? "no_such_file" : systemError());
  if (S_ISDIR(status.st_mode))
    throwUnreadable(path, "is_directory");
  if (!S_ISREG(status.st_mode))
    throwUnreadable(path, "not_regular_file");
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0)
    throwUnreadable(path, systemError());
  takeSize();
  if (packing == Packing::Keep ||
      !(isPacked(path) || isPackedInside(path, descriptor_)))
    return;
  const InputFile packed(path, descriptor_); // closes it
  descriptor_ = -1;
  descriptor_ = unpackFile(path, packed.descriptor_);
  takeSize();
}

InputFile::InputFile(const std::string& path, int descriptor)
    : path_(path)
    , descriptor_(descriptor)
    , size_(0)
{
  takeSize();
}

void
InputFile::takeSize()
{
  struct stat status {};
  const bool is_known = ::fstat(descriptor_, &status) == 0;
  size_ = is_known ? static_cast<std::uint64_t>(status.st_size) : 0;
  if (size_ > 0)
    return;
  ::close(descriptor_); // the constructor fails
  throwUnreadable(path_, is_known ? "empty_file" : systemError());
}

InputFile::~InputFile()
{
  ::close(descriptor_);
}

void
InputFile::read(std::uint64_t offset, void* bytes, std::size_t count) const
{
  auto* out = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t got = ::pread(descriptor_, out, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      throwUnreadable(path_, systemError());
    if (got == 0)
      throwUnreadable(path_, "shortened_file");
    out += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
}

std::string
InputFile::head(std::uint64_t count) const
{
  std::string bytes(std::min(count, size_), '\0');
  read(0, bytes.data(), bytes.size());
  return bytes;
}

OutputFile::OutputFile(const std::string& path, std::string name)
    : name_(std::move(name))
    , descriptor_(::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC))
{
  if (descriptor_ < 0)
    throwUnwritable(name_, systemError());
}

OutputFile::~OutputFile()
{
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

void
OutputFile::flushFull()
{
  if (buffer_.size() >= block_bytes)
    write(nullptr, 0);
}

void
OutputFile::write(const void* bytes, std::size_t count)
{
  const auto write_out = [this](const char* from, std::size_t left) {
    while (left > 0) {
      const ssize_t done = ::write(descriptor_, from, left);
      if (done < 0 && errno == EINTR)
        continue;
      if (done < 0)
        throwUnwritable(name_, systemError());
      from += done;
      left -= static_cast<std::size_t>(done);
    }
  };
  write_out(buffer_.data(), buffer_.size());
  buffer_.clear();
  write_out(static_cast<const char*>(bytes), count);
}

void
OutputFile::close()
{
  write(nullptr, 0);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0)
    throwUnwritable(name_, systemError());
}

bool
Lines::next(std::string_view& line)
{
  if (rest_.empty())
    return false;
  ++line_;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r')
    line.remove_suffix(1);
  return true;
}

void
splitWords(std::string_view line, std::vector<std::string_view>& words)
{
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  words.clear();
  const char* at = line.data();
  const char* const last = at + line.size();
  while (true) {
    while (at != last && blank(*at))
      ++at;
    if (at == last)
      return;
    const char* const start = at;
    while (at != last && !blank(*at))
      ++at;
    words.emplace_back(start, static_cast<std::size_t>(at - start));
  }
}

} // namespace io
} // namespace pcl_uvol
