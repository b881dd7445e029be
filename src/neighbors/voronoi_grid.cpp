// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/parallel.h"
#include "neighbors/site_distances.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace pcl_uvol {

namespace {

constexpr std::size_t node_block = 1u << 14;

/** A point in its cell: sorts by both. */
struct Placed {
  std::uint32_t cell, point;

  bool
  operator<(const Placed& other) const
  {
    return cell != other.cell ? cell < other.cell : point < other.point;
  }
};

void
checkShape(const GridShape& shape)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (shape.cells[axis] < 1 || shape.cells[axis] > GridShape::largest_side ||
        !(shape.spacing[axis] > 0.0) || !std::isfinite(shape.spacing[axis]) ||
        !std::isfinite(shape.origin[axis]))
      throw InvalidArgument("voronoi_grid_not_allowed",
                            {{"most", GridShape::largest_side}});
  const std::string grid = "A grid of " + std::to_string(shape.cells[0]) + " x " +
                           std::to_string(shape.cells[1]) + " x " +
                           std::to_string(shape.cells[2]) + " cells";
  // Nearest sites, and what is made of them: distances, arrays of a file.
  constexpr double bytes_per_cell = 12.0;
  checkMemory(grid, bytes_per_cell * static_cast<double>(shape.size()));
  if (shape.size() >= no_site)
    throw InvalidArgument("grid_beyond_numbers", {{"grid", grid}});
}

bool
isFinite(const float* xyz)
{
  return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
}

/** A pair of regions, the lower site in the upper half. */
using RegionPair = std::uint64_t;

void
sortUnique(std::vector<RegionPair>& pairs)
{
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/** Half of the cells that share a point with one: those with a higher number. */
constexpr std::array<std::array<int, 3>, 13> later_cells = {{{{1, 0, 0}},
                                                             {{-1, 1, 0}},
                                                             {{0, 1, 0}},
                                                             {{1, 1, 0}},
                                                             {{-1, -1, 1}},
                                                             {{0, -1, 1}},
                                                             {{1, -1, 1}},
                                                             {{-1, 0, 1}},
                                                             {{0, 0, 1}},
                                                             {{1, 0, 1}},
                                                             {{-1, 1, 1}},
                                                             {{0, 1, 1}},
                                                             {{1, 1, 1}}}};

/** Pairs of regions that meet at the cells of a plane, or behind it. */
std::vector<RegionPair>
findRegionPairs(const GridShape& shape,
                const std::vector<std::uint32_t>& nearest,
                int z)
{
  const std::array<int, 3> cells{{static_cast<int>(shape.cells[0]),
                                  static_cast<int>(shape.cells[1]),
                                  static_cast<int>(shape.cells[2])}};
  const auto rowAt = [&](int y, int at_z) {
    return &nearest[(static_cast<std::size_t>(at_z) * shape.cells[1] +
                     static_cast<std::size_t>(y)) *
                    shape.cells[0]];
  };
  std::vector<RegionPair> pairs, row;
  for (int y = 0; y < cells[1]; ++y) {
    row.clear();
    for (const auto& offset : later_cells) {
      const int other_y = y + offset[1], other_z = z + offset[2];
      if (other_y < 0 || other_y >= cells[1] || other_z >= cells[2])
        continue;
      const std::uint32_t* const here = rowAt(y, z);
      const std::uint32_t* const there = rowAt(other_y, other_z) + offset[0];
      const int end = std::min(cells[0], cells[0] - offset[0]);
      RegionPair last = 0; // found again and again along a border
      for (int x = std::max(0, -offset[0]); x < end; ++x) {
        const RegionPair a = here[x], b = there[x];
        const RegionPair pair = std::min(a, b) << 32 | std::max(a, b);
        if (a != b && pair != last)
          row.push_back(last = pair);
      }
    }
    sortUnique(row);
    pairs.insert(pairs.end(), row.begin(), row.end());
  }
  sortUnique(pairs);
  return pairs;
}

/** Each pair in the rows of both sites. */
NeighborGraph
toGraph(const std::vector<RegionPair>& pairs, std::size_t sites)
{
  NeighborGraph graph;
  graph.offsets.assign(sites + 1, 0);
  for (const RegionPair pair : pairs) {
    ++graph.offsets[(pair >> 32) + 1];
    ++graph.offsets[static_cast<std::uint32_t>(pair) + std::size_t{1}];
  }
  for (std::size_t i = 0; i < sites; ++i)
    graph.offsets[i + 1] += graph.offsets[i];
  graph.indices.resize(graph.offsets.back());
  std::vector<std::uint64_t> next(graph.offsets.begin(), graph.offsets.end() - 1);
  // Sorted by the lower site: the lower neighbours of a row come first, in order.
  for (const RegionPair pair : pairs)
    graph.indices[next[static_cast<std::uint32_t>(pair)]++] =
        static_cast<std::uint32_t>(pair >> 32);
  for (const RegionPair pair : pairs)
    graph.indices[next[pair >> 32]++] = static_cast<std::uint32_t>(pair);
  return graph;
}

} // namespace

VoronoiGrid::VoronoiGrid(const GridShape& shape,
                         const float* xyz,
                         std::size_t stride,
                         const std::vector<std::uint32_t>& use,
                         NearestSites& way,
                         unsigned threads,
                         Report& report)
    : shape_(shape)
{
  checkShape(shape);
  std::vector<Placed> placed;
  {
    const StepTimer timer(report, "sites");
    placed = parallelGather<Placed>(
        use.size(), node_block, threads, [&](auto begin, auto end, auto& found) {
          for (std::size_t i = begin; i < end; ++i) {
            const float* const p = xyz + use[i] * stride;
            if (isFinite(p))
              found.push_back({static_cast<std::uint32_t>(
                                   shape_.indexOf(shape_.cellAt({{p[0], p[1], p[2]}}))),
                               use[i]});
          }
        });
    report.count("non_finite", use.size() - placed.size());
    if (placed.empty())
      throw InvalidArgument("voronoi_grid_without_point", {});
    parallelSort(placed.begin(), placed.end(), threads, std::less<Placed>());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const std::uint32_t cell = placed[i].cell;
      if (i == 0 || cell != placed[i - 1].cell) {
        members_.offsets.push_back(i);
        sites_.push_back(shape_.cellOf(cell));
      }
      members_.indices.push_back(placed[i].point);
    }
    members_.offsets.push_back(placed.size());
  }
  report.count("cells", shape_.size());
  report.count("sites", sites_.size());
  nearest_ = way.find(shape_, sites_, threads, report);
}

std::vector<float>
VoronoiGrid::computeDistances(unsigned threads) const
{
  return computeSiteDistances(shape_, sites_, nearest_, threads);
}

NeighborGraph
VoronoiGrid::findAdjacentRegions(unsigned threads) const
{
  auto pairs = parallelGather<RegionPair>(
      shape_.cells[2], 1, threads, [&](auto z, auto, auto& found) {
        found = findRegionPairs(shape_, nearest_, static_cast<int>(z));
      });
  parallelSort(pairs.begin(), pairs.end(), threads, std::less<RegionPair>());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return toGraph(pairs, sites_.size());
}

} // namespace pcl_uvol
