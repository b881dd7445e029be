// SPDX-License-Identifier: BSD-3-Clause
// Scalars to colours.
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/color_map.h>

#include <gtest/gtest.h>

#include <limits>

namespace test_color_map {

using pcl_uvol::Color;
using pcl_uvol::ColorMap;
using pcl_uvol::InvalidArgument;
using pcl_uvol::toRgba;

TEST(ColorMap, EndsAndMiddleAreThoseOfMatplotlib)
{
  const ColorMap viridis;
  EXPECT_EQ(toRgba(viridis.at(0.0)), 0xff540144u); // 0xaabbggrr
  EXPECT_EQ(toRgba(viridis.at(1.0)), 0xff25e7fdu);
  EXPECT_EQ(toRgba(viridis.at(0.5)), 0xff8c9121u);
  EXPECT_EQ(toRgba(ColorMap("gray").at(0.0)), 0xff000000u);
  EXPECT_EQ(toRgba(ColorMap("gray").at(1.0)), 0xffffffffu);
}

TEST(ColorMap, PerceptuallyUniformMapsGetLighter)
{
  for (const char* name :
       {"viridis", "cividis", "inferno", "magma", "plasma", "gray"}) {
    const ColorMap map(name);
    double before = -1.0;
    for (int i = 0; i <= 64; ++i) {
      const Color color = map.at(i / 64.0);
      const double luminance = 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
      EXPECT_GT(luminance, before) << name << " at " << i;
      before = luminance;
    }
  }
}

TEST(ColorMap, RunsBackwards)
{
  const ColorMap map("RdBu"), reversed("RdBu_r");
  for (const double place : {0.0, 0.3, 0.5, 1.0})
    for (int shift = 0; shift < 24; shift += 8)
      EXPECT_NEAR(toRgba(map.at(place)) >> shift & 0xff,
                  toRgba(reversed.at(1.0 - place)) >> shift & 0xff,
                  1);
  EXPECT_EQ(toRgba(map.at(0.0)), 0xff1f0067u); // dark red
}

TEST(ColorMap, EveryNameIsAMapOfManyColors)
{
  for (const std::string& name : ColorMap::names()) {
    const ColorMap map(name);
    EXPECT_GE(map.size(), 8u) << name;
    EXPECT_NE(toRgba(map.at(0.1)), toRgba(map.at(0.6))) << name;
    EXPECT_EQ(name == "tab10" || name == "OkabeIto", map.isCategorical());
  }
}

TEST(ColorMap, ValuesBeyondTheRangeGetItsEnds)
{
  const ColorMap map;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto colors = map.apply({-5.0f, 2.0f, 4.0f, 9.0f, nan, infinity}, 2.0, 4.0);
  EXPECT_EQ(colors[0], toRgba(map.at(0.0)));
  EXPECT_EQ(colors[1], toRgba(map.at(0.0)));
  EXPECT_EQ(colors[2], toRgba(map.at(1.0)));
  EXPECT_EQ(colors[3], toRgba(map.at(1.0)));
  EXPECT_EQ(colors[4], 0xff808080u);
  EXPECT_EQ(colors[5], toRgba(map.at(1.0)));
}

TEST(ColorMap, OneValueGetsTheMiddle)
{
  const ColorMap map;
  const auto color = map.apply({3.0f}, 3.0, 3.0)[0];
  const auto middle = toRgba(map.at(0.5));
  for (int shift = 0; shift < 24; shift += 8)
    EXPECT_NEAR(static_cast<int>(color >> shift & 0xff),
                static_cast<int>(middle >> shift & 0xff),
                1);
}

TEST(ColorMap, RefusesUnknownNamesAndRanges)
{
  for (const char* name : {"jet", "", "_r", "jet_r"})
    EXPECT_THROW(ColorMap{name}, InvalidArgument) << name;
  const ColorMap map;
  EXPECT_THROW(map.apply({1.0f}, 2.0, 1.0), InvalidArgument);
  EXPECT_THROW(map.apply({1.0f}, 0.0, std::numeric_limits<double>::infinity()),
               InvalidArgument);
}

} // namespace test_color_map
