// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a formula gives at the points of a cloud.
#pragma once

#include "expressions/formula.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** [component][point]; NaN where there is no finite number. */
using Columns = std::vector<std::vector<double>>;

/** What an operand without a value makes of a program that it is in. */
enum class Missing {
  Everything, ///< its result is missing as well
  Comparisons ///< comparisons with it fail but for !=
};

/** The points of a formula. Derivatives may see images of them as well, in a box that
 * repeats. */
struct FormulaPoints {
  CloudView own; ///< with the coordinates that a formula has outside of derivatives
  /** The same points first, then their images, where derivatives have them. */
  CloudView with_images;
  std::vector<std::uint32_t> image_of; ///< the point of each image
};

/** Compute a formula at all points.
 * \param missing for the formula itself, not for those in it
 * \param undefined gets one more for every number of a point, not of its images, that
 * is not finite although all that it is made of are
 * \param report gets warnings of derivatives */
Columns
evaluateFormula(const Formula& formula,
                const FormulaPoints& points,
                Missing missing,
                unsigned threads,
                std::uint64_t& undefined,
                Report& report);

} // namespace pcl_uvol
