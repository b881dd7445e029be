// SPDX-License-Identifier: BSD-3-Clause
// Seconds per picture of the ray tracer, beside Embree and the octree of the thesis
// with the same discs, light and mirrors.
#include "embree_tracer.h"
#include "octree_tracer.h"
#include "support/surfaces.h"
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace {

using pcl_uvol::Camera;
using Splats = pcl::PointCloud<pcl_uvol::PointSplat>;

/** The knot of the rendering measurements as discs of one radius. */
Splats::ConstPtr
knot(std::size_t count, double radius)
{
  static std::map<std::pair<std::size_t, double>, Splats::Ptr> made;
  Splats::Ptr& splats = made[{count, radius}];
  if (splats)
    return splats;
  splats.reset(new Splats);
  const auto points = uvol_test::makeTorusKnot(count, 1);
  for (const auto& point : *points) {
    pcl_uvol::PointSplat splat;
    splat.getVector3fMap() = point.getVector3fMap();
    splat.getNormalVector3fMap() = point.getNormalVector3fMap();
    splat.getTangentVector3fMap() = point.getNormalVector3fMap().unitOrthogonal();
    splat.radius = static_cast<float>(radius);
    splats->push_back(splat);
  }
  return splats;
}

Camera
lookAtKnot()
{
  return Camera::fit({{0.0, 0.0, 0.0}, 3.0}, "iso", 30.0, 1.0);
}

/** Arguments: splats, radius in ten thousandths, pixels of a side, depth. */
void
rayTracer(benchmark::State& state)
{
  pcl_uvol::Scene scene;
  scene.splats.resize(1);
  scene.splats[0].splats = knot(static_cast<std::size_t>(state.range(0)),
                                1e-4 * static_cast<double>(state.range(1)));
  scene.splats[0].material.reflectivity = state.range(3) > 0 ? 0.5 : 0.0;
  scene.lights = {pcl_uvol::Light()};
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(lookAtKnot());
  const int size = static_cast<int>(state.range(2));
  tracer.setSize(size, size);
  tracer.settings().depth = static_cast<int>(state.range(3));
  pcl_uvol::Image image;
  tracer.getBounds(); // builds
  for (auto _ : state)
    tracer.render(image);
  const auto& report = tracer.getReport();
  state.counters["rays"] = static_cast<double>(report.getCount("primary_rays") +
                                               report.getCount("secondary_rays") +
                                               report.getCount("shadow_rays"));
}

void
measure(benchmark::State& state, const uvol_bench::PeerTracer& tracer)
{
  pcl_uvol::Image image;
  for (auto _ : state)
    tracer.render(lookAtKnot(),
                  static_cast<int>(state.range(2)),
                  static_cast<int>(state.range(3)),
                  state.range(3) > 0 ? 0.5f : 0.0f,
                  0,
                  image);
}

void
embree(benchmark::State& state, uvol_bench::EmbreeWay way)
{
  const auto splats = knot(static_cast<std::size_t>(state.range(0)),
                           1e-4 * static_cast<double>(state.range(1)));
  measure(state, uvol_bench::EmbreeTracer(*splats, way));
}

void
octree(benchmark::State& state, std::size_t centers)
{
  const auto splats = knot(static_cast<std::size_t>(state.range(0)),
                           1e-4 * static_cast<double>(state.range(1)));
  measure(state, uvol_bench::OctreeTracer(*splats, centers));
}

void
cases(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({"splats", "radius", "size", "depth"})
      ->Args({300000, 300, 1200, 0})
      ->Args({300000, 300, 1200, 4})
      ->Args({300000, 600, 1200, 0})
      ->Args({1000000, 170, 1200, 4})
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

BENCHMARK(rayTracer)->Apply(cases);
// Ever more splats of the same surface, as many of them on top of each other.
BENCHMARK(rayTracer)
    ->ArgNames({"splats", "radius", "size", "depth"})
    ->Args({100000, 520, 1200, 0})
    ->Args({1000000, 164, 1200, 0})
    ->Args({10000000, 52, 1200, 0})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(embree, userGeometry, uvol_bench::EmbreeWay::UserGeometry)
    ->Apply(cases);
BENCHMARK_CAPTURE(embree, orientedDiscs, uvol_bench::EmbreeWay::OrientedDiscs)
    ->Apply(cases);
BENCHMARK_CAPTURE(octree, 16 centres, 16)->Apply(cases);
BENCHMARK_CAPTURE(octree, 8 centres, 8)->Apply(cases);
BENCHMARK_CAPTURE(octree, 4 centres, 4)->Apply(cases);

} // namespace

BENCHMARK_MAIN();
