// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text: the one parser and the one printer of all text formats.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_uvol {

/** \brief The whole of a text as a number; nan and inf in any case are numbers.
 * \return false for anything else, also for numbers too large for a double */
PCL_UVOL_EXPORTS bool
parseNumber(std::string_view text, double& value);

/** \brief The whole of a text as a number of a pcl::PCLPointField datatype.
 * \param[out] bytes gets the number
 * \return false for anything else, also for numbers the type cannot hold */
PCL_UVOL_EXPORTS bool
parseNumber(std::string_view text, std::uint8_t datatype, std::uint8_t* bytes);

/** \brief The whole of a text as a number that counts something. */
PCL_UVOL_EXPORTS bool
parseCount(std::string_view text, std::uint64_t& value);

/** \brief Append a number so that reading it gives the same bits (NaN: `nan`). */
PCL_UVOL_EXPORTS void
appendNumber(std::string& text, std::uint8_t datatype, const std::uint8_t* bytes);

/** \brief True if a float holds the number of that text to all the digits given. */
PCL_UVOL_EXPORTS bool
floatHoldsDigits(std::string_view text, double value);

/** \brief A number and the words for it, which are those for one or for several. */
PCL_UVOL_EXPORTS std::string
describeCount(std::uint64_t count, const std::string& one, const std::string& several);

/** \brief Three numbers between commas, with the digits that a double keeps of a text.
 */
PCL_UVOL_EXPORTS std::string
joinNumbers(const std::array<double, 3>& numbers);

PCL_UVOL_EXPORTS std::string_view
trimmed(std::string_view text);

PCL_UVOL_EXPORTS std::string
lowerCase(std::string_view text);

} // namespace pcl_uvol
