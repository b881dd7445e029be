// SPDX-License-Identifier: BSD-3-Clause
// Tree, all neighbourhoods and one isosurface beside CGAL's parallel Delaunay
// triangulation with its edges, on the radial test of thesis Table 2.9, in one run.
#include "neighbors/neighborhood_finder.h"
#include "radial_cloud.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace {

using uvol_test::RadialCloud;

/** Tree and all neighbourhoods, then the edges that cross the isovalue: as much as CGAL
 * does. */
void
wholeJobUvol(benchmark::State& state)
{
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  std::vector<std::uint32_t> use(radial.cloud->size());
  std::iota(use.begin(), use.end(), 0u);
  std::size_t edges = 0;
  pcl_uvol::Report report;
  for (auto _ : state) {
    report = pcl_uvol::Report();
    const auto samples =
        pcl_uvol::SampleSet::build(&(*radial.cloud)[0].x,
                                   sizeof(pcl::PointXYZI) / sizeof(float),
                                   use,
                                   pcl_uvol::Position{{1.0f, 1.0f, 1.0f}},
                                   0,
                                   report);
    const auto graph =
        pcl_uvol::computeNaturalNeighbors(*samples,
                                          pcl_uvol::TouchingCells(*samples),
                                          pcl_uvol::AngleCriterion::Kept,
                                          0,
                                          report);
    const auto isAbove = [&](std::size_t i) {
      return (*radial.cloud)[samples->getInputIndex(i)].intensity >= radial.radius;
    };
    edges = 0;
    for (std::size_t i = 0; i < graph.size(); ++i)
      for (const auto j : graph[i])
        edges += isAbove(i) != isAbove(j);
  }
  for (const auto& [step, milliseconds] : report.milliseconds)
    state.counters[step + "_ms"] = milliseconds;
  state.counters["crossing"] = static_cast<double>(edges);
}

void
wholeJobCgal(benchmark::State& state)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_3<
      Vertex,
      CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
      CGAL::Parallel_tag>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
  CGAL::Bbox_3 box;
  for (const auto& point : *radial.cloud) {
    points.emplace_back(Kernel::Point_3(point.x, point.y, point.z),
                        static_cast<std::uint32_t>(points.size()));
    box += points.back().first.bbox();
  }
  std::size_t edges = 0;
  for (auto _ : state) {
    Delaunay::Lock_data_structure locks(box, 50);
    const Delaunay delaunay(points.begin(), points.end(), &locks);
    const auto isAbove = [&](const Delaunay::Vertex_handle& vertex) {
      return (*radial.cloud)[vertex->info()].intensity >= radial.radius;
    };
    edges = 0;
    for (const auto& edge : delaunay.finite_edges())
      edges += isAbove(edge.first->vertex(edge.second)) !=
               isAbove(edge.first->vertex(edge.third));
  }
  state.counters["crossing"] = static_cast<double>(edges);
}

/** What uvol_isosurface does: neighbourhoods only where the surface passes. */
void
isosurfaceUvol(benchmark::State& state)
{
  const RadialCloud& radial = radialCloud(static_cast<std::size_t>(state.range(0)));
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  pcl_uvol::Report report;
  for (auto _ : state) {
    pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
    extraction.setInputCloud(radial.cloud);
    extraction.setIsoValue(radial.radius);
    extraction.extract(surface);
    report = extraction.getReport();
  }
  for (const auto& [step, milliseconds] : report.milliseconds)
    state.counters[step + "_ms"] = milliseconds;
  state.counters["isopoints"] = static_cast<double>(surface.size());
}

// Real time: the work is parallel. One size after the other, so that ratios are of one
// cloud.
void
pairPerSize()
{
  for (const std::int64_t n : {100000, 1000000, 4000000}) {
    for (const auto& [name, function] :
         {std::pair{"whole_job/uvol", &wholeJobUvol},
          std::pair{"whole_job/cgal_delaunay_tbb", &wholeJobCgal},
          std::pair{"isosurface/uvol", &isosurfaceUvol}})
      benchmark::RegisterBenchmark(name, function)
          ->Arg(n)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  }
}

} // namespace

int
main(int argc, char** argv)
{
  pairPerSize();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
