// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/neighbors/angle_criterion.h>

#include <algorithm>

namespace pcl_uvol {

void
AngleFilter::apply(std::uint32_t sample, std::vector<std::uint32_t>& candidates)
{
  // Double: differences of floats and their squares neither overflow nor lose ties.
  const Position& x = positions_[sample];
  if (sights_.size() < candidates.size())
    sights_.resize(candidates.size());
  Sight* const open = sights_.data();
  Sight* end = open;
  for (const std::uint32_t candidate : candidates) {
    const Position& y = positions_[candidate];
    const double dx = static_cast<double>(y[0]) - x[0];
    const double dy = static_cast<double>(y[1]) - x[1];
    const double dz = static_cast<double>(y[2]) - x[2];
    *end++ = {dx, dy, dz, dx * dx + dy * dy + dz * dz, candidate, 0};
  }

  // The nearest of the open candidates judges the others, which are all farther.
  const std::uint32_t out = criterion_ == AngleCriterion::Kept ? 1 : 2;
  candidates.clear();
  while (end != open) {
    const Sight* nearest = open;
    for (const Sight* sight = open + 1; sight != end; ++sight)
      nearest = sight->isBefore(*nearest) ? sight : nearest;
    const Sight judge = *nearest;
    if (judge.hidden == 0)
      candidates.push_back(judge.index);
    Sight* kept = open;
    for (const Sight* sight = open; sight != end; ++sight) {
      Sight next = *sight;
      // cos > sqrt(1/3), squared to save the roots
      const double product = next.x * judge.x + next.y * judge.y + next.z * judge.z;
      next.hidden |= static_cast<std::uint32_t>(
          (product > 0.0) & (3.0 * product * product > next.sq_dist * judge.sq_dist));
      *kept = next;
      // The judge hides itself, and goes whatever the criterion.
      kept += static_cast<std::ptrdiff_t>((next.hidden < out) & (sight != nearest));
    }
    end = kept;
  }
}

} // namespace pcl_uvol
