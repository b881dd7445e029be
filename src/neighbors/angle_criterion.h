// SPDX-License-Identifier: BSD-3-Clause
// The angle criterion of thesis 2.3: no two neighbours of a sample lie behind each
// other.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Remove every candidate whose angle to a closer one, seen from the sample, is
 * below acos(sqrt(1/3)), 54.7 degrees (Table 2.4), unless the criterion is None. Equal
 * distances count by index. */
class PCL_UVOL_EXPORTS AngleFilter {
public:
  /** \param positions must outlive the filter and be distinct */
  AngleFilter(const std::vector<Position>& positions, AngleCriterion criterion)
      : positions_(positions)
      , criterion_(criterion)
  {
  }

  /** \brief Filter in place; what stays is sorted by (squared distance, index). */
  void
  apply(std::uint32_t sample, std::vector<std::uint32_t>& candidates);

private:
  /** A candidate as seen from the sample; the direction is not normalised. */
  struct Sight {
    double x, y, z, sq_dist;
    std::uint32_t index;

    bool
    isBefore(const Sight& other) const
    {
      return (sq_dist < other.sq_dist) |
             ((sq_dist == other.sq_dist) & (index < other.index));
    }

    /** cos > sqrt(1/3), squared to save the roots. */
    bool
    isBehind(const Sight& other) const
    {
      const double product = x * other.x + y * other.y + z * other.z;
      return (product > 0.0) & (3.0 * product * product > sq_dist * other.sq_dist);
    }
  };

  /** Those of [first, last) that no kept closer one hides; the range is used up. */
  static void
  keepByKept(Sight* first, Sight* last, std::vector<std::uint32_t>& kept);

  /** Whether any closer one hides a candidate. */
  bool
  isHidden(std::uint32_t candidate) const;

  const std::vector<Position>& positions_;
  AngleCriterion criterion_;
  std::vector<Sight> sights_, all_sights_; // workspace
};

} // namespace pcl_uvol
