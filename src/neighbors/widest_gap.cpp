// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/widest_gap.h"

#include "common/parallel.h"

#include <cmath>
#include <functional>

namespace pcl_uvol {

std::vector<double>
sortPlaces(const CloudView& cloud,
           const PeriodicBox& box,
           std::size_t axis,
           unsigned threads)
{
  std::vector<double> places;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const float x = cloud.xyz(i)[axis]; std::isfinite(x))
      places.push_back(box.toBox(static_cast<double>(x), axis));
  parallelSort(places.begin(), places.end(), threads, std::less<>());
  return places;
}

std::vector<Gap>
listGaps(const std::vector<double>& places, double first)
{
  std::vector<Gap> gaps{{first, 1, places.front()}};
  for (std::size_t i = 1; i < places.size(); ++i)
    if (const double width = places[i] - places[i - 1]; width > 0.0)
      gaps.push_back({width, 1, places[i]});
    else
      ++gaps.back().samples;
  return gaps;
}

bool
areWider(const Gap* gaps, const Gap* others, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) {
    if (gaps[i].width != others[i].width)
      return gaps[i].width > others[i].width;
    if (gaps[i].samples != others[i].samples)
      return gaps[i].samples < others[i].samples;
  }
  return false;
}

std::size_t
findWidestGap(const std::vector<Gap>& gaps, std::size_t count, std::size_t compared)
{
  std::size_t widest = 0;
  for (std::size_t i = 1; i < count; ++i)
    if (areWider(&gaps[i], &gaps[widest], compared))
      widest = i;
  return widest;
}

} // namespace pcl_uvol
