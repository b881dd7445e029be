// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/weak_support.h"

#include "pipeline/supported_isopoints.h"
#include "pipeline/thin_parts.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

void
add(const PointIso& point,
    IsoMethod method,
    IsoOrientation orientation,
    SupportCounts& counts)
{
  const auto support = static_cast<IsoSupport>(point.support);
  const bool is_bisector = orientation == IsoOrientation::Bisector;
  ++counts.examined;
  const bool has_good_fit =
      method == IsoMethod::Fit && !is_bisector && isPrecise(point);
  if (support == IsoSupport::Rim)
    ++(has_good_fit ? counts.at_border : counts.beside_gaps);
  else if (support == IsoSupport::Bridged && has_good_fit)
    ++counts.beside_gaps;
  else
    counts.unconstrained += is_bisector || support == IsoSupport::Bridged;
}

Message
withPercent(Message message, std::size_t part, std::size_t all)
{
  message.values.emplace_back("percent", 100 * part / all);
  return message;
}

} // namespace

SupportCounts
findSupportCounts(const pcl::PointCloud<PointIso>& isopoints,
                  const IsoEdges& edges,
                  const IsopointChoice& choice,
                  const std::vector<std::uint8_t>& is_on_cap,
                  const PeriodicBox& box)
{
  SupportCounts counts;
  const std::vector<std::uint8_t> is_thin = findThinParts(isopoints, edges);
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    const PointIso& point = isopoints[i];
    const bool is_cap = !is_on_cap.empty() && is_on_cap[i] != 0;
    if (!is_cap && point.support != static_cast<std::uint8_t>(IsoSupport::Unknown) &&
        (!isPeriodic(box.sides) || box.holds(point.data))) {
      add(point, choice.method[i], choice.orientation[i], counts);
      counts.thin += is_thin[i];
    }
  }
  return counts;
}

SupportCounts
findSupportCounts(const SurfaceTally& tally)
{
  SupportCounts counts;
  counts.examined = tally.examined;
  counts.beside_gaps = tally.examined_rim;
  counts.unconstrained = tally.examined_bridged;
  return counts;
}

SupportCounts
addTogether(const SupportCounts& own, Communicator& communicator)
{
  std::vector<std::uint64_t> counts{
      own.examined, own.at_border, own.beside_gaps, own.unconstrained, own.thin};
  communicator.allReduce(counts);
  return {counts[0], counts[1], counts[2], counts[3], counts[4]};
}

std::optional<Message>
describeWeakSupport(const SupportCounts& counts,
                    const std::optional<SamplingSummary>& sampling,
                    Message message,
                    bool have_border)
{
  const bool lie_all_around = sampling && sampling->most == LocalDimension::Volume;
  const std::size_t at_border =
                        counts.at_border + (lie_all_around ? counts.beside_gaps : 0),
                    all = counts.at_border + counts.beside_gaps + counts.unconstrained;
  if (have_border && 2 * at_border > counts.examined)
    return withPercent({"isopoints_at_border", {}}, at_border, counts.examined);
  if (2 * all <= counts.examined)
    return std::nullopt;
  if (have_border && lie_all_around && at_border > counts.unconstrained)
    message = {"isopoints_beside_samples", {}};
  return withPercent(std::move(message), all, counts.examined);
}

std::optional<Message>
describeWeakBorder(const SupportCounts& counts)
{
  const std::size_t all = counts.at_border + counts.beside_gaps + counts.unconstrained;
  if (2 * all <= counts.examined)
    return std::nullopt;
  return withPercent({"unconstrained_border", {}}, all, counts.examined);
}

std::vector<MessageValue>
listRemedies(const IsosurfacePipelineParameters& parameters)
{
  return {{"scale",
           !parameters.takesAutomaticScale() &&
               (parameters.isosurface.scale == 1.0f).all()},
          {"gaps", !parameters.fill_gaps}};
}

} // namespace pcl_uvol
