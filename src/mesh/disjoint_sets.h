// SPDX-License-Identifier: BSD-3-Clause
// Which items are connected.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Disjoint sets of items; the lowest one stands for its set. */
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count)
      : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t
  find(std::uint32_t item)
  {
    while (parent_[item] != item)
      item = parent_[item] = parent_[parent_[item]];
    return item;
  }

  void
  join(std::uint32_t a, std::uint32_t b)
  {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parent_;
};

} // namespace pcl_uvol::detail
