// SPDX-License-Identifier: BSD-3-Clause
// Rows of a table as text, one after another.
#pragma once

#include "io/file_cursor.h"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_uvol {
namespace io {

using Cells = std::vector<std::string_view>;

/** \brief Takes lines of a text apart into cells. */
class TextRows {
public:
  static constexpr char blanks = ' '; ///< separator of words between blanks and tabs

  struct Shape {
    char separator = blanks;
    std::size_t cells = 0;      ///< of each row
    std::string comments = "#"; ///< lines that begin with one of these are none
    std::uint64_t rows = std::numeric_limits<std::uint64_t>::max(); ///< at most
  };

  TextRows(const std::string& path, FileCursor& cursor)
      : path_(path)
      , cursor_(cursor)
  {
  }

  /** \brief How the lines from now on are made. */
  void
  setShape(const Shape& shape)
  {
    shape_ = shape;
    left_ = shape.rows;
  }

  const Shape&
  getShape() const
  {
    return shape_;
  }

  /** \brief The cells of a line, without quotes and the blanks around them.
   * \throws IOError for quotes that do not end */
  void
  split(std::string_view line, Cells& cells) const;

  /** \brief The next row's line; empty lines and comments are none.
   * \return false after the last row */
  bool
  nextLine(std::string_view& line);

  /** \brief The cells of the next row, valid until the next call.
   * \return false after the last row
   * \throws IOError for another number of cells */
  bool
  next(Cells& cells);

private:
  std::string_view
  takeQuoted(std::string_view line, std::size_t& at) const;

  const std::string& path_;
  FileCursor& cursor_;
  Shape shape_;
  std::uint64_t left_ = std::numeric_limits<std::uint64_t>::max(); ///< rows
};

} // namespace io
} // namespace pcl_uvol
