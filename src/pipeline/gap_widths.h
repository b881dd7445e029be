// SPDX-License-Identifier: BSD-3-Clause
// How wide gaps between lines of samples are, in spacings.
#pragma once

#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Predicted samples to the width of a gap: with 2, a hold-out test tells more
 * of the samples left out wrongly (tests/benchmarks), since gaps are narrower in
 * places. */
constexpr double samples_per_gap = 4.0;

/** \brief Spacings of predicted samples: edges that are longer reach across a gap. */
constexpr double half_gap = 0.5 * samples_per_gap;

/** \brief Spacings of predicted samples, half a gap: so far outside of the convex hull
 * of the measured samples a place still counts as between them. Without, samples on a
 * plane have no gaps, and a dive at the end of a glider's track that is left out lies
 * around them. */
constexpr double hull_tolerance = half_gap;

/** \brief Spacings of predicted samples: slopes of the kriged field are those between
 * places so far to both sides. */
constexpr double slope_step = 1.0;

/** \brief Spacings along lines or sheets: edges that are longer may reach across to
 * others. Where nothing is seen to lie beside a line, the gaps are as wide as the lower
 * quartile of these edges. */
constexpr double crossing_edge = 8.0;

/** \brief How wide gaps are: as lines or sheets lie apart, or the lower quartile of the
 * edges that reach across to others.
 * \param lengths of edges that the surface crosses, in the unit of the sampling
 * \return 0 where the samples do not tell */
inline double
findGapWidth(const SamplingSummary& sampling, std::vector<double> lengths)
{
  if (std::isfinite(sampling.across))
    return static_cast<double>(sampling.across);
  const double least = crossing_edge * static_cast<double>(sampling.along);
  const auto across = std::partition(
      lengths.begin(), lengths.end(), [&](double length) { return length > least; });
  if (across == lengths.begin())
    return 0.0;
  const auto quartile = lengths.begin() + (across - lengths.begin()) / 4;
  std::nth_element(lengths.begin(), quartile, across);
  return *quartile;
}

} // namespace pcl_uvol::detail
