// SPDX-License-Identifier: BSD-3-Clause
#include "shared/number_list.h"

#include "common/printable.h"
#include "shared/options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace uvol_tools {

namespace {

constexpr std::size_t most_values = 1000; // a longer range is a slip of the pen
constexpr char logarithmic[] = "log";

/** Without what the arithmetic of a range adds to the digits of its ends: 0.3 instead
 * of 0.30000000000000004. */
double
withoutRoundoff(double value, double largest)
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.12g", value);
  return std::abs(value) < 1e-12 * largest ? 0.0 : std::strtod(digits, nullptr);
}

[[noreturn]] void
throwNoRange(const std::string& option, const std::string& text, const char* reason)
{
  throw UsageError("-" + option +
                   " takes ranges as 0.1:0.1:0.6 (first:step:last) or "
                   "0.01:1:5log (first:last:number), and " +
                   pcl_uvol::quoteText(text) + " " + reason + ".");
}

/** low, high and the number of values, whose ratios are equal. */
std::vector<double>
makeLogarithmicRange(const std::string& option,
                     const std::string& text,
                     double low,
                     double high,
                     const std::string& count_text)
{
  std::size_t count = 0;
  if (!parseWhole(count_text, count) || count < 2 || count > most_values)
    throwNoRange(option, text, "has no number of values from 2 to 1000");
  if (!(low * high > 0.0))
    throwNoRange(option, text, "has no two ends of the same sign");
  std::vector<double> values{low};
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(withoutRoundoff(low * std::pow(high / low, part), 0.0));
  }
  values.push_back(high);
  return values;
}

/** Values from first to last, last among them if steps lead there. */
std::vector<double>
makeRange(const std::string& option,
          const std::string& text,
          double first,
          double step,
          double last)
{
  const double steps = (last - first) / step;
  if (!(steps >= 0.0)) // for a step of 0 as well
    throwNoRange(option, text, "never reaches its end");
  if (steps >= static_cast<double>(most_values))
    throwNoRange(option, text, "has more than 1000 values");
  std::vector<double> values;
  const double largest = std::max(std::abs(first), std::abs(last));
  for (int i = 0; i <= static_cast<int>(steps + 1e-9); ++i)
    values.push_back(withoutRoundoff(first + i * step, largest));
  return values;
}

/** Parts of a text between the separators. */
std::vector<std::string>
split(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

std::vector<double>
parseRange(const std::string& option, const std::string& text)
{
  std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 3)
    throwNoRange(option, text, "is none");
  const double first = parseNumber(option, parts[0]);
  const double second = parseNumber(option, parts[1]);
  const std::size_t word = parts[2].find(logarithmic);
  return word == std::string::npos || word + 3 != parts[2].size()
             ? makeRange(option, text, first, second, parseNumber(option, parts[2]))
             : makeLogarithmicRange(
                   option, text, first, second, parts[2].substr(0, word));
}

} // namespace

double
parseNumber(const std::string& option, const std::string& text)
{
  double value = 0.0;
  if (!parseWhole(text, value) || !std::isfinite(value))
    throw UsageError("-" + option + " takes numbers, and " + pcl_uvol::quoteText(text) +
                     " is not a number.");
  return value;
}

std::vector<double>
parseNumbers(const std::string& option, const std::string& value, std::size_t count)
{
  std::vector<double> numbers;
  for (const std::string& part : split(value, ','))
    if (count == 0 && part.find(':') != std::string::npos) {
      const std::vector<double> range = parseRange(option, part);
      numbers.insert(numbers.end(), range.begin(), range.end());
    }
    else
      numbers.push_back(parseNumber(option, part));
  if (count != 0 && numbers.size() != count)
    throw UsageError("-" + option + " takes " + std::to_string(count) +
                     " numbers joined by commas, and " + pcl_uvol::quoteText(value) +
                     " has " + std::to_string(numbers.size()) + ".");
  return numbers;
}

std::optional<double>
parseAutomatic(const std::string& option,
               const std::string& value,
               double low,
               double high)
{
  if (value == "auto")
    return std::nullopt;
  double number = 0.0;
  if (!parseWhole(value, number) || !std::isfinite(number) || number < low ||
      number > high) {
    std::ostringstream range;
    range << "from " << low;
    if (std::isfinite(high))
      range << " to " << high;
    throw UsageError("-" + option + " takes auto or a number " + range.str() +
                     ", and " + pcl_uvol::quoteText(value) + " is neither.");
  }
  return number;
}

std::uint64_t
parseBytes(const std::string& option, const std::string& text)
{
  static const std::string units = "KMGT";
  std::string digits = text;
  double factor = 1.0;
  const std::size_t unit = text.empty() ? std::string::npos : units.find(text.back());
  if (unit != std::string::npos) {
    digits.pop_back();
    factor = std::pow(1000.0, static_cast<double>(unit + 1));
  }
  const double bytes = digits.empty() ? 0.0 : parseNumber(option, digits) * factor;
  if (!(bytes >= 1.0 && bytes < 1e18))
    throw UsageError("-" + option +
                     " takes a number of bytes, as in 1500M or 2G, and " +
                     pcl_uvol::quoteText(text) + " is not such a number.");
  return static_cast<std::uint64_t>(bytes);
}

} // namespace uvol_tools
