// SPDX-License-Identifier: BSD-3-Clause
// Several isovalues in the window of uvol_viewer, with their colours and opacities.
#include "tools/viewer_test.h"
#include "viewer/opacity_choice.h"
#include <pcl_uvol/common/point_types.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <utility>
#include <vector>

namespace test_viewer_opacities {

using pcl_uvol::Image;
using uvol_test::countColored;
using uvol_test::covered;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::UvolViewer;

std::vector<double>
isovaluesOf(const pcl::PCLPointCloud2& cloud)
{
  return pcl_uvol::listCategories(pcl_uvol::viewOf(cloud), "isovalue", 20);
}

TEST_F(UvolViewer, IsovaluesAreKeptColoredAndLetLightThrough)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const int colored = countColored(open.shoot()); // of the triad
  open.type('i');
  open.type('i'); // once is enough
  EXPECT_EQ((std::vector<double>{0.5, 0.5}), open.surface.getIsoValues());
  EXPECT_EQ(1u, isovaluesOf(*open.surface.getCloud()).size());
  open.slide(0.3);
  ASSERT_EQ(2u, open.surface.getIsoValues().size());
  EXPECT_EQ(0.5, open.surface.getIsoValues()[0]);
  EXPECT_EQ(2u, isovaluesOf(*open.surface.getCloud()).size());
  const Image outer = open.shoot();
  EXPECT_GT(countColored(outer), colored + 1000);
  open.type('o');
  const Image clear = open.shoot();
  EXPECT_TRUE(clear.color != outer.color);
  EXPECT_NEAR(covered(outer), covered(clear), 0.05 * covered(outer));
  open.type('s');
  EXPECT_GT(countColored(read("uvol_viewer_1.png")), 1000);
  open.type('o');
  EXPECT_TRUE(clear.color != open.shoot().color);
  open.slide(open.surface.getRange()[0]); // which has no points: one is left
  EXPECT_EQ(1u, isovaluesOf(*open.surface.getCloud()).size());
  EXPECT_GT(covered(open.shoot()), 1500);
  open.slide(0.3);
  open.type('o'); // all are opaque
  EXPECT_GT(countColored(open.shoot()), colored + 1000);
  open.type('c'); // one colour
  EXPECT_EQ(colored, countColored(open.shoot()));
  open.type('m');
  EXPECT_GT(open.surface.getTriangles().size(), 1000u);
  open.type('I');
  EXPECT_EQ(1u, open.surface.getIsoValues().size());
  EXPECT_NEAR(0.3, open.surface.getIsoValue(), 0.05);
  EXPECT_EQ(1u, isovaluesOf(*open.surface.getCloud()).size());
}

/** Cubes around the origin, a corner in each octant.
 * \param sides half of those of each cube, by isovalue */
pcl::PCLPointCloud2
makeCubes(const std::vector<std::pair<float, float>>& sides)
{
  pcl::PointCloud<pcl_uvol::PointIso> points;
  for (const auto& [isovalue, side] : sides)
    for (int corner = 0; corner < 8; ++corner) {
      pcl_uvol::PointIso point;
      for (int axis = 0; axis < 3; ++axis)
        point.data[axis] = (corner >> axis & 1) != 0 ? side : -side;
      point.isovalue = isovalue;
      points.push_back(point);
    }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  return cloud;
}

TEST(OpacityChoice, FollowsTheIsovaluesThatHavePoints)
{
  using Opacities = std::vector<double>;
  const auto three = makeCubes({{0.1f, 3.0f}, {0.2f, 1.0f}, {0.4f, 2.0f}});
  const auto two = makeCubes({{0.1f, 3.0f}, {0.4f, 2.0f}});
  pcl::PCLPointCloud2 plain;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(10, 1), plain);

  uvol_tools::OpacityChoice opaque({});
  EXPECT_EQ(Opacities(), opaque.find(three, {}));
  EXPECT_EQ(0.6, opaque.next());
  EXPECT_EQ((Opacities{0.6, 1.0, 0.6}), opaque.find(three, {}));
  EXPECT_EQ((Opacities{0.6, 1.0}), opaque.find(two, {0.1, 0.2, 0.4}));
  EXPECT_EQ(Opacities(), opaque.find(plain, {}));
  EXPECT_EQ(0.3, opaque.next());
  EXPECT_EQ((Opacities{0.3, 1.0, 0.3}), opaque.find(three, {}));
  EXPECT_EQ(1.0, opaque.next());
  EXPECT_EQ(Opacities(), opaque.find(three, {}));

  uvol_tools::OpacityChoice given({0.5, 0.25});
  EXPECT_EQ((Opacities{0.5, 0.25, 0.25}), given.find(three, {}));
  EXPECT_EQ((Opacities{0.5, 0.25}), given.find(two, {}));
  // The lowest of those that were asked for has no points.
  EXPECT_EQ((Opacities{0.25, 0.25}), given.find(two, {0.4, 0.1, 0.05, 0.4}));
  EXPECT_EQ((Opacities{0.5}), given.find(plain, {}));
  EXPECT_EQ(1.0, given.next());
  EXPECT_EQ(0.6, given.next());
  EXPECT_EQ(0.3, given.next());
  EXPECT_GT(0.0, given.next());
  EXPECT_EQ((Opacities{0.5, 0.25, 0.25}), given.find(three, {}));
}

} // namespace test_viewer_opacities
