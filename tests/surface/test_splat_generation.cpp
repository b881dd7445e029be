// SPDX-License-Identifier: BSD-3-Clause
// Splats of surfaces that are known: how large they are and how many, that they leave
// nothing uncovered, and what normals they give (thesis 4.2.1).
#include "support/environment.h"
#include "support/statistics.h"
#include "surface/splat_setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace test_splat_generation {

using namespace uvol_test;
using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;

/** Points are found to be this much farther off than float has kept them. */
constexpr double rounding = 1e-6;

/** Spacing of points: 1 / spacing^2 of them per area. */
double
spacingOf(double area, std::size_t points)
{
  return std::sqrt(area / static_cast<double>(points));
}

double
degreesBetween(const Vector3d& a, const Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / pi;
}

pcl::PointNormal
makePoint(const Vector3d& position, const Vector3d& normal)
{
  pcl::PointNormal point;
  point.getVector3fMap() = position.cast<float>();
  point.getNormalVector3fMap() = normal.normalized().cast<float>();
  return point;
}

struct Surface {
  const char* name;
  SurfaceCloudPtr (*make)(std::size_t n, std::uint64_t seed);
};

const Surface sphere{"sphere", makeSphere}, waves{"waves", makeWaves},
    knot{"torus knot", makeTorusKnot};

/** Moved along their normals by up to that length. */
SurfaceCloudPtr
withNoise(const SurfaceCloudPtr& cloud, double length)
{
  Random random(1);
  SurfaceCloudPtr noisy(new pcl::PointCloud<pcl::PointNormal>(*cloud));
  for (auto& point : *noisy)
    point.getVector3fMap() +=
        static_cast<float>(length * (2.0 * random.uniform() - 1.0)) *
        point.getNormalVector3fMap();
  return noisy;
}

/** Random points of a square of side 2 in the plane z = 0, with a hole in its middle.
 */
SurfaceCloudPtr
makePlate(std::size_t n, double hole_radius, std::uint64_t seed)
{
  Random random(seed);
  SurfaceCloudPtr plate(new pcl::PointCloud<pcl::PointNormal>);
  while (plate->size() < n) {
    const double x = 2.0 * random.uniform() - 1.0, y = 2.0 * random.uniform() - 1.0;
    if (std::hypot(x, y) >= hole_radius)
      plate->push_back(makePoint({x, y, 0.0}, Vector3d::UnitZ()));
  }
  return plate;
}

/** Random points of z = (a x^2 + b y^2) / 2 over a square of side 1. */
SurfaceCloudPtr
makeQuadric(double a, double b, std::size_t n)
{
  Random random(3);
  SurfaceCloudPtr quadric(new pcl::PointCloud<pcl::PointNormal>);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
    quadric->push_back(
        makePoint({x, y, 0.5 * (a * x * x + b * y * y)}, {-a * x, -b * y, 1.0}));
  }
  return quadric;
}

TEST(SplatGeneration, DiscsOnASphereAreAsLargeAsDeltaAllows)
{
  // Points sink below the plane of the first one by rho^2 / 2R, and half of that is
  // delta. A disc covers 200 points, so that hardly a border lies in a gap of more than
  // a few of them.
  constexpr std::size_t points = 200000;
  constexpr double delta = 1e-3;
  const double radius = std::sqrt(4.0 * delta);
  const auto cloud = makeSphere(points, 1);
  SplatStage generation;
  generation.setInputCloud(cloud);
  generation.setAbsoluteDelta(delta);
  SplatCloud splats;
  generation.compute(splats);
  ASSERT_EQ(splats.size(), generation.getSources().size());
  double sum = 0.0;
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const Disc disc(splats[i]);
    const auto& source = (*cloud)[generation.getSources()[i]];
    sum += disc.radius;
    ASSERT_NEAR(disc.radius, radius, 0.05 * radius);
    ASSERT_LE(disc.error, delta + rounding);
    // The point itself is the highest one: the plane lies below it by the error.
    ASSERT_NEAR(disc.normal().dot(normalOf(source)), 1.0, rounding);
    ASSERT_LT((disc.local(positionOf(source)) - Vector3d(0.0, 0.0, disc.error)).norm(),
              rounding);
    ASSERT_LT((disc.axes * disc.axes.transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-5);
  }
  EXPECT_NEAR(sum / static_cast<double>(splats.size()), radius, 0.01 * radius);
  EXPECT_EQ(generation.getReport().getCount("splats"), splats.size());
  EXPECT_EQ(generation.getReport().getCount("widened"), 0u);
}

TEST(SplatGeneration, NumberIsThatOfRandomSequentialAdsorption_long)
{
  // No two centres are nearer than lambda r and there is no room for another one: discs
  // of that diameter, put down one by one at random, cover 0.547 of a surface in the
  // end (Feder 1980), at 0.547 / (pi/4) per square of the diameter. Points stand for
  // all places only if there are many of them in a diameter; moreover a point is passed
  // over only if its cell, about a spacing, lies within the disc. Here lambda r is 25
  // spacings, and 13.
  constexpr std::size_t points = 200000;
  constexpr double delta = 1e-2, in_the_end = 0.547 / (0.25 * pi);
  const double radius = std::sqrt(4.0 * delta), area = 4.0 * pi;
  const auto cloud = makeSphere(points, 2);
  for (const double lambda : {1.0, 0.5}) {
    const double distance = lambda * radius;
    ASSERT_GT(distance, 10.0 * spacingOf(area, points));
    const double expected = in_the_end * area / (distance * distance);
    const auto count = static_cast<double>(makeSplats(cloud, delta, lambda).size());
    EXPECT_NEAR(count, expected, 0.15 * expected) << lambda;
  }
}

TEST(SplatGeneration, LambdaZeroPassesOverNoPoint)
{
  const auto cloud = makeSphere(5000, 3);
  EXPECT_EQ(makeSplats(cloud, 1e-2, 0.0).size(), cloud->size());
}

/** Points that no surface surrounds have half the way to the next one, and no more than
 * is usual where there is a surface. */
TEST(SplatGeneration, PointsAloneReachHalfWayToTheNext)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  cloud->push_back(makePoint({0.0, 0.0, 0.0}, Vector3d::UnitZ()));
  cloud->push_back(makePoint({3.0, 0.0, 4.0}, Vector3d::UnitZ()));
  const SplatCloud pair = makeSplats(cloud, 1e-3, 0.2);
  ASSERT_EQ(2u, pair.size());
  for (const auto& splat : pair)
    EXPECT_NEAR(2.5, splat.radius, 1e-5);

  const SurfaceCloudPtr plate = makePlate(2500, 0.0, 1);
  const double spacing = spacingOf(4.0, plate->size());
  for (auto& point : *cloud)
    point.getVector3fMap() += Eigen::Vector3f(0.0f, 0.0f, 20.0f);
  *cloud += *plate;
  std::size_t alone = 0;
  for (const auto& splat : makeSplats(cloud, 1e-3, 1.0))
    if (splat.z > 10.0f) {
      ++alone;
      EXPECT_LT(splat.radius, 2.0 * spacing);
      EXPECT_GT(splat.radius, 0.2 * spacing);
    }
  EXPECT_EQ(2u, alone);
}

TEST(SplatGeneration, EveryPointIsWithinDeltaOfASplatOnItsSide)
{
  constexpr std::size_t points = 4000;
  for (const Surface& surface : {sphere, waves, knot})
    for (const double noise : {0.0, 0.02})
      for (const double delta : {1e-3, 2e-2}) // less than the noise, and as much
        for (const double lambda : {0.2, 1.0}) {
          const auto cloud = withNoise(surface.make(points, 4), noise);
          const auto discs = discsOf(makeSplats(cloud, delta, lambda));
          const auto far = std::count_if(cloud->begin(), cloud->end(), [&](auto& p) {
            const Vector3d x = positionOf(p), n = normalOf(p);
            return std::none_of(discs.begin(), discs.end(), [&](const Disc& disc) {
              return disc.covers(x, n) &&
                     std::abs(disc.local(x).z()) <= delta + rounding;
            });
          });
          EXPECT_EQ(far, 0) << surface.name << ", noise " << noise << ", delta "
                            << delta << ", lambda " << lambda;
        }
}

/** Places of the surface beside which there is no disc, of some random ones.
 * \param margin to the rims of the waves */
std::size_t
openPlaces(const Surface& surface, const std::vector<Disc>& discs, double margin)
{
  const auto places = surface.make(1000, 99);
  std::size_t open = 0;
  for (const auto& place : *places) {
    const Vector3d x = positionOf(place), n = normalOf(place);
    if (surface.make == makeWaves && x.head<2>().cwiseAbs().maxCoeff() > 1.0 - margin)
      continue;
    const bool is_covered =
        std::any_of(discs.begin(), discs.end(), [&](const Disc& disc) {
          // Beside it, not on another part of the surface far below.
          return disc.covers(x, n) && std::abs(disc.local(x).z()) < 0.5 * disc.radius;
        });
    open += is_covered ? 0 : 1;
  }
  return open;
}

TEST(SplatGeneration, LeavesNoHole_long)
{
  // With few points, or a small delta, discs are as large as gaps make them; with many
  // points, as delta does.
  for (const std::size_t points : {1000u, 20000u})
    for (const Surface& surface : {sphere, waves})
      for (const double delta : {5e-4, 5e-3})
        for (const double lambda : {0.2, 1.0}) {
          const auto splats = makeSplats(surface.make(points, 5), delta, lambda);
          // Between its last points and its rim a surface is not known to go on.
          const double margin = 3.0 * spacingOf(4.0, points);
          EXPECT_EQ(openPlaces(surface, discsOf(splats), margin), 0u)
              << surface.name << " of " << points << " points, delta " << delta
              << ", lambda " << lambda;
        }
}

/** Angles in degrees between the fields of all splats that cover a place of a sphere
 * and its normal there, at random places. */
std::vector<double>
fieldErrors(const SplatCloud& splats)
{
  const auto places = makeSphere(1000, 98);
  const auto discs = discsOf(splats);
  std::vector<double> errors;
  for (const auto& place : *places) {
    const Vector3d x = positionOf(place), n = normalOf(place);
    for (const Disc& disc : discs)
      if (disc.covers(x, n))
        errors.push_back(degreesBetween(disc.normalAt(x), n));
  }
  return errors;
}

TEST(SplatGeneration, FieldsOnASphereAreItsNormals)
{
  // Without them normals would be off by 3.6 and 7.2 degrees at the border of a disc.
  const auto cloud = makeSphere(20000, 6);
  for (const double delta : {1e-3, 4e-3})
    for (const double lambda : {0.2, 1.0}) {
      const auto errors = fieldErrors(makeSplats(cloud, delta, lambda));
      ASSERT_GE(errors.size(), 1000u); // every place is covered
      EXPECT_LT(computeMean(errors), 0.02) << delta;
      EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 0.2) << delta;
    }
}

TEST(SplatGeneration, FieldsAverageNoisyNormals)
{
  // A disc has a hundred points for three numbers in either direction: the noise goes
  // down to a sixth, even at the centre, whose own normal does not count more.
  const auto cloud = makeSphere(50000, 7);
  Random random(8);
  std::vector<double> noise;
  for (auto& point : *cloud) {
    const Vector3d before = normalOf(point);
    for (int axis = 0; axis < 3; ++axis)
      point.data_n[axis] += static_cast<float>(0.07 * (random.uniform() - 0.5));
    noise.push_back(degreesBetween(before, normalOf(point)));
  }
  const auto errors = fieldErrors(makeSplats(cloud, 4e-3, 0.5));
  ASSERT_GE(errors.size(), 1000u);
  EXPECT_LT(computeMean(errors), 0.25 * computeMean(noise));
}

TEST(SplatGeneration, SlopesAreThePrincipalCurvatures)
{
  // Around the apex, where they are -a and -b times the radius; the tangent has the
  // larger of the two. A saddle, bowls to either side, a cylinder.
  struct Curvatures {
    double a, b;
  };
  for (const auto& [a, b] :
       {Curvatures{1.0, -0.5}, {1.0, 0.4}, {-1.0, -0.3}, {2.0, 0.0}}) {
    const double tolerance = 0.03 * std::max(std::abs(a), std::abs(b));
    int seen = 0;
    for (const Disc& disc : discsOf(makeSplats(makeQuadric(a, b, 20000), 2e-3, 0.2))) {
      if (disc.center.head<2>().norm() > 0.05)
        continue;
      ++seen;
      EXPECT_NEAR(disc.slope.x() / disc.radius, std::max(-a, -b), tolerance);
      EXPECT_NEAR(disc.slope.y() / disc.radius, std::min(-a, -b), tolerance);
      EXPECT_GT(std::abs(disc.axes(0, -b > -a ? 1 : 0)), 0.995) << a << ", " << b;
    }
    EXPECT_GE(seen, 5) << a << ", " << b;
  }
}

TEST(SplatGeneration, NoDiscReachesAcrossTheRimOfASquare)
{
  constexpr std::size_t points = 4000;
  const double spacing = spacingOf(4.0, points);
  for (const double lambda : {0.2, 1.0}) {
    const auto discs =
        discsOf(makeSplats(makePlate(points, 0.0, 1), 5.0, lambda)); // allows any size
    double largest = 0.0, beyond = 0.0;
    for (const Disc& disc : discs) {
      beyond = std::max(
          beyond, disc.center.head<2>().cwiseAbs().maxCoeff() + disc.radius - 1.0);
      largest = std::max(largest, disc.radius);
    }
    // Gaps between the last points let a disc through by as much as they are wide.
    EXPECT_LT(beyond, 2.5 * spacing) << lambda;
    EXPECT_GT(largest, 20.0 * spacing) << lambda; // 31.6 at most
  }
}

TEST(SplatGeneration, ADrilledHoleStaysOpen)
{
  constexpr std::size_t points = 4000;
  constexpr double hole = 0.3;
  const double spacing = spacingOf(4.0 - pi * hole * hole, points);
  for (const double lambda : {0.2, 1.0}) {
    double largest = 0.0, reach = 0.0; // into the hole
    for (const Disc& disc :
         discsOf(makeSplats(makePlate(points, hole, 1), 5.0, lambda))) {
      reach = std::max(reach, disc.radius - (disc.center.head<2>().norm() - hole));
      largest = std::max(largest, disc.radius);
    }
    EXPECT_LT(reach, 3.0 * spacing) << lambda; // its centre is 10 spacings away
    EXPECT_GT(largest, 8.0 * spacing) << lambda;
  }
}

TEST(SplatGeneration, SheetsBackToBackAreNotMixed)
{
  constexpr double height = 0.005;
  const auto cloud = makePlate(8000, 0.0, 2);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    (*cloud)[i].z = side * static_cast<float>(height);
    (*cloud)[i].normal_z = side;
  }
  const auto discs = discsOf(makeSplats(cloud, 10.0 * height, 0.2));
  double largest = 0.0;
  for (const Disc& disc : discs) {
    EXPECT_NEAR(disc.center.z(), height * disc.normal().z(), rounding);
    EXPECT_LT(disc.error, rounding);
    EXPECT_LT(disc.tilt.norm() + disc.slope.norm(), rounding);
    largest = std::max(largest, disc.radius);
  }
  EXPECT_GT(largest, 0.5); // the other sheet does not end a disc
}

/** Of sheets that look away from each other each place has a disc of its own sheet. */
TEST(SplatGeneration, SheetsHalfASpacingApartHaveNoHoles)
{
  constexpr std::size_t points = 4000;
  const double spacing = spacingOf(4.0, points / 2);
  for (const double lambda : {0.2, 1.0})
    for (const double delta : {0.02 * spacing, 0.5 * spacing}) {
      const auto cloud = makePlate(points, 0.0, 4);
      for (std::size_t i = 0; i < points; ++i) {
        const float side = i % 2 == 0 ? 1.0f : -1.0f;
        (*cloud)[i].z = 0.25f * side * static_cast<float>(spacing);
        (*cloud)[i].normal_z = side;
      }
      const auto discs = discsOf(makeSplats(cloud, delta, lambda));
      Random random(7);
      const double inner = 1.0 - 3.0 * spacing; // where the sheets surely go on
      std::size_t open = 0;
      for (int i = 0; i < 20000; ++i) {
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const Vector3d place(inner * (2.0 * random.uniform() - 1.0),
                             inner * (2.0 * random.uniform() - 1.0),
                             0.25 * side * spacing);
        open += std::none_of(discs.begin(), discs.end(), [&](const Disc& disc) {
          return disc.normal().z() * side > 0.0 &&
                 disc.covers(place, side * Vector3d::UnitZ());
        });
      }
      EXPECT_EQ(0u, open) << "lambda " << lambda << ", delta " << delta;
    }
}

} // namespace test_splat_generation
