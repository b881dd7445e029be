// SPDX-License-Identifier: BSD-3-Clause
// Plots of convergence: lines are where the values say.
#include "charts/line_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test_line_plot {

using pcl_uvol::Image;
using uvol_tools::drawLinePlot;

/** Rows of a column where the colour of the first line is, from top to bottom; letters
 * and the legend are elsewhere. */
std::vector<std::uint32_t>
blueRows(const Image& image, std::uint32_t column)
{
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 60; row < image.height; ++row) {
    const std::uint8_t* const pixel =
        &image.color[4 * (std::size_t{row} * image.width + column)];
    if (pixel[2] > 150 && pixel[0] < 100)
      rows.push_back(row);
  }
  return rows;
}

TEST(LinePlot, LinesFallAsTheirValues)
{
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i)
    values.push_back(std::pow(10.0, -0.04 * i));
  const Image image = drawLinePlot({{"change", values}}, "step");
  ASSERT_EQ(std::size_t{4} * image.width * image.height, image.color.size());
  // A straight line on a logarithmic ordinate.
  const auto at = [&](std::uint32_t column) {
    const auto rows = blueRows(image, column);
    EXPECT_FALSE(rows.empty()) << column;
    return rows.empty() ? 0.0 : 0.5 * (rows.front() + rows.back());
  };
  const double first = at(250), middle = at(350), last = at(450);
  EXPECT_GT(middle, first + 20.0);
  EXPECT_NEAR(middle - first, last - middle, 1.5);
}

TEST(LinePlot, ValuesThatAreNotPositiveLeaveAGap)
{
  std::vector<double> values(101, 0.5);
  for (std::size_t i = 40; i < 60; ++i)
    values[i] = i % 2 == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  const Image image = drawLinePlot({{"change", values}}, "step");
  EXPECT_FALSE(blueRows(image, 200).empty());
  EXPECT_TRUE(blueRows(image, 385).empty());
  EXPECT_FALSE(blueRows(image, 600).empty());
}

TEST(LinePlot, NothingToDrawIsAnEmptyPlot)
{
  for (const Image& image : {drawLinePlot({}, "step"),
                             drawLinePlot({{"change", {}}}, "step"),
                             drawLinePlot({{"change", {1.0}}}, "step"),
                             drawLinePlot({{"change", {0.0, -1.0}}}, "step")})
    EXPECT_FALSE(image.color.empty());
}

} // namespace test_line_plot
