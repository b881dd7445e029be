// SPDX-License-Identifier: BSD-3-Clause
// Expressions as they are computed: what stands for the fields is resolved, what is
// left is a program of muParser's.
#pragma once

#include "common/scalar_field.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/message.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

enum class Derivative { Gradient, Laplacian, Curvature, Divergence, Curl, Q, Lambda2 };

struct Formula;

/** What a program has a variable for, or a vector of several components. */
struct Operand {
  enum class Kind { Field, Norm, Derivative };

  Kind kind = Kind::Field;
  std::string text; ///< as written
  /** Components of fields, with what is added to them: the origin, to coordinates. @{
   */
  std::vector<FieldComponent> components;
  std::vector<double> addends;
  /** @} */
  bool is_coordinate = false; ///< x, y or z
  Derivative derivative = Derivative::Gradient;
  std::vector<Formula> arguments;       ///< of norms and derivatives
  std::optional<std::size_t> component; ///< the one of several that is meant

  /** Components before one is chosen. */
  std::size_t
  fullWidth() const;

  std::size_t
  width() const
  {
    return component ? 1 : fullWidth();
  }
};

/** One number per point, or several. */
struct Formula {
  std::string text; ///< as written
  std::vector<Operand> operands;
  /** muParser's, with the variables v0, v1, ... for operands; empty for an operand
   * alone. */
  std::string program;
  bool compares = false; ///< there is a comparison in it

  std::size_t
  width() const
  {
    return program.empty() ? operands.front().width() : 1;
  }

  /** True if a derivative is in it, at any depth. */
  bool
  hasDerivative() const;

  /** True if a field is in it, at any depth. */
  bool
  hasField() const;

  /** True if a coordinate is in it, at any depth. */
  bool
  hasCoordinate() const;
};

/** Resolve an expression against the fields of a dataset, whose points are not looked
 * at. Fields of names are compared with a name, `hole="A-117"` or `hole=A-117`.
 * \throws ExpressionError */
Formula
parseFormula(const Dataset& header, const std::string& expression);

/** What the message of several_components holds, of an operand where one number is
 * needed. */
std::vector<MessageValue>
valuesOfComponents(const Operand& operand);

/** True for an expression with derivatives in it, told without knowing any field. */
PCL_UVOL_EXPORTS bool
mayHaveDerivative(const std::string& expression);

} // namespace pcl_uvol
