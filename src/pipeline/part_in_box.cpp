// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/part_in_box.h"

#include "distributed/byte_stream.h"
#include "distributed/fetch_points.h"
#include "distributed/periodic_ranks.h"
#include "pipeline/periodic_surface.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

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

std::uint64_t
PartInBox::countAllPlaces(Communicator& communicator) const
{
  std::vector<std::vector<ImagePlace>> of_ranks(communicator.size());
  for (const ImagePlace& place : listPlaces(*points_, part_->cloud.width)) {
    std::array<std::uint32_t, 3> bits;
    std::memcpy(bits.data(), place.data(), sizeof(bits));
    of_ranks[(bits[0] ^ bits[1] ^ bits[2]) % of_ranks.size()].push_back(place);
  }
  std::vector<Bytes> messages(communicator.size());
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
    ByteWriter(messages[rank]).put(of_ranks[rank]);
  std::vector<ImagePlace> own;
  for (const Bytes& bytes : communicator.allToAll(std::move(messages))) {
    ByteReader reader(bytes);
    reader.get(own);
  }
  std::vector<std::uint64_t> count{countPlaces(std::move(own))};
  communicator.allReduce(count);
  return count[0];
}

void
PartInBox::finish(const StageSamples& read,
                  Communicator& communicator,
                  IsosurfaceResult& result) const
{
  if (!isPeriodic(box_.sides))
    return;
  result.box = toSampleBox(box_, part_->origin);
  returnPoints(cut_, box_, part_->origin, result);
  // Images lie in the pieces of others as well: the first process tells of all samples.
  std::vector<std::uint64_t> counts{read.samples, read.duplicates};
  communicator.allReduce(counts);
  const std::uint64_t images = image_firsts_.back(),
                      places = counts[1] == 0 ? images : countAllPlaces(communicator);
  const bool counts_all = rank_ == 0;
  result.report.setCount("samples", counts_all ? counts[0] - places : 0);
  result.report.setCount("duplicates", counts_all ? counts[1] - (images - places) : 0);
}

} // namespace pcl_uvol
