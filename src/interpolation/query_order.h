// SPDX-License-Identifier: BSD-3-Clause
// An order in which queries that follow one another lie close together.
#pragma once

#include "interpolation/field_model.h"
#include "neighbors/kd_tree.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Queries along a space-filling curve, those of equal place by index.
 * \param box of the samples: what lies outside counts as on its border */
std::vector<std::uint32_t>
orderInSpace(const std::vector<Query>& queries, const KdBox& box, unsigned threads);

} // namespace pcl_uvol::detail
