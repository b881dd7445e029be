// SPDX-License-Identifier: BSD-3-Clause
// What a process does with its share of the samples, by itself: the levels of the
// decomposition, which every process works through for all of its samples. One thread.
#include "distributed/decomposition.h"
#include "radial_cloud.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

constexpr std::size_t samples = 10000000;

const std::vector<pcl_uvol::Position>&
positions()
{
  static const auto made = [] {
    std::vector<pcl_uvol::Position> all;
    const auto cloud = radialCloud(samples).cloud;
    for (const auto& point : *cloud)
      all.push_back({{point.x, point.y, point.z}});
    return all;
  }();
  return made;
}

/** The first levels of the tree. */
void
decompose(benchmark::State& state)
{
  const auto& all = positions();
  const int levels = static_cast<int>(state.range(0));
  pcl_uvol::SelfCommunicator alone;
  std::size_t passes = 0;
  for (auto _ : state) {
    passes = 0;
    const auto read = [&](std::uint64_t begin, std::size_t, pcl_uvol::Position*) {
      passes += static_cast<std::size_t>(begin == 0);
      return all.data() + begin;
    };
    const pcl_uvol::Decomposition decomposition({samples, read}, levels, alone, 1);
    benchmark::DoNotOptimize(decomposition.findPiece(all[0]));
  }
  const auto seconds_per = [](double count) {
    return benchmark::Counter(count,
                              benchmark::Counter::kIsIterationInvariantRate |
                                  benchmark::Counter::kInvert);
  };
  state.counters["passes"] = static_cast<double>(passes);
  state.counters["per_sample"] = seconds_per(samples);
  state.counters["per_sample_and_pass"] =
      seconds_per(static_cast<double>(samples * passes));
}

/** The piece of every sample, as when they are dealt out. */
void
findPieces(benchmark::State& state)
{
  const auto& all = positions();
  pcl_uvol::SelfCommunicator alone;
  const pcl_uvol::Decomposition decomposition(
      {samples,
       [&](std::uint64_t begin, std::size_t, pcl_uvol::Position*) {
         return all.data() + begin;
       }},
      static_cast<int>(state.range(0)),
      alone,
      1);
  for (auto _ : state)
    for (const pcl_uvol::Position& position : all)
      benchmark::DoNotOptimize(decomposition.findPiece(position));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

BENCHMARK(decompose)->DenseRange(2, 14, 3)->Arg(7)->Unit(benchmark::kMillisecond);
BENCHMARK(findPieces)->DenseRange(2, 14, 6)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
