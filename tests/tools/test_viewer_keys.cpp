// SPDX-License-Identifier: BSD-3-Clause
// Keys of uvol_viewer that switch what is drawn, and save it.
#include "tools/viewer_test.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <string>

namespace test_viewer_keys {

using pcl_uvol::Image;
using uvol_test::covered;
using uvol_test::height;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::runCommand;
using uvol_test::UvolViewer;
using uvol_test::width;

TEST_F(UvolViewer, KeysSwitchPasses)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  OpenWindow open(sphere, "", {"-feature-threshold", "0.0001"});
  const Image first = open.shoot();
  for (const char key : std::string("1234567")) {
    open.type(key);
    EXPECT_TRUE(open.shoot().color != first.color) << key;
    open.type(key);
    EXPECT_TRUE(open.shoot().color == first.color) << key;
  }
  open.type('7');
  const Image without_footprints = open.shoot();
  open.type('8'); // and now there are holes
  EXPECT_LT(covered(open.shoot()), covered(without_footprints) * 9 / 10);
  open.type('9'); // the far side is seen through them
  EXPECT_GT(covered(open.shoot()), 1000);
  open.type('x');
  open.type('+');
}

TEST_F(UvolViewer, MessagesStandAboveTheSlider)
{
  OpenWindow open(makeVolume(), "intensity", {});
  const Image silent = open.shoot();
  open.type('o'); // of one isovalue it changes nothing but the message
  const Image telling = open.shoot();
  int above = 0;
  for (std::size_t i = 0; i < silent.pixels(); ++i)
    if (silent.color[4 * i] != telling.color[4 * i]) {
      EXPECT_LT(i / width, height * 4 / 5);
      ++above;
    }
  EXPECT_GT(above, 300);
}

TEST_F(UvolViewer, ColorsStayWithoutLight)
{
  OpenWindow open(
      makeVolume(), "intensity", {"-color", "x", "-range", "-1,3", "-no-bar"});
  const Image lit = open.shoot();
  open.type('1');
  const Image flat = open.shoot();
  EXPECT_NEAR(covered(lit), covered(flat), 0.02 * covered(lit));
  EXPECT_TRUE(lit.color != flat.color);
  open.type('c'); // one colour: white, with a message
  EXPECT_LT(covered(open.shoot()), 0.1 * covered(lit));
  open.type('4'); // silhouettes
  EXPECT_GT(covered(open.shoot()), 300);
}

TEST_F(UvolViewer, MShowsAMeshAndThePointsAgain)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "mean_curvature"});
  const Image points = open.shoot();
  open.type('m');
  EXPECT_GT(open.surface.getTriangles().size(), 1000u);
  const Image mesh = open.shoot();
  EXPECT_NEAR(covered(points), covered(mesh), 0.1 * covered(points));
  EXPECT_TRUE(points.color != mesh.color);
  open.type('c'); // one colour
  EXPECT_TRUE(mesh.color != open.shoot().color);
  const std::size_t triangles = open.surface.getTriangles().size();
  open.slide(0.3);
  EXPECT_LT(open.surface.getTriangles().size(), triangles / 2);
  open.type('m');
  EXPECT_TRUE(open.surface.getTriangles().empty());

  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  OpenWindow of_points(sphere, "", {});
  of_points.type('m'); // tells that there are no samples
  EXPECT_FALSE(of_points.surface.isMeshed());
}

TEST_F(UvolViewer, KeysForColorsHelpAndPictures)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "mean_curvature"});
  const Image colored = open.shoot();
  open.type('c');
  const Image plain = open.shoot();
  EXPECT_TRUE(plain.color != colored.color);
  open.type('c');
  EXPECT_TRUE(plain.color != open.shoot().color);
  open.type('h');
  EXPECT_TRUE(plain.color != open.shoot().color);
  open.type('s');
  open.type('s');
  EXPECT_EQ(3u, folder_.list().size());
  const Image drawn = read("uvol_viewer_2.png");
  open.type('S');
  const Image traced = read("uvol_viewer_3.png");
  EXPECT_TRUE(traced.color != drawn.color); // there are shadows
  EXPECT_NEAR(covered(drawn), covered(traced), 0.03 * covered(drawn));
}

TEST_F(UvolViewer, KeysSaveASurfaceAndAPictureThatRenderDrawsAgain)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "none"});
  open.type('e');
  const pcl_uvol::Dataset saved = pcl_uvol::loadDataset("uvol_viewer_1.ply");
  EXPECT_EQ(open.surface.getCloud()->width, saved.cloud.width);
  open.type('h'); // letters of the window are not in the picture
  open.type('s');
  testing::internal::CaptureStdout();
  open.type('p');
  std::string camera = testing::internal::GetCapturedStdout();
  camera.pop_back(); // the end of the line
  const std::string command =
      "uvol_render uvol_viewer_1.ply same.png -color none -size " +
      std::to_string(width) + "x" + std::to_string(height) + " " + camera;
  const auto result = runCommand(command);
  ASSERT_EQ(0, result.exit_code) << command << ": " << result.err;
  const Image first = read("uvol_viewer_1.png"), same = read("same.png");
  ASSERT_EQ(first.color.size(), same.color.size());
  int different = 0;
  for (std::size_t i = 0; i < first.color.size(); ++i)
    different += std::abs(first.color[i] - same.color[i]) > 2;
  EXPECT_LT(different, static_cast<int>(first.color.size()) / 200);
}

} // namespace test_viewer_keys
