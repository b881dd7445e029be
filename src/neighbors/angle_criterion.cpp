// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/angle_criterion.h"

#include <algorithm>

namespace pcl_uvol {

void
AngleFilter::apply(std::uint32_t sample, std::vector<std::uint32_t>& candidates)
{
  // Double: differences of floats and their squares neither overflow nor lose ties.
  const Position& x = positions_[sample];
  if (sights_.size() < candidates.size())
    sights_.resize(candidates.size());
  Sight* const first = sights_.data();
  Sight* last = first;
  for (const std::uint32_t candidate : candidates) {
    const Position& y = positions_[candidate];
    const double dx = static_cast<double>(y[0]) - x[0];
    const double dy = static_cast<double>(y[1]) - x[1];
    const double dz = static_cast<double>(y[2]) - x[2];
    *last++ = {dx, dy, dz, dx * dx + dy * dy + dz * dz, candidate};
  }
  candidates.clear();
  if (criterion_ == AngleCriterion::None) {
    std::sort(
        first, last, [](const Sight& a, const Sight& b) { return a.isBefore(b); });
    for (const Sight* sight = first; sight != last; ++sight)
      candidates.push_back(sight->index);
    return;
  }
  if (criterion_ == AngleCriterion::Kept) {
    keepByKept(first, last, candidates);
    return;
  }
  // Whom no closer one hides, none of the kept ones hides either: few are to be asked.
  all_sights_.assign(first, last);
  keepByKept(first, last, candidates);
  candidates.erase(
      std::remove_if(candidates.begin(),
                     candidates.end(),
                     [&](std::uint32_t candidate) { return isHidden(candidate); }),
      candidates.end());
}

void
AngleFilter::keepByKept(Sight* first, Sight* last, std::vector<std::uint32_t>& kept)
{
  // The nearest of the open candidates is kept, and removes the others behind it.
  while (last != first) {
    const Sight* nearest = first;
    for (const Sight* sight = first + 1; sight != last; ++sight)
      nearest = sight->isBefore(*nearest) ? sight : nearest;
    const Sight judge = *nearest;
    kept.push_back(judge.index);
    Sight* open = first;
    for (const Sight* sight = first; sight != last; ++sight) {
      const Sight next = *sight;
      *open = next;
      open += static_cast<std::ptrdiff_t>(!next.isBehind(judge) & (sight != nearest));
    }
    last = open;
  }
}

bool
AngleFilter::isHidden(std::uint32_t candidate) const
{
  const Sight sight =
      *std::find_if(all_sights_.begin(), all_sights_.end(), [&](const Sight& other) {
        return other.index == candidate;
      });
  return std::any_of(all_sights_.begin(), all_sights_.end(), [&](const Sight& other) {
    return other.isBefore(sight) && sight.isBehind(other);
  });
}

} // namespace pcl_uvol
