// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/formula.h"

#include "common/printable.h"

#include <algorithm>

namespace pcl_uvol {
namespace {

/** True if an operand of that kind is in a formula, at any depth. */
template <typename Predicate>
bool
hasOperand(const Formula& formula, const Predicate& is_meant)
{
  return std::any_of(
      formula.operands.begin(), formula.operands.end(), [&](const Operand& operand) {
        return is_meant(operand) || std::any_of(operand.arguments.begin(),
                                                operand.arguments.end(),
                                                [&](const Formula& argument) {
                                                  return hasOperand(argument, is_meant);
                                                });
      });
}

} // namespace

std::size_t
Operand::fullWidth() const
{
  switch (kind) {
  case Kind::Field:
    return components.size();
  case Kind::Norm:
    return 1;
  default:
    return derivative == Derivative::Gradient || derivative == Derivative::Curl ? 3 : 1;
  }
}

std::vector<MessageValue>
valuesOfComponents(const Operand& operand)
{
  const std::size_t width = operand.width();
  return {{"name", shortenText(operand.text)},
          {"components", width},
          {"operand", operand.text},
          {"last", width - 1}};
}

bool
Formula::hasDerivative() const
{
  return hasOperand(*this, [](const Operand& operand) {
    return operand.kind == Operand::Kind::Derivative;
  });
}

bool
Formula::hasField() const
{
  return hasOperand(*this, [](const Operand& operand) {
    return operand.kind == Operand::Kind::Field;
  });
}

bool
Formula::hasCoordinate() const
{
  return hasOperand(*this,
                    [](const Operand& operand) { return operand.is_coordinate; });
}

} // namespace pcl_uvol
