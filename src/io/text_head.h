// SPDX-License-Identifier: BSD-3-Clause
// What stands above the rows of a table as text: names, units, titles and comments, as
// spreadsheets, instruments and simulations write them.
#pragma once

#include "io/file_cursor.h"
#include "io/text_rows.h"
#include <pcl_uvol/common/message.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol::io {

/** \brief How a table begins. */
struct TextHead {
  TextRows::Shape shape;
  std::vector<std::string> names; ///< of the columns, as they are given; empty: none
  std::size_t line = 0;           ///< of the names
  FileCursor::Place start;        ///< of the first row
  char decimal = '.';             ///< in numbers
  std::vector<Message> notes;     ///< lines that were skipped
};

/** \brief Look at the first lines of a table.
 *
 * Names come from the line above the rows, or from a comment above numbers. Lines that
 * begin with # are comments, and those with the sign that the first line begins with,
 * if that is %, !, *, / or //. Skipped with a note are: titles above the names (a line
 * that has another number of cells), units below them (a row without any number), and a
 * line with the number of rows. The first line may name the separator
 * ("sep=;"). Sea-Bird's files list names in comments ("# name 0 = prDM: Pressure"),
 * Tecplot's in VARIABLES: of their zones the first is read.
 * \param cursor at the begin of the text; comes back anywhere
 * \throws IOError for a file without any row */
TextHead
readTextHead(const std::string& path, FileCursor& cursor);

} // namespace pcl_uvol::io
