// SPDX-License-Identifier: BSD-3-Clause
// Names of labels in a comparison, as in `hole="A-117"`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pcl_uvol {

/** Whether a quoted name starts so. */
bool
isLabelQuote(char character);

/** The name that stands there: between double or single quotes, two of which mean one
 * within, or, as shells take quotes away, up to the end of the comparison: &&, ||, a
 * closing parenthesis, the end.
 * \param[in,out] at moves behind it
 * \return false where a quotation mark is not closed */
bool
takeLabel(std::string_view text, std::size_t& at, std::string& name);

} // namespace pcl_uvol
