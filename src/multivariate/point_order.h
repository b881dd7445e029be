// SPDX-License-Identifier: BSD-3-Clause
// The order of points in which those of a kd-tree's cell follow one another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Rows in their order, and the indices they had. */
struct PointOrder {
  std::vector<float> rows;
  std::vector<std::uint32_t> points;
};

/** \brief Order points such that blocks of lanes consecutive ones are cells, and blocks
 * of lanes such blocks, and so on: cells are split near the median of their widest
 * axis, equal coordinates by index. */
PointOrder
orderPoints(const std::vector<float>& values,
            std::size_t columns,
            std::size_t lanes,
            unsigned threads);

} // namespace pcl_uvol
