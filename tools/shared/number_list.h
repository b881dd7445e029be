// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a command line: the whole of a word, or none.
#pragma once

#include <charconv>
#include <string>
#include <system_error>

namespace uvol_tools {

/** \brief The whole text as a number; false for anything else, such as 1.5m or nothing.
 */
template <typename T>
bool
parseWhole(const std::string& text, T& value)
{
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

/** \brief A finite number as an option's value.
 * \throws UsageError that names the option */
double
parseNumber(const std::string& option, const std::string& text);

} // namespace uvol_tools
