// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_column.h"

#include "common/numbers.h"
#include "io/ply_types.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr double exact_integers = 0x1p53; ///< double holds the integers below

} // namespace

double
TextColumn::take(std::string_view text, std::size_t line)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  const bool parsed = parseNumber(text, value);
  if (parsed && !std::isnan(value)) {
    ++numbers;
    low = std::min(low, value);
    high = std::max(high, value);
    floats = floats && floatHoldsDigits(text, value);
    integers = integers && std::floor(value) == value &&
               text.find_first_of(".eE") == std::string_view::npos;
    inexact = inexact || (integers && std::abs(value) >= exact_integers);
    return value;
  }
  integers = false;
  const bool is_text = !parsed && !isMissing(text);
  if (is_text && texts == 0) {
    first_text_line = line;
    first_text = text;
  }
  texts += is_text;
  return value;
}

std::uint8_t
TextColumn::getDatatype() const
{
  if (!labels.empty())
    return Type::INT32;
  if (integers && numbers > 0 && low >= std::numeric_limits<std::int32_t>::min() &&
      high <= std::numeric_limits<std::int32_t>::max())
    return Type::INT32;
  return floats ? Type::FLOAT32 : Type::FLOAT64;
}

bool
isMissing(std::string_view cell)
{
  if (cell.empty())
    return true;
  if (cell.size() > 4)
    return false;
  const std::string lower = lowerCase(cell);
  return lower == "nan" || lower == "na" || lower == "n/a" || lower == "null";
}

double
numberIn(std::string_view cell)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  parseNumber(cell, value);
  return value;
}

std::string
withoutDoubledQuotes(std::string_view cell)
{
  std::string text;
  for (std::size_t at = 0; at < cell.size(); ++at) {
    text += cell[at];
    at += cell.substr(at, 2) == "\"\"";
  }
  return text;
}

double
findLabel(std::string_view cell, const std::vector<std::string>& names)
{
  if (isMissing(cell))
    return no_name;
  const auto name =
      std::lower_bound(names.begin(), names.end(), withoutDoubledQuotes(cell));
  return static_cast<double>(name - names.begin());
}

void
nameNormals(const std::vector<TextColumn>& columns, Fields& fields)
{
  constexpr const char* names[][3] = {{ply_normals[0], ply_normals[1], ply_normals[2]},
                                      {"Nx", "Ny", "Nz"}};
  for (const auto& normal : names) {
    const bool are_units =
        std::all_of(columns.begin(), columns.end(), [&](const TextColumn& column) {
          const bool is_part =
              std::find(std::begin(normal), std::end(normal), column.name) !=
              std::end(normal);
          return !is_part || (column.low >= -1.0 && column.high <= 1.0);
        });
    if (are_units)
      renameFields(fields, normal, cloud_normals);
  }
}

void
putNumber(double value, std::uint8_t datatype, std::uint8_t* to)
{
  const auto put = [to](auto number) { std::memcpy(to, &number, sizeof(number)); };
  if (datatype == Type::FLOAT64)
    put(value);
  else if (datatype == Type::FLOAT32)
    put(static_cast<float>(value));
  else
    put(static_cast<std::int32_t>(value));
}

} // namespace io
} // namespace pcl_uvol
