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

/** Samples next to the surface whose values stand alone, as IsosurfaceExtraction and
 * SurfaceMesh count them. */
void
warnOfSpikes(const IsosurfacePipelineParameters& parameters, Report& report)
{
  const auto spikes = static_cast<double>(report.getCount("spikes")),
             crossing = static_cast<double>(report.getCount("crossing_samples"));
  if (!parameters.smooth && spikes > told_spikes * crossing)
    report.warn("spikes", {{"percent", 100.0 * spikes / crossing}});
}

/** Part of the isopoints: by chance 8 samples are on one side at 2 * 0.5^8 of all
 * places on a surface, so that no more than these need no warning. */
constexpr double by_chance = 2.0 / 256.0;

/** Isopoints that the extraction removed, see OneSidedTest.
 * \param isopoints that are left */
void
warnOfContradicted(std::uint64_t isopoints, Report& report)
{
  const std::uint64_t removed = report.getCount("contradicted");
  const std::uint64_t all = isopoints + removed + report.getCount("removed_by_error") +
                            report.getCount("removed_bridged");
  if (static_cast<double>(removed) > by_chance * static_cast<double>(all))
    report.warn("contradicted_isopoints", {{"removed", removed}, {"isopoints", all}});
}

/** Part of the isopoints: where fewer are left, a surface has become a few specks. */
constexpr double little = 0.1;

/** All isopoints that there were, or nearly all. */
void
warnOfLittleLeft(std::uint64_t isopoints, Report& report)
{
  const std::uint64_t by_error = report.getCount("removed_by_error"),
                      bridged = report.getCount("removed_bridged");
  const std::uint64_t removed = by_error + bridged;
  if (removed > 0 && static_cast<double>(isopoints) <
                         little * static_cast<double>(isopoints + removed))
    report.warn(isopoints > 0 ? "few_isopoints_left" : "no_isopoints_left",
                {{"isopoints", isopoints + removed},
                 {"left", isopoints},
                 {"by_error", by_error > 0},
                 {"by_support", bridged > 0}});
}

} // namespace

void
dropIsopoints(pcl::PointCloud<PointIso>& isopoints,
              IsoEdges& edges,
              IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              const KnownIsopoints& known,
              Report& report)
{
  const auto filter = [&](const auto& keep) {
    choice.filter(isopoints, keep);
    return filterIsopoints(isopoints, edges, keep);
  };
  const auto drop = [&](const char* name, const auto& keep) {
    report.count(name, filter(keep));
  };
  const PeriodicBox box{{}, sidesOf(parameters)};
  if (isPeriodic(box.sides) && !parameters.mesh)
    filter([&](const PointIso& point) { return box.holds(point.data); });
  if (parameters.max_error)
    drop("removed_by_error",
         [&](const PointIso& point) { return point.error <= *parameters.max_error; });
  if (parameters.automatic_max_error) {
    const PointIso* const first = isopoints.data();
    const std::vector<std::uint8_t> is_known = known.find(isopoints, edges);
    drop("removed_by_error", [&](const PointIso& point) {
      return is_known[static_cast<std::size_t>(&point - first)] != 0;
    });
  }
  if (parameters.drop_bridged)
    drop("removed_bridged", [](const PointIso& point) {
      return point.support != static_cast<std::uint8_t>(IsoSupport::Bridged);
    });
}

void
warnOfGuesses(const SurfaceGrounds& grounds,
              SurfaceRole role,
              const IsosurfacePipelineParameters& parameters,
              const std::optional<SamplingSummary>& sampling,
              Report& report)
{
  Message guess("guessed_isopoints", listRemedies(parameters));
  guess.values.emplace_back("validate", parameters.validation.folds == 0);
  if (const auto told = role == SurfaceRole::ClusterBorder
                            ? tellGuessedBorder(grounds)
                            : tellGuesses(grounds, sampling, std::move(guess)))
    report.warnings.push_back(*told);
  if (4 * grounds.thin > grounds.known)
    report.warn("thin_parts", {{"percent", 100 * grounds.thin / grounds.known}});
}

void
warnOfLosses(const IsosurfacePipelineParameters& parameters,
             std::uint64_t isopoints,
             Report& report)
{
  warnOfSpikes(parameters, report);
  warnOfContradicted(isopoints, report);
  warnOfLittleLeft(isopoints, report);
}

} // namespace pcl_uvol
