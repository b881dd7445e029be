// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/guessed_isopoints.h"

#include "pipeline/known_isopoints.h"
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
    SurfaceGrounds& grounds)
{
  const auto support = static_cast<IsoSupport>(point.support);
  const bool is_bisector = orientation == IsoOrientation::Bisector;
  ++grounds.known;
  const bool has_good_fit = method == IsoMethod::Fit && !is_bisector && isKnown(point);
  if (support == IsoSupport::Rim)
    ++(has_good_fit ? grounds.at_border : grounds.beside_gaps);
  else if (support == IsoSupport::Bridged && has_good_fit)
    ++grounds.beside_gaps;
  else
    grounds.guessed += is_bisector || support == IsoSupport::Bridged;
}

Message
withPercent(Message message, std::size_t part, std::size_t all)
{
  message.values.emplace_back("percent", 100 * part / all);
  return message;
}

} // namespace

SurfaceGrounds
findGrounds(const pcl::PointCloud<PointIso>& isopoints,
            const IsoEdges& edges,
            const IsopointChoice& choice,
            const std::vector<std::uint8_t>& is_on_cap,
            const PeriodicBox& box)
{
  SurfaceGrounds grounds;
  const std::vector<std::uint8_t> is_thin = findThinParts(isopoints, edges);
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    const PointIso& point = isopoints[i];
    const bool is_cap = !is_on_cap.empty() && is_on_cap[i] != 0;
    if (!is_cap && point.support != static_cast<std::uint8_t>(IsoSupport::Unknown) &&
        (!isPeriodic(box.sides) || box.holds(point.data))) {
      add(point, choice.method[i], choice.orientation[i], grounds);
      grounds.thin += is_thin[i];
    }
  }
  return grounds;
}

SurfaceGrounds
findGrounds(const SurfaceTally& tally)
{
  SurfaceGrounds grounds;
  grounds.known = tally.examined;
  grounds.beside_gaps = tally.examined_rim;
  grounds.guessed = tally.examined_bridged;
  return grounds;
}

SurfaceGrounds
addTogether(const SurfaceGrounds& own, Communicator& communicator)
{
  std::vector<std::uint64_t> counts{
      own.known, own.at_border, own.beside_gaps, own.guessed, own.thin};
  communicator.allReduce(counts);
  return {counts[0], counts[1], counts[2], counts[3], counts[4]};
}

std::optional<Message>
tellGuesses(const SurfaceGrounds& grounds,
            const std::optional<SamplingSummary>& sampling,
            Message guess,
            bool have_border)
{
  const bool lie_all_around = sampling && sampling->most == LocalDimension::Volume;
  const std::size_t at_border =
                        grounds.at_border + (lie_all_around ? grounds.beside_gaps : 0),
                    all = grounds.at_border + grounds.beside_gaps + grounds.guessed;
  if (have_border && 2 * at_border > grounds.known)
    return withPercent({"isopoints_at_border", {}}, at_border, grounds.known);
  if (2 * all <= grounds.known)
    return std::nullopt;
  if (have_border && lie_all_around && at_border > grounds.guessed)
    guess = {"isopoints_beside_samples", {}};
  return withPercent(std::move(guess), all, grounds.known);
}

std::optional<Message>
tellGuessedBorder(const SurfaceGrounds& grounds)
{
  const std::size_t all = grounds.at_border + grounds.beside_gaps + grounds.guessed;
  if (2 * all <= grounds.known)
    return std::nullopt;
  return withPercent({"guessed_border", {}}, all, grounds.known);
}

std::vector<MessageValue>
listRemedies(const IsosurfacePipelineParameters& parameters)
{
  return {{"scale",
           !parameters.automatic_scale && (parameters.isosurface.scale == 1.0f).all()},
          {"gaps", !parameters.fill_gaps}};
}

} // namespace pcl_uvol
