// SPDX-License-Identifier: BSD-3-Clause
// Files as bytes and lines, with errors that name the file in one sentence.
#pragma once

#include "common/memory.h"
#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Bytes that deflate makes of one at most: zeros. */
constexpr std::uint64_t deflate_expansion = 1032;

/** \brief Why a file cannot be read or written. */
struct PCL_UVOL_EXPORTS FileReason {
  /** \param code row of file_error_texts.cpp
   * \param values what its text holds, in the order in which the text names it */
  template <typename... Values>
  FileReason(const char* code, const Values&... values)
      : FileReason(Message(code, {MessageValue("", values)...}))
  {
    nameValues();
  }
  /** \brief A message of what the file is read for. */
  FileReason(Message other)
      : message(std::move(other))
  {
  }

  Message message;

private:
  void
  nameValues();
};

/** \brief What the system says of its last error. */
PCL_UVOL_EXPORTS FileReason
systemError();

/** \throws IOError "Cannot read 'path': reason", with the code of the reason and the
 * path among its values */
[[noreturn]] PCL_UVOL_EXPORTS void
throwUnreadable(const std::string& path, const FileReason& reason);

/** \throws IOError "Cannot read 'path', line n: reason" */
[[noreturn]] PCL_UVOL_EXPORTS void
throwUnreadable(const std::string& path, std::size_t line, const FileReason& reason);

/** \throws IOError "Cannot write 'path': reason" */
[[noreturn]] PCL_UVOL_EXPORTS void
throwUnwritable(const std::string& path, const FileReason& reason);

/** \brief Call what reads a file; numbers it cannot take and a lack of memory that
 * shows while it reads are errors of the file.
 * \throws IOError
 * \throws NotEnoughMemory before points are read */
template <typename Reader>
auto
reading(const std::string& path, const Reader& read)
{
  try {
    return read();
  }
  catch (const NotEnoughMemory&) {
    throw;
  }
  catch (const InvalidArgument& error) {
    throwUnreadable(path, error.asMessage());
  }
  catch (const std::bad_alloc&) {
    throwUnreadable(path, "too_large_for_memory");
  }
  catch (const std::length_error&) { // of a vector longer than any memory
    throwUnreadable(path, "too_large_for_memory");
  }
}

/** \brief The ending of a file name in lower case, with its dot; "-", standard output,
 * counts as .ply, and what packs a file (.gz, .bz2, .zst) does not count where the name
 * has another ending. */
PCL_UVOL_EXPORTS std::string
getEnding(const std::string& path);

/** \brief Throw IOError unless a file of that name can be created. */
PCL_UVOL_EXPORTS void
checkWritable(const std::string& path);

/** \brief A regular, non-empty file opened for reading; "-" is standard input. */
class PCL_UVOL_EXPORTS InputFile {
public:
  /** What is read of a file whose name ends in .gz, .bz2 or .zst. */
  enum class Packing { Unpack, Keep };

  /** \throws IOError for a file that is missing, empty, a directory, unreadable, and
   * for one that cannot be unpacked */
  explicit InputFile(const std::string& path, Packing packing = Packing::Unpack);

  /** \param descriptor of a file, which is closed at the end
   * \param path the name that errors give */
  InputFile(const std::string& path, int descriptor);
  InputFile(const InputFile&) = delete;
  InputFile&
  operator=(const InputFile&) = delete;
  ~InputFile();

  std::uint64_t
  getSize() const
  {
    return size_;
  }

  /** \brief Read exactly these bytes.
   * \throws IOError */
  void
  read(std::uint64_t offset, void* bytes, std::size_t count) const;

  int
  getDescriptor() const
  {
    return descriptor_;
  }

  /** \brief The bytes from the start, at most that many. */
  std::string
  head(std::uint64_t count) const;

private:
  void
  takeSize();

  std::string path_;
  int descriptor_;
  std::uint64_t size_;
};

/** \brief A file written through a buffer. */
class OutputFile {
public:
  /** \param name the name that errors give */
  OutputFile(const std::string& path, std::string name);
  OutputFile(const OutputFile&) = delete;
  OutputFile&
  operator=(const OutputFile&) = delete;
  ~OutputFile();

  /** \brief Where text is appended; write it out by flush() when it has grown. */
  std::string&
  buffer()
  {
    return buffer_;
  }

  /** \brief Write the buffer out if it is larger than a block. */
  void
  flushFull();

  /** \brief Write the buffer out, then these bytes. */
  void
  write(const void* bytes, std::size_t count);

  /** \brief Write all out and close.
   * \throws IOError */
  void
  close();

private:
  std::string name_, buffer_;
  int descriptor_;
};

/** \brief Lines of a text, counted from 1, without their end (LF or CRLF). */
class Lines {
public:
  explicit Lines(std::string_view text, std::size_t line = 0)
      : rest_(text)
      , line_(line)
  {
  }

  /** \return false after the last line */
  bool
  next(std::string_view& line);

  std::size_t
  lineNumber() const
  {
    return line_;
  }

  /** \brief What follows the lines taken so far. */
  std::string_view
  rest() const
  {
    return rest_;
  }

private:
  std::string_view rest_;
  std::size_t line_;
};

/** \brief The words of a line between blanks and tabs. */
PCL_UVOL_EXPORTS void
splitWords(std::string_view line, std::vector<std::string_view>& words);

} // namespace io
} // namespace pcl_uvol
