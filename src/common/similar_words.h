// SPDX-License-Identifier: BSD-3-Clause
// What was probably meant by a word that is none of those allowed.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The shortest word that begins so, small letters or capital ones; else the
 * word with the fewest letters to insert, remove, replace or exchange, the
 * first of several; "" if these are all letters, or more than one and a quarter of
 * them.
 */
PCL_UVOL_EXPORTS std::string
findSimilar(const std::vector<std::string>& words, const std::string& word);

} // namespace pcl_uvol
