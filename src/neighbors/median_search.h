// SPDX-License-Identifier: BSD-3-Clause
// Exact medians of samples that several processes hold, by radix selection.
#pragma once

#include <pcl_uvol/neighbors/decomposition.h>

namespace pcl_uvol {

/** \brief The child of a node that a position lies below. \param axis of the node's
 * plane
 */
inline std::size_t
childOf(std::size_t node,
        const Position& position,
        int axis,
        const std::vector<PlaneKey>& planes)
{
  return node << 1 |
         static_cast<std::size_t>(lessAlong(axis, planes[node].below, position));
}

/** \brief The node at a depth that a position lies below. \param planes by node number
 */
inline std::size_t
nodeOf(const Position& position,
       int depth,
       const AxisCycle& axes,
       const std::vector<PlaneKey>& planes)
{
  std::size_t node = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(depth); ++d)
    node = childOf(node, position, axes[d], planes);
  return node;
}

/** \brief The medians of all nodes of one depth after another. */
class MedianSearch {
public:
  /** \param scan, ranks must outlive the search */
  MedianSearch(const PositionScan& scan, RankGroup& ranks, unsigned threads)
      : scan_(scan)
      , ranks_(ranks)
      , threads_(threads)
  {
  }

  /** \brief Count the samples. \return axes along which they differ */
  std::array<bool, 3>
  findExtent();

  /** \brief Of all processes, once findExtent() was called. */
  std::uint64_t
  getSampleCount() const
  {
    return count_;
  }

  /** \brief Set the planes of a depth, one after another from 0 on. A node with fewer
   * than two samples, which only equal ones leave behind, has a plane above all of
   * them.
   */
  void
  findMedians(int depth, const AxisCycle& axes, std::vector<PlaneKey>& planes);

private:
  const PositionScan& scan_;
  RankGroup& ranks_;
  unsigned threads_;
  std::uint64_t count_ = 0;
  std::vector<std::uint32_t> nodes_; // see Level::findNode
};

} // namespace pcl_uvol
