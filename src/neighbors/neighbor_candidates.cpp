// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/neighbor_candidates.h"

#include "common/parallel.h"
#include "neighbors/exact_neighbors.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_sites = 1u << 10;

/** Samples per cell unless the user chooses: fewer cost the time of the grid, more that
 * of the angle criterion. */
constexpr double usual_samples = 4.0;

/** Candidates per sample, in the mean, that are looked at: a tenth of a millisecond, 30
 * times what the kd-tree takes; about 110 where samples are spread evenly. */
constexpr double most_candidates = 2000.0;

/** Where samples crowd in few cells, their number grows with the square. */
void
checkCandidates(const NeighborGraph& members, const NeighborGraph& adjacent)
{
  double candidates = 0.0;
  for (std::size_t site = 0; site < members.size(); ++site) {
    double around = static_cast<double>(members[site].size()) - 1.0;
    for (const std::uint32_t other : adjacent[site])
      around += static_cast<double>(members[other].size());
    candidates += around * static_cast<double>(members[site].size());
  }
  const double per_sample = candidates / static_cast<double>(members.indices.size());
  if (per_sample > most_candidates)
    throw InvalidArgument("too_many_candidates",
                          {{"candidates", candidates},
                           {"per_sample", per_sample},
                           {"most", most_candidates}});
}

GridShape
shapeFor(const SampleSet& samples, std::uint32_t cells)
{
  const auto& positions = samples.getPositions();
  std::array<double, 3> low{{positions[0][0], positions[0][1], positions[0][2]}};
  std::array<double, 3> high = low;
  for (const Position& position : positions)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = position[static_cast<int>(axis)];
      low[axis] = std::min(low[axis], place);
      high[axis] = std::max(high[axis], place);
    }
  if (cells > 0)
    return GridShape::cubes(low, high, cells);
  const double usual = std::cbrt(static_cast<double>(samples.size()) / usual_samples);
  return GridShape::cubes(
      low, high, static_cast<std::uint32_t>(std::max(1.0, std::round(usual))));
}

/** True if one of the planes around a cell is one of those around a cell in it. */
bool
isBounding(const KdCell& outer, const KdCell& inner)
{
  const auto same = [](const SplitPlane& a, const SplitPlane& b) {
    return std::isfinite(a.coordinate) && a.coordinate == b.coordinate &&
           a.below_sample == b.below_sample;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (same(outer.low[axis], inner.low[axis]) ||
        same(outer.high[axis], inner.high[axis]))
      return true;
  return false;
}

} // namespace

void
TouchingCells::find(std::uint32_t sample, std::vector<std::uint32_t>& candidates) const
{
  const KdTree& own = samples_.getTree();
  own.findTouching(samples_.getPositions(), sample, candidates);
  if (samples_.getTrees().size() == 1)
    return;
  const KdCell cell = own.findCell(sample);
  if (isBounding(own.getCell(), cell))
    for (const KdTree& tree : samples_.getTrees())
      if (&tree != &own)
        tree.findTouching(samples_.getPositions(), cell, candidates);
}

std::vector<std::uint32_t>
TouchingCells::findCrossing(const NodeRanges& ranges,
                            float isovalue,
                            unsigned threads) const
{
  const KdTree& own = samples_.getTree();
  const auto& positions = samples_.getPositions();
  auto crossing = own.findCrossing(positions, ranges, isovalue, threads);
  const auto& trees = samples_.getTrees();
  if (trees.size() == 1)
    return crossing;
  const auto beside = parallelGather<std::uint32_t>(
      trees.size(), 1, threads, [&](std::size_t i, std::size_t, auto& found) {
        if (&trees[i] != &own)
          own.findCrossing(positions, ranges, isovalue, trees[i], found);
      });
  crossing.insert(crossing.end(), beside.begin(), beside.end());
  parallelSort(crossing.begin(), crossing.end(), threads, std::less<std::uint32_t>());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  return crossing;
}

VoronoiCandidates::VoronoiCandidates(const SampleSet& samples,
                                     const VoronoiCandidateSettings& settings,
                                     unsigned threads,
                                     Report& report)
{
  std::vector<std::uint32_t> all(samples.size());
  std::iota(all.begin(), all.end(), 0u);
  FeatureTransform transform;
  const VoronoiGrid grid(shapeFor(samples, settings.cells),
                         samples.getPositions()[0].x,
                         sizeof(Position) / sizeof(float),
                         all,
                         settings.way ? *settings.way : transform,
                         threads,
                         report);
  members_ = grid.getMembers();
  site_of_.resize(samples.size());
  for (std::uint32_t site = 0; site < members_.size(); ++site)
    for (const std::uint32_t sample : members_[site])
      site_of_[sample] = site;
  const StepTimer timer(report, "adjacent_regions");
  adjacent_ = grid.findAdjacentRegions(threads);
  checkCandidates(members_, adjacent_);
}

void
VoronoiCandidates::find(std::uint32_t sample,
                        std::vector<std::uint32_t>& candidates) const
{
  candidates.clear();
  const std::uint32_t own = site_of_[sample];
  for (const std::uint32_t other : members_[own])
    if (other != sample)
      candidates.push_back(other);
  for (const std::uint32_t site : adjacent_[own])
    candidates.insert(candidates.end(), members_[site].begin(), members_[site].end());
}

std::vector<std::uint32_t>
VoronoiCandidates::findCrossing(const NodeRanges& ranges,
                                float isovalue,
                                unsigned threads) const
{
  // Whether samples of a site lie below and above.
  std::vector<std::uint8_t> sides(members_.size());
  constexpr std::uint8_t below = 1, above = 2;
  const auto sideOf = [&](std::uint32_t sample) {
    return ranges.values[sample] >= isovalue ? above : below;
  };
  parallelBlocks(sides.size(), block_sites, threads, [&](auto begin, auto end) {
    for (std::size_t site = begin; site < end; ++site)
      for (const std::uint32_t sample : members_[site])
        sides[site] |= sideOf(sample);
  });
  auto crossing = parallelGather<std::uint32_t>(
      sides.size(), block_sites, threads, [&](auto begin, auto end, auto& found) {
        for (std::size_t site = begin; site < end; ++site) {
          std::uint8_t around = sides[site];
          for (const std::uint32_t other : adjacent_[site])
            around |= sides[other];
          if (around != (below | above))
            continue;
          const auto members = members_[site];
          found.insert(found.end(), members.begin(), members.end());
        }
      });
  parallelSort(crossing.begin(), crossing.end(), threads, std::less<std::uint32_t>());
  return crossing;
}

NeighborCandidates::ConstPtr
makeCandidates(const SampleSet& samples,
               const std::optional<VoronoiCandidateSettings>& voronoi,
               unsigned threads,
               Report& report)
{
  if (voronoi)
    return std::make_shared<VoronoiCandidates>(samples, *voronoi, threads, report);
  return std::make_shared<TouchingCells>(samples);
}

NeighborCandidates::ConstPtr
makeCandidates(const SampleSet& samples,
               NeighborSource source,
               std::uint32_t voronoi_cells,
               unsigned threads,
               Report& report)
{
  if (source == NeighborSource::Exact)
    return std::make_shared<ExactNeighbors>(samples, threads, report);
  std::optional<VoronoiCandidateSettings> voronoi;
  if (source == NeighborSource::Voronoi)
    voronoi = VoronoiCandidateSettings{voronoi_cells, nullptr};
  return makeCandidates(samples, voronoi, threads, report);
}

} // namespace pcl_uvol
