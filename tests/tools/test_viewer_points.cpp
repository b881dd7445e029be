// SPDX-License-Identifier: BSD-3-Clause
// Points under the mouse in the window of uvol_viewer, and in front of a cut.
#include "tools/viewer_test.h"
#include "viewer/point_picking.h"

#include <gtest/gtest.h>

#include <string>

namespace test_viewer_points {

using pcl_uvol::Image;
using uvol_test::covered;
using uvol_test::height;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::UvolViewer;
using uvol_test::width;

TEST_F(UvolViewer, PointsAreFoundUnderTheMouse)
{
  // So small that a point of the front is at hand everywhere.
  OpenWindow open(makeVolume(), "intensity", {"-view", "front", "-zoom", "0.6"});
  open.shoot();
  const pcl::PCLPointCloud2& cloud = *open.surface.getCloud();
  const auto find = [&](double column, double row) {
    return uvol_tools::findPointAt(cloud, open.renderer(), column, row);
  };
  // From the front the ellipsoid's half axis of a quarter points to the eye.
  const int row = height * 61 / 100; // of the middle of what is free above the slider
  const auto middle = find(0.5 * width, row);
  ASSERT_TRUE(middle);
  const float* const p = pcl_uvol::viewOf(cloud).xyz(*middle);
  EXPECT_NEAR(0.0, p[0], 0.06);
  EXPECT_NEAR(-0.25, p[1], 0.02);
  EXPECT_NEAR(0.0, p[2], 0.06);
  EXPECT_FALSE(find(2.0, height - 2.0));

  const std::string text = uvol_tools::describePoint(cloud, {{1e6, 0.0, 0.0}}, *middle);
  EXPECT_EQ(0u, text.find(p[0] < 0.0f ? "x 999999.9" : "x 1000000")) << text;
  EXPECT_NE(std::string::npos, text.find("\nintensity 0.5")) << text;

  open.click(width / 2, row);
  const Image told = open.shoot();
  open.click(2, height - 2);
  EXPECT_TRUE(told.color != open.shoot().color);
  open.pointAt(width / 2, row);
  open.type('f');
  const Eigen::Vector3d center(open.camera().GetFocalPoint());
  EXPECT_EQ(Eigen::Vector3d(p[0], p[1], p[2]), center);
  open.pointAt(2, height - 2);
  open.type('f'); // no point is there
  EXPECT_EQ(center, Eigen::Vector3d(open.camera().GetFocalPoint()));
}

TEST_F(UvolViewer, AKeyCutsAwayWhatLiesInFront)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const std::size_t whole = open.surface.getCloud()->width;
  const double depth = open.camera().GetFocalPoint()[1];
  open.type('k');
  const auto checkCut = [&] {
    const pcl_uvol::CloudView cut = pcl_uvol::viewOf(*open.surface.getCloud());
    for (std::size_t i = 0; i < cut.count; ++i)
      EXPECT_GE(static_cast<double>(cut.xyz(i)[1]), depth - 1e-6);
  };
  checkCut();
  EXPECT_NEAR(0.5, static_cast<double>(open.surface.getCloud()->width) / whole, 0.05);
  open.type('+'); // stays cut
  checkCut();
  open.type('-');
  open.type('m'); // a mesh has all of its vertices
  EXPECT_GT(open.surface.getTriangles().size(), 1000u);
  for (const pcl_uvol::Triangle& triangle : open.surface.getTriangles())
    for (const std::uint32_t vertex : triangle)
      ASSERT_LT(vertex, open.surface.getCloud()->width);
  EXPECT_GT(covered(open.shoot()), 1500);
  open.type('m'); // points are cut again
  checkCut();
  open.type('k');
  EXPECT_EQ(whole, open.surface.getCloud()->width);
}

} // namespace test_viewer_points
