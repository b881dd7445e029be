// SPDX-License-Identifier: BSD-3-Clause
// PCA normals beside pcl::NormalEstimationOMP for the sizes of thesis Table 4.3, in one
// run; search trees included.
#include "common/parallel.h"
#include "neighbors/sample_set.h"
#include "support/environment.h"
#include <pcl_uvol/surface/surface_normals.h>

#include <benchmark/benchmark.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <numeric>
#include <utility>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

/** Points of the unit sphere, each with a probability of its own. */
Cloud::Ptr
randomSphere(std::size_t n)
{
  uvol_test::Random random(1);
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(n);
  while (cloud->size() < n) {
    const Eigen::Vector3d p(
        2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
    if (p.squaredNorm() > 1.0 || p.squaredNorm() < 1e-4)
      continue;
    const Eigen::Vector3f q = p.normalized().cast<float>();
    cloud->push_back({q.x(), q.y(), q.z()});
  }
  return cloud;
}

/** The same points in leaf order: as an extraction gives its isopoints, and what suits
 * PCL's queries best. */
Cloud::Ptr
inLeafOrder(const Cloud& cloud)
{
  std::vector<std::uint32_t> use(cloud.size());
  std::iota(use.begin(), use.end(), 0u);
  pcl_uvol::Report report;
  const auto samples = pcl_uvol::SampleSet::build(&cloud[0].x,
                                                  sizeof(pcl::PointXYZ) / sizeof(float),
                                                  use,
                                                  {{1.0f, 1.0f, 1.0f}},
                                                  0,
                                                  report);
  Cloud::Ptr sorted(new Cloud);
  for (const pcl_uvol::Position& p : samples->getPositions())
    sorted->push_back({p[0], p[1], p[2]});
  return sorted;
}

const Cloud::Ptr&
surfaceOf(const benchmark::State& state)
{
  static std::pair<std::int64_t, std::int64_t> made{0, 0};
  static Cloud::Ptr cloud;
  const std::pair wanted{state.range(0), state.range(2)};
  if (made != wanted) {
    cloud = randomSphere(static_cast<std::size_t>(wanted.first));
    if (wanted.second != 0)
      cloud = inLeafOrder(*cloud);
    made = wanted;
  }
  return cloud;
}

void
normalsUvol(benchmark::State& state)
{
  const Cloud::Ptr& surface = surfaceOf(state);
  pcl_uvol::Report report;
  for (auto _ : state) {
    pcl_uvol::SurfaceNormalEstimation<pcl::PointXYZ> estimation;
    estimation.setInputCloud(surface);
    estimation.setKSearch(static_cast<std::size_t>(state.range(1)));
    Normals normals;
    estimation.compute(normals);
    benchmark::DoNotOptimize(normals.points.data());
    report = estimation.getReport();
  }
  for (const auto& [step, milliseconds] : report.milliseconds)
    state.counters[step + "_ms"] = milliseconds;
}

void
normalsPcl(benchmark::State& state)
{
  const Cloud::Ptr& surface = surfaceOf(state);
  for (auto _ : state) {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setNumberOfThreads(pcl_uvol::resolveThreads(0));
    estimation.setInputCloud(surface);
    estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(
        new pcl::search::KdTree<pcl::PointXYZ>));
    // PCL counts the point itself as one of its neighbours.
    estimation.setKSearch(static_cast<int>(state.range(1)) + 1);
    Normals normals;
    estimation.compute(normals);
    benchmark::DoNotOptimize(normals.points.data());
  }
}

// Real time, since the work is parallel; CPU time is of all threads and bears other
// load.
void
pairPerEntry()
{
  for (const std::int64_t n : {125000, 250000, 500000, 1000000})
    for (const std::int64_t leaf_order : {0, 1})
      for (const std::int64_t k : {10, 20, 30, 40})
        for (const auto& [name, function] : {std::pair{"normals/uvol", &normalsUvol},
                                             std::pair{"normals/pcl_omp", &normalsPcl}})
          benchmark::RegisterBenchmark(name, function)
              ->Args({n, k, leaf_order})
              ->ArgNames({"n", "k", "leaf_order"})
              ->Unit(benchmark::kMillisecond)
              ->MeasureProcessCPUTime()
              ->UseRealTime();
}

} // namespace

int
main(int argc, char** argv)
{
  pairPerEntry();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
