// SPDX-License-Identifier: BSD-3-Clause
// Small tables as text, made elsewhere.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>

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

} // namespace pcl_uvol
