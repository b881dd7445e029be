// SPDX-License-Identifier: BSD-3-Clause
// Long text in several lines.
#pragma once

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Distance of lines of text, in parts of the font's size. */
constexpr double line_distance = 1.25;

/** \brief The lines of a text that is no wider than some pixels: broken at blanks, a
 * word that is too long for a line behind its signs, or else anywhere.
 * \param size of the font, pixels
 * \return at least one line, and at least a letter in each */
std::vector<std::string>
wrapText(const std::string& text, int size, int width);

} // namespace uvol_tools
