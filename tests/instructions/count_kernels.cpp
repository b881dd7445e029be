// SPDX-License-Identifier: BSD-3-Clause
// Runs one kernel on a fixed input for callgrind, which counts what happens inside
// measured() only. usage: count_kernels KERNEL
#include "neighbors/nearest_neighbors.h"
#include "neighbors/neighborhood_finder.h"
#include "support/clouds.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <string>

namespace {

constexpr std::size_t sample_count = 20000;
constexpr unsigned threads = 1; // counts of several threads depend on their timing

} // namespace

/** \brief The function that run.sh tells callgrind to count in. */
extern "C" __attribute__((noinline)) void
measured(const std::function<void()>& kernel)
{
  kernel();
}

int
main(int argc, char** argv)
{
  using namespace pcl_uvol;
  const auto radial = uvol_test::makeRadialCloud(sample_count, 1);
  std::vector<std::uint32_t> all(sample_count);
  std::iota(all.begin(), all.end(), 0u);
  Report report;
  const auto build = [&] {
    return SampleSet::build(radial.cloud->points.front().data,
                            sizeof(pcl::PointXYZI) / sizeof(float),
                            all,
                            Position{{1.0f, 1.0f, 1.0f}},
                            threads,
                            report);
  };
  const auto samples = build();

  IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setNumberOfThreads(threads);
  extraction.setIsoValue(radial.radius);
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  extraction.extract(isopoints); // the tree is not what "isovalue" counts

  const std::map<std::string, std::function<void()>> kernels = {
      {"tree", [&] { build(); }},
      {"natural_neighbors",
       [&] {
         computeNaturalNeighbors(
             *samples, TouchingCells(*samples), AngleCriterion::Kept, threads, report);
       }},
      {"nearest_neighbors",
       [&] { computeNearestNeighbors(*samples, 26, threads, report); }},
      {"isovalue", [&] { extraction.extract(isopoints); }}};
  const auto kernel = kernels.find(argc == 2 ? argv[1] : "");
  if (kernel == kernels.end()) {
    std::fputs(
        "usage: count_kernels tree|natural_neighbors|nearest_neighbors|isovalue\n",
        stderr);
    return 2;
  }
  measured(kernel->second);
  return 0;
}
