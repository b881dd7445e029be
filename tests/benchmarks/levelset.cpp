// SPDX-License-Identifier: BSD-3-Clause
// Thesis Tables 3.1 to 3.3: level sets of a volume resampled at random positions, step
// by step, beside the memory bandwidth of the same run.
#include "common/parallel.h"
#include "neighbors/nearest_neighbors.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/noisy_shapes.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace {

using pcl_uvol::CurvatureFlow;
using pcl_uvol::Integration;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Evolution = pcl_uvol::LevelSetEvolution<pcl::PointXYZI>;

/** The bytes of a sample that carries a stencil, in a step: the stencil of 26
 * neighbours, and what is read and written by sample. */
constexpr double step_bytes = 616.0 + 12.0 * sizeof(float);

double
secondsOf(const std::function<void()>& task)
{
  const auto start = std::chrono::steady_clock::now();
  task();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

/** Reading, in GB/s, by all threads: the best of five. */
double
bandwidth()
{
  const std::vector<std::uint64_t> words(std::size_t{1} << 27, 1);
  std::vector<std::uint64_t> sums(words.size() >> 16);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i)
    best = std::min(
        best, secondsOf([&] {
          pcl_uvol::parallelBlocks(words.size(), 1 << 16, 0, [&](auto begin, auto end) {
            sums[begin >> 16] =
                std::accumulate(words.begin() + static_cast<std::ptrdiff_t>(begin),
                                words.begin() + static_cast<std::ptrdiff_t>(end),
                                std::uint64_t{0});
          });
        }));
  return static_cast<double>(words.size() * sizeof(std::uint64_t)) / best * 1e-9;
}

Cloud::Ptr
resample(const pcl_uvol::Volume& volume, std::size_t n)
{
  uvol_test::Random random(1);
  const auto upper = volume.upper();
  const Cloud::Ptr cloud(new Cloud);
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, 3> x{};
    pcl::PointXYZI point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x[axis] =
          volume.origin[axis] + random.uniform() * (upper[axis] - volume.origin[axis]);
      point.data[axis] = static_cast<float>(x[axis]);
    }
    point.intensity = static_cast<float>(volume.sample(x));
    cloud->push_back(point);
  }
  return cloud;
}

double
millisecondsOf(const pcl_uvol::Report& report, const std::string& step)
{
  for (const auto& [name, spent] : report.milliseconds)
    if (name == step)
      return spent;
  return 0.0;
}

struct Outcome {
  std::vector<float> phi;
  double seconds;
};

Outcome
evolve(Evolution& evolution, const Cloud::Ptr& cloud, double isovalue)
{
  evolution.setInputCloud(cloud);
  evolution.setIsoValue(isovalue);
  Outcome outcome;
  outcome.seconds = secondsOf([&] { evolution.evolve(outcome.phi); });
  return outcome;
}

/** Million samples advanced per second. */
double
rateOf(const pcl_uvol::Report& report)
{
  return static_cast<double>(report.getCount("updates")) /
         millisecondsOf(report, "evolution") * 1e-3;
}

void
printSize(const pcl_uvol::Volume& volume, double isovalue, std::size_t n)
{
  const auto cloud = resample(volume, n);
  std::printf("%zu samples\n", n);
  pcl_uvol::SampleSet::ConstPtr samples;
  const double tree = secondsOf([&] { samples = uvol_test::buildSamples(*cloud); });
  pcl_uvol::Report report;
  const double nearest =
      secondsOf([&] { pcl_uvol::computeNearestNeighbors(*samples, 26, 0, report); });
  samples.reset();
  std::printf("  kd-tree %.2f s, 26 nearest neighbours %.2f s\n", tree, nearest);

  double with_band = 0.0;
  for (const double band : {5.0, 0.0}) {
    Evolution evolution;
    evolution.setBandWidth(band);
    const Outcome outcome = evolve(evolution, cloud, isovalue);
    if (band > 0.0)
      with_band = outcome.seconds;
    std::printf(
        "  %s: %.2f s, %zu steps of %zu samples, noise %.3f, mu %.2f; ",
        band > 0.0 ? "band" : "all samples",
        outcome.seconds,
        evolution.getSummary().steps.size(),
        static_cast<std::size_t>(evolution.getReport().getCount("band_samples")),
        evolution.getSummary().noise,
        evolution.getSummary().mu);
    for (const auto& [name, spent] : evolution.getReport().milliseconds)
      std::printf("%s %.0f ms ", name.c_str(), spent);
    if (band == 0.0)
      std::printf("; all / band %.1f", outcome.seconds / with_band);
    const Cloud::Ptr level(new Cloud(*cloud));
    for (std::size_t i = 0; i < n; ++i)
      (*level)[i].intensity = outcome.phi[i];
    std::size_t points = 0;
    const double extraction = secondsOf([&] {
      points = uvol_test::isopoints(level, pcl_uvol::Interpolation::Fit).size();
    });
    std::printf("\n    zero level: %zu isopoints in %.2f s, tree included\n",
                points,
                extraction);
  }
  for (const Integration integration :
       {Integration::Synchronous, Integration::Asynchronous}) {
    Evolution evolution;
    evolution.setBandWidth(0.0);
    evolution.setIntegration(integration);
    evolution.setMaximumSteps(60);
    evolution.setTolerance(1e-9);
    evolve(evolution, cloud, isovalue);
    const double rate = rateOf(evolution.getReport());
    std::printf("  %s, all samples: %.1f million samples/s, %.1f GB/s\n",
                integration == Integration::Synchronous ? "synchronous"
                                                        : "asynchronous",
                rate,
                rate * step_bytes * 1e-3);
  }
  std::fflush(stdout);
}

/** A ball whose surface is sampled ever more densely about one of its points: few
 * samples bound the steps of all. */
Cloud::Ptr
clusteredBall()
{
  constexpr double radius = 14.0, extent = 20.0, innermost = 0.2;
  uvol_test::Random random(1);
  const Cloud::Ptr cloud(new Cloud);
  const auto add = [&](const Eigen::Vector3d& x) {
    pcl::PointXYZI point;
    point.getVector3fMap() = x.cast<float>();
    point.intensity =
        static_cast<float>(radius - x.norm() + 0.5 * (random.uniform() - 0.5));
    cloud->push_back(point);
  };
  const auto inCube = [&] {
    return Eigen::Vector3d(2.0 * random.uniform() - 1.0,
                           2.0 * random.uniform() - 1.0,
                           2.0 * random.uniform() - 1.0);
  };
  for (int i = 0; i < 64000; ++i)
    add(extent * inCube());
  for (int i = 0; i < 3200;) {
    const Eigen::Vector3d direction = inCube();
    if (direction.norm() > 1.0 || direction.norm() == 0.0)
      continue;
    const double distance =
        innermost * std::pow(0.5 * extent / innermost, random.uniform());
    add(radius * Eigen::Vector3d::UnitX() + distance * direction.normalized());
    ++i;
  }
  return cloud;
}

void
printClustered()
{
  const auto cloud = clusteredBall();
  std::puts("clustered ball, 67200 samples");
  for (const CurvatureFlow flow : {CurvatureFlow::Relative, CurvatureFlow::Mean}) {
    double seconds[2] = {};
    for (const Integration integration :
         {Integration::Asynchronous, Integration::Synchronous}) {
      Evolution evolution;
      evolution.setCurvatureFlow(flow);
      if (flow == CurvatureFlow::Mean)
        evolution.setMu(0.5);
      evolution.setIntegration(integration);
      evolution.setMaximumSteps(1000000);
      evolve(evolution, cloud, 0.0);
      const auto& report = evolution.getReport();
      seconds[static_cast<int>(integration)] =
          1e-3 * millisecondsOf(report, "evolution");
      std::printf("  %s flow, %s: %s in %.2f s, %zu steps, %.1f million updates, %.1f "
                  "million samples/s\n",
                  flow == CurvatureFlow::Relative ? "relative" : "mean",
                  integration == Integration::Synchronous ? "synchronous"
                                                          : "asynchronous",
                  evolution.getSummary().converged ? "converged" : "not converged",
                  1e-3 * millisecondsOf(report, "evolution"),
                  evolution.getSummary().steps.size(),
                  1e-6 * static_cast<double>(report.getCount("updates")),
                  rateOf(report));
    }
    std::printf("  synchronous / asynchronous %.1f\n",
                seconds[static_cast<int>(Integration::Synchronous)] /
                    seconds[static_cast<int>(Integration::Asynchronous)]);
  }
}

} // namespace

/** levelset VOLUME ISOVALUE SAMPLES... */
int
main(int argc, char** argv)
{
  if (argc < 4) {
    std::fputs("usage: levelset VOLUME ISOVALUE SAMPLES...\n", stderr);
    return 2;
  }
  std::printf("reading memory: %.1f GB/s\n", bandwidth());
  const auto volume = pcl_uvol::loadVolume(argv[1]);
  for (int i = 3; i < argc; ++i)
    printSize(volume, std::atof(argv[2]), static_cast<std::size_t>(std::atof(argv[i])));
  printClustered();
  return 0;
}
