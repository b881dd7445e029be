// SPDX-License-Identifier: BSD-3-Clause
// Lengths in the window of uvol_viewer: its bar, and what is stretched.
#include "tools/viewer_test.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <sstream>
#include <string>

namespace test_viewer_lengths {

using pcl_uvol::Image;
using uvol_test::columnsOf;
using uvol_test::height;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::runCommand;
using uvol_test::UvolViewer;
using uvol_test::width;

/** Length in pixels of the dark line in the lower right corner. */
int
barLength(const Image& image)
{
  int length = 0;
  const auto row = static_cast<std::size_t>(height - 18);
  for (int column = 3 * width / 4; column < width; ++column)
    length += image.color[4 * (row * width + static_cast<std::size_t>(column))] < 100;
  return length;
}

TEST_F(UvolViewer, ABarShowsLengths)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  OpenWindow open(sphere, "", {"-eye", "0,-10,0", "-at", "0,0,0"});
  // 33.6 pixels per unit: 1, and not 2, is no longer than 48 pixels.
  constexpr double tangent = 0.267949; // of 15 degrees
  EXPECT_NEAR(0.5 * height / (10.0 * tangent), barLength(open.shoot()), 3.0);
  open.camera().SetPosition(0.0, -16.0, 0.0); // 2
  EXPECT_NEAR(2 * 0.5 * height / (16.0 * tangent), barLength(open.shoot()), 3.0);

  OpenWindow equally(sphere, "", {"-view", "front"}, {2.0, 2.0, 2.0});
  equally.camera().SetPosition(0.0, -20.0, 0.0); // sees it as large
  EXPECT_NEAR(0.5 * height / (10.0 * tangent), barLength(equally.shoot()), 3.0);
  OpenWindow unequally(sphere, "", {}, {1.0, 1.0, 2.0});
  EXPECT_EQ(0, barLength(unequally.shoot()));
}

TEST_F(UvolViewer, StretchesWhatItShowsAndNotTheData)
{
  pcl_uvol::Dataset volume = makeVolume();
  volume.origin = {{100.0, 0.0, 1000.0}};
  OpenWindow open(volume, "intensity", {"-view", "front"}, {1.0, 1.0, 3.0});
  // As high as it is wide
  const float* const shown = pcl_uvol::viewOf(*open.surface.getCloud()).xyz(7);
  const float* const data = pcl_uvol::viewOf(*open.surface.getData()).xyz(7);
  EXPECT_EQ(data[0], shown[0]);
  EXPECT_EQ(data[1], shown[1]);
  EXPECT_EQ(3.0f * data[2], shown[2]);
  const auto radius = open.surface.getBounds().radius;
  EXPECT_NEAR(0.5, radius, 0.02);

  open.type('e');
  const pcl_uvol::Dataset saved = pcl_uvol::loadDataset("uvol_viewer_1.ply");
  ASSERT_EQ(open.surface.getData()->width, saved.cloud.width);
  const float* const first = pcl_uvol::viewOf(saved.cloud).xyz(7);
  EXPECT_NEAR(data[2] + 1000.0, first[2] + saved.origin[2], 1e-3);
  // The options that are printed give the same view.
  testing::internal::CaptureStdout();
  open.type('p');
  std::istringstream camera(testing::internal::GetCapturedStdout());
  std::string option, eye;
  camera >> option >> eye;
  OpenWindow again(volume,
                   "intensity",
                   {"-exaggerate", "1,1,3", "-eye", eye.c_str(), "-at", "100,0,1000"},
                   {1.0, 1.0, 3.0});
  const Eigen::Vector3d place(open.camera().GetPosition());
  EXPECT_LT((Eigen::Vector3d(again.camera().GetPosition()) - place).norm(), 1e-3);

  open.type('k'); // at the centre, of what is shown
  open.type('z');
  open.type('k');
  open.type('k');
  const pcl_uvol::CloudView cut = pcl_uvol::viewOf(*open.surface.getCloud());
  EXPECT_EQ(cut.count, pcl_uvol::viewOf(*open.surface.getData()).count);
  for (std::size_t i = 0; i < cut.count; ++i)
    EXPECT_LT(cut.xyz(i)[2], 0.1f);
  EXPECT_GT(cut.count, 100u);

  pcl_uvol::saveDataset("volume.ply", volume);
  const std::string look = " -exaggerate 1,1,3 -view front -size 240x180 ";
  auto result =
      uvol_test::runWell("uvol_viewer volume.ply -field intensity -iso 0.5 -screenshot "
                         "shown.png" +
                         look);
  result = uvol_test::runWell(
      "uvol_isosurface volume.ply half.ply -field intensity -iso 0.5 "
      "-png drawn.png" +
      look);
  const auto [left, right] = columnsOf(read("drawn.png"));
  const auto [shown_left, shown_right] = columnsOf(read("shown.png"));
  EXPECT_NEAR(left + right, shown_left + shown_right, 2);
  // As large as it fits above the slider
  EXPECT_NEAR(0.78 * (right - left), shown_right - shown_left, 2);
}

} // namespace test_viewer_lengths
