// SPDX-License-Identifier: BSD-3-Clause
// Gradients, curls, vortex criteria and the like of fields at their own samples.
#pragma once

#include "expressions/evaluation.h"

namespace pcl_uvol {

/** \param fields one column, or three of a vector, at points and images
 * \return columns of points and images: images have the numbers of their points
 * \param undefined, report see evaluateFormula */
Columns
deriveColumns(Derivative derivative,
              const Columns& fields,
              const FormulaPoints& points,
              unsigned threads,
              std::uint64_t& undefined,
              Report& report);

} // namespace pcl_uvol
