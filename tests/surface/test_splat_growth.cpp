// SPDX-License-Identifier: BSD-3-Clause
// Single splats on surfaces in closed form: how far they grow, and their fields of
// normals.
#include "src/surface/splat_growth.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace test_splat_growth {

using namespace pcl_uvol;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Points above the square of side 2 about the origin, one of them at its middle. */
struct Patch {
  OrientedPoints points;
  std::uint32_t middle = 0;
  double unit;

  Patch(std::size_t count,
        const std::function<double(const Vector2d&)>& height,
        const std::function<Vector2d(const Vector2d&)>& inclination)
  {
    std::mt19937_64 engine(6);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    pcl::PointCloud<pcl::PointNormal> cloud;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d at =
          i == 0 ? Vector2d(0.0, 0.0) : Vector2d(place(engine), place(engine));
      const Vector2d slope = inclination(at);
      pcl::PointNormal point;
      point.getVector3fMap() = Vector3d(at[0], at[1], height(at)).cast<float>();
      point.getNormalVector3fMap() =
          Vector3d(slope[0], slope[1], 1.0).normalized().cast<float>();
      cloud.push_back(point);
    }
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    Report report;
    points = orientPoints(viewOf(cloud), all, 1, report);
    unit = points.samples->getScale()[0];
    while (points.samples->getInputIndex(middle) != 0)
      ++middle;
  }

  Vector3d
  position(std::size_t i) const
  {
    const Position& x = points.samples->getPositions()[i];
    return {x[0], x[1], x[2]};
  }

  /** \param least_radius of all points
   * \param delta a length */
  SplatGround
  ground(double least_radius, double delta, double lambda) const
  {
    Report report;
    const std::size_t size = points.samples->size();
    return {points,
            std::vector<std::uint8_t>(size, 0),
            computeFootprints(points, 1, report).nearest,
            std::vector<float>(size, static_cast<float>(unit * least_radius)),
            std::vector<PackedRim>(size, 0),
            unit * delta,
            lambda};
  }
};

/** Inclinations that are linear in the place: the field is their matrix, turned to its
 * axes. */
TEST(SplatGrowth, FieldsAreTheLinearFieldsOfTheNormals)
{
  Matrix2d turn;
  turn << 0.3, 0.25, 0.25, -0.4;
  const Patch patch(
      600,
      [](const Vector2d&) { return 0.0; },
      [&](const Vector2d& x) { return turn * x; });
  SplatGround ground = patch.ground(0.05, 0.1, 0.2);
  constexpr double rim = 0.7; // splats end there
  for (std::size_t i = 0; i < ground.on_rim.size(); ++i)
    ground.on_rim[i] = patch.position(i).head<2>().norm() > rim * patch.unit ? 1 : 0;
  SplatGrower grower(ground);
  const GrownSplat grown = grower.grow(patch.middle);
  const PointSplat& splat = grown.splat;
  const double radius = splat.radius / patch.unit;
  EXPECT_NEAR(rim, radius, 0.1);
  EXPECT_FALSE(grown.widened);
  const Vector2d u = splat.getTangentVector3fMap().cast<double>().head<2>();
  const Vector2d v(-u[1], u[0]);
  const Matrix2d field =
      (splat.slope_u * u * u.transpose() + splat.slope_v * v * v.transpose()) / radius;
  EXPECT_NEAR(0.0, (field - turn).norm(), 1e-3);
  EXPECT_NEAR(0.0, std::hypot(splat.tilt_u, splat.tilt_v), 1e-3);
  EXPECT_NEAR(0.0, splat.error, 1e-6);
}

TEST(SplatGrowth, TiltsTowardsTheMeanOfItsNeighbours)
{
  // All but the middle one lean to one side.
  const Vector2d lean(0.2, -0.1);
  const Patch patch(
      600,
      [](const Vector2d&) { return 0.0; },
      [&](const Vector2d& x) { return x.isZero() ? Vector2d(0.0, 0.0) : lean; });
  SplatGround ground = patch.ground(0.3, 0.1, 0.2);
  std::fill(ground.on_rim.begin(), ground.on_rim.end(), 1);
  SplatGrower grower(ground);
  const GrownSplat grown = grower.grow(patch.middle);
  EXPECT_TRUE(grown.widened) << "on the rim it has its least radius";
  EXPECT_NEAR(0.3, grown.splat.radius / patch.unit, 1e-6);
  const Vector2d u = grown.splat.getTangentVector3fMap().cast<double>().head<2>();
  const Vector2d v(-u[1], u[0]);
  // The middle one counts as well, once.
  double within = 0.0;
  for (std::size_t i = 0; i < ground.on_rim.size(); ++i)
    within += patch.position(i).norm() <= 0.3 * patch.unit ? 1.0 : 0.0;
  const double part = 1.0 - 1.0 / within;
  EXPECT_NEAR(0.0,
              (grown.splat.tilt_u * u + grown.splat.tilt_v * v - part * lean).norm(),
              3e-3);
}

/** On a bowl a splat covers the nearest points until one of them is too high. */
TEST(SplatGrowth, EndsAtTheErrorBoundAndPassesOverWhatItCovers)
{
  constexpr double curvature = 0.5, least = 0.02, lambda = 0.4;
  for (const double delta : {0.002, 0.01, 0.04}) {
    const Patch patch(
        2000,
        [&](const Vector2d& x) { return 0.5 * curvature * x.squaredNorm(); },
        [&](const Vector2d& x) { return Vector2d(-curvature * x); });
    const SplatGround ground = patch.ground(least, delta, lambda);
    SplatGrower grower(ground);
    const GrownSplat grown = grower.grow(patch.middle);
    // Nearest first, in space.
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < patch.points.samples->size(); ++i)
      if (i != patch.middle)
        order.emplace_back(patch.position(i).norm() / patch.unit, i);
    std::sort(order.begin(), order.end());
    double radius = 0.0, high = 0.0;
    for (const auto& [distance, i] : order) {
      const Vector3d x = patch.position(i) / patch.unit;
      if (x[2] > 2.0 * delta)
        break;
      radius = std::max(radius, x.head<2>().norm());
      high = std::max(high, x[2]);
    }
    ASSERT_GT(radius, least);
    EXPECT_NEAR(radius, grown.splat.radius / patch.unit, 1e-6);
    EXPECT_NEAR(0.5 * high, grown.splat.z / patch.unit, 1e-6);
    EXPECT_NEAR(0.5 * high, grown.splat.error / patch.unit, 1e-4 * high + 1e-6);
    EXPECT_LE(grown.splat.error / patch.unit, delta);
    std::vector<std::uint32_t> expected, passed = grown.passed_over;
    for (const auto& [distance, i] : order) {
      const double away = patch.position(i).head<2>().norm() / patch.unit;
      if (away <= lambda * radius && away + least <= radius)
        expected.push_back(i);
    }
    std::sort(expected.begin(), expected.end());
    std::sort(passed.begin(), passed.end());
    EXPECT_EQ(expected, passed);
    // The normals of a bowl turn by its curvature, in all directions alike.
    EXPECT_NEAR(-curvature * radius, grown.splat.slope_u, 2e-3);
    EXPECT_NEAR(-curvature * radius, grown.splat.slope_v, 2e-3);
  }
}

} // namespace test_splat_growth
