// SPDX-License-Identifier: BSD-3-Clause
// Surfaces stretched for pictures.
#include "render/stretch_surface.h"
#include "support/surfaces.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/conversions.h>

namespace test_stretch_surface {

using Eigen::Vector3d;

TEST(StretchSurface, MakesAnEllipsoidWithItsNormals)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(500, 1), sphere.cloud);
  sphere.origin = {1.0, 2.0, 3.0};
  const Vector3d factors(1.0, 2.0, 100.0);
  pcl_uvol::stretchSurface(sphere, factors);
  EXPECT_EQ((std::array<double, 3>{1.0, 4.0, 300.0}), sphere.origin);
  pcl::PointCloud<pcl::PointNormal> points;
  pcl::fromPCLPointCloud2(sphere.cloud, points);
  for (const pcl::PointNormal& point : points) {
    const Vector3d place = point.getVector3fMap().cast<double>();
    EXPECT_NEAR(1.0, place.cwiseQuotient(factors).norm(), 1e-5);
    // The gradient of |x / factors|^2.
    const Vector3d truth =
        place.cwiseQuotient(factors.cwiseProduct(factors)).normalized();
    EXPECT_LT((point.getNormalVector3fMap().cast<double>() - truth).norm(), 1e-5);
  }
}

TEST(StretchSurface, KnowsHowLongEdgesCanBecome)
{
  pcl::PointCloud<pcl_uvol::PointIso> points(1, 1);
  points[0].edge_length = 0.5f;
  points[0].error = 7.0f;
  pcl_uvol::Dataset surface;
  pcl::toPCLPointCloud2(points, surface.cloud);
  pcl_uvol::stretchSurface(surface, Vector3d(1.0, 3.0, 2.0));
  pcl::fromPCLPointCloud2(surface.cloud, points);
  EXPECT_EQ(1.5f, points[0].edge_length);
  EXPECT_EQ(7.0f, points[0].error);
}

TEST(StretchSurface, RefusesSplats)
{
  pcl_uvol::Dataset surface;
  pcl::toPCLPointCloud2(pcl::PointCloud<pcl_uvol::PointSplat>(1, 1), surface.cloud);
  EXPECT_THROW(pcl_uvol::stretchSurface(surface, Vector3d(1.0, 1.0, 2.0)),
               pcl_uvol::InvalidArgument);
}

} // namespace test_stretch_surface
