// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a formula gives at the points of a cloud.
#pragma once

#include "expressions/formula.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/report.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** [component][point]; NaN where there is no finite number. */
using Columns = std::vector<std::vector<double>>;

/** Compute a formula at all points.
 * \param undefined gets one more for every number that is not finite although all that
 * it is made of are
 * \param report gets warnings of derivatives */
Columns
evaluateFormula(const Formula& formula,
                const CloudView& cloud,
                unsigned threads,
                std::uint64_t& undefined,
                Report& report);

} // namespace pcl_uvol
