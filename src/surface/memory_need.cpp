// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/memory_need.h"

#include "common/random.h"
#include "surface/memory_need.h"
#include "surface/splat_growth.h"
#include "surface/usual_extent.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr double float_bytes = sizeof(float), index_bytes = sizeof(std::uint32_t);

/** Patches, the points of one at most, and the part of all points that they may be: a
 * splat takes some ten microseconds to grow. */
constexpr std::size_t patches = 2, patch_points = 2048, patches_part = 64;

/** Fewer points are no patch. */
constexpr std::size_t fewest_points = 256;

/** The points of a patch that count: splats do not grow across its rim. */
constexpr std::size_t inner_part = 4;

/** Where there is no patch: points of a surface that is sampled no finer than its
 * splats reach. */
constexpr double usual_splats = 0.9;

/** Splats that are grown at once, in parts of those that stand already when it is done
 * for the last time, and what one says is covered: mostly none or a few. */
constexpr double grown_part = 0.2, passed_over_bytes = 32.0;

/** Indices of the finite points. */
std::vector<std::uint32_t>
findFinite(const CloudView& cloud)
{
  std::vector<std::uint32_t> finite;
  finite.reserve(cloud.count);
  for (std::uint32_t i = 0; i < cloud.count; ++i) {
    const float* const xyz = cloud.xyz(i);
    if (std::all_of(xyz, xyz + 3, [](float x) { return std::isfinite(x); }))
      finite.push_back(i);
  }
  return finite;
}

/** The longest one. */
double
findUsualSide(const CloudView& cloud, const std::vector<std::uint32_t>& points)
{
  if (points.empty())
    return 0.0;
  std::vector<Position> positions(points.size());
  std::transform(points.begin(), points.end(), positions.begin(), [&](auto point) {
    return toPosition(cloud.xyz(point));
  });
  const auto sides = findUsualSides(positions);
  return *std::max_element(sides.begin(), sides.end());
}

/** Points around one of them: the nearest, and of these the nearest ones, ascending. */
struct Patch {
  std::vector<std::uint32_t> points, inner;
};

/** A ball, whose inner points are far from its rim on every layer of the surface.
 * \param points finite ones, brought into another order
 * \param most points of the patch */
Patch
takePatch(const CloudView& cloud,
          std::vector<std::uint32_t>& points,
          std::size_t most,
          std::uint64_t seed)
{
  const auto at = [&](std::uint32_t i) -> Eigen::Vector3d {
    return Eigen::Vector3f(cloud.xyz(i)).cast<double>();
  };
  const Eigen::Vector3d middle = at(points[mixBits(seed) % points.size()]);
  const auto take_nearest = [&](std::vector<std::uint32_t>& from, std::size_t count) {
    const auto end = from.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(from.begin(), end, from.end(), [&](auto a, auto b) {
      return (at(a) - middle).squaredNorm() < (at(b) - middle).squaredNorm();
    });
    return std::vector<std::uint32_t>(from.begin(), end);
  };
  Patch patch;
  patch.points = take_nearest(points, std::min(most, points.size()));
  patch.inner = take_nearest(patch.points, patch.points.size() / inner_part);
  std::sort(patch.inner.begin(), patch.inner.end());
  return patch;
}

} // namespace

MemoryNeed
surfaceNormalsNeed(double points, double k)
{
  // A normal in single precision, its curvature, and whether it is degenerate; the side
  // to look to.
  constexpr double fit_bytes = (5 + 3) * float_bytes;
  MemoryForecast forecast(0.0);
  forecast.run(sampleSetNeed(points));
  forecast.run(nearestNeighborsNeed(points, k));
  const double kept = sizeof(SurfaceNormal) * points;
  forecast.hold((fit_bytes + index_bytes) * points + kept);
  return {forecast.getPeak(), kept};
}

double
estimateSplats(const CloudView& cloud,
               const SplatParameters& parameters,
               unsigned threads)
{
  const std::size_t most =
      std::min(patch_points, cloud.count / (patches * patches_part));
  std::vector<std::uint32_t> finite = findFinite(cloud);
  if (std::min(most, finite.size()) < fewest_points)
    return usual_splats;
  SplatParameters of_patch = parameters;
  if (!parameters.delta_is_length)
    of_patch.delta = parameters.delta * findUsualSide(cloud, finite);
  of_patch.delta_is_length = true;
  std::size_t points = 0, splats = 0;
  for (std::uint64_t seed = 0; seed < patches; ++seed) {
    const auto patch = takePatch(cloud, finite, most, seed);
    try {
      Report ignored;
      const auto grown =
          detail::generateSplats(cloud, patch.points, of_patch, threads, ignored);
      points += patch.inner.size();
      splats += static_cast<std::size_t>(std::count_if(
          grown.sources.begin(), grown.sources.end(), [&](std::uint32_t source) {
            return std::binary_search(patch.inner.begin(), patch.inner.end(), source);
          }));
    }
    catch (const InvalidArgument&) {
      // the splats of the whole cloud will tell what is wrong
    }
  }
  return points > 0 ? static_cast<double>(splats) / static_cast<double>(points)
                    : usual_splats;
}

MemoryNeed
splatsNeed(double points, double splats, bool has_normals)
{
  MemoryForecast forecast(0.0);
  // Finite points and those with a normal, and packed normals.
  const double of_input = (2.0 * index_bytes + sizeof(PackedNormal)) * points;
  forecast.hold(of_input);
  constexpr double estimation_neighbors = 30.0; // default of SurfaceNormalParameters
  if (!has_normals)
    forecast.run({surfaceNormalsNeed(points, estimation_neighbors).peak, 0.0});
  forecast.run(sampleSetNeed(points));
  forecast.hold(sizeof(PackedNormal) * points);
  forecast.release(of_input);
  const double oriented = forecast.getHeld();
  // Radii, fillers, rims, bends and nearest points; what they are made of.
  constexpr double footprint_bytes = 2.0 * float_bytes + sizeof(std::uint8_t) +
                                     sizeof(PackedBend) + sizeof(PackedRim) +
                                     sizeof(NearestPoints);
  constexpr double reach_bytes = 8.0 * float_bytes;
  forecast.hold(footprint_bytes * points);
  forecast.run({reach_bytes * points, 0.0});
  // The order, who is passed over, and the splats as they are grown.
  forecast.hold((index_bytes + sizeof(std::uint8_t)) * points);
  constexpr double accepted_bytes = sizeof(PointSplat) + alignof(PointSplat);
  const double accepted = accepted_bytes * splats;
  forecast.hold(accepted);
  forecast.run({grown_part * (sizeof(GrownSplat) + passed_over_bytes) * splats, 0.0});
  forecast.release(forecast.getHeld() - oriented - accepted);
  const double kept = (sizeof(PointSplat) + index_bytes + sizeof(PackedRim)) * splats;
  forecast.hold(index_bytes * points + kept); // which splat is that of a sample
  return {forecast.getPeak(), kept};
}

} // namespace pcl_uvol
