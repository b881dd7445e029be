// SPDX-License-Identifier: BSD-3-Clause
// Tags of XML files one after another: as much of XML as VTK's files use, and no tree
// that grows with the file.
#pragma once

#include "io/file_cursor.h"
#include <pcl_uvol/common/export.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief <name a="1">, </name> or <name/>. */
struct PCL_UVOL_EXPORTS XmlTag {
  std::string name;
  bool closes = false; ///< </name>
  bool empty = false;  ///< <name/>
  std::vector<std::pair<std::string, std::string>> attributes;
  std::uint64_t begin = 0; ///< of the tag in the file
  std::uint64_t end = 0;   ///< behind it
  /** Where the text between the tag before and this one begins; begin if it is blank.
   */
  std::uint64_t text = 0;

  /** \brief The value of an attribute, null if it is not there. */
  const std::string*
  find(std::string_view attribute) const;
};

/** \brief Reads tags; they have to be nested properly, at most 100 deep. */
class PCL_UVOL_EXPORTS XmlScanner {
public:
  explicit XmlScanner(const std::string& path,
                      FileCursor::Content content = FileCursor::Content::Any)
      : path_(path)
      , cursor_(path, content)
  {
  }

  /** \return false at the end of the file
   * \throws IOError for what is not XML */
  bool
  next(XmlTag& tag);

  /** \brief Elements that are open behind the last tag. */
  const std::vector<std::string>&
  getOpen() const
  {
    return open_;
  }

private:
  [[noreturn]] void
  fail(const FileReason& reason) const;
  std::string_view
  takeTag();
  void
  parse(std::string_view text, XmlTag& tag) const;
  std::string
  decoded(std::string_view text) const;
  void
  nest(const XmlTag& tag);

  const std::string path_;
  FileCursor cursor_;
  std::string tag_;
  std::vector<std::string> open_;
};

} // namespace io
} // namespace pcl_uvol
