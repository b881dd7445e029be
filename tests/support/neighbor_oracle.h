// SPDX-License-Identifier: BSD-3-Clause
// Brute force for the neighbour search: a kd-tree by plain sorting, boxes of integer
// ranks, all pairs. Slow and obvious.
#pragma once

#include "neighbors/angle_criterion.h"
#include "neighbors/kd_tree.h"

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace uvol_test {

/** \brief Cells of distinct samples by thesis Table 2.2, as intervals of plane ranks.
 */
class NeighborOracle {
public:
  /** \param positions distinct, in any order */
  explicit NeighborOracle(std::vector<pcl_uvol::Position> positions);

  /** \brief Positions in leaf order. */
  const std::vector<pcl_uvol::Position>&
  positions() const
  {
    return positions_;
  }

  /** \brief Samples whose closed box shares a point with that of the sample, ascending.
   */
  std::vector<std::uint32_t>
  touching(std::uint32_t sample) const;

  /** \brief Those that pass the angle criterion, by increasing distance. */
  std::vector<std::uint32_t>
  neighbors(std::uint32_t sample, pcl_uvol::AngleCriterion criterion) const;

  /** \brief (lower, higher) index of every edge whose ends differ in value >= isovalue.
   */
  std::set<std::pair<std::uint32_t, std::uint32_t>>
  edges(const std::vector<float>& values,
        float isovalue,
        pcl_uvol::AngleCriterion criterion) const;

private:
  struct Plane {
    float coordinate;
    pcl_uvol::Position below;
  };
  struct Box { // plane numbers, -1 without bound
    int low[3] = {-1, -1, -1};
    int high[3] = {-1, -1, -1};
  };

  void
  split(std::size_t begin, std::size_t end, int depth, const Box& box);
  void
  rankPlanes();

  std::vector<int> axes_;
  std::vector<pcl_uvol::Position> positions_;
  std::vector<Plane> planes_;
  std::vector<int> plane_axes_;
  std::vector<Box> boxes_;
};

} // namespace uvol_test
