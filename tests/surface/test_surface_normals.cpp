// SPDX-License-Identifier: BSD-3-Clause
// PCA normals on surfaces whose normals are known, and where there is no surface.
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/search/kdtree.h>

#include <atomic>
#include <cmath>
#include <limits>

namespace test_surface_normals {

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Estimation = pcl_uvol::SurfaceNormalEstimation<pcl::PointNormal>;
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

/** Points on a sphere; own normals are rough outside vectors of any length. */
Cloud::Ptr
makeSphere(std::size_t n, float radius, const Eigen::Vector3f& center, float side)
{
  uvol_test::Random random(1);
  Cloud::Ptr cloud(new Cloud);
  while (cloud->size() < n) {
    const Eigen::Vector3f p(static_cast<float>(2 * random.uniform() - 1),
                            static_cast<float>(2 * random.uniform() - 1),
                            static_cast<float>(2 * random.uniform() - 1));
    if (p.norm() > 1.0f || p.norm() < 0.1f)
      continue;
    pcl::PointNormal point;
    point.getVector3fMap() = center + radius * p.normalized();
    point.getNormalVector3fMap() =
        side * (3.0f * p.normalized() + Eigen::Vector3f(0.3f, 0.2f, 0.1f));
    cloud->push_back(point);
  }
  return cloud;
}

pcl::PointCloud<pcl::Normal>
estimate(const Cloud::Ptr& cloud, std::size_t k = 30, unsigned threads = 0)
{
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(k);
  estimation.setNumberOfThreads(threads);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  return normals;
}

TEST(SurfaceNormals, OfASphereAreRadialAndLookToTheOutsideVectors)
{
  for (const float side : {1.0f, -1.0f})
    for (const Eigen::Vector3f& center :
         {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1e4f, -1e4f, 50.0f)}) {
      const auto cloud = makeSphere(20000, 10.0f, center, side);
      const auto normals = estimate(cloud);
      ASSERT_EQ(cloud->size(), normals.size());
      for (std::size_t i = 0; i < normals.size(); ++i) {
        const Eigen::Vector3f radial =
            side * ((*cloud)[i].getVector3fMap() - center).normalized();
        // neighbours reach 0.4 of radius 10: the plane tilts by a few hundredths at
        // most
        EXPECT_GT(radial.dot(normals[i].getNormalVector3fMap()), 0.998f);
        EXPECT_LT(normals[i].curvature, 0.01f);
      }
    }
}

TEST(SurfaceNormals, TwoNearLayersKeepTheirSides)
{
  const auto outer = makeSphere(20000, 10.0f, {0, 0, 0}, 1.0f);
  const auto inner = makeSphere(20000, 9.0f, {0, 0, 0}, -1.0f);
  Cloud::Ptr both(new Cloud(*outer));
  *both += *inner;
  const auto normals = estimate(both, 12);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_GT((*both)[i].getNormalVector3fMap().normalized().dot(
                  normals[i].getNormalVector3fMap()),
              0.8f);
}

/** Two planes a distance apart that look away from each other, a point per unit of
 * area; outside vectors lie up to 75 degrees off, as edges between samples do. */
Cloud::Ptr
makeSheets(float distance)
{
  uvol_test::Random random(3);
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 8000; ++i) {
    const float side = i % 2 == 0 ? 1.0f : -1.0f;
    pcl::PointNormal point;
    point.getVector3fMap() << static_cast<float>(63.0 * random.uniform()),
        static_cast<float>(63.0 * random.uniform()), 0.5f * side * distance;
    const double slant = std::tan(1.3 * random.uniform());
    const double turn = 6.283185307 * random.uniform();
    point.getNormalVector3fMap() << static_cast<float>(slant * std::cos(turn)),
        static_cast<float>(slant * std::sin(turn)), side;
    cloud->push_back(point);
  }
  return cloud;
}

TEST(SurfaceNormals, SheetsThatLookAwayFromEachOtherAreNotMixed)
{
  for (const float distance : {2.0f, 1.0f, 0.5f}) {
    const auto sheets = makeSheets(distance);
    const auto normals = estimate(sheets);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const float side = (*sheets)[i].z > 0.0f ? 1.0f : -1.0f;
      wrong += side * normals[i].normal_z < 0.9999f ? 1 : 0;
    }
    EXPECT_LE(wrong, normals.size() / 40) << distance;
  }
}

TEST(SurfaceNormals, APointThatLooksTheWrongWayKeepsThePlaneOfItsNeighbors)
{
  const auto sheets = makeSheets(0.0f);
  for (auto& point : *sheets)
    point.getNormalVector3fMap() << 0.0f, 0.0f, 1.0f;
  (*sheets)[100].getNormalVector3fMap() << 0.0f, 0.7f, -0.7f;
  EXPECT_NEAR(-1.0f, estimate(sheets)[100].normal_z, 1e-6f);
}

TEST(SurfaceNormals, WithoutNormalsTheViewPointDecides)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr plane(new pcl::PointCloud<pcl::PointXYZ>);
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column)
      plane->push_back({static_cast<float>(column), static_cast<float>(row), 5.0f});
  pcl_uvol::SurfaceNormalEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(plane);
  for (const float z : {9.0f, 0.0f}) {
    estimation.setViewPoint(4.0f, 4.0f, z);
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    for (const auto& normal : normals) {
      EXPECT_NEAR(z > 5.0f ? 1.0f : -1.0f, normal.normal_z, 1e-6f);
      EXPECT_NEAR(0.0f, normal.curvature, 1e-6f);
    }
  }
}

TEST(SurfaceNormals, ScaleGivesTheNormalsOfTheOriginalSpace)
{
  // An ellipsoid that the scale turns into a sphere.
  const auto sphere = makeSphere(20000, 10.0f, {0, 0, 0}, 1.0f);
  Cloud::Ptr ellipsoid(new Cloud(*sphere));
  for (auto& point : *ellipsoid)
    point.z /= 8.0f;
  Estimation estimation;
  estimation.setInputCloud(ellipsoid);
  estimation.setScale({1.0f, 1.0f, 8.0f});
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Eigen::Vector3f gradient = (*ellipsoid)[i].getVector3fMap();
    gradient[2] *= 64.0f;
    EXPECT_GT(gradient.normalized().dot(normals[i].getNormalVector3fMap()), 0.98f);
  }
}

/** A plane across x, of which nothing else is left where x is stretched so much. */
TEST(SurfaceNormals, StretchedBeyondSquaresOfFloatsTheyAreUnitVectors)
{
  Cloud::Ptr cloud(new Cloud);
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column) {
      pcl::PointNormal point;
      point.getVector3fMap() << 0.0f, static_cast<float>(column),
          static_cast<float>(row);
      point.getNormalVector3fMap() << -1.0f, 0.5f, 0.0f;
      cloud->push_back(point);
    }
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(9);
  estimation.setScale({1e30f, 1.0f, 1.0f});
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  for (const pcl::Normal& normal : normals)
    EXPECT_EQ(Eigen::Vector3f(-1, 0, 0), normal.getNormalVector3fMap());
}

/** Of the shortest vectors that a float can hold no direction is left. */
TEST(SurfaceNormals, OwnNormalsNearZeroAreNone)
{
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 20; ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() << static_cast<float>(i), 0.0f, 1.0f;
    point.getNormalVector3fMap() << 2e-43f, 0.0f, 5e-44f;
    cloud->push_back(point);
  }
  for (const pcl::Normal& normal : estimate(cloud, 5))
    EXPECT_NEAR(1.0f, normal.getNormalVector3fMap().norm(), 1e-6f);
}

TEST(SurfaceNormals, SameForAnyNumberOfThreads)
{
  const auto cloud = makeSphere(5000, 1.0f, {0, 0, 0}, 1.0f);
  const auto one = estimate(cloud, 20, 1), two = estimate(cloud, 20, 2);
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_EQ(one[i].getNormalVector4fMap(), two[i].getNormalVector4fMap());
}

TEST(SurfaceNormals, DegenerateNeighborhoodsTakeTheOutsideVector)
{
  for (const int n : {1, 2, 50}) { // one point, two, a line
    Cloud::Ptr cloud(new Cloud);
    for (int i = 0; i < n; ++i) {
      pcl::PointNormal point;
      point.x = point.y = point.z = static_cast<float>(i);
      point.normal_y = 2.0f;
      cloud->push_back(point);
    }
    Estimation estimation;
    estimation.setInputCloud(cloud);
    pcl::PointCloud<pcl::Normal> normals;
    estimation.compute(normals);
    EXPECT_EQ(static_cast<std::uint64_t>(n),
              estimation.getReport().getCount("degenerate_normals"));
    for (const auto& normal : normals)
      EXPECT_EQ(Eigen::Vector3f(0, 1, 0),
                Eigen::Vector3f(normal.getNormalVector3fMap()));
  }
}

TEST(SurfaceNormals, DuplicatesAndNonFinitePointsStayInLine)
{
  const auto cloud = makeSphere(1000, 1.0f, {0, 0, 0}, 1.0f);
  const auto expected = estimate(cloud);
  cloud->push_back((*cloud)[7]);
  cloud->push_back((*cloud)[7]);
  cloud->back().x = nan_value;
  const auto normals = estimate(cloud);
  EXPECT_FALSE(normals.is_dense);
  EXPECT_TRUE(std::isnan(normals.back().normal_x));
  EXPECT_EQ(normals[7].getNormalVector4fMap(), normals[1000].getNormalVector4fMap());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(expected[i].getNormalVector4fMap(), normals[i].getNormalVector4fMap());
}

TEST(SurfaceNormals, OfSeveralIsosurfacesAreFittedOneByOne)
{
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  for (const float z : {0.0f, 0.5f}) // as near to each other as their points
    for (int i = 0; i < 400; ++i) {
      pcl_uvol::PointIso point;
      const int row = i / 20;
      point.x = static_cast<float>(i % 20);
      point.y = static_cast<float>(row);
      point.z = z;
      point.isovalue = z;
      point.normal_x = 0.6f;
      point.normal_z = z == 0.0f ? 0.8f : -0.8f;
      isopoints.push_back(point);
    }
  pcl_uvol::Report report;
  pcl_uvol::detail::replaceNormals(isopoints, {}, 0, report);
  for (const pcl_uvol::PointIso& point : isopoints)
    EXPECT_NEAR(point.isovalue == 0.0f ? 1.0f : -1.0f, point.normal_z, 1e-6f);
}

TEST(SurfaceNormals, AllEqualPointsAreOneDegenerateSample)
{
  const auto one = makeSphere(1, 1.0f, {0, 0, 0}, 1.0f);
  Cloud::Ptr equal(new Cloud);
  for (int i = 0; i < 40; ++i)
    equal->push_back((*one)[0]);
  const Eigen::Vector3f outside = (*one)[0].getNormalVector3fMap().normalized();
  for (const auto& normal : estimate(equal))
    EXPECT_LT((outside - normal.getNormalVector3fMap()).norm(), 1e-6f);
}

TEST(SurfaceNormals, TurnWithTheCloud)
{
  const auto cloud = makeSphere(5000, 1.0f, {0, 0, 0}, 1.0f);
  for (auto& point : *cloud)
    point.z *= 0.5f; // curvatures differ from place to place
  const Eigen::Matrix3f turn =
      (Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, 3).normalized())).matrix();
  Cloud::Ptr turned(new Cloud(*cloud));
  for (auto& point : *turned) {
    point.getVector3fMap() = 100.0f * (turn * point.getVector3fMap());
    point.getNormalVector3fMap() = turn * point.getNormalVector3fMap();
  }
  const auto before = estimate(cloud), after = estimate(turned);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_GT(
        (turn * before[i].getNormalVector3fMap()).dot(after[i].getNormalVector3fMap()),
        0.9999f);
}

TEST(SurfaceNormals, OfIndicesAreThoseOfTheCloudOfThesePoints)
{
  const auto cloud = makeSphere(2000, 1.0f, {0, 0, 0}, 1.0f);
  const pcl::IndicesPtr indices(new pcl::Indices);
  Cloud::Ptr chosen(new Cloud);
  for (int i = 1999; i >= 0; i -= 3) {
    indices->push_back(i);
    chosen->push_back((*cloud)[static_cast<std::size_t>(i)]);
  }
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(indices);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  const auto expected = estimate(chosen);
  ASSERT_EQ(expected.size(), normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_EQ(expected[i].getNormalVector4fMap(), normals[i].getNormalVector4fMap());
}

/** Counts its queries. */
class CountingSearch : public pcl::search::KdTree<pcl::PointXYZ> {
public:
  using KdTree::nearestKSearch;
  int
  nearestKSearch(const pcl::PointXYZ& point,
                 int k,
                 pcl::Indices& indices,
                 std::vector<float>& sq_dists) const override
  {
    ++queries;
    return KdTree::nearestKSearch(point, k, indices, sq_dists);
  }
  mutable std::atomic<std::size_t> queries{0};
};

TEST(SurfaceNormals, TheSearchOfTheUserIsHonoured)
{
  const auto cloud = makeSphere(2000, 1.0f, {0, 0, 0}, 1.0f);
  const pcl::shared_ptr<CountingSearch> search(new CountingSearch);
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(search);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  EXPECT_EQ(cloud->size(), search->queries);
  const auto expected = estimate(cloud);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_EQ(expected[i].getNormalVector4fMap(), normals[i].getNormalVector4fMap());
}

TEST(SurfaceNormals, BadInputThrows)
{
  const auto good = makeSphere(100, 1.0f, {0, 0, 0}, 1.0f);
  const auto expectThrow = [](const Cloud::Ptr& cloud, auto&& configure) {
    Estimation estimation;
    if (cloud)
      estimation.setInputCloud(cloud);
    configure(estimation);
    pcl::PointCloud<pcl::Normal> normals(2, 1);
    EXPECT_THROW(estimation.compute(normals), pcl_uvol::InvalidArgument);
    EXPECT_EQ(2u, normals.size());
  };
  const auto nothing = [](Estimation&) {};
  expectThrow(nullptr, nothing);
  expectThrow(Cloud::Ptr(new Cloud), nothing);
  expectThrow(good, [](Estimation& e) { e.setKSearch(1); });
  expectThrow(good, [](Estimation& e) { e.setScale({0.0f, 1.0f, 1.0f}); });
  expectThrow(good, [](Estimation& e) { e.setScale({nan_value, 1.0f, 1.0f}); });
  Cloud::Ptr nowhere(new Cloud(*good));
  for (auto& point : *nowhere)
    point.x = nan_value;
  expectThrow(nowhere, nothing);
}

} // namespace test_surface_normals
