// SPDX-License-Identifier: BSD-3-Clause
// Files that are dropped on the window of uvol_viewer.
#include "tools/viewer_test.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cstring>

namespace test_viewer_files {

using pcl_uvol::Image;
using uvol_test::covered;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::UvolViewer;

TEST_F(UvolViewer, FilesAreDroppedOnIt)
{
  pcl_uvol::Dataset volume = makeVolume();
  pcl_uvol::saveDataset("same.ply", volume);
  const pcl_uvol::CloudView points = pcl_uvol::viewOf(volume.cloud);
  const auto field = std::find_if(volume.cloud.fields.begin(),
                                  volume.cloud.fields.end(),
                                  [](const auto& f) { return f.name == "intensity"; });
  for (std::size_t i = 0; i < points.count; ++i) {
    float value;
    std::uint8_t* const place =
        &volume.cloud.data[i * volume.cloud.point_step + field->offset];
    std::memcpy(&value, place, sizeof(value));
    value = 1000.0f * value + 1000.0f;
    std::memcpy(place, &value, sizeof(value));
  }
  pcl_uvol::saveDataset("other.ply", volume);
  uvol_test::writeFile("equal.csv", "x,y,z,intensity\n0,0,0,1\n1,0,0,1\n");
  uvol_test::writeFile("none.csv", "x,y,z\n0,0,0\n1,0,0\n");

  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const std::size_t width_at_half = open.surface.getCloud()->width;
  open.type('i');
  open.slide(0.7);
  const auto isovalues = open.surface.getIsoValues();
  const auto before = open.surface.getCloud();
  open.drop({});
  for (const char* const bad : {"gone.ply", "equal.csv", "none.csv"}) {
    open.drop({bad, "same.ply"});
    EXPECT_EQ(before, open.surface.getCloud()) << bad;
    EXPECT_EQ(isovalues, open.surface.getIsoValues()) << bad;
    EXPECT_EQ("uvol_viewer in (h: keys)", open.title());
  }
  open.type('k'); // cuts the old surface
  open.drop({"same.ply"});
  EXPECT_EQ("uvol_viewer same.ply (h: keys)", open.title());
  EXPECT_EQ(isovalues, open.surface.getIsoValues());
  EXPECT_EQ(before->width, open.surface.getCloud()->width);

  open.drop({"other.ply", "same.ply"});
  EXPECT_EQ("uvol_viewer other.ply (h: keys)", open.title());
  ASSERT_EQ(1u, open.surface.getIsoValues().size());
  EXPECT_NEAR(1000.0, open.surface.getRange()[0], 50.0);
  open.slide(1500.0); // by the new range
  EXPECT_NEAR(1500.0, open.surface.getIsoValue(), 40.0);
  EXPECT_NEAR(width_at_half,
              open.surface.getCloud()->width,
              0.1 * static_cast<double>(width_at_half));
  EXPECT_GT(covered(open.shoot()), 1500);
}

TEST_F(UvolViewer, DroppedPointsThatCannotBeDrawnLeaveTheOldOnes)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  uvol_test::writeFile("nowhere.csv", "x,y,z\n,,\n,,\n");
  OpenWindow open(sphere, "", {});
  sphere.origin = {{100.0, 0.0, 0.0}};
  pcl_uvol::saveDataset("far.ply", sphere);
  const Image before = open.shoot();
  open.drop({"nowhere.csv"});
  EXPECT_EQ("uvol_viewer in (h: keys)", open.title());
  EXPECT_NEAR(covered(before), covered(open.shoot()), 0.01 * covered(before));
  open.drop({"far.ply"});
  EXPECT_EQ("uvol_viewer far.ply (h: keys)", open.title());
  EXPECT_GT(covered(open.shoot()), 1000);
}

} // namespace test_viewer_files
