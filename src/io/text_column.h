// SPDX-License-Identifier: BSD-3-Clause
// A column of a table as text: what its cells hold, and the type that keeps them.
#pragma once

#include "common/records.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief What is known of a column from the cells that were taken. */
struct TextColumn {
  std::string name;
  std::optional<std::size_t> cell; ///< of the row; without one all values are 0
  double factor = 1.0;             ///< -1 for a coordinate that counts downwards
  char decimal = '.';              ///< in numbers
  std::vector<double> values;      ///< if they are kept
  bool floats = true;              ///< float32 holds all digits
  bool integers = true;            ///< all cells are whole numbers
  bool inexact = false;            ///< double does not hold some of these
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  std::size_t numbers = 0;
  std::size_t texts = 0;
  std::size_t below = 0; ///< numbers that are given as less than a limit
  bool is_flag = false;  ///< 1 where its cell is such a number, else 0
  std::size_t first_text_line = 0;
  std::string first_text;
  std::vector<std::string> labels; ///< of a column of names, ascending

  /** \brief Look at one more cell.
   * \return NaN where it holds no number */
  double
  take(std::string_view text, std::size_t line);

  /** \brief Names may be numbers, too ("34873" beside "A-117"), where one in ten is
   * none; fewer, and a single one, rather are slips in a column of numbers. */
  bool
  holdsNames() const
  {
    return !isMostlyNumbers() || (texts > 1 && 10 * texts >= texts + numbers);
  }

  bool
  isMostlyNumbers() const
  {
    return numbers >= texts;
  }

  /** \brief The smallest type that keeps the cells as they are given. */
  std::uint8_t
  getDatatype() const;
};

/** \brief Names of a column that are kept: beyond it they rather describe single rows.
 */
constexpr std::size_t most_names = 1u << 16;

constexpr double no_name = -1.0; ///< the label of a missing name

/** \brief True for an empty cell, "NaN", "n/a" and the like. */
bool
isMissing(std::string_view cell);

/** \brief A cell as a number: also with a decimal comma, if that is the sign, and with
 * an exponent of Fortran (0.5D-03).
 * \return false if it holds no number */
bool
parseCell(std::string_view cell, char decimal, double& value);

/** \brief Whether a cell is a number below a limit of detection, as "<0.25".
 * \param limit gets that */
bool
isBelow(std::string_view cell, char decimal, double& limit);

/** \brief NaN where the cell holds no number; the limit of one below it. */
double
numberIn(std::string_view cell, char decimal);

/** \brief A cell as it is meant: of two quotes one. */
std::string
withoutDoubledQuotes(std::string_view cell);

/** \brief The number of the name in a cell among all names of its column. */
double
findLabel(std::string_view cell, const std::vector<std::string>& names);

/** \brief Columns that are named as the normal of PLY files (nx) or of CloudCompare
 * (Nx): they are one where every row holds a unit vector, zeros or a missing number. */
class NormalColumns {
public:
  explicit NormalColumns(const std::vector<TextColumn>& columns);

  /** \brief Look at a row.
   * \param values of all columns */
  void
  take(const std::vector<double>& values);

  /** \brief Give them the names that clouds have for a normal, if they are one. */
  void
  rename(Fields& fields) const;

private:
  const char* const (*names_)[3] = nullptr; ///< of the three; null without them
  std::size_t columns_[3];
  bool are_units_ = true, has_any_ = false;
};

/** \brief Write a number as INT32, FLOAT32 or FLOAT64. */
void
putNumber(double value, std::uint8_t datatype, std::uint8_t* to);

} // namespace io
} // namespace pcl_uvol
