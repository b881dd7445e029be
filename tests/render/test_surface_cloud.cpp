// SPDX-License-Identifier: BSD-3-Clause
// Points prepared for drawing: normals, blocks, and discs that leave no hole.
#include "support/environment.h"
#include "support/surfaces.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/surface_cloud.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

namespace {

using pcl_uvol::InvalidArgument;
using pcl_uvol::Report;
using pcl_uvol::SurfaceBlock;
using pcl_uvol::SurfaceCloud;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
SurfaceCloud
prepare(const pcl::PointCloud<PointT>& cloud, Report& report, unsigned threads = 0)
{
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  return SurfaceCloud(pcl_uvol::viewOf(cloud), all, threads, report);
}

Eigen::Vector3f
positionOf(const SurfaceCloud& cloud, std::size_t i)
{
  return {cloud.getCoordinates(0)[i],
          cloud.getCoordinates(1)[i],
          cloud.getCoordinates(2)[i]};
}

/** Part of the places that no disc covers, of random places in the middle of a square
 * whose points lie in the plane z = 0. */
double
uncovered(const SurfaceCloud& cloud, double half_side)
{
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<float> place(static_cast<float>(-half_side),
                                              static_cast<float>(half_side));
  constexpr int tries = 2000;
  int open = 0;
  for (int i = 0; i < tries; ++i) {
    const Eigen::Vector3f x(place(engine), place(engine), 0.0f);
    bool is_covered = false;
    for (std::size_t j = 0; j < cloud.size() && !is_covered; ++j)
      is_covered = (positionOf(cloud, j) - x).norm() <= cloud.getFootprints()[j];
    open += is_covered ? 0 : 1;
  }
  return static_cast<double>(open) / tries;
}

/** Random points of the plane z = 0, the spacing along x stretched. */
pcl::PointCloud<pcl::PointNormal>
makePlane(std::size_t n, double stretch)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointNormal point;
    point.x = static_cast<float>(stretch) * place(engine);
    point.y = place(engine);
    point.normal_z = 1.0f;
    cloud.push_back(point);
  }
  return cloud;
}

TEST(PackedNormal, IsWithinAHundredthOfADegree)
{
  std::mt19937_64 engine(1);
  std::normal_distribution<float> component;
  double largest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Vector3f normal(component(engine), component(engine), component(engine));
    if (i < 6)
      normal = (i % 2 == 0 ? 1.0f : -1.0f) * Eigen::Vector3f::Unit(i / 2);
    Eigen::Vector3f unpacked;
    pcl_uvol::unpackNormal(pcl_uvol::packNormal(normal.data()), unpacked.data());
    EXPECT_NEAR(unpacked.norm(), 1.0f, 1e-6f);
    largest = std::max(largest,
                       static_cast<double>(unpacked.cross(normal.normalized()).norm()));
    EXPECT_GT(unpacked.dot(normal), 0.0f);
  }
  EXPECT_LT(largest, 0.004 * 3.14159265 / 180.0);
}

TEST(SurfaceCloud, KeepsEveryPointOnceAndKnowsItsInput)
{
  auto cloud = uvol_test::makeTorusKnot(5000, 1);
  Report report;
  const SurfaceCloud surface = prepare(*cloud, report);
  ASSERT_EQ(surface.size(), cloud->size());
  const Eigen::Vector3f center = surface.getBounds().center.cast<float>();
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::uint32_t input = surface.getInputIndices()[i];
    EXPECT_TRUE(seen.insert(input).second);
    EXPECT_TRUE((positionOf(surface, i) + center)
                    .isApprox((*cloud)[input].getVector3fMap(), 1e-5f));
    EXPECT_LE(positionOf(surface, i).norm(), surface.getBounds().radius * 1.000001);
  }
  EXPECT_FALSE(surface.isTwoSided());
}

TEST(SurfaceCloud, BlocksHoldTheirPointsAndNormals)
{
  auto cloud = uvol_test::makeTorusKnot(20000, 2);
  Report report;
  const SurfaceCloud surface = prepare(*cloud, report);
  std::uint32_t next = 0;
  for (const SurfaceBlock& block : surface.getBlocks()) {
    EXPECT_EQ(block.begin, next);
    next = block.end;
    const Eigen::Map<const Eigen::Vector3f> center(block.center.x), axis(block.axis.x);
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      EXPECT_LE((positionOf(surface, i) - center).norm(), block.radius);
      Eigen::Vector3f normal;
      pcl_uvol::unpackNormal(surface.getNormals()[i], normal.data());
      if (block.spread < 1.0f) {
        EXPECT_GT(normal.dot(axis), 0.0f);
        EXPECT_LE(normal.cross(axis).norm(), block.spread);
      }
    }
  }
  EXPECT_EQ(next, surface.size());
}

TEST(Footprints, CoverThePlaneAndHardlyMore)
{
  Report report;
  SurfaceCloud surface = prepare(makePlane(4000, 1.0), report);
  surface.computeFootprints(0, report);
  EXPECT_EQ(uncovered(surface, 0.9), 0.0);
  // Random points have holes of more than a spacing, few of more than two.
  const double spacing = std::sqrt(4.0 / 4000);
  EXPECT_LT(surface.getTypicalFootprint(), 1.3 * spacing);
  EXPECT_GT(surface.getTypicalFootprint(), 0.8 * spacing);
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
  Report report;
  SurfaceCloud surface = prepare(lines, report);
  surface.computeFootprints(0, report);
  EXPECT_EQ(uncovered(surface, 0.8), 0.0);
  EXPECT_LT(surface.getTypicalFootprint(), 0.04f);
}

TEST(Footprints, StayAtTheRimAndAtOutliers)
{
  auto plane = makePlane(4000, 1.0);
  pcl::PointNormal outlier;
  outlier.z = 0.4f;
  outlier.normal_z = 1.0f;
  plane.push_back(outlier);
  Report report;
  SurfaceCloud surface = prepare(plane, report);
  surface.computeFootprints(0, report);
  const double spacing = std::sqrt(4.0 / 4000);
  std::vector<double> beyond_rim;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f x =
        positionOf(surface, i) + surface.getBounds().center.cast<float>();
    const double beyond =
        std::max(std::abs(x.x()), std::abs(x.y())) + surface.getFootprints()[i] - 1.0;
    if (surface.getInputIndices()[i] == 4000)
      EXPECT_LT(surface.getFootprints()[i], 4.0 * spacing);
    else if (beyond > 0.0)
      beyond_rim.push_back(beyond);
  }
  ASSERT_GT(beyond_rim.size(), 100u);
  std::sort(beyond_rim.begin(), beyond_rim.end());
  EXPECT_LT(beyond_rim[beyond_rim.size() / 2], 0.7 * spacing);
  EXPECT_LT(beyond_rim.back(), 3.0 * spacing);
}

TEST(Footprints, DoNotDependOnThreads)
{
  auto cloud = uvol_test::makeTorusKnot(20000, 5);
  std::vector<float> first;
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    Report report;
    SurfaceCloud surface = prepare(*cloud, report, threads);
    surface.computeFootprints(threads, report);
    if (first.empty())
      first = surface.getFootprints();
    EXPECT_EQ(surface.getFootprints(), first) << threads;
  }
}

TEST(SurfaceCloud, EstimatesNormalsWhereThereAreNone)
{
  pcl::PointCloud<pcl::PointXYZ> bare;
  const auto sphere = uvol_test::makeSphere(2000, 4);
  for (const auto& point : *sphere)
    bare.push_back({point.x, point.y, point.z});
  Report report;
  const SurfaceCloud surface = prepare(bare, report);
  EXPECT_TRUE(surface.isTwoSided());
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("no normals"), std::string::npos);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    Eigen::Vector3f normal;
    pcl_uvol::unpackNormal(surface.getNormals()[i], normal.data());
    EXPECT_GT(std::abs(normal.dot(positionOf(surface, i).normalized())), 0.97f);
  }
}

TEST(SurfaceCloud, LeavesOutPointsThatCannotBeDrawn)
{
  auto cloud = uvol_test::makeSphere(100, 1);
  (*cloud)[3].x = nan_value;
  (*cloud)[4].normal_y = nan_value;
  (*cloud)[5].getNormalVector3fMap().setZero();
  (*cloud)[6].getVector3fMap() = (*cloud)[7].getVector3fMap();
  Report report;
  const SurfaceCloud surface = prepare(*cloud, report);
  EXPECT_EQ(surface.size(), 96u);
  EXPECT_EQ(report.getCount("points"), 100u);
  EXPECT_EQ(report.getCount("non_finite"), 1u);
  EXPECT_EQ(report.getCount("without_normal"), 2u);
  EXPECT_EQ(report.getCount("duplicates"), 1u);
}

TEST(SurfaceCloud, TakesOneAndTwoPoints)
{
  for (const std::size_t n : {1u, 2u}) {
    Report report;
    SurfaceCloud surface = prepare(*uvol_test::makeSphere(n, 1), report);
    EXPECT_EQ(surface.size(), n);
    EXPECT_NO_THROW(surface.computeFootprints(0, report));
    EXPECT_EQ(surface.getFootprints().size(), n);
  }
}

TEST(SurfaceCloud, RefusesNothing)
{
  Report report;
  EXPECT_THROW(prepare(pcl::PointCloud<pcl::PointNormal>(), report), InvalidArgument);
  pcl::PointCloud<pcl::PointNormal> lost(3, 1);
  for (auto& point : lost)
    point.x = nan_value;
  EXPECT_THROW(prepare(lost, report), InvalidArgument);
}

} // namespace
