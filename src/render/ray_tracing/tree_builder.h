// SPDX-License-Identifier: BSD-3-Clause
// Divides boxes into a tree with sixteen children per node, by the surface area
// heuristic (Wald 2007: binned).
#pragma once

#include "render/ray_tracing/splat_tree_kernel.h"
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief A box around one item. */
struct ItemBox {
  float low[3], high[3];
};

/** \brief Nodes, the root first, and the items of every leaf: at most tree_width each,
 * leaf after leaf. */
struct WideTree {
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> items;
  std::vector<std::uint32_t> leaf_begin; ///< in items; one more than leaves
};

/** \brief The tree does not depend on the number of threads. Its depth is at most 32.
 * \param boxes at least one
 * \param step of the items */
WideTree
buildWideTree(const std::vector<ItemBox>& boxes, unsigned threads, StepTimer& step);

} // namespace pcl_uvol
