// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_column.h"

#include "common/numbers.h"
#include "io/ply_types.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr double exact_integers = 0x1p53; ///< double holds the integers below

/** A number as C++ writes it: with a point, and e before the exponent. */
std::string
plainDigits(std::string_view cell)
{
  std::string digits(trimmed(cell));
  for (char& c : digits)
    c = c == ',' ? '.' : c == 'd' || c == 'D' ? 'e' : c;
  return digits;
}

} // namespace

double
TextColumn::take(std::string_view text, std::size_t line)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  bool parsed = parseCell(text, decimal, value);
  if (!parsed && isBelow(text, decimal, value)) {
    parsed = true;
    ++below;
    text.remove_prefix(1);
  }
  if (parsed && !std::isnan(value)) {
    ++numbers;
    low = std::min(low, value);
    high = std::max(high, value);
    floats = floats && floatHoldsDigits(plainDigits(text), value);
    integers = integers && std::floor(value) == value &&
               text.find_first_of(".,eEdD") == std::string_view::npos;
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

bool
parseCell(std::string_view cell, char decimal, double& value)
{
  const std::size_t point = cell.find(decimal);
  if (decimal == ',' && cell.find('.') != std::string_view::npos)
    return false; // thousands, dates
  const bool has_comma = decimal == ',' && point != std::string_view::npos;
  if (!has_comma && parseNumber(cell, value))
    return true;
  const auto is_digit = [&](std::size_t at) {
    return at < cell.size() && cell[at] >= '0' && cell[at] <= '9';
  };
  // A comma is followed by a digit; Fortran writes a point before its exponent.
  if (point == std::string_view::npos || (has_comma && !is_digit(point + 1)) ||
      cell.find(decimal, point + 1) != std::string_view::npos ||
      std::string_view("+-.,0123456789").find(cell[0]) == std::string_view::npos)
    return false;
  return (has_comma || cell.find_first_of("dD") != std::string_view::npos) &&
         parseNumber(plainDigits(cell), value);
}

bool
isBelow(std::string_view cell, char decimal, double& limit)
{
  return cell.size() > 1 && cell[0] == '<' &&
         parseCell(trimmed(cell.substr(1)), decimal, limit) && std::isfinite(limit);
}

double
numberIn(std::string_view cell, char decimal)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  if (!parseCell(cell, decimal, value))
    isBelow(cell, decimal, value);
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

namespace {

constexpr const char* normal_names[][3] = {
    {ply_normals[0], ply_normals[1], ply_normals[2]}, {"Nx", "Ny", "Nz"}};

/** How far the square of a unit vector is from 1, if its parts have three digits. */
constexpr double rounding = 0.005;

} // namespace

NormalColumns::NormalColumns(const std::vector<TextColumn>& columns)
{
  for (const auto& names : normal_names) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (columns[i].name == names[axis]) {
          columns_[axis] = i;
          ++found;
        }
    if (found == 3)
      names_ = &names;
  }
}

void
NormalColumns::take(const std::vector<double>& values)
{
  if (names_ == nullptr)
    return;
  double square = 0.0;
  for (const std::size_t column : columns_)
    square += values[column] * values[column];
  const bool is_unit = std::abs(square - 1.0) <= rounding;
  has_any_ = has_any_ || is_unit;
  are_units_ = are_units_ && (is_unit || square == 0.0 || std::isnan(square));
}

void
NormalColumns::rename(Fields& fields) const
{
  if (names_ != nullptr && are_units_ && has_any_)
    renameFields(fields, *names_, cloud_normals);
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
