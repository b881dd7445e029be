// SPDX-License-Identifier: BSD-3-Clause
// Nodes of a cubic lattice on both sides of an isosurface, found by following it from
// cell to cell (Wyvill, McPheeters and Wyvill 1986) through a field that can be asked
// anywhere.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A node of the lattice, and the cell between it and the next ones along all
 * axes. Within +-2^20. */
using LatticeNode = std::array<std::int32_t, 3>;

/** \brief What a field is at a node. */
struct NodeValue {
  double value;  ///< NaN: none
  bool is_asked; ///< the surface is followed here
};

/** \brief Follows isosurfaces and collects the nodes around them. */
class PCL_UVOL_EXPORTS LatticeBand {
public:
  /** \brief Tells the field at some nodes, in their order. */
  using Evaluate =
      std::function<std::vector<NodeValue>(const std::vector<LatticeNode>&)>;

  /** \param most nodes that are asked for: a surface with more is not followed to its
   * end */
  LatticeBand(Evaluate evaluate, std::size_t most)
      : evaluate_(std::move(evaluate))
      , most_(most)
  {
  }

  /** \brief Follow the isosurface from some cells and those around them.
   *
   * A cell belongs to it where its nodes all have values, on both sides of the
   * isovalue, and one of them at least is asked for. Nodes of such cells and of those
   * around them are collected.
   * \return false if it has too many nodes */
  bool
  follow(const std::vector<LatticeNode>& seeds, double isovalue);

  /** \brief The nodes collected so far that have a value and are asked for, ascending,
   * and their values. */
  std::vector<std::pair<LatticeNode, double>>
  listNodes() const;

private:
  using Key = std::uint64_t;

  bool
  evaluateCorners(const std::vector<Key>& cells);

  bool
  isCrossed(Key cell, double isovalue) const;

  Evaluate evaluate_;
  std::size_t most_;
  std::unordered_map<Key, NodeValue> nodes_;
  std::unordered_set<Key> collected_;
};

} // namespace pcl_uvol::detail
