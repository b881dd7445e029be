// SPDX-License-Identifier: BSD-3-Clause
// Small tables as text, made elsewhere.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>

#include <sstream>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A name as a cell of CSV: in quotes where it holds what separates cells. */
PCL_UVOL_EXPORTS std::string
quotedCell(const std::string& name);

/** \brief Write a text as a file that appears whole or not at all.
 * \throws IOError */
PCL_UVOL_EXPORTS void
saveTable(const std::string& path, const std::string& text);

/** \brief Throw IOError unless the name ends in .csv and its folder can be written to:
 * to be called before work whose result would be lost. */
PCL_UVOL_EXPORTS void
checkTablePath(const std::string& path);

/** \brief Write structs that list their members, a row each and a column per member.
 * \param number column of the numbers of the rows, from 1
 * \throws IOError */
template <typename Row>
void
saveRows(const std::string& path,
         const std::string& number,
         const std::vector<Row>& rows)
{
  std::ostringstream table;
  table << number;
  forEachMember<Row>([&](const char* name, auto) { table << ',' << name; });
  table << '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table << i + 1;
    forEachMember<Row>(
        [&](const char*, auto pointer) { table << ',' << rows[i].*pointer; });
    table << '\n';
  }
  saveTable(path, table.str());
}

} // namespace pcl_uvol
