// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/isopoint_filter.h"

#include "common/parallel.h"
#include "distributed/byte_stream.h"
#include "isosurface/iso_edges.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/periodic_box.h"
#include "pipeline/periodic_surface.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr std::size_t filter_block = 256;

bool
isBridged(const PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(IsoSupport::Bridged);
}

/** An isopoint in a gap, and the nearest one of its isovalue that is in none. */
struct InGap {
  float place[3], isovalue, error;
};
struct Better {
  double distance, error;
};

/** The nearest isopoint in no gap, of those of one process.
 * \param others isopoints of one isovalue
 * \param asked,found those of that isovalue get what is found */
void
findBetter(const pcl::PointCloud<PointIso>& isopoints,
           const std::vector<std::uint32_t>& others,
           unsigned threads,
           const std::vector<InGap>& asked,
           std::vector<Better>& found)
{
  Report own;
  const CloudView view = viewOf(isopoints);
  const auto places = SampleSet::build(
      view.xyz(0), view.stride(), others, {{1.0f, 1.0f, 1.0f}}, threads, own);
  const LengthUnit& unit = places->getUnit();
  parallelBlocks(asked.size(), filter_block, threads, [&](auto begin, auto end) {
    NearestFinder nearest(*places, 1);
    for (std::size_t i = begin; i < end; ++i) {
      if (asked[i].isovalue != isopoints[others.front()].isovalue)
        continue;
      const auto& [x, y, z] = asked[i].place;
      const auto row = nearest.find(unit.apply({{x, y, z}}), 1.0f);
      const PointIso& other = isopoints[places->getInputIndex(row.samples[0])];
      const Eigen::Vector3d offset =
          (other.getVector3fMap() - Eigen::Vector3f(x, y, z)).cast<double>();
      found[i] = {offset.norm(), static_cast<double>(other.error)};
    }
  });
}

/** Find isopoints in gaps that nothing locates: their error reaches beyond the nearest
 * isopoint that is in no gap, and beyond its error. That one says more of the surface
 * there. In a hold-out test of thirteen surfaces the share of samples on the right side
 * changes by -0.4 to +1.7 %; without the other one's error by -1.7 to +1.6 %, as if all
 * isopoints in gaps were removed. Of dense samples it removes 0 to 2.4 % (free
 * surfaces of particles).
 * \param total gets their number on all processes
 * \return 1 per isopoint of this process that is one of them */
std::vector<std::uint8_t>
findUnlocated(const pcl::PointCloud<PointIso>& isopoints,
              Communicator& communicator,
              unsigned threads,
              std::uint64_t& total)
{
  std::vector<std::uint32_t> bridged;
  std::vector<InGap> own;
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    if (const PointIso& point = isopoints[i]; isBridged(point)) {
      bridged.push_back(static_cast<std::uint32_t>(i));
      own.push_back({{point.x, point.y, point.z}, point.isovalue, point.error});
    }
  const auto counts =
      allGatherItems(communicator, std::vector<std::size_t>{own.size()});
  const std::vector<InGap> all = allGatherItems(communicator, own);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<Better> found(all.size(), {infinite, infinite});
  for (std::size_t first = 0, last = 0; first < isopoints.size() && !all.empty();
       first = last) {
    std::vector<std::uint32_t> others;
    for (; last < isopoints.size() &&
           isopoints[last].isovalue == isopoints[first].isovalue;
         ++last)
      if (!isBridged(isopoints[last]))
        others.push_back(static_cast<std::uint32_t>(last));
    if (!others.empty())
      findBetter(isopoints, others, threads, all, found);
  }
  std::vector<Bytes> answers(counts.size()); // for those who asked
  const Better* next = found.data();
  for (std::size_t process = 0; process < counts.size(); next += counts[process++])
    ByteWriter(answers[process]).put(next, counts[process]);
  std::vector<Better> best(own.size(), {infinite, infinite});
  for (const Bytes& answer : communicator.allToAll(std::move(answers))) {
    std::vector<Better> of_one;
    ByteReader(answer).get(of_one);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (of_one[i].distance < best[i].distance)
        best[i] = of_one[i];
  }
  std::vector<std::uint8_t> is_unlocated(isopoints.size());
  std::vector<std::uint64_t> count{0};
  for (std::size_t i = 0; i < own.size(); ++i)
    if (best[i].distance + best[i].error < static_cast<double>(own[i].error)) {
      is_unlocated[bridged[i]] = 1;
      ++count[0];
    }
  communicator.allReduce(count);
  total = count[0];
  return is_unlocated;
}

/** Share of the samples next to the surface that are spikes: of 1 % of all samples it
 * is 3 %. */
constexpr double warned_spikes = 0.001;

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
                                    own.dropped.unlocated,
                                    own.dropped.by_error,
                                    own.dropped.by_support,
                                    own.isopoints};
  communicator.allReduce(counts);
  SurfaceLosses all{};
  all.tally.crossing = counts[0];
  all.tally.spikes = counts[1];
  all.tally.contradicted = counts[2];
  all.dropped = {counts[3], counts[4], counts[5]};
  all.isopoints = counts[6];
  return all;
}

/** Samples next to the surface whose values stand alone. */
void
warnOfSpikes(const SurfaceTally& tally, Report& report)
{
  const auto spikes = static_cast<double>(tally.spikes),
             crossing = static_cast<double>(tally.crossing);
  if (spikes > warned_spikes * crossing)
    report.warn("spikes", {{"percent", 100.0 * spikes / crossing}});
}

/** Part of the isopoints: by chance 8 samples are on one side at 2 * 0.5^8 of all
 * places on a surface, so that no more than these need no warning. */
constexpr double by_chance = 2.0 / 256.0;

/** Isopoints that were removed without being asked for: those that the extraction
 * removed, see OneSidedTest, and those that nothing locates. */
void
warnOfRemoved(const SurfaceLosses& losses, bool fills_gaps, Report& report)
{
  const std::uint64_t contradicted = losses.tally.contradicted,
                      unlocated = losses.dropped.unlocated,
                      all = losses.isopoints + contradicted + unlocated +
                            losses.dropped.by_error + losses.dropped.by_support;
  const double least = by_chance * static_cast<double>(all);
  if (static_cast<double>(contradicted) > least)
    report.warn("contradicted_isopoints",
                {{"removed", contradicted}, {"isopoints", all}});
  if (static_cast<double>(unlocated) > least)
    report.warn("unlocated_isopoints",
                {{"removed", unlocated}, {"isopoints", all}, {"gaps", !fills_gaps}});
}

/** Part of the isopoints: where fewer are left, a surface has become a few specks. */
constexpr double little = 0.1;

/** All isopoints that there were, or nearly all. */
void
warnOfLittleLeft(const SurfaceLosses& losses, Report& report)
{
  const std::uint64_t by_error = losses.dropped.by_error,
                      by_support = losses.dropped.by_support;
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
              const SupportedIsopoints& supported,
              bool removes_unlocated,
              Communicator& communicator,
              unsigned threads,
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
  if (removes_unlocated) {
    const PointIso* const first = isopoints.data();
    std::uint64_t total = 0;
    const auto is_unlocated = findUnlocated(isopoints, communicator, threads, total);
    if (total > 0)
      drop(
          [&](const PointIso& point) {
            return is_unlocated[static_cast<std::size_t>(&point - first)] == 0;
          },
          dropped.unlocated,
          "unlocated");
  }
  if (parameters.max_error)
    drop([&](const PointIso& point) { return point.error <= *parameters.max_error; },
         dropped.by_error,
         "removed_by_error");
  if (parameters.automatic_max_error) {
    const PointIso* const first = isopoints.data();
    const std::vector<std::uint8_t> is_supported =
        supported.find(isopoints, edges, threads);
    drop(
        [&](const PointIso& point) {
          return is_supported[static_cast<std::size_t>(&point - first)] != 0;
        },
        dropped.by_error,
        "removed_by_error");
  }
  if (parameters.drop_bridged)
    drop([](const PointIso& point) { return !isBridged(point); },
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
  Message message("unconstrained_isopoints", listRemedies(parameters));
  message.values.emplace_back("validate", parameters.validation.folds == 0);
  message.values.emplace_back("bridged", !parameters.drop_bridged && !parameters.mesh);
  if (const auto warning =
          role == SurfaceRole::ClusterBorder
              ? describeWeakBorder(counts)
              : describeWeakSupport(counts,
                                    sampling,
                                    std::move(message),
                                    !(parameters.periodic > 0.0).all()))
    report.warn({*warning});
  if (4 * counts.thin > counts.examined)
    report.warn("thin_parts", {{"percent", 100 * counts.thin / counts.examined}});
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
  warnOfRemoved(all, parameters.fill_gaps, report);
  warnOfLittleLeft(all, report);
}

} // namespace pcl_uvol
