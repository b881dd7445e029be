// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/samples_in_box.h"

#include <numeric>
#include <utility>

namespace pcl_uvol {

SamplesInBox::SamplesInBox(Dataset& samples,
                           const std::array<double, 3>& sides,
                           const Eigen::Array3f& scale,
                           unsigned threads,
                           Report& report)
{
  if (!pcl_uvol::isPeriodic(sides))
    return;
  std::vector<std::uint32_t> all(samples.cloud.width);
  std::iota(all.begin(), all.end(), 0u);
  PeriodicReach reach;
  reach.scale = toPosition(scale);
  reach.spacings = 8.0; // a level set knows less of the field where it ends
  const auto box = findPeriodicBox(samples, sides, report);
  images_ = addPeriodicImages(samples, all, box, reach, threads, report);
  before_ = std::move(samples);
  samples = std::move(images_.samples);
  report.count("images", images_.image_of.size());
}

void
SamplesInBox::dropImages(Dataset& points)
{
  if (!isPeriodic())
    return;
  images_.samples = std::move(points);
  points = dropPeriodicImages(std::move(images_), before_);
}

void
addFieldsInBox(Dataset& samples,
               const std::array<double, 3>& sides,
               double least,
               unsigned threads,
               const ProgressCallback& progress,
               const std::function<void(Dataset&)>& add)
{
  if (!isPeriodic(sides))
    return add(samples);
  Report own; // whoever uses the box tells of it
  own.progress = progress;
  std::vector<std::uint32_t> all(samples.cloud.width);
  std::iota(all.begin(), all.end(), 0u);
  PeriodicReach reach;
  reach.least = least;
  auto images = addPeriodicImages(
      samples,
      all,
      cutAtWidestGap(samples, findPeriodicBox(samples, sides, own), threads),
      reach,
      threads,
      own);
  add(images.samples);
  samples = dropPeriodicImages(std::move(images), samples);
}

} // namespace pcl_uvol
