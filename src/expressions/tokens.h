// SPDX-License-Identifier: BSD-3-Clause
// The parts of an expression, and what comparisons among them mean.
#pragma once

#include "expressions/formula.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol {

/** A part of an expression, in the order of the text. */
struct Token {
  enum class Kind { Operand, Number, Sign, Relation, Joint, Open, Close, Other };

  Kind kind;
  std::size_t place;   ///< in the expression
  std::string program; ///< muParser's text
  std::size_t operand = 0;
  double number = 0.0;
};

/** Comparisons in a row, as 1 < T < 2, would compare a truth with a number.
 * \return the second one, or null */
const Token*
findSecondRelation(const std::vector<Token>& tokens);

/** A number that a float32 field alone is compared with becomes the float nearest to
 * it, relative to the origin: else T=4.1 would never hold. */
void
roundNumbers(const std::vector<Operand>& operands, std::vector<Token>& tokens);

} // namespace pcl_uvol
