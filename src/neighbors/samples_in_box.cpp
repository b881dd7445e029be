// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/samples_in_box.h"

#include <utility>

namespace pcl_uvol {

SamplesInBox::SamplesInBox(Dataset& samples,
                           const std::array<double, 3>& sides,
                           const Eigen::Array3f& scale,
                           unsigned threads,
                           Report& report)
{
  warnOfUnusedBox(samples, sides, report);
  if (!pcl_uvol::isPeriodic(sides))
    return;
  PeriodicReach reach;
  reach.scale = toPosition(scale);
  reach.spacings = PeriodicReach::of_level_sets; // of all users, it asks for most
  const auto box = findPeriodicBox(samples, sides, report);
  images_ = addPeriodicImages(samples, box, reach, threads, report);
  before_ = std::move(samples);
  samples = std::move(images_.samples);
  report.count("images", images_.image_of.size());
}

SamplesInBox::SamplesInBox(std::shared_ptr<const Dataset>& samples,
                           const std::array<double, 3>& sides,
                           const Eigen::Array3f& scale,
                           unsigned threads,
                           Report& report)
{
  if (!pcl_uvol::isPeriodic(sides)) {
    warnOfUnusedBox(*samples, sides, report);
    return;
  }
  const auto imaged = std::make_shared<Dataset>(*samples);
  *this = SamplesInBox(*imaged, sides, scale, threads, report);
  samples = imaged;
}

void
SamplesInBox::dropImages(Dataset& points)
{
  if (!isPeriodic())
    return;
  images_.samples = std::move(points);
  points = dropPeriodicImages(std::move(images_), before_);
}

} // namespace pcl_uvol
