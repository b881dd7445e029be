// SPDX-License-Identifier: BSD-3-Clause
// What MetaImage and NRRD have in common: a header of lines that tells the sizes of a
// volume and names the files of its numbers.
#pragma once

#include "io/file_cursor.h"
#include "io/volume_data.h"

#include <string>
#include <string_view>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Base of the two parsers. */
class VolumeHeader {
public:
  explicit VolumeHeader(const std::string& path)
      : path_(path)
      , cursor_(path)
  {
  }

  /** \brief The volume, with the numbers of its files.
   * \throws IOError */
  Volume
  read();

  /** \brief The files of the numbers, the header's own too.
   * \throws IOError */
  std::vector<std::string>
  findFiles();

protected:
  ~VolumeHeader() = default;

  /** \brief Take all that the header says. */
  virtual void
  parse() = 0;

  /** \brief Make the volume ready for its numbers. */
  virtual void
  finish() = 0;

  /** \brief Take the files of the numbers: a list in the lines that follow, a pattern
   * or a single name.
   * \throws IOError for no name, and for files of a pattern that are not there */
  void
  takeFiles(std::string_view value);

  /** \throws IOError for a word that is no number */
  double
  parseWord(std::string_view word) const;

  [[noreturn]] void
  throwInLine(const FileReason& reason) const;

  const std::string path_;
  FileCursor cursor_;
  std::vector<std::string_view> words_; ///< of the line's value
  Volume volume_;
  VolumeData data_;
  bool has_sizes_ = false;
};

} // namespace io
} // namespace pcl_uvol
