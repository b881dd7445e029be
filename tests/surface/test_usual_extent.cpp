// SPDX-License-Identifier: BSD-3-Clause
// Extents of clouds whose sides are known, with points far from them.
#include "src/surface/usual_extent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace test_usual_extent {

using namespace pcl_uvol;
using Sides = std::array<double, 3>;

/** 10 x 20 x 5 places in steps of 1. */
std::vector<Position>
makeBlock()
{
  std::vector<Position> places;
  places.reserve(1000);
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 10; ++x)
        places.push_back(
            {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}});
  return places;
}

TEST(UsualExtent, IsThatOfTheBox)
{
  EXPECT_EQ((Sides{9.0, 19.0, 4.0}), findUsualSides(makeBlock()));
  EXPECT_EQ((Sides{0.0, 0.0, 0.0}), findUsualSides({{{1.0f, 2.0f, 3.0f}}}));
  EXPECT_EQ((Sides{0.0, 0.0, 0.0}), findUsualSides({}));
}

TEST(UsualExtent, AFewFarPointsAtEitherEndDoNotCount)
{
  auto places = makeBlock();
  for (int i = 0; i < 10; ++i) {
    places.push_back({{-1e6f, 1.0f, 1.0f}});
    places.push_back({{1e6f, 1e6f, 1.0f}});
  }
  EXPECT_EQ((Sides{9.0, 19.0, 4.0}), findUsualSides(places));
  std::reverse(places.begin(), places.end());
  EXPECT_EQ((Sides{9.0, 19.0, 4.0}), findUsualSides(places));
}

TEST(UsualExtent, MorePointsThanAFewCount)
{
  auto places = makeBlock();
  for (int i = 0; i < 11; ++i) // a hundredth of 1011 are 10
    places.push_back({{1e6f, 1.0f, 1.0f}});
  EXPECT_EQ((Sides{1e6, 19.0, 4.0}), findUsualSides(places));
}

TEST(UsualExtent, PointsThatLieHardlyFartherOutCount)
{
  auto places = makeBlock();
  places.push_back({{18.0f, 1.0f, 1.0f}}); // twice as far
  EXPECT_EQ((Sides{18.0, 19.0, 4.0}), findUsualSides(places));
  places.back()[0] = 18.1f;
  EXPECT_EQ((Sides{9.0, 19.0, 4.0}), findUsualSides(places));
}

TEST(UsualExtent, AllPointsOfAFewCount)
{
  EXPECT_EQ((Sides{1e6, 0.0, 0.0}),
            findUsualSides({{{0, 0, 0}}, {{1, 0, 0}}, {{2, 0, 0}}, {{1e6f, 0, 0}}}));
}

} // namespace test_usual_extent
