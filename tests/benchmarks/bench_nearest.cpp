// SPDX-License-Identifier: BSD-3-Clause
// The 41 nearest samples of every isopoint: boxes of our own tree beside FLANN, whose
// index holds only the samples near the surface. One thread. Radial test of thesis
// Table 2.9.
#include "neighbors/nearest_finder.h"
#include "neighbors/sample_set.h"
#include "radial_cloud.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <benchmark/benchmark.h>
#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

constexpr std::size_t k = 41;
constexpr std::size_t samples = 4000000;
/** Farther from the surface than that no sample is among the nearest. */
constexpr float margin = 3.5f;

struct Setup {
  const uvol_test::RadialCloud& radial = radialCloud(samples);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  std::vector<pcl_uvol::Position> points; ///< isopoints, as the input has them

  Setup()
  {
    extraction.setInputCloud(radial.cloud);
    extraction.setIsoValue(radial.radius);
    extraction.setInterpolation(pcl_uvol::Interpolation::Linear);
    pcl::PointCloud<pcl_uvol::PointIso> surface;
    extraction.extract(surface);
    for (const pcl_uvol::PointIso& point : surface)
      points.push_back({{point.x, point.y, point.z}});
  }
};

const Setup&
setup()
{
  static const Setup instance;
  return instance;
}

void
uvolFinder(benchmark::State& state)
{
  constexpr std::size_t batch = 8;
  const auto set = setup().extraction.getSamples();
  // Samples are kept in a unit of their own.
  std::vector<pcl_uvol::Position> points;
  for (const pcl_uvol::Position& point : setup().points)
    points.push_back(set->getUnit().apply(point));
  const float spacing = set->getUnit().factor;
  for (auto _ : state) {
    pcl_uvol::NearestFinder finder(*set, k);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % batch == 0)
        finder.expect(&points[i], std::min(batch, points.size() - i));
      benchmark::DoNotOptimize(finder.find(points[i], spacing).samples);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(points.size()) *
                          state.iterations());
}

void
flannNearSurface(benchmark::State& state)
{
  const auto& points = setup().points;
  const auto& radial = setup().radial;
  std::vector<std::size_t> indices(k);
  std::vector<float> sq_dists(k);
  flann::SearchParams search(flann::FLANN_CHECKS_UNLIMITED);
  search.use_heap = flann::FLANN_False;
  for (auto _ : state) {
    std::vector<float> near_surface;
    for (const pcl::PointXYZI& p : *radial.cloud) {
      const double r =
          std::hypot(p.x - radial.center, p.y - radial.center, p.z - radial.center);
      if (std::abs(r - radial.radius) < margin)
        near_surface.insert(near_surface.end(), {p.x, p.y, p.z});
    }
    flann::KDTreeSingleIndex<flann::L2_3D<float>> index(
        flann::Matrix<float>(near_surface.data(), near_surface.size() / 3, 3),
        flann::KDTreeSingleIndexParams(15));
    index.buildIndex();
    for (pcl_uvol::Position point : points) {
      flann::Matrix<std::size_t> index_row(indices.data(), 1, k);
      flann::Matrix<float> sq_dist_row(sq_dists.data(), 1, k);
      index.knnSearch(
          flann::Matrix<float>(point.x, 1, 3), index_row, sq_dist_row, k, search);
      benchmark::DoNotOptimize(indices.data());
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(points.size()) *
                          state.iterations());
}

BENCHMARK(uvolFinder)->Unit(benchmark::kMillisecond);
BENCHMARK(flannNearSurface)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
