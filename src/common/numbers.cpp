// SPDX-License-Identifier: BSD-3-Clause
// Number parsing and printing by <charconv>: exact, and deaf to the locale.
#include "common/numbers.h"

#include <pcl/PCLPointField.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>
#include <type_traits>

namespace pcl_uvol {
namespace {

/** Digits that every float keeps. */
constexpr int float_digits = 7;

/** from_chars knows no leading plus sign. */
std::string_view
withoutPlus(std::string_view text)
{
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
    text.remove_prefix(1);
  return text;
}

template <typename T>
bool
parseReal(std::string_view text, T& value)
{
  text = withoutPlus(text);
  const char* const last = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), last, value);
  if (parsed.ptr != last || parsed.ec == std::errc::invalid_argument)
    return false;
  if (parsed.ec != std::errc::result_out_of_range)
    return true;
  // from_chars does not tell the vanishing from the overflowing
  static const locale_t with_points = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const double nearest = ::strtod_l(std::string(text).c_str(), nullptr, with_points);
  value = static_cast<T>(nearest);
  return std::abs(nearest) < 1.0;
}

template <typename T>
bool
parseInteger(std::string_view text, T& value)
{
  text = withoutPlus(text);
  const char* const last = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), last, value);
  if (parsed.ec == std::errc() && parsed.ptr == last)
    return true;
  double real = 0.0; // whole numbers are also written as 3.0 and 1e3
  if (!parseReal(text, real) || real != std::floor(real) ||
      real < static_cast<double>(std::numeric_limits<T>::lowest()) ||
      real >= std::ldexp(1.0, std::numeric_limits<T>::digits))
    return false;
  value = static_cast<T>(real);
  return true;
}

template <typename Visitor>
auto
visitDatatype(std::uint8_t datatype, Visitor&& visit)
{
  using Type = pcl::PCLPointField;
  switch (datatype) {
  case Type::FLOAT32:
    return visit(float{});
  case Type::FLOAT64:
    return visit(double{});
  case Type::INT8:
    return visit(std::int8_t{});
  case Type::INT16:
    return visit(std::int16_t{});
  case Type::UINT16:
    return visit(std::uint16_t{});
  case Type::INT32:
    return visit(std::int32_t{});
  case Type::UINT32:
    return visit(std::uint32_t{});
  case Type::INT64:
    return visit(std::int64_t{});
  case Type::UINT64:
    return visit(std::uint64_t{});
  default: // UINT8, BOOL
    return visit(std::uint8_t{});
  }
}

int
significantDigits(std::string_view text)
{
  int digits = 0, zeros = 0;
  for (const char c : text) {
    if (c == 'e' || c == 'E')
      break;
    if (c < '0' || c > '9')
      continue;
    if (c == '0') { // leading zeros never count, trailing ones do not
      zeros += digits > 0;
      continue;
    }
    digits += zeros + 1;
    zeros = 0;
  }
  return digits;
}

} // namespace

bool
parseNumber(std::string_view text, double& value)
{
  return parseReal(text, value);
}

bool
parseNumber(std::string_view text, std::uint8_t datatype, std::uint8_t* bytes)
{
  return visitDatatype(datatype, [&](auto value) {
    bool parsed;
    if constexpr (std::is_floating_point_v<decltype(value)>)
      parsed = parseReal(text, value);
    else
      parsed = parseInteger(text, value);
    if (parsed)
      std::memcpy(bytes, &value, sizeof(value));
    return parsed;
  });
}

bool
parseCount(std::string_view text, std::uint64_t& value)
{
  const char* const last = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), last, value);
  return parsed.ec == std::errc() && parsed.ptr == last;
}

void
appendNumber(std::string& text, std::uint8_t datatype, const std::uint8_t* bytes)
{
  visitDatatype(datatype, [&](auto value) {
    std::memcpy(&value, bytes, sizeof(value));
    char digits[32];
    if constexpr (std::is_floating_point_v<decltype(value)>)
      if (std::isnan(value)) { // no "-nan"
        text += "nan";
        return;
      }
    text.append(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr);
  });
}

bool
floatHoldsDigits(std::string_view text, double value)
{
  if (significantDigits(text) <= float_digits || !std::isfinite(value))
    return std::abs(value) <= std::numeric_limits<float>::max() ||
           !std::isfinite(value);
  if (std::abs(value) > std::numeric_limits<float>::max())
    return false;
  char digits[32];
  const auto printed =
      std::to_chars(digits, digits + sizeof(digits), static_cast<float>(value));
  double shortest = 0.0;
  std::from_chars(digits, printed.ptr, shortest);
  return shortest == value;
}

std::string
describeCount(std::uint64_t count, const std::string& one, const std::string& several)
{
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

std::string
joinNumbers(const std::array<double, 3>& numbers)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::digits10);
  text << numbers[0] << ',' << numbers[1] << ',' << numbers[2];
  return text.str();
}

std::string_view
trimmed(std::string_view text)
{
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string
lowerCase(std::string_view text)
{
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

} // namespace pcl_uvol
