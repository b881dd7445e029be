// SPDX-License-Identifier: BSD-3-Clause
// Axes by strike, dip and plunge, and linear maps taken apart into them and factors.
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "support/environment.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cmath>
#include <utility>
#include <vector>

namespace test_stretch_axes {

using Eigen::Array3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using pcl_uvol::detail::Stretch;
using pcl_uvol::detail::StretchAxes;

constexpr double degree = 3.14159265358979323846 / 180.0;

void
expectNear(const Eigen::RowVector3d& a, const Vector3d& b)
{
  EXPECT_LT((a.transpose() - b).norm(), 1e-12) << a << " and " << b.transpose();
}

TEST(StretchAxes, AreThoseOfTheCoordinatesWithoutAngles)
{
  const StretchAxes axes(Array3d::Zero());
  EXPECT_FALSE(axes.areTurned());
  EXPECT_EQ(Matrix3d(Matrix3d::Identity()), axes.getRows());
  EXPECT_TRUE(StretchAxes(Array3d(0.0, 1e-6, 0.0)).areTurned());
}

TEST(StretchAxes, ThePlaneGoesDownToTheRightOfItsStrike)
{
  // Strikes north and dips to the east.
  const Matrix3d north = StretchAxes(Array3d(0.0, 30.0, 0.0)).getRows();
  const double s = std::sin(30.0 * degree), c = std::cos(30.0 * degree);
  expectNear(north.row(0), {c, 0.0, -s});
  expectNear(north.row(1), {0.0, 1.0, 0.0});
  expectNear(north.row(2), {s, 0.0, c});
  // Strikes east and dips to the south.
  const Matrix3d east = StretchAxes(Array3d(90.0, 30.0, 0.0)).getRows();
  expectNear(east.row(0), {0.0, -c, -s});
  expectNear(east.row(1), {1.0, 0.0, 0.0});
  expectNear(east.row(2), {0.0, -s, c});
  // Stands upright.
  const Matrix3d upright = StretchAxes(Array3d(0.0, 90.0, 0.0)).getRows();
  expectNear(upright.row(0), {0.0, 0.0, -1.0});
  expectNear(upright.row(2), {1.0, 0.0, 0.0});
  EXPECT_EQ(StretchAxes(Array3d(360.0, 90.0, 0.0)).getRows(), upright);
}

TEST(StretchAxes, TheLinePlungesInThePlane)
{
  for (const double plunge : {-40.0, -10.0, 0.0, 25.0, 40.0}) {
    const Matrix3d rows = StretchAxes(Array3d(70.0, 40.0, plunge)).getRows();
    const Matrix3d plane = StretchAxes(Array3d(70.0, 40.0, 0.0)).getRows();
    EXPECT_NEAR(rows(1, 2), -std::sin(plunge * degree), 1e-12);
    EXPECT_GE(rows.row(1).dot(plane.row(1)), -1e-7);
    expectNear(rows.row(2), plane.row(2).transpose());
    EXPECT_LT((rows * rows.transpose() - Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(rows.determinant(), 1.0, 1e-12);
  }
}

TEST(StretchAxes, RefuseAnglesThatAreNone)
{
  const double nan = std::nan("");
  for (const Array3d& angles : {Array3d(nan, 0.0, 0.0),
                                Array3d(0.0, -1.0, 0.0),
                                Array3d(0.0, 90.5, 0.0),
                                Array3d(0.0, nan, 0.0),
                                Array3d(0.0, 30.0, 31.0),
                                Array3d(0.0, 30.0, -31.0),
                                Array3d(0.0, 0.0, nan)})
    EXPECT_THROW(StretchAxes{angles}, pcl_uvol::InvalidArgument) << angles;
}

TEST(StretchAxes, TurnPositionsAndNormalsAndBack)
{
  pcl::PointCloud<pcl::PointNormal> points;
  uvol_test::Random random(4);
  for (int i = 0; i < 20; ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = Eigen::Vector3f::NullaryExpr(
        [&] { return static_cast<float>(random.uniform()); });
    point.getNormalVector3fMap() = Eigen::Vector3f(0.0f, 0.6f, 0.8f);
    point.curvature = 7.0f;
    points.push_back(point);
  }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  const StretchAxes axes(Array3d(20.0, 50.0, 10.0));
  const pcl_uvol::CloudView turned = axes.turn(pcl_uvol::viewOf(cloud));
  const Eigen::Matrix3f rows = axes.getRows().cast<float>();
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT(
        (Eigen::Vector3f(turned.xyz(i)) - rows * points[i].getVector3fMap()).norm(),
        3e-7f);
  pcl::PCLPointCloud2 in_place = cloud;
  axes.turn(in_place);
  EXPECT_EQ(*turned.copy, std::vector<std::uint8_t>(in_place.data));
  pcl::PointCloud<pcl::PointNormal> seen, back;
  pcl::fromPCLPointCloud2(in_place, seen);
  axes.turnBack(in_place);
  pcl::fromPCLPointCloud2(in_place, back);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((seen[i].getNormalVector3fMap() - rows * points[i].getNormalVector3fMap())
                  .norm(),
              3e-7f);
    EXPECT_LT((back[i].getVector3fMap() - points[i].getVector3fMap()).norm(), 3e-7f);
    EXPECT_LT(
        (back[i].getNormalVector3fMap() - points[i].getNormalVector3fMap()).norm(),
        3e-7f);
    EXPECT_EQ(7.0f, back[i].curvature);
  }
  const StretchAxes none(Array3d::Zero());
  EXPECT_EQ(cloud.data.data(), none.turn(pcl_uvol::viewOf(cloud)).data);
}

TEST(StretchAxes, TurnNormalsInDouble)
{
  pcl::PointCloud<pcl::PointXYZ> points;
  points.push_back({1.0f, 2.0f, 3.0f});
  pcl_uvol::Dataset samples;
  pcl::toPCLPointCloud2(points, samples.cloud);
  const Vector3d normal(0.36, 0.48, 0.8);
  for (const auto& [name, value] : {std::pair("normal_x", normal[0]),
                                    std::pair("normal_y", normal[1]),
                                    std::pair("normal_z", normal[2])})
    pcl_uvol::setField(samples, name, std::vector<double>{value});
  const StretchAxes axes(Array3d(20.0, 50.0, 10.0));
  axes.turn(samples.cloud);
  const Vector3d expected = axes.getRows() * normal;
  for (const auto& [name, value] : {std::pair("normal_x", expected[0]),
                                    std::pair("normal_y", expected[1]),
                                    std::pair("normal_z", expected[2])})
    EXPECT_NEAR(value,
                pcl_uvol::ScalarField(samples.cloud.fields, name)
                    .read(samples.cloud.data.data()),
                1e-15);
}

TEST(Stretch, OfAMapMeasuresItsLengths)
{
  uvol_test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Matrix3d map =
        Matrix3d::NullaryExpr([&] { return 2.0 * random.uniform() - 1.0; });
    if (std::abs(map.determinant()) < 1e-3)
      continue;
    const Stretch stretch = Stretch::ofMap(map);
    const Matrix3d rows = StretchAxes(stretch.rotation).getRows();
    for (int j = 0; j < 5; ++j) {
      const Vector3d offset =
          Vector3d::NullaryExpr([&] { return 2.0 * random.uniform() - 1.0; });
      const double expected = (map * offset).norm();
      EXPECT_NEAR(
          expected,
          (stretch.scale.cast<double>() * (rows * offset).array()).matrix().norm(),
          1e-5 * expected + 1e-7);
    }
  }
}

TEST(Stretch, OfFactorsOrOfARotationGivesTheseBack)
{
  const Matrix3d factors = Eigen::Vector3d(2.0, 1.0, 100.0).asDiagonal();
  EXPECT_TRUE((Stretch::ofMap(factors).scale == Eigen::Array3f(2, 1, 100)).all());
  EXPECT_TRUE((Stretch::ofMap(factors).rotation == 0.0).all());
  const Array3d angles(35.0, 30.0, -20.0);
  const Stretch turned = Stretch::ofMap(factors * StretchAxes(angles).getRows());
  EXPECT_TRUE(turned.scale.isApprox(Eigen::Array3f(2, 1, 100), 1e-5f)) << turned.scale;
  EXPECT_TRUE(turned.rotation.isApprox(angles, 1e-9)) << turned.rotation;
}

TEST(Stretch, NeedsAMapThatKeepsDirections)
{
  Matrix3d flat = Matrix3d::Identity();
  flat(2, 2) = 0.0;
  EXPECT_THROW(Stretch::ofMap(flat), pcl_uvol::InvalidArgument);
  flat(2, 2) = std::nan("");
  EXPECT_THROW(Stretch::ofMap(flat), pcl_uvol::InvalidArgument);
}

} // namespace test_stretch_axes
