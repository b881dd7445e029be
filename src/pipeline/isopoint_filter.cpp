// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/isopoint_filter.h"

#include "isosurface/iso_edges.h"
#include "neighbors/periodic_box.h"
#include "pipeline/periodic_surface.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

/** Share of the samples next to the surface that are spikes: of 1 % of all samples it
 * is 3 %. */
constexpr double told_spikes = 0.001;

/** What a surface has lost, on all processes together. */
struct SurfaceLosses {
  SurfaceTally tally;
  DroppedIsopoints dropped;
  std::uint64_t isopoints; ///< that are left
};

SurfaceLosses
addTogether(const SurfaceLosses& own, Communicator& communicator)
{
  std::vector<std::uint64_t> counts{own.tally.crossing,
                                    own.tally.spikes,
                                    own.tally.contradicted,
                                    own.dropped.by_error,
                                    own.dropped.by_support,
                                    own.isopoints};
  communicator.allReduce(counts);
  SurfaceLosses all{};
  all.tally.crossing = counts[0];
  all.tally.spikes = counts[1];
  all.tally.contradicted = counts[2];
  all.dropped = {counts[3], counts[4]};
  all.isopoints = counts[5];
  return all;
}

/** Samples next to the surface whose values stand alone. */
void
warnOfSpikes(const SurfaceTally& tally, Report& report)
{
  const auto spikes = static_cast<double>(tally.spikes),
             crossing = static_cast<double>(tally.crossing);
  if (spikes > told_spikes * crossing)
    report.warn("spikes", {{"percent", 100.0 * spikes / crossing}});
}

/** Part of the isopoints: by chance 8 samples are on one side at 2 * 0.5^8 of all
 * places on a surface, so that no more than these need no warning. */
constexpr double by_chance = 2.0 / 256.0;

/** Isopoints that the extraction removed, see OneSidedTest. */
void
warnOfContradicted(const SurfaceLosses& losses, Report& report)
{
  const std::uint64_t removed = losses.tally.contradicted;
  const std::uint64_t all =
      losses.isopoints + removed + losses.dropped.by_error + losses.dropped.by_support;
  if (static_cast<double>(removed) > by_chance * static_cast<double>(all))
    report.warn("contradicted_isopoints", {{"removed", removed}, {"isopoints", all}});
}

/** Part of the isopoints: where fewer are left, a surface has become a few specks. */
constexpr double little = 0.1;

/** All isopoints that there were, or nearly all. */
void
warnOfLittleLeft(const SurfaceLosses& losses, Report& report)
{
  const auto [by_error, by_support] = losses.dropped;
  const std::uint64_t left = losses.isopoints, removed = by_error + by_support;
  if (removed > 0 &&
      static_cast<double>(left) < little * static_cast<double>(left + removed))
    report.warn(left > 0 ? "few_isopoints_left" : "no_isopoints_left",
                {{"isopoints", left + removed},
                 {"left", left},
                 {"by_error", by_error > 0},
                 {"by_support", by_support > 0}});
}

} // namespace

DroppedIsopoints
dropIsopoints(pcl::PointCloud<PointIso>& isopoints,
              IsoEdges& edges,
              IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              const SupportedIsopoints& known,
              Report& report)
{
  const auto filter = [&](const auto& keep) {
    choice.filter(isopoints, keep);
    return filterIsopoints(isopoints, edges, keep);
  };
  DroppedIsopoints dropped;
  const auto drop = [&](const auto& keep, std::uint64_t& count, const char* name) {
    const std::uint64_t some = filter(keep);
    count += some;
    report.count(name, some);
  };
  const PeriodicBox box{{}, sidesOf(parameters)};
  if (isPeriodic(box.sides) && !parameters.mesh)
    filter([&](const PointIso& point) { return box.holds(point.data); });
  if (parameters.max_error)
    drop([&](const PointIso& point) { return point.error <= *parameters.max_error; },
         dropped.by_error,
         "removed_by_error");
  if (parameters.automatic_max_error) {
    const PointIso* const first = isopoints.data();
    const std::vector<std::uint8_t> is_known = known.find(isopoints, edges);
    drop(
        [&](const PointIso& point) {
          return is_known[static_cast<std::size_t>(&point - first)] != 0;
        },
        dropped.by_error,
        "removed_by_error");
  }
  if (parameters.drop_bridged)
    drop(
        [](const PointIso& point) {
          return point.support != static_cast<std::uint8_t>(IsoSupport::Bridged);
        },
        dropped.by_support,
        "removed_bridged");
  return dropped;
}

void
warnOfWeakSupport(const SupportCounts& counts,
                  SurfaceRole role,
                  const IsosurfacePipelineParameters& parameters,
                  const std::optional<SamplingSummary>& sampling,
                  Report& report)
{
  Message guess("unconstrained_isopoints", listRemedies(parameters));
  guess.values.emplace_back("validate", parameters.validation.folds == 0);
  guess.values.emplace_back("bridged", !parameters.drop_bridged && !parameters.mesh);
  if (const auto told = role == SurfaceRole::ClusterBorder
                            ? describeWeakBorder(counts)
                            : describeWeakSupport(counts,
                                                  sampling,
                                                  std::move(guess),
                                                  !(parameters.periodic > 0.0).all()))
    report.warn({*told});
  if (4 * counts.thin > counts.known)
    report.warn("thin_parts", {{"percent", 100 * counts.thin / counts.known}});
}

void
warnOfLosses(const IsosurfacePipelineParameters& parameters,
             const SurfaceTally& tally,
             const DroppedIsopoints& dropped,
             std::uint64_t isopoints,
             Communicator& communicator,
             Report& report)
{
  const SurfaceLosses all = addTogether({tally, dropped, isopoints}, communicator);
  if (!parameters.smooth)
    warnOfSpikes(all.tally, report);
  warnOfContradicted(all, report);
  warnOfLittleLeft(all, report);
}

} // namespace pcl_uvol
