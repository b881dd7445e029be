// SPDX-License-Identifier: BSD-3-Clause
// A file read from front to back through a small buffer.
#pragma once

#include "io/files.h"
#include <pcl_uvol/common/export.h>

#include <string>
#include <string_view>

namespace pcl_uvol {
namespace io {

/** \brief Takes bytes and lines of a file one after another; what is held in memory is
 * one block, or the longest line. */
class PCL_UVOL_EXPORTS FileCursor {
public:
  /** Bytes that are zero belong to no text. */
  enum class Content { Any, Text };

  /** Where reading goes on. */
  struct Place {
    std::uint64_t offset = 0; ///< from the start of the file
    std::size_t line = 0;     ///< lines that end before
  };

  /** \throws IOError as InputFile does */
  explicit FileCursor(const std::string& path,
                      Content content = Content::Any,
                      InputFile::Packing packing = InputFile::Packing::Unpack);

  const InputFile&
  getFile() const
  {
    return file_;
  }

  Place
  tell() const
  {
    return {start_ + begin_, line_};
  }

  void
  seek(const Place& place);

  /** \brief Bytes up to the end of the file. */
  std::uint64_t
  left() const
  {
    return file_.getSize() - start_ - begin_;
  }

  /** \brief The next bytes, valid until the next call; null if fewer are left. */
  const char*
  take(std::size_t bytes);

  /** \return false if fewer bytes are left */
  bool
  skip(std::uint64_t bytes);

  /** \brief The next line without its end (LF or CRLF), valid until the next call.
   * \return false after the last line
   * \throws IOError for a line of more than 16 MB, and a text with bytes that are zero
   */
  bool
  nextLine(std::string_view& line);

  /** \brief Words of the next line that has any.
   * \return false after the last line */
  bool
  nextWords(std::vector<std::string_view>& words);

  /** \brief The next word between blanks and ends of lines, valid until the next call.
   * \return false after the last word
   * \throws IOError for a word of more than 16 MB */
  bool
  nextWord(std::string_view& word);

  /** \brief Go in front of the next byte of that value, or of no blank.
   * \return false, and the end of the file, if there is none @{ */
  bool
  skipTo(char byte);
  bool
  skipBlanks();
  /** @} */

private:
  bool
  fill();
  void
  checkLength(std::size_t bytes) const;

  const std::string path_;
  const InputFile file_;
  const Content content_;
  std::string buffer_;
  std::uint64_t start_ = 0; ///< of the buffer in the file
  std::size_t begin_ = 0;   ///< of what was not taken
  std::size_t end_ = 0;     ///< of what was read
  std::size_t line_ = 0;
};

} // namespace io
} // namespace pcl_uvol
