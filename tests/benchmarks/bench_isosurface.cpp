// SPDX-License-Identifier: BSD-3-Clause
// The steps of an extraction one by one, beside a copy of the samples' memory in the
// same run: how far each is from the machine's limit. Radial test of thesis Table 2.9.
#include "common/parallel.h"
#include "radial_cloud.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace {

using pcl_uvol::Interpolation;
using uvol_test::RadialCloud;
using Extraction = pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI>;

/** x, y, z and the scalar. */
constexpr std::size_t sample_bytes = 16;

/** Rates by samples and by their bytes. */
void
setRates(benchmark::State& state, std::size_t samples)
{
  const auto processed = static_cast<std::int64_t>(samples) * state.iterations();
  state.SetItemsProcessed(processed);
  state.SetBytesProcessed(processed * static_cast<std::int64_t>(sample_bytes));
}

/** The limit: read once, written once, by all threads. */
void
copySamples(benchmark::State& state)
{
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<char> source(n * sample_bytes, 1);
  std::vector<char> target(n * sample_bytes);
  for (auto _ : state) {
    pcl_uvol::parallelBlocks(source.size(), 1 << 18, 0, [&](auto begin, auto end) {
      std::copy(source.begin() + static_cast<std::ptrdiff_t>(begin),
                source.begin() + static_cast<std::ptrdiff_t>(end),
                target.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    benchmark::DoNotOptimize(target.data());
  }
  setRates(state, n);
}

void
buildTree(benchmark::State& state)
{
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  std::vector<std::uint32_t> use(radial.cloud->size());
  std::iota(use.begin(), use.end(), 0u);
  for (auto _ : state) {
    pcl_uvol::Report report;
    benchmark::DoNotOptimize(
        pcl_uvol::SampleSet::build(&(*radial.cloud)[0].x,
                                   sizeof(pcl::PointXYZI) / sizeof(float),
                                   use,
                                   pcl_uvol::Position{{1.0f, 1.0f, 1.0f}},
                                   0,
                                   report));
  }
  setRates(state, use.size());
}

/** Another isovalue of the same field: values, tree and ranges are there. */
void
furtherIsovalue(benchmark::State& state, Interpolation interpolation)
{
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  Extraction extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValue(radial.radius);
  extraction.setInterpolation(interpolation);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  pcl_uvol::Report report;
  for (auto _ : state) {
    extraction.extract(surface);
    report = extraction.getReport();
  }
  for (const auto& [step, milliseconds] : report.milliseconds)
    state.counters[step + "_ms"] = milliseconds;
  state.counters["isopoints"] = static_cast<double>(surface.size());
  state.counters["per_isopoint"] = benchmark::Counter(
      static_cast<double>(surface.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/** Another field over the same positions: its values, their ranges, one surface. */
void
furtherField(benchmark::State& state)
{
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  Extraction extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValue(radial.radius);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  bool other = true;
  for (auto _ : state) {
    other = !other;
    extraction.setScalarField(other ? "intensity" : "x");
    extraction.setIsoValue(other ? radial.radius : radial.center);
    extraction.extract(surface);
  }
  setRates(state, radial.cloud->size());
}

/** A cloud that is new every time, as in a robot's loop. */
void
newCloud(benchmark::State& state)
{
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  Extraction extraction;
  extraction.setIsoValue(radial.radius);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  pcl_uvol::Report report;
  for (auto _ : state) {
    extraction.setInputCloud(radial.cloud);
    extraction.extract(surface);
    report = extraction.getReport();
  }
  for (const auto& [step, milliseconds] : report.milliseconds)
    state.counters[step + "_ms"] = milliseconds;
  setRates(state, radial.cloud->size());
}

} // namespace

int
main(int argc, char** argv)
{
  const auto linear = [](benchmark::State& state) {
    furtherIsovalue(state, Interpolation::Linear);
  };
  const auto smooth = [](benchmark::State& state) {
    furtherIsovalue(state, Interpolation::Fit);
  };
  for (const std::int64_t n : {100000, 1000000, 4000000}) {
    const auto add = [&](const char* name, auto function) {
      benchmark::RegisterBenchmark(name, function)
          ->Arg(n)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("copy_of_samples", copySamples);
    add("tree", buildTree);
    add("new_cloud", newCloud);
    add("further_field", furtherField);
    add("further_isovalue/linear", linear);
    add("further_isovalue/smooth", smooth);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
