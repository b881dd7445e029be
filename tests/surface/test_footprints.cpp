// SPDX-License-Identifier: BSD-3-Clause
// Discs that leave no hole, rims, and the nearest points.
#include "support/surfaces.h"
#include "surface/footprints.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace test_footprints {

using pcl_uvol::Footprints;
using uvol_test::SurfaceCloudPtr;

/** A surface and its footprints. */
struct Surface {
  pcl_uvol::OrientedPoints points;
  Footprints footprints;

  template <typename PointT>
  explicit Surface(const pcl::PointCloud<PointT>& cloud, unsigned threads = 0)
  {
    std::vector<std::uint32_t> all(cloud.size());
    std::iota(all.begin(), all.end(), 0u);
    pcl_uvol::Report report;
    points = pcl_uvol::orientPoints(pcl_uvol::viewOf(cloud), all, threads, report);
    footprints = pcl_uvol::computeFootprints(points, threads, report);
    const auto& unit = points.samples->getUnit();
    for (float& radius : footprints.radii)
      radius = static_cast<float>(unit.toInput(radius));
  }

  std::size_t
  size() const
  {
    return points.samples->size();
  }

  Eigen::Vector3f
  position(std::size_t i) const
  {
    return Eigen::Vector3f(points.samples->getPositions()[i].x) /
           points.samples->getUnit().factor;
  }

  double
  medianRadius() const
  {
    std::vector<float> radii = footprints.radii;
    std::nth_element(radii.begin(), radii.begin() + radii.size() / 2, radii.end());
    return radii[radii.size() / 2];
  }
};

/** Part of the places that no disc covers, of random places in the middle of a square
 * whose points lie in the plane z = 0. */
double
uncovered(const Surface& surface, float half_side)
{
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<float> place(-half_side, half_side);
  constexpr int tries = 2000;
  int open = 0;
  for (int i = 0; i < tries; ++i) {
    const Eigen::Vector3f x(place(engine), place(engine), 0.0f);
    bool is_covered = false;
    for (std::size_t j = 0; j < surface.size() && !is_covered; ++j)
      is_covered = (surface.position(j) - x).norm() <= surface.footprints.radii[j];
    open += is_covered ? 0 : 1;
  }
  return static_cast<double>(open) / tries;
}

/** Random points of the square of side 2 in the plane z = 0. */
pcl::PointCloud<pcl::PointNormal>
makePlane(std::size_t n)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointNormal point;
    point.x = place(engine);
    point.y = place(engine);
    point.normal_z = 1.0f;
    cloud.push_back(point);
  }
  return cloud;
}

TEST(Footprints, CoverThePlaneAndHardlyMore)
{
  const Surface surface(makePlane(4000));
  EXPECT_EQ(uncovered(surface, 0.9f), 0.0);
  // Random points have holes of more than a spacing, few of more than two.
  const double spacing = std::sqrt(4.0 / 4000);
  EXPECT_LT(surface.medianRadius(), 1.3 * spacing);
  EXPECT_GT(surface.medianRadius(), 0.8 * spacing);
}

TEST(Footprints, ReachAcrossTheLinesOfAScan)
{
  // Ten times denser along the lines than across: the 16 nearest lie on one line.
  pcl::PointCloud<pcl::PointNormal> lines;
  for (int line = -20; line <= 20; ++line)
    for (int i = -200; i <= 200; ++i) {
      pcl::PointNormal point;
      point.x = 0.005f * static_cast<float>(i);
      point.y = 0.05f * static_cast<float>(line) + 0.001f * static_cast<float>(i % 2);
      point.normal_z = 1.0f;
      lines.push_back(point);
    }
  const Surface surface(lines);
  EXPECT_EQ(uncovered(surface, 0.8f), 0.0);
  EXPECT_LT(surface.medianRadius(), 0.04);
}

TEST(Footprints, StayAtTheRimAndAtOutliers)
{
  auto plane = makePlane(4000);
  pcl::PointNormal outlier;
  outlier.z = 0.4f;
  outlier.normal_z = 1.0f;
  plane.push_back(outlier);
  const Surface surface(plane);
  const double spacing = std::sqrt(4.0 / 4000);
  std::vector<double> beyond_rim;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f x = surface.position(i);
    const double radius = surface.footprints.radii[i];
    const double beyond = std::max(std::abs(x.x()), std::abs(x.y())) + radius - 1.0;
    if (surface.points.samples->getInputIndex(i) == 4000)
      EXPECT_LT(radius, 4.0 * spacing);
    else if (beyond > 0.0)
      beyond_rim.push_back(beyond);
  }
  ASSERT_GT(beyond_rim.size(), 100u);
  std::sort(beyond_rim.begin(), beyond_rim.end());
  EXPECT_LT(beyond_rim[beyond_rim.size() / 2], 0.7 * spacing);
  EXPECT_LT(beyond_rim.back(), 3.0 * spacing);
}

/** A plane with a round hole of a radius in spacings, and a point alone in its middle,
 * which has a cell as wide as half the hole. */
pcl::PointCloud<pcl::PointNormal>
makeHoleWithOutlier(float hole)
{
  pcl::PointCloud<pcl::PointNormal> plane;
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<float> shift(-0.2f, 0.2f);
  for (int y = -30; y <= 30; ++y)
    for (int x = -30; x <= 30; ++x) {
      const bool is_center = x == 0 && y == 0;
      if (!is_center && std::hypot(x, y) < hole)
        continue;
      pcl::PointNormal point;
      point.x = static_cast<float>(x) + (is_center ? 0.0f : shift(engine));
      point.y = static_cast<float>(y) + (is_center ? 0.0f : shift(engine));
      point.normal_z = 1.0f;
      plane.push_back(point);
    }
  return plane;
}

std::size_t
findOutlier(const Surface& surface)
{
  std::size_t outlier = 0;
  for (std::size_t i = 0; i < surface.size(); ++i)
    if (surface.position(i).norm() < surface.position(outlier).norm())
      outlier = i;
  EXPECT_EQ(0.0f, surface.position(outlier).norm());
  return outlier;
}

TEST(Footprints, OfAPlantedOutlierAreAtMostThreeTimesThoseOfItsNeighbours)
{
  const Surface surface(makeHoleWithOutlier(12.0f));
  const auto& [radii, fillers, on_rim, bends, rims, nearest] = surface.footprints;
  const std::size_t outlier = findOutlier(surface);
  constexpr std::size_t compared = 8;
  float largest = 0.0f;
  for (std::size_t k = 0; k < compared; ++k)
    largest = std::max(largest, radii[nearest[outlier][k]]);
  EXPECT_LT(largest, 1.5f);
  EXPECT_GT(largest, 0.5f);
  EXPECT_NEAR(3.0 * largest, radii[outlier], 1e-5 * largest);
  EXPECT_LE(fillers[outlier], radii[outlier]);
}

TEST(Footprints, OfAPointThatIsAloneAreNone)
{
  const Surface surface(makeHoleWithOutlier(20.0f));
  const std::size_t outlier = findOutlier(surface);
  EXPECT_EQ(0.0f, surface.footprints.radii[outlier]);
  EXPECT_EQ(1, surface.footprints.on_rim[outlier]);
}

/** No surface goes through them. Where the plane of one meets the ball, next to points
 * that look nearly as it does, its disc is no larger than two spacings. */
TEST(Footprints, OfSpecksBesideASurfaceAreNone)
{
  const auto ball = uvol_test::makeSphere(6000, 1);
  const float spacing = std::sqrt(4.0f * 3.14159265f / 6000.0f);
  constexpr float oblique = 0.8f;
  auto cloud = *ball;
  std::vector<float> most;
  for (const float height : {2.5f, 4.0f, 6.0f})
    for (const float tilt : {0.0f, oblique, 1.5f, 3.1f}) {
      pcl::PointNormal speck;
      const auto place = static_cast<float>(most.size());
      const Eigen::Vector3f up(std::cos(place), std::sin(place), 0.0f);
      speck.getVector3fMap() = (1.0f + height * spacing) * up;
      speck.getNormalVector3fMap() =
          std::cos(tilt) * up + std::sin(tilt) * Eigen::Vector3f::UnitZ();
      cloud.push_back(speck);
      most.push_back(tilt == oblique ? 2.0f * spacing : 0.0f);
    }
  const Surface clean(*ball), surface(cloud);
  const float largest =
      *std::max_element(clean.footprints.radii.begin(), clean.footprints.radii.end());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::size_t input = surface.points.samples->getInputIndex(i);
    const bool is_speck = input >= ball->size();
    EXPECT_LE(surface.footprints.radii[i],
              is_speck ? most[input - ball->size()] : largest)
        << input;
  }
}

/** Normals of neighbours are 63 degrees apart, and there are few of them. */
TEST(Footprints, CoverCoarseModels)
{
  const float golden = 0.5f * (1.0f + std::sqrt(5.0f));
  pcl::PointCloud<pcl::PointNormal> icosahedron;
  for (const float one : {-1.0f, 1.0f})
    for (const float other : {-golden, golden})
      for (int axis = 0; axis < 3; ++axis) {
        pcl::PointNormal vertex;
        vertex.data[axis] = one;
        vertex.data[(axis + 1) % 3] = other;
        vertex.getNormalVector3fMap() = vertex.getVector3fMap().normalized();
        icosahedron.push_back(vertex);
      }
  const Surface surface(icosahedron);
  // Centres of triangles are 1.155 away from their corners.
  for (const float radius : surface.footprints.radii)
    EXPECT_GT(radius, 1.1f);
  auto triangle = icosahedron;
  triangle.resize(3);
  for (auto& corner : triangle)
    corner.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
  for (const float radius : Surface(triangle).footprints.radii)
    EXPECT_GT(radius, 0.0f);
}

/** Isopoints on a sphere about a place. */
void
addIsopoints(const Eigen::Vector3f& center,
             float radius,
             std::size_t n,
             float isovalue,
             float edge_length,
             pcl::PointCloud<pcl_uvol::PointIso>& cloud)
{
  const auto seed = static_cast<unsigned>(cloud.size());
  const auto sphere = uvol_test::makeSphere(n, seed);
  for (const pcl::PointNormal& on_sphere : *sphere) {
    pcl_uvol::PointIso point;
    point.getVector3fMap() = center + radius * on_sphere.getVector3fMap();
    point.getNormalVector3fMap() = on_sphere.getNormalVector3fMap();
    point.isovalue = isovalue;
    point.edge_length = edge_length;
    cloud.push_back(point);
  }
}

/** Specks of noise above a surface. */
void
addSpecks(float edge, pcl::PointCloud<pcl_uvol::PointIso>& cloud)
{
  constexpr std::size_t specks = 60, of_speck = 14;
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<float> place(-3.0f, 3.0f);
  for (std::size_t speck = 0; speck < specks; ++speck)
    addIsopoints({place(engine), place(engine), 4.0f + place(engine)},
                 0.4f * edge,
                 of_speck,
                 1.0f,
                 edge,
                 cloud);
}

TEST(Footprints, OfSpecksOfNoiseAreNoLargerThanTheSpecks)
{
  constexpr float edge = 0.06f;
  constexpr std::size_t of_surface = 4000;
  pcl::PointCloud<pcl_uvol::PointIso> cloud;
  addIsopoints({0.0f, 0.0f, 0.0f}, 1.0f, of_surface, 1.0f, edge, cloud);
  const float usual = static_cast<float>(Surface(cloud).medianRadius());
  addSpecks(edge, cloud);
  // Far from everything, at the ends of bridges.
  for (const float x : {20.0f, -25.0f})
    addIsopoints({x, 0.0f, 0.0f}, 0.01f, 1, 1.0f, std::abs(x), cloud);
  const Surface surface(cloud);
  std::vector<float> of_specks;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::uint32_t input = surface.points.samples->getInputIndex(i);
    const float radius = surface.footprints.radii[i];
    if (input >= cloud.size() - 2)
      EXPECT_EQ(0.0f, radius);
    else if (input >= of_surface)
      of_specks.push_back(radius);
    else
      EXPECT_LT(radius, 4.0f * usual);
  }
  std::sort(of_specks.begin(), of_specks.end());
  EXPECT_LE(of_specks.back(), 2.2f * edge);
  EXPECT_LE(of_specks[of_specks.size() * 9 / 10], 1.1f * edge);
}

TEST(Footprints, AreTheRadiiOfSplatsThatDoNotGrow)
{
  pcl::PointCloud<pcl_uvol::PointIso> cloud;
  addIsopoints({0.0f, 0.0f, 0.0f}, 1.0f, 4000, 1.0f, 0.06f, cloud);
  addSpecks(0.06f, cloud);
  const Surface surface(cloud);
  std::vector<float> radii(cloud.size());
  for (std::size_t i = 0; i < surface.size(); ++i)
    radii[surface.points.samples->getInputIndex(i)] = surface.footprints.radii[i];

  pcl_uvol::SplatGeneration<pcl_uvol::PointIso> generation;
  generation.setInputCloud(cloud.makeShared());
  generation.setAbsoluteDelta(1e-12);
  generation.setLambda(0.0);
  pcl::PointCloud<pcl_uvol::PointSplat> splats;
  generation.compute(splats);
  ASSERT_EQ(cloud.size(), splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i)
    if (const float radius = radii[generation.getSources()[i]]; radius > 0.0f)
      EXPECT_EQ(radius, splats[i].radius);
    else
      EXPECT_LT(splats[i].radius, 0.06f);
}

TEST(Footprints, OfAnIsovalueDoNotSeeAnother)
{
  pcl::PointCloud<pcl_uvol::PointIso> alone, nested;
  addIsopoints({0.0f, 0.0f, 0.0f}, 1.0f, 4000, 10.0f, 0.06f, alone);
  nested = alone;
  addIsopoints({0.0f, 0.0f, 0.0f}, 0.99f, 8000, 60.0f, 0.06f, nested);
  const Surface one(alone), both(nested);
  EXPECT_TRUE(one.points.surfaces.empty());
  std::vector<float> radii(nested.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    const std::uint32_t input = both.points.samples->getInputIndex(i);
    EXPECT_EQ(input < alone.size() ? 0 : 1, both.points.surfaces[i]);
    for (const std::uint32_t neighbor : both.footprints.nearest[i])
      EXPECT_EQ(both.points.surfaces[i], both.points.surfaces[neighbor]);
    radii[input] = both.footprints.radii[i];
  }
  std::size_t alike = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const float alone_radius = one.footprints.radii[i];
    const float radius = radii[one.points.samples->getInputIndex(i)];
    alike += std::abs(radius - alone_radius) < 1e-4f * alone_radius ? 1 : 0;
  }
  EXPECT_GT(alike, one.size() * 9 / 10);
}

TEST(Footprints, OfBridgedIsopointsAreNone)
{
  pcl::PointCloud<pcl_uvol::PointIso> cloud;
  addIsopoints({0.0f, 0.0f, 0.0f}, 1.0f, 4000, 10.0f, 0.06f, cloud);
  const Surface without(cloud);
  EXPECT_TRUE(without.points.bridged.empty());
  for (std::size_t i = 0; i < cloud.size(); i += 40) // each alone among others
    cloud[i].support = static_cast<std::uint8_t>(pcl_uvol::IsoSupport::Bridged);
  const Surface surface(cloud);
  ASSERT_EQ(surface.size(), surface.points.bridged.size());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const bool is_bridged = surface.points.samples->getInputIndex(i) % 40 == 0;
    EXPECT_EQ(is_bridged, surface.points.bridged[i] == 1);
    EXPECT_EQ(is_bridged, surface.footprints.radii[i] == 0.0f) << i;
    if (!is_bridged)
      continue;
    bool is_covered = false; // by the others
    for (std::size_t j = 0; j < surface.size(); ++j)
      is_covered |= (surface.position(j) - surface.position(i)).norm() <
                    surface.footprints.radii[j];
    EXPECT_TRUE(is_covered) << i;
  }
}

TEST(Footprints, DistinguishTheRimFromTheMiddle)
{
  const Surface surface(makePlane(4000));
  const float spacing = std::sqrt(4.0f / 4000);
  std::size_t rim = 0, marked = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const float to_rim = 1.0f - surface.position(i).cwiseAbs().maxCoeff();
    if (to_rim > 4.0f * spacing)
      EXPECT_EQ(0, surface.footprints.on_rim[i]) << to_rim / spacing;
    else if (to_rim < 0.2f * spacing) {
      ++rim;
      marked += surface.footprints.on_rim[i];
    }
  }
  ASSERT_GT(rim, 30u);
  EXPECT_GE(marked, 0.95 * static_cast<double>(rim));
}

TEST(Footprints, NearestPointsAreThoseOfBruteForce)
{
  const Surface surface(*uvol_test::makeTorusKnot(700, 6));
  for (std::uint32_t i = 0; i < surface.size(); ++i) {
    std::vector<std::pair<float, std::uint32_t>> others;
    for (std::uint32_t j = 0; j < surface.size(); ++j)
      if (j != i)
        others.emplace_back((surface.position(j) - surface.position(i)).squaredNorm(),
                            j);
    std::sort(others.begin(), others.end());
    const auto& nearest = surface.footprints.nearest[i];
    for (std::size_t k = 0; k < nearest.size(); ++k)
      EXPECT_NEAR(others[k].first,
                  (surface.position(nearest[k]) - surface.position(i)).squaredNorm(),
                  1e-6f * others[k].first);
    auto distinct = nearest;
    std::sort(distinct.begin(), distinct.end());
    EXPECT_EQ(std::adjacent_find(distinct.begin(), distinct.end()), distinct.end());
  }
}

TEST(Footprints, OfFewPointsEndWithThePointItself)
{
  const Surface surface(*uvol_test::makeSphere(3, 1));
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(1, surface.footprints.on_rim[i]);
    EXPECT_NE(i, surface.footprints.nearest[i][1]);
    EXPECT_EQ(i, surface.footprints.nearest[i][2]);
  }
}

TEST(Footprints, DoNotDependOnThreads)
{
  const SurfaceCloudPtr cloud = uvol_test::makeTorusKnot(20000, 5);
  const Footprints first = Surface(*cloud, 1).footprints;
  for (const unsigned threads : {2u, 3u, 7u}) {
    const Footprints other = Surface(*cloud, threads).footprints;
    EXPECT_EQ(first.radii, other.radii) << threads;
    EXPECT_EQ(first.fillers, other.fillers) << threads;
    EXPECT_EQ(first.on_rim, other.on_rim) << threads;
    EXPECT_EQ(first.nearest, other.nearest) << threads;
  }
}

} // namespace test_footprints
