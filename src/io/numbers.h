// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text: the one parser and the one printer of all text formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_uvol {
namespace io {

/** \brief The whole of a text as a number; nan and inf in any case are numbers.
 * \return false for anything else, also for numbers too large for a double */
bool
parseNumber(std::string_view text, double& value);

/** \brief The whole of a text as a number of a pcl::PCLPointField datatype.
 * \param[out] bytes gets the number
 * \return false for anything else, also for numbers the type cannot hold */
bool
parseNumber(std::string_view text, std::uint8_t datatype, std::uint8_t* bytes);

/** \brief The whole of a text as a number that counts something. */
bool
parseCount(std::string_view text, std::uint64_t& value);

/** \brief Append a number so that reading it gives the same bits (NaN: `nan`). */
void
appendNumber(std::string& text, std::uint8_t datatype, const std::uint8_t* bytes);

/** \brief True if a float holds the number of that text to all the digits given. */
bool
floatHoldsDigits(std::string_view text, double value);

std::string_view
trimmed(std::string_view text);

std::string
lowerCase(std::string_view text);

} // namespace io
} // namespace pcl_uvol
