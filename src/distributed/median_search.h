// SPDX-License-Identifier: BSD-3-Clause
// Exact medians of samples that several processes hold, by sampled selection.
#pragma once

#include "distributed/decomposition.h"

namespace pcl_uvol {

/** \brief The child of a node that a position lies below.
 * \param axis of the node's plane */
inline std::size_t
findChild(std::size_t node,
          const Position& position,
          int axis,
          const std::vector<PlaneKey>& planes)
{
  return node << 1 |
         static_cast<std::size_t>(lessAlong(axis, planes[node].below, position));
}

/** \brief The node at a depth that a position lies below.
 * \param planes by node number */
inline std::size_t
findNode(const Position& position,
         int depth,
         const AxisCycle& axes,
         const std::vector<PlaneKey>& planes)
{
  std::size_t node = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(depth); ++d)
    node = findChild(node, position, axes[d], planes);
  return node;
}

/** \brief A position of a node, from the first node of a depth. */
struct NodePosition {
  std::uint32_t node;
  Position position;
};

/** \brief The medians of all nodes of one depth after another.
 *
 * Positions drawn at random tell between which two positions a median nearly certainly
 * lies; one pass over all samples counts those below, and hands out those between them,
 * among which the median is found (Floyd and Rivest 1975). A median that is not there
 * is sought again on the side where it is: the result does not depend on what was
 * drawn. */
class MedianSearch {
public:
  /** \brief Count the samples, draw some of them.
   * \param levels that are going to be sought
   * \param positions, communicator must outlive the search */
  MedianSearch(const PositionSource& positions,
               int levels,
               Communicator& communicator,
               unsigned threads);

  /** \brief Axes along which the samples of all processes differ. */
  const std::array<bool, 3>&
  getExtent() const
  {
    return extent_;
  }

  /** \brief Samples of all processes, by node at the depths found so far. */
  const std::vector<std::uint64_t>&
  getCounts() const
  {
    return counts_;
  }

  /** \brief Set the planes of a depth, one after another from 0 on. A node without two
   * different samples, which only equal ones leave behind, has a plane above all. */
  void
  findMedians(int depth, const AxisCycle& axes, std::vector<PlaneKey>& planes);

private:
  const PositionSource& positions_;
  Communicator& communicator_;
  unsigned threads_;
  std::array<bool, 3> extent_;
  std::vector<std::uint64_t> counts_; // by node number; node 0 is none
  std::uint64_t drawn_limit_;         // as expected
  std::vector<NodePosition> drawn_;   // of all processes, of the depth sought last
  bool all_drawn_;
};

} // namespace pcl_uvol
