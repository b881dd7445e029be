// SPDX-License-Identifier: BSD-3-Clause
// Clusters that rounding makes: many values pile up at each of its steps.
#pragma once

#include "multivariate/attributes.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Warn of attributes of which at least two clusters and half of all have a
 * single value each, mostly one step apart, the smallest one between its values, and
 * apart in no other attribute.
 *
 * Classes are no rounding: fewer than 8 values, or whole numbers that are not many more
 * than the clusters.
 * \param labels per row of the table; -1: noise */
void
warnOfRounding(const AttributeTable& table,
               const std::vector<std::int32_t>& labels,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
