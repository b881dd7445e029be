// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams: growth with cells and with sites (thesis Tables 2.5 and
// 2.6), by the exact transform and by cones on the GL depth test.
#include "common/random.h"
#include "gl/conic_sections.h"
#include "neighbors/site_distances.h"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace {

using pcl_uvol::FeatureTransform;
using pcl_uvol::GridCell;
using pcl_uvol::GridShape;
using pcl_uvol::Report;

GridShape
cube(std::int64_t side)
{
  GridShape shape;
  shape.cells.fill(static_cast<std::uint32_t>(side));
  return shape;
}

/** Cells of that many random points. */
std::vector<GridCell>
randomSites(const GridShape& shape, std::int64_t points)
{
  std::vector<std::uint64_t> cells;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(points); ++i) {
    GridCell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      cell[axis] = static_cast<std::uint16_t>(pcl_uvol::uniformAt(1, i, axis) *
                                              shape.cells[axis]);
    cells.push_back(shape.indexOf(cell));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<GridCell> sites;
  for (const std::uint64_t cell : cells)
    sites.push_back(shape.cellOf(cell));
  return sites;
}

/** Arguments: cells of a side, points. */
void
transform(benchmark::State& state)
{
  const GridShape shape = cube(state.range(0));
  const auto sites = randomSites(shape, state.range(1));
  for (auto _ : state) {
    Report report;
    benchmark::DoNotOptimize(FeatureTransform().find(shape, sites, 0, report));
  }
  state.counters["sites"] = static_cast<double>(sites.size());
}

/** The thesis's cones have 4 triangles in the first ring. */
void
cones(benchmark::State& state, const char* context, unsigned triangles)
{
  const GridShape shape = cube(state.range(0));
  const auto sites = randomSites(shape, state.range(1));
  pcl_uvol::ConicSections sections(
      pcl_uvol::createHeadlessContext(context), 2.0, triangles);
  std::vector<std::uint32_t> nearest;
  for (auto _ : state) {
    Report report;
    nearest = sections.find(shape, sites, 0, report);
  }
  Report report;
  const auto exact = pcl_uvol::computeSiteDistances(
      shape, sites, FeatureTransform().find(shape, sites, 0, report), 0);
  const auto found = pcl_uvol::computeSiteDistances(shape, sites, nearest, 0);
  double hits = 0.0, excess = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    hits += found[i] == exact[i] ? 1.0 : 0.0;
    excess = std::max(excess, double{found[i]} - exact[i]);
  }
  state.counters["sites"] = static_cast<double>(sites.size());
  state.counters["exact_%"] = 100.0 * hits / static_cast<double>(exact.size());
  state.counters["excess"] = excess;
}

void
grow(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({"side", "points"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(transform)->Apply(grow)->ArgsProduct({{32, 64, 128, 256, 512}, {10000}});
BENCHMARK(transform)->Apply(grow)->ArgsProduct({{256},
                                                {1250, 2500, 5000, 20000, 500000}});
BENCHMARK_CAPTURE(cones, osmesa 6, "osmesa", 6u)
    ->Apply(grow)
    ->ArgsProduct({{32, 64, 128}, {10000}})
    ->ArgsProduct({{64}, {1250, 2500, 5000, 20000}});
BENCHMARK_CAPTURE(cones, osmesa 4, "osmesa", 4u)
    ->Apply(grow)
    ->ArgsProduct({{32, 64, 128}, {10000}});

} // namespace

BENCHMARK_MAIN();
