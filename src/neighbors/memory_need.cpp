// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/memory_need.h"

#include "neighbors/kd_tree.h"

#include <cmath>

namespace pcl_uvol {

namespace {

constexpr double index_bytes = sizeof(std::uint32_t);

/** FLANN's tree, per point: its copy of the position, a pointer to it, its index, and
 * nodes of 40 bytes, two for every leaf of the 11 points that leaves of at most 15
 * hold in the mean. */
constexpr double flann_bytes =
    3 * sizeof(float) + sizeof(float*) + sizeof(int) + 2 * 40.0 / 11.0;

/** Inner nodes are numbered up to a power of two. */
double
nodeNumbers(double samples)
{
  return std::exp2(std::ceil(std::log2(std::max(samples, 1.0))));
}

} // namespace

MemoryNeed
sampleSetNeed(double samples)
{
  const double planes = sizeof(SplitPlane) * nodeNumbers(samples);
  const double boxes =
      2.0 * sizeof(KdBox) * nodeNumbers(samples / KdTree::bucket_samples);
  const double kept = planes + boxes + (sizeof(Position) + index_bytes) * samples;
  return {kept + sizeof(SampleRecord) * samples, kept};
}

double
nodeRangesBytes(double samples)
{
  return sizeof(NodeRanges::Range) * nodeNumbers(samples);
}

MemoryNeed
nearestNeighborsNeed(double samples, double k)
{
  const double row = std::min(k, std::max(samples - 1.0, 0.0));
  const double kept = (sizeof(std::uint64_t) + row * index_bytes) * samples;
  return {kept + flann_bytes * samples, kept};
}

} // namespace pcl_uvol
