// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/neighbors/angle_criterion.h>

#include <algorithm>

namespace pcl_uvol {

double
AngleFilter::dot(const Sight& a, const Sight& b)
{
  return a.direction[0] * b.direction[0] + a.direction[1] * b.direction[1] +
         a.direction[2] * b.direction[2];
}

void
AngleFilter::apply(std::uint32_t sample, std::vector<std::uint32_t>& candidates)
{
  // Double: differences of floats and their squares neither overflow nor lose ties.
  const Position& x = positions_[sample];
  sights_.resize(candidates.size());
  keys_.resize(candidates.size());
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    Sight& sight = sights_[i];
    for (int axis = 0; axis < 3; ++axis)
      sight.direction[axis] =
          static_cast<double>(positions_[candidates[i]][axis]) - x[axis];
    sight.sq_dist = dot(sight, sight);
    keys_[i] = {sight.sq_dist, candidates[i], i};
  }
  std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) {
    return a.sq_dist != b.sq_dist ? a.sq_dist < b.sq_dist : a.index < b.index;
  });

  candidates.clear();
  judges_.clear();
  for (const Key& key : keys_) {
    const Sight& y = sights_[key.position];
    const bool hidden =
        std::any_of(judges_.begin(), judges_.end(), [&](const Sight& z) {
          // cos > sqrt(1/3), squared to save the roots
          const double product = dot(y, z);
          return product > 0.0 && 3.0 * product * product > y.sq_dist * z.sq_dist;
        });
    if (!hidden)
      candidates.push_back(key.index);
    if (!hidden || criterion_ == AngleCriterion::All)
      judges_.push_back(y);
  }
}

} // namespace pcl_uvol
