// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "common/records.h"
#include "neighbors/boxed_samples.h"
#include "neighbors/nearest_finder.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace pcl_uvol {
namespace {

constexpr std::size_t image_block = 1024;

/** How far beyond the faces the neighbours of samples in the box lie, in the stretched
 * space; more than the reach where images do not suffice. */
double
measureNeed(const BoxedSamples& boxed,
            const PeriodicReach& how,
            double reach,
            unsigned threads,
            const ProgressCallback& progress)
{
  const std::vector<std::uint32_t>& use = boxed.getUsed();
  const std::vector<PeriodicImage> images = boxed.findImages(reach, threads);
  std::vector<Position> places;
  places.reserve(use.size() + images.size());
  for (const std::uint32_t sample : use)
    places.push_back(boxed.getPlace(sample));
  for (const PeriodicImage& image : images)
    places.push_back(boxed.getPlace(image));
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  Report own; // of samples that others count as well
  own.progress = progress;
  const auto set = SampleSet::build(places[0].x, 3, all, how.scale, threads, own);
  if (set->size() < how.neighbors)
    return std::numeric_limits<double>::infinity();
  StepTimer step(own, "images", set->size());
  std::vector<double> needs((set->size() + image_block - 1) / image_block, 0.0);
  parallelBlocks(set->size(), image_block, threads, [&](auto begin, auto end) {
    NearestFinder finder(*set, how.neighbors);
    float length = 1.0f;
    double& need = needs[begin / image_block];
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t input = set->getInputIndex(i);
      const double depth = input < use.size()
                               ? static_cast<double>(boxed.getDepth(use[input]))
                               : 2.0 * reach;
      if (depth > reach) // neighbours of deeper ones lie in the box, but for voids
        continue;
      const auto row = finder.find(set->getPositions()[i], length);
      length = std::sqrt(*std::max_element(row.sq_dists, row.sq_dists + row.size));
      need =
          std::max(need, set->getUnit().toInput(static_cast<double>(length)) - depth);
    }
    step.advance(end - begin);
  });
  return *std::max_element(needs.begin(), needs.end());
}

} // namespace

PeriodicSamples
addPeriodicImages(const Dataset& samples,
                  const std::vector<std::uint32_t>& use,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  unsigned threads,
                  Report& report)
{
  const StepTimer timer(report, "images");
  const BoxedSamples boxed(viewOf(samples.cloud), use, box, reach.scale);
  const double found =
      findReach(boxed, boxed.measureSpread(), reach, [&](double least) {
        return measureNeed(boxed, reach, least, threads, report.progress);
      });
  return boxed.addImages(samples, found, threads);
}

PeriodicSamples
addPeriodicImages(const Dataset& samples,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  unsigned threads,
                  Report& report)
{
  std::vector<std::uint32_t> all(samples.cloud.width);
  std::iota(all.begin(), all.end(), 0u);
  return addPeriodicImages(samples, all, box, reach, threads, report);
}

Dataset
dropPeriodicImages(PeriodicSamples&& images, const Dataset& samples)
{
  Dataset own = std::move(images.samples);
  own.origin = samples.origin;
  resizePoints(own.cloud, samples.cloud.width);
  for (std::size_t i = 0; i < samples.cloud.width; ++i)
    std::memcpy(own.cloud.data.data() + i * own.cloud.point_step,
                samples.cloud.data.data() + i * samples.cloud.point_step,
                3 * sizeof(float));
  return own;
}

} // namespace pcl_uvol
