// SPDX-License-Identifier: BSD-3-Clause
// Points prepared for drawing: normals and blocks.
#include "render/surface_cloud.h"
#include "support/surfaces.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace test_surface_cloud {

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

TEST(SurfaceCloud, GivesCamerasItsDiscsButNotIsolatedPoints)
{
  auto cloud = *uvol_test::makeSphere(4000, 1);
  for (auto& point : cloud)
    point.getVector3fMap() *= 1024.0f; // discs are in the unit of the input
  const std::size_t on_sphere = cloud.size();
  cloud.push_back(cloud[0]);
  cloud.back().getVector3fMap() *= 30.0f;
  cloud.push_back(cloud[1]);
  cloud.back().x = nan_value;
  Report report;
  const SurfaceCloud surface = prepare(cloud, report);
  const auto discs =
      surface.listFittedDiscs(surface.findFootprints(1, report), cloud.size());
  ASSERT_EQ(cloud.size(), discs.size());
  const double spacing = 1024.0 * std::sqrt(4.0 * M_PI / 4000.0);
  for (std::size_t i = 0; i < on_sphere; ++i) {
    EXPECT_GT(discs[i].radius, 0.2 * spacing);
    EXPECT_LT(discs[i].radius, 3.0 * spacing);
    const Eigen::Vector3f normal(discs[i].normal.data());
    EXPECT_GT(normal.dot(cloud[i].getNormalVector3fMap()), 0.9999f);
  }
  EXPECT_TRUE(std::isnan(discs[on_sphere].radius));
  EXPECT_TRUE(std::isnan(discs[on_sphere + 1].radius));
}

TEST(SurfaceCloud, OfDotsAloneGivesCamerasDots)
{
  Report report;
  const auto cloud = *uvol_test::makeSphere(2, 1);
  const SurfaceCloud surface = prepare(cloud, report);
  pcl_uvol::Footprints footprints = surface.findFootprints(1, report);
  footprints.radii = {0.0f, 0.0f};
  for (const auto& disc : surface.listFittedDiscs(footprints, 2))
    EXPECT_EQ(0.0f, disc.radius);
  footprints.radii = {1.0f, 0.0f};
  const auto half = surface.listFittedDiscs(footprints, 2);
  EXPECT_NE(std::isnan(half[0].radius), std::isnan(half[1].radius));
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

} // namespace test_surface_cloud
