// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/part_in_box.h"

#include "distributed/fetch_points.h"
#include "distributed/periodic_ranks.h"
#include "pipeline/periodic_surface.h"

#include <algorithm>

namespace pcl_uvol {

PartInBox::PartInBox(const std::shared_ptr<const Dataset>& part,
                     const IsosurfacePipelineParameters& parameters,
                     Communicator& communicator,
                     unsigned threads,
                     Report& report)
    : part_(part)
    , points_(part)
    , rank_(communicator.rank())
{
  if (isPeriodic(sidesOf(parameters))) {
    box_ = findPeriodicBox(*part, sidesOf(parameters), communicator, report);
    cut_ = cutAtWidestGap(*part, box_, communicator, threads);
    points_ = std::make_shared<Dataset>(
        addPeriodicImages(*part,
                          listWithValue(*part, nullptr, parameters.isosurface.field),
                          cut_,
                          reachFor(parameters),
                          communicator,
                          threads,
                          report)
            .samples);
    report.count("images", points_->cloud.width - part->cloud.width);
  }
  const std::uint64_t own = part->cloud.width;
  own_firsts_ = findFirstIndices(own, communicator);
  image_firsts_ = findFirstIndices(points_->cloud.width - own, communicator);
}

std::uint64_t
PartInBox::toSource(std::uint64_t point) const
{
  const std::uint64_t own = part_->cloud.width;
  return point < own ? own_firsts_[rank_] + point
                     : own_firsts_.back() + image_firsts_[rank_] + (point - own);
}

std::uint64_t
PartInBox::toPoint(std::uint64_t source) const
{
  const std::uint64_t samples = own_firsts_.back();
  const bool is_image = source >= samples;
  const auto& firsts = is_image ? image_firsts_ : own_firsts_;
  const std::uint64_t number = is_image ? source - samples : source;
  const auto next = static_cast<std::size_t>(
      std::upper_bound(firsts.begin(), firsts.end(), number) - firsts.begin());
  return number + (is_image ? own_firsts_[next] : image_firsts_[next - 1]);
}

void
PartInBox::numberByPoints(std::vector<std::vector<GlobalIsopoint>>& isopoints) const
{
  for (auto& of_isovalue : isopoints)
    for (GlobalIsopoint& isopoint : of_isovalue) {
      isopoint.first = toPoint(isopoint.first);
      isopoint.second = toPoint(isopoint.second);
    }
}

Samples
PartInBox::readSamples(const ScalarField& field,
                       const ValueFrame& frame,
                       unsigned threads,
                       Report& report) const
{
  Samples samples =
      pcl_uvol::readSamples(viewOf(points_->cloud), field, frame, 0, threads, report);
  for (std::uint64_t& source : samples.sources)
    source = toSource(source);
  return samples;
}

void
PartInBox::finish(Communicator& communicator, IsosurfaceResult& result) const
{
  if (!isPeriodic(box_.sides))
    return;
  returnPoints(cut_, box_, part_->origin, result);
  // Images lie in the pieces of others as well: the first process tells of all samples.
  std::vector<std::uint64_t> samples{result.report.getCount("samples")};
  communicator.allReduce(samples);
  result.report.setCount("samples", rank_ == 0 ? samples[0] - image_firsts_.back() : 0);
}

} // namespace pcl_uvol
