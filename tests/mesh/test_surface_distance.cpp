// SPDX-License-Identifier: BSD-3-Clause
// Distances between surfaces: against all triangles tried, and between spheres and
// planes that are known.
#include "measured_shapes.h"
#include "mesh/surface_distance.h"
#include "mesh/triangle_tree.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace test_surface_distance {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using namespace uvol_test;

Eigen::Vector3d
anywhere(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const double x = any(random), y = any(random);
  return {x, y, any(random)};
}

TEST(TriangleTree, NearestPointsAreNoFartherThanAnyOther)
{
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    std::array<Eigen::Vector3d, 3> corners = {
        anywhere(random), anywhere(random), anywhere(random)};
    if (i % 4 == 1) // a line
      corners[2] = 0.3 * corners[0] + 0.7 * corners[1];
    if (i % 4 == 2) // a point
      corners[1] = corners[2] = corners[0];
    const Eigen::Vector3d place = 2.0 * anywhere(random);
    const TrianglePoint nearest = nearestOfTriangle(corners, place);
    const double distance = (nearest.place - place).norm();
    double sum = 0.0;
    Eigen::Vector3d made = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(nearest.lambda[k], 0.0);
      sum += nearest.lambda[k];
      made += nearest.lambda[k] * corners[k];
    }
    EXPECT_NEAR(1.0, sum, 1e-12);
    EXPECT_LT((made - nearest.place).norm(), 1e-12);
    double best = std::numeric_limits<double>::infinity();
    constexpr int steps = 60;
    for (int u = 0; u <= steps; ++u)
      for (int v = 0; u + v <= steps; ++v) {
        const double p = static_cast<double>(u) / steps,
                     q = static_cast<double>(v) / steps;
        best = std::min(
            best,
            (p * corners[0] + q * corners[1] + (1.0 - p - q) * corners[2] - place)
                .norm());
      }
    EXPECT_LE(distance, best + 1e-12);
    EXPECT_GE(distance, best - 0.06);
  }
}

TEST(TriangleTree, FindsWhatTryingAllFinds)
{
  std::mt19937_64 random(2);
  const MeasuredShape shape = makeTorus(0.6, 0.3, 24, 11);
  const TriangleTree tree(shape.places, shape.triangles);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d place = anywhere(random);
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : shape.triangles)
      best = std::min(
          best,
          (nearestOfTriangle({shape.places[a], shape.places[b], shape.places[c]}, place)
               .place -
           place)
              .norm());
    const TriangleTree::Nearest found = tree.find(place);
    EXPECT_EQ(best, found.distance);
    EXPECT_EQ(best, (found.point.place - place).norm());
  }
}

/** Two squares above a plane: a large one at the height 1, and one of a four-thousandth
 * of its area at 5. */
TEST(SurfaceDistance, TrianglesWeighAsMuchAsTheirArea)
{
  MeasuredShape plane, squares;
  const auto add = [](MeasuredShape& shape, double half, double height) {
    const auto first = static_cast<std::uint32_t>(shape.places.size());
    for (const auto& [x, y] :
         {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      shape.places.emplace_back(half * x, half * y, height);
    shape.triangles.push_back({first, first + 1, first + 2});
    shape.triangles.push_back({first, first + 2, first + 3});
  };
  add(plane, 64.0, 0.0);
  add(squares, 32.0, 1.0);
  add(squares, 0.5, 5.0);
  const Dataset of_plane = plane.toDataset(), of_squares = squares.toDataset();
  const SurfaceDistances distances =
      measureDistances({of_squares, squares.triangles}, {of_plane, plane.triangles}, 1);
  constexpr double all = 4096.0 + 1.0;
  EXPECT_NEAR((4096.0 * 1.0 + 1.0 * 5.0) / all, distances.mean, 1e-9);
  EXPECT_NEAR(std::sqrt((4096.0 + 25.0) / all), distances.root_mean_square, 1e-9);
  EXPECT_NEAR(5.0, distances.largest, 1e-9);
  EXPECT_NEAR(1.0, distances.permille, 1e-9) << "the small one is less than a permille";
}

TEST(SurfaceDistance, SpheresInEachOther)
{
  const MeasuredShape large = makeEllipsoid({1.0, 1.0, 1.0}, 5),
                      small = makeEllipsoid({0.75, 0.75, 0.75}, 5);
  Dataset of_large = large.toDataset(), of_small = small.toDataset();
  setField(of_large, "f", std::vector<float>(large.places.size(), 3.0f));
  setField(of_small, "f", std::vector<float>(small.places.size(), 1.0f));
  const SurfaceDistances inwards = measureDistances({of_large, large.triangles},
                                                    {of_small, small.triangles},
                                                    2),
                         outwards = measureDistances({of_small, small.triangles},
                                                     {of_large, large.triangles},
                                                     1);
  for (const SurfaceDistances& distances : {inwards, outwards}) {
    EXPECT_NEAR(0.25, distances.mean, 2e-3);
    EXPECT_NEAR(0.25, distances.root_mean_square, 2e-3);
    EXPECT_NEAR(0.25, distances.permille, 2e-3);
    EXPECT_NEAR(0.25, distances.largest, 2e-3);
    ASSERT_EQ(1u, distances.fields.size());
    EXPECT_NEAR(2.0, distances.fields[0].mean, 1e-12);
    EXPECT_NEAR(2.0, distances.fields[0].largest, 1e-12);
  }
  for (const float distance : inwards.at_vertices)
    ASSERT_GT(distance, 0.2f);
  for (const float distance : outwards.at_vertices)
    ASSERT_LT(distance, -0.2f);
  const SurfaceDistances same =
      measureDistances({of_large, large.triangles}, {of_large, large.triangles}, 2);
  EXPECT_LT(same.largest, 1e-7);
}

TEST(SurfaceDistance, FindsTheSpike)
{
  const MeasuredShape box = makeBox({1.0, 1.0, 1.0});
  MeasuredShape spiked = box;
  spiked.places[7] = {1.0, 1.0, 3.0};
  Dataset a = spiked.toDataset(), b = box.toDataset();
  a.origin = b.origin = {{5e6, 0.0, 0.0}};
  const SurfaceDistances out = measureDistances(
                             {a, spiked.triangles}, {b, box.triangles}, 2),
                         back = measureDistances(
                             {b, box.triangles}, {a, spiked.triangles}, 2);
  EXPECT_DOUBLE_EQ(2.0, out.largest);
  EXPECT_EQ(5e6 + 1.0, out.farthest[0]);
  EXPECT_EQ(3.0, out.farthest[2]);
  EXPECT_LT(back.largest, 1.0);
  EXPECT_GT(out.largest, out.permille);
  EXPECT_GT(out.root_mean_square, out.mean);
  // Another origin of the same place.
  b.origin = {{5e6 - 2.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(
      2.0, measureDistances({b, box.triangles}, {a, spiked.triangles}, 2).largest);
}

TEST(SurfaceDistance, PointsCountEachTheSame)
{
  MeasuredShape points, line;
  points.places = {{0.0, 1.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 6.0, 0.0}};
  line.places = {{-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const SurfaceDistances distances = measureDistances(
      {points.toDataset(), points.triangles}, {line.toDataset(), line.triangles}, 1);
  EXPECT_DOUBLE_EQ(3.0, distances.mean);
  EXPECT_DOUBLE_EQ(6.0, distances.largest);
  EXPECT_EQ((std::vector<float>{1.0f, 2.0f, 6.0f}), distances.at_vertices);
}

TEST(SurfaceDistance, RefusesWhatIsNoSurface)
{
  const MeasuredShape box = makeBox({1.0, 1.0, 1.0});
  const Dataset good = box.toDataset();
  MeasuredShape bad = box;
  bad.triangles[0][0] = 99;
  EXPECT_THROW(measureDistances({good, bad.triangles}, {good, box.triangles}, 1),
               InvalidArgument);
  EXPECT_THROW(measureDistances({good, box.triangles}, {Dataset(), {}}, 1),
               InvalidArgument);
  bad = box;
  bad.places[3][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(
      measureDistances({bad.toDataset(), bad.triangles}, {good, box.triangles}, 1),
      InvalidArgument);
}

} // namespace test_surface_distance
