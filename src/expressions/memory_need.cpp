// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/memory_need.h"

#include "expressions/formula.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Bytes per sample of detail::computeDerivatives with three fields, and of what goes
 * into it and comes out (measured, see tests/tools/test_memory_forecast.cpp). */
constexpr double derivative_bytes = 160.0;

/** True for what addDerivedField leaves as it is, whatever the fields are called. */
bool
isPlainName(const std::string& name)
{
  return name.find_first_of("+-*/^<>=!&?(") == std::string::npos;
}

} // namespace

MemoryNeed
derivedFieldNeed(const std::string& expression, double points, double& point_step)
{
  if (isPlainName(expression))
    return {};
  // The column, and the points packed anew twice.
  const double adding = (sizeof(double) + 2.0 * point_step + sizeof(double)) * points;
  point_step += sizeof(double);
  const double deriving =
      mayHaveDerivative(expression) ? derivative_bytes * points : 0.0;
  return {std::max(adding, deriving), sizeof(double) * points};
}

} // namespace pcl_uvol
