// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/sample_fits.h"

#include "interpolation/bucket_fitter.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** Room for the rounding of distances. */
constexpr double slack = 1.0001;

} // namespace

SampleFits::SampleFits(const SampledFields& sampled, unsigned threads)
    : sampled_(sampled)
    , metrics_(*sampled.samples, threads)
    , balls_(
          *sampled.samples,
          [this](const BallTree::Bucket& bucket) { return boundByBox(bucket); },
          threads,
          [this](const BallTree::Bucket& bucket) { return boundReach(bucket); })
    , fits_(balls_.getBuckets().size())
    , once_(balls_.getBuckets().size())
{
}

/** No sample of a bucket is farther from another one; where they are few in all, fits
 * reach farther than their only bucket. */
double
SampleFits::boundByBox(const BallTree::Bucket& bucket) const
{
  double sq_extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent =
        static_cast<double>(bucket.box.high[axis]) - bucket.box.low[axis];
    sq_extent += extent * extent;
  }
  double ratio = 1.0;
  for (std::uint32_t i = bucket.begin; i < bucket.begin + bucket.count; ++i)
    if (const StretchedMetric* const metric = metrics_.find(i))
      ratio = std::max(ratio, metric->ratio);
  const double diagonal = ratio * std::sqrt(sq_extent);
  return slack * (bucket.count <= BucketFitter::blended_samples
                      ? std::max(1.0, 2.0 * diagonal)
                      : diagonal);
}

double
SampleFits::boundReach(const BallTree::Bucket& bucket) const
{
  // Neighbours of the same bucket are no nearer than the nearest ones.
  const std::vector<Position>& positions = sampled_.samples->getPositions();
  constexpr std::size_t blended = BucketFitter::blended_samples;
  if (bucket.count <= blended)
    return boundByBox(bucket);
  double sq_reach = 0.0;
  std::vector<double> sq_dists(bucket.count);
  for (std::uint32_t i = bucket.begin; i < bucket.begin + bucket.count; ++i) {
    const StretchedMetric* const metric = metrics_.find(i);
    for (std::uint32_t j = 0; j < bucket.count; ++j)
      sq_dists[j] =
          offsetIn(metric, positions[i], positions[bucket.begin + j]).squaredNorm();
    std::nth_element(sq_dists.begin(), sq_dists.begin() + blended, sq_dists.end());
    sq_reach = std::max(sq_reach, sq_dists[blended]);
  }
  return slack * std::sqrt(sq_reach);
}

const BucketFits&
SampleFits::getFits(std::size_t bucket) const
{
  std::call_once(once_[bucket], [&] {
    BucketFitter fitter(sampled_, metrics_);
    fits_[bucket] = std::make_unique<const BucketFits>(fitter.fit(
        balls_.getBuckets()[bucket].begin, balls_.getBuckets()[bucket].count));
  });
  return *fits_[bucket];
}

std::uint64_t
SampleFits::countReduced() const
{
  std::uint64_t count = 0;
  for (const auto& fits : fits_)
    if (fits)
      count += static_cast<std::uint64_t>(
          std::count(fits->is_reduced.begin(), fits->is_reduced.end(), true));
  return count;
}

} // namespace pcl_uvol::detail
