// SPDX-License-Identifier: BSD-3-Clause
// Figures of slices: colours and contours lie where the values are.
#include "charts/line_plot.h"
#include "charts/slice_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace test_slice_plot {

using pcl_uvol::Image;
using namespace uvol_tools;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::array<int, 3>
pixelAt(const Image& image, int column, int row)
{
  const std::uint8_t* const pixel =
      &image.color[4 * (static_cast<std::size_t>(row) * image.width +
                        static_cast<std::size_t>(column))];
  return {pixel[0], pixel[1], pixel[2]};
}

/** A ramp from 0 to 1 along x, 600 x 512 values, in shades of grey. */
SlicePlot
makeRamp()
{
  SlicePlot plot;
  plot.width = 600;
  plot.height = 512;
  for (std::size_t row = 0; row < plot.height; ++row)
    for (std::size_t column = 0; column < plot.width; ++column)
      plot.values.push_back(static_cast<float>(column) / 599.0f);
  plot.across = {10.0, 20.0};
  plot.up = {-1.0, 1.0};
  plot.across_label = "x";
  plot.up_label = "y";
  plot.title = "ramp";
  plot.map = pcl_uvol::ColorMap("gray");
  plot.scale = {0.0, 1.0};
  return plot;
}

/** Width and height of what has the ground of values that are none. */
std::array<int, 2>
groundOf(const Image& image)
{
  constexpr std::array<int, 3> ground{232, 232, 232};
  std::vector<int> in_columns(image.width), in_rows(image.height);
  for (std::size_t row = 0; row < in_rows.size(); ++row)
    for (std::size_t column = 0; column < in_columns.size(); ++column)
      if (pixelAt(image, static_cast<int>(column), static_cast<int>(row)) == ground) {
        ++in_columns[column];
        ++in_rows[row];
      }
  constexpr int more_than_letters_have = 99;
  const auto count = [](const std::vector<int>& pixels) {
    return static_cast<int>(std::count_if(pixels.begin(), pixels.end(), [](int sum) {
      return sum > more_than_letters_have;
    }));
  };
  return {count(in_columns), count(in_rows)};
}

/** Columns of a row of the figure that a plot with contours, or with samples, changes.
 */
std::set<int>
changedColumns(const SlicePlot& plot, const SlicePlot& plain, int row)
{
  const Image image = drawSlicePlot(plot), other = drawSlicePlot(plain);
  std::set<int> columns;
  for (int column = 0; column < 690; ++column) // the bar is farther right
    if (pixelAt(image, column, row) != pixelAt(other, column, row))
      columns.insert(column);
  return columns;
}

// The font has 13 pixels, and the values begin 8 fonts from the left.
constexpr int left = 8 * 13, top = 19;

TEST(SlicePlot, ValuesHaveTheirColours)
{
  const Image image = drawSlicePlot(makeRamp());
  const pcl_uvol::ColorMap map("gray");
  for (const int column : {0, 150, 599})
    EXPECT_NEAR(pixelAt(image, left + column, 250)[0],
                255.0 * static_cast<double>(map.at(column / 599.0).r),
                1.0);
  EXPECT_EQ(pixelAt(image, left - 1, 250), (std::array<int, 3>{255, 255, 255}));
  EXPECT_EQ(pixelAt(image, left + 600, 250), (std::array<int, 3>{255, 255, 255}));
}

TEST(SlicePlot, FillsPaperAsFarAsSquaresCan)
{
  SlicePlot plot = makeRamp();
  plot.values.assign(plot.values.size(), nan);
  plot.map = pcl_uvol::ColorMap("viridis"); // the bar has no grey
  for (const auto& [width, height] : {std::pair(900, 800), {1600, 700}, {500, 1400}}) {
    plot.paper = {width, height};
    const Image image = drawSlicePlot(plot);
    ASSERT_EQ(static_cast<std::uint32_t>(width), image.width);
    ASSERT_EQ(static_cast<std::uint32_t>(height), image.height);
    const auto [across, up] = groundOf(image);
    EXPECT_NEAR(across / 600.0, up / 512.0, 0.002) << width << ' ' << height;
    // One of both sides is as long as axes and bar leave.
    const int font = plot.paper.chartLetters({785, 600});
    EXPECT_TRUE(across == width - 21 * font || up == height - 3 * font / 2 - 5 * font)
        << width << ' ' << height;
  }
}

TEST(SlicePlot, TheFirstRowIsBelowAndNothingIsGrey)
{
  SlicePlot plot = makeRamp();
  std::fill(plot.values.begin(), plot.values.begin() + 600, 1.0f);
  std::fill(plot.values.end() - 600, plot.values.end(), nan);
  const Image image = drawSlicePlot(plot);
  EXPECT_EQ(pixelAt(image, left + 3, top + 511), (std::array<int, 3>{255, 255, 255}));
  EXPECT_EQ(pixelAt(image, left + 3, top), (std::array<int, 3>{232, 232, 232}));
}

TEST(SlicePlot, FewValuesBecomeSquares)
{
  SlicePlot plot = makeRamp();
  plot.width = 4;
  plot.height = 2;
  plot.values = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 0.0f, 0.0f, 0.0f};
  const Image image = drawSlicePlot(plot);
  EXPECT_EQ(pixelAt(image, left + 127, top + 127)[0], 255); // the second row, above
  EXPECT_EQ(pixelAt(image, left + 128, top + 127)[0], 0);
  EXPECT_EQ(pixelAt(image, left + 127, top + 128)[0], 0);
  EXPECT_NEAR(pixelAt(image, left + 511, top + 128)[0], 191, 1);
}

TEST(SlicePlot, ThinSlicesAreStretchedUntilTheirNumbersFit)
{
  SlicePlot plot = makeRamp();
  const auto draw = [&](std::size_t height) {
    plot.height = height;
    plot.values.assign(plot.width * height, 0.0f);
    std::fill_n(plot.values.end() - 600, 600, 1.0f); // the highest row
    return drawSlicePlot(plot);
  };
  const auto isWhite = [](const Image& image, int row) {
    return pixelAt(image, left + 40, row)[0] == 255;
  };
  // Five letters of 13 pixels are 65; four rows of 17 are the least multiple beyond.
  const Image thin = draw(4), other = draw(70);
  EXPECT_EQ(thin.height, top + 4u * 17u - 1u + 65u);
  EXPECT_TRUE(isWhite(thin, top + 16));
  EXPECT_FALSE(isWhite(thin, top + 17));
  EXPECT_FALSE(isWhite(thin, top + 67));
  EXPECT_EQ(other.height, top + 70u - 1u + 65u);
  EXPECT_FALSE(isWhite(other, top + 1));
}

TEST(SlicePlot, ContoursLieWhereTheValueIs)
{
  SlicePlot plot = makeRamp();
  plot.contours = {0.25, 7.0};
  const auto columns = changedColumns(plot, makeRamp(), 250);
  ASSERT_FALSE(columns.empty());
  EXPECT_NEAR(0.5 * (*columns.begin() + *columns.rbegin()), left + 0.25 * 599.0, 1.0);
  EXPECT_LE(columns.size(), 4u);
  // A saddle: two lines, which do not cross.
  SlicePlot saddle = makeRamp();
  saddle.width = saddle.height = 2;
  saddle.values = {1.0f, 0.0f, 0.0f, 0.9f};
  SlicePlot lines = saddle;
  lines.contours = {0.5};
  EXPECT_EQ(pixelAt(drawSlicePlot(lines), left + 256, top + 256),
            pixelAt(drawSlicePlot(saddle), left + 256, top + 256));
}

TEST(SlicePlot, LogarithmicColoursPartDecadesEvenly)
{
  SlicePlot plot = makeRamp();
  plot.scale = {1e-4, 1.0, true};
  std::fill(plot.values.begin(), plot.values.end(), 0.01f);
  plot.values[0] = 0.0f;
  const Image image = drawSlicePlot(plot);
  EXPECT_NEAR(pixelAt(image, left + 300, 250)[0], 128, 1);
  // as where there is no value
  EXPECT_EQ(pixelAt(image, left, top + 511), (std::array<int, 3>{232, 232, 232}));
}

TEST(SlicePlot, SamplesLieAtTheirPlaces)
{
  SlicePlot plot = makeRamp();
  plot.samples = {{12.5, 0.0, 1.0}, {30.0, 0.0, 1.0}};
  const auto columns = changedColumns(plot, makeRamp(), top + 256);
  ASSERT_FALSE(columns.empty());
  EXPECT_NEAR(0.5 * (*columns.begin() + *columns.rbegin()), left + 0.25 * 599.0, 1.0);
  EXPECT_EQ(pixelAt(drawSlicePlot(plot), left + 150, top + 256)[0], 255);
}

TEST(SlicePlot, RimsHideNoSample)
{
  SlicePlot plot = makeRamp();
  for (int i = 0; i < 40; ++i) // half a pixel apart
    plot.samples.push_back({12.5 + 0.008 * i, 0.0, 1.0});
  const Image image = drawSlicePlot(plot);
  for (int column = 150; column < 169; ++column)
    EXPECT_EQ(pixelAt(image, left + column, top + 256)[0], 255);
}

TEST(SlicePlot, ColoursRangeOverTheValuesWithinThoseOfTheSamples)
{
  const AxisScale bounds{-1.0, 5.0};
  const auto of = [&](const std::vector<float>& values, bool is_logarithmic) {
    const auto range = findColorScale(values, bounds, is_logarithmic);
    return std::array<double, 2>{range.low, range.high};
  };
  using Range = std::array<double, 2>;
  EXPECT_EQ(of({1.0f, nan, 3.0f, -7e6f, 5.5f}, false), (Range{1.0, 3.0}));
  EXPECT_EQ(of({nan, 9.0f}, false), (Range{-1.0, 5.0}));
  EXPECT_EQ(of({-0.5f, 0.5f, 4.0f}, true), (Range{0.5, 4.0}));
  EXPECT_EQ(of({1e-20f, 4.0f}, true), (Range{4e-6, 4.0}));
  EXPECT_EQ(findColorScale({}, {-2.0, -1.0}, true).high, 1.0);
}

TEST(Profile, LinesAndGapsLieWhereTheValuesAre)
{
  Profile profile;
  for (int i = 0; i <= 100; ++i) {
    profile.abscissas.push_back(0.1 * i);
    profile.values.push_back(i > 40 && i < 60 ? std::nan("") : i);
    profile.errors.push_back(i > 80 ? 10.0 : 0.0);
  }
  const Image image = drawProfile(profile);
  const auto rowsAt = [&](int column, auto is_ink) {
    std::vector<int> rows;
    for (int row = 0; row < 370; ++row)
      if (is_ink(pixelAt(image, column, row)))
        rows.push_back(row);
    return rows;
  };
  const auto is_line = [](const std::array<int, 3>& p) {
    return p[0] < 100 && p[2] > 150;
  };
  const auto is_band = [](const std::array<int, 3>& p) {
    return p[0] == 205 && p[1] == 225 && p[2] == 240;
  };
  const auto at = [](double part) { return 110 + static_cast<int>(part * 590.0); };
  ASSERT_FALSE(rowsAt(at(0.2), is_line).empty());
  ASSERT_FALSE(rowsAt(at(0.7), is_line).empty());
  EXPECT_TRUE(rowsAt(at(0.5), is_line).empty());
  // The ordinate ranges over a twentieth more on both sides.
  const double rise =
      rowsAt(at(0.2), is_line).front() - rowsAt(at(0.7), is_line).front();
  EXPECT_NEAR(rise, 0.5 / 1.1 * (376 - 20), 3.0);
  EXPECT_TRUE(rowsAt(at(0.2), is_band).empty());
  EXPECT_NEAR(static_cast<double>(rowsAt(at(0.88), is_band).size()),
              20.0 / 110.0 * (376 - 20),
              8.0);
}

} // namespace test_slice_plot
