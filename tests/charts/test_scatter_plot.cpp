// SPDX-License-Identifier: BSD-3-Clause
// Pictures of projected points: dots, axes and clusters are where the numbers say.
#include "charts/scatter_plot.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

namespace test_scatter_plot {

using pcl_uvol::Image;
using pcl_uvol::InvalidArgument;
using uvol_tools::drawScatterPlot;
using uvol_tools::ScatterAxis;
using Points = std::vector<std::array<float, 3>>;
using Labels = std::vector<std::int32_t>;

constexpr int side = 400, center = side / 2;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Image
draw(const Points& points,
     const Labels& labels = {},
     const std::vector<ScatterAxis>& axes = {},
     const std::string& view = "top")
{
  return drawScatterPlot(points, labels, axes, view, {side, side});
}

const std::uint8_t*
pixel(const Image& image, int column, int row)
{
  return &image.color[4 * (static_cast<std::size_t>(row) * image.width +
                           static_cast<std::size_t>(column))];
}

bool
isBlue(const std::uint8_t* color)
{
  return color[2] > 150 && color[0] < 100;
}

bool
isOrange(const std::uint8_t* color)
{
  return color[0] > 200 && color[1] > 100 && color[2] < 100;
}

bool
isDark(const std::uint8_t* color)
{
  return color[0] < 100 && color[1] < 100 && color[2] < 100;
}

/** Number of such pixels, and the mean of their columns and rows relative to the
 * centre, upwards; the legend in the upper left corner is left out. */
template <typename Predicate>
std::tuple<int, double, double>
spotOf(const Image& image, const Predicate& is_part)
{
  int count = 0;
  double columns = 0.0, rows = 0.0;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      if ((column > 150 || row > 150) && is_part(pixel(image, column, row))) {
        ++count;
        columns += column;
        rows += row;
      }
  return {count, columns / count - center, center - rows / count};
}

/** Many points at each of these places, labelled in their order. */
std::pair<Points, Labels>
crowdsAt(const Points& places)
{
  constexpr std::size_t crowd = 200;
  std::pair<Points, Labels> crowds;
  for (std::size_t i = 0; i < places.size(); ++i) {
    crowds.first.insert(crowds.first.end(), crowd, places[i]);
    crowds.second.insert(crowds.second.end(), crowd, static_cast<std::int32_t>(i));
  }
  return crowds;
}

TEST(ScatterPlot, DotsAreWhereTheirPointsAre)
{
  const auto [points, labels] = crowdsAt({{{1.0f, 0.0f, 0.0f}},
                                          {{0.0f, 0.5f, 0.0f}},
                                          {{-1.0f, 0.0f, 0.0f}},
                                          {{0.0f, -0.5f, 0.0f}}});
  const Image image = draw(points, labels);
  const auto [blue, blue_right, blue_up] = spotOf(image, isBlue);
  const auto [orange, orange_right, orange_up] = spotOf(image, isOrange);
  for (const int dot : {blue, orange}) {
    EXPECT_GT(dot, 3);
    EXPECT_LT(dot, 12);
  }
  EXPECT_NEAR(0.0, blue_up, 1.0);
  EXPECT_GT(blue_right, 0.6 * center);
  EXPECT_LT(blue_right, 1.0 * center);
  EXPECT_NEAR(0.0, orange_right, 1.0);
  EXPECT_NEAR(0.5 * blue_right, orange_up, 1.5);
}

/** 99 % of ten points are ten. */
TEST(ScatterPlot, FewPointsAreAllSeen)
{
  Points points;
  for (int i = 0; i < 9; ++i)
    points.push_back({{static_cast<float>(i), 0.0f, 0.0f}});
  points.push_back({{30.0f, 0.0f, 0.0f}});
  constexpr int pixels_per_dot = 5;
  EXPECT_GE(std::get<0>(spotOf(draw(points), isBlue)), 10 * pixels_per_dot);
}

/** Beyond the border, or behind the eye. */
TEST(ScatterPlot, OneFarPointDoesNotMakeTheOthersADot)
{
  Points points = crowdsAt({{{1.0f, 0.0f, 0.0f}}, {{-1.0f, 0.0f, 0.0f}}}).first;
  const Image expected = draw(points);
  for (const std::array<float, 3>& far : {std::array<float, 3>{{0.0f, 1e3f, 0.0f}},
                                          {{0.0f, 1e13f, 0.0f}},
                                          {{0.0f, 1e30f, 0.0f}},
                                          {{0.1f, 0.1f, -1e30f}},
                                          {{0.1f, 0.1f, 1e3f}}}) {
    points.push_back(far);
    const bool is_deep = far[2] < 0.0f; // seen, at the centre
    EXPECT_EQ(!is_deep, expected.color == draw(points).color)
        << far[1] << ' ' << far[2];
    points.pop_back();
  }
}

TEST(ScatterPlot, NearerDotsCoverFartherOnes)
{
  const Points line{{{0.0f, 0.0f, 0.5f}}, {{0.0f, 0.0f, -0.5f}}};
  EXPECT_TRUE(isBlue(pixel(draw(line, {0, 1}), center, center)));
  EXPECT_TRUE(isOrange(pixel(draw(line, {1, 0}), center, center)));
  EXPECT_TRUE(isOrange(pixel(draw(line, {0, 1}, {}, "bottom"), center, center)));
}

TEST(ScatterPlot, NoiseIsGray)
{
  const Image image = draw({{{0.0f, 0.0f, 0.0f}}}, {-1});
  const std::uint8_t* const color = pixel(image, center, center);
  EXPECT_EQ(color[0], color[1]);
  EXPECT_EQ(color[1], color[2]);
  EXPECT_GT(color[0], 100);
  EXPECT_LT(color[0], 230);
}

TEST(ScatterPlot, PointsThatAreNotFiniteAreNotDrawn)
{
  const Points finite{{{1.0f, 0.2f, 0.0f}}, {{-0.3f, 0.5f, 0.1f}}};
  Points all = finite;
  all.insert(all.begin(), {{nan, 0.0f, 0.0f}});
  all.push_back({{0.0f, std::numeric_limits<float>::infinity(), 0.0f}});
  all.push_back({{0.0f, 0.0f, -std::numeric_limits<float>::infinity()}});
  EXPECT_EQ(draw(finite).color, draw(all).color);
}

TEST(ScatterPlot, NothingToDrawIsWhite)
{
  for (const Points& points : {Points{}, Points{{{nan, nan, nan}}}}) {
    const Image image = draw(points);
    EXPECT_EQ(std::vector<std::uint8_t>(4 * image.pixels(), 255), image.color);
  }
}

TEST(ScatterPlot, AxesAreAsLongAsTheirUnits)
{
  const Image image = draw({}, {}, {{"", {{2.0, 0.0, 0.0}}}, {"", {{0.0, 1.0, 0.0}}}});
  int right = 0, up = 0;
  while (isDark(pixel(image, center + right + 1, center)))
    ++right;
  while (isDark(pixel(image, center, center - up - 1)))
    ++up;
  EXPECT_GT(right, 0.6 * center);
  EXPECT_NEAR(0.5 * right, up, 2.0);
  EXPECT_FALSE(isDark(pixel(image, center - 5, center)));
  EXPECT_FALSE(isDark(pixel(image, center, center + 5)));
}

TEST(ScatterPlot, AxesBearTheirNames)
{
  const auto dark = [](const std::string& name) {
    return std::get<0>(spotOf(draw({}, {}, {{name, {{1.0, 0.5, 0.0}}}}), &isDark));
  };
  EXPECT_GT(dark("rho"), dark("") + 10);
  EXPECT_GT(dark("|vx,vy,vz|"), dark("rho"));
}

TEST(ScatterPlot, AxesWithoutLengthAreNone)
{
  EXPECT_EQ(draw({}).color, draw({}, {}, {{"rho", {{0.0, 0.0, 0.0}}}}).color);
}

TEST(ScatterPlot, HasTheSizeThatIsAskedFor)
{
  for (const auto& [width, height] :
       {std::pair(1, 1), {640, 2}, {2, 640}, {16384, 1}}) {
    const Image image = drawScatterPlot({{{1.0f, 2.0f, 3.0f}}},
                                        {0},
                                        {{"a", {{1.0, 0.0, 0.0}}}},
                                        "iso",
                                        {width, height});
    EXPECT_EQ(static_cast<std::uint32_t>(width), image.width);
    EXPECT_EQ(static_cast<std::uint32_t>(height), image.height);
    EXPECT_EQ(4 * image.pixels(), image.color.size());
  }
}

TEST(ScatterPlot, LabelsMayBeAnyNumbers)
{
  const Points points(3, {{0.5f, 0.0f, 0.0f}});
  EXPECT_NO_THROW(draw(points,
                       {std::numeric_limits<std::int32_t>::min(),
                        std::numeric_limits<std::int32_t>::max(),
                        0}));
}

TEST(ScatterPlot, RefusesNonsense)
{
  const Points point{{{0.0f, 0.0f, 0.0f}}};
  EXPECT_THROW(draw(point, {}, {}, "above"), InvalidArgument);
  EXPECT_THROW(draw(point, {}, {}, ""), InvalidArgument);
  EXPECT_THROW(draw(point, {0, 1}), InvalidArgument);
  EXPECT_THROW(draw({}, {0}), InvalidArgument);
  for (const int size : {0, -1, 16385}) {
    EXPECT_THROW(drawScatterPlot(point, {}, {}, "top", {size, 10}), InvalidArgument);
    EXPECT_THROW(drawScatterPlot(point, {}, {}, "top", {10, size}), InvalidArgument);
  }
}

} // namespace test_scatter_plot
