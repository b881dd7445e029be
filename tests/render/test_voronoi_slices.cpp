// SPDX-License-Identifier: BSD-3-Clause
// Slices of Voronoi diagrams: a colour per region, at the place of its cells.
#include "common/random.h"
#include "render/voronoi_slices.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace test_voronoi_slices {

using pcl_uvol::drawVoronoiSlices;
using pcl_uvol::GridCell;
using pcl_uvol::GridShape;
using pcl_uvol::Image;
using pcl_uvol::InvalidArgument;
using pcl_uvol::VoronoiGrid;

constexpr std::uint32_t white = 0xffffffff;

/** Cells of side 1, and that many random points. */
VoronoiGrid
makeGrid(const std::array<std::uint32_t, 3>& cells, std::size_t points)
{
  std::vector<float> xyz;
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      xyz.push_back(static_cast<float>(cells[axis] * pcl_uvol::uniformAt(6, i, axis)));
  std::vector<std::uint32_t> all(points);
  std::iota(all.begin(), all.end(), 0u);
  GridShape shape;
  shape.cells = cells;
  pcl_uvol::FeatureTransform way;
  pcl_uvol::Report report;
  return VoronoiGrid(shape, xyz.data(), 3, all, way, 1, report);
}

std::uint32_t
colorAt(const Image& image, std::uint32_t column, std::uint32_t row)
{
  std::uint32_t color = 0;
  std::memcpy(&color,
              &image.color[4 * (std::size_t{row} * image.width + column)],
              sizeof(color));
  return color;
}

/** The colours of regions, which must be the same wherever they are seen. */
class Colors {
public:
  explicit Colors(const VoronoiGrid& grid)
      : grid_(grid)
  {
  }

  /** Compares a slice with the cells of a plane.
   * \param axes to the right, upwards, away
   * \param place of the plane
   * \param side of a cell in pixels */
  void
  expectPlane(const Image& image,
              const std::array<std::size_t, 3>& axes,
              std::uint32_t place,
              std::uint32_t left,
              std::uint32_t top,
              std::uint32_t side)
  {
    const auto& cells = grid_.getShape().cells;
    GridCell cell{};
    cell[axes[2]] = static_cast<std::uint16_t>(place);
    for (std::uint32_t y = 0; y < cells[axes[1]] * side; ++y)
      for (std::uint32_t x = 0; x < cells[axes[0]] * side; ++x) {
        cell[axes[0]] = static_cast<std::uint16_t>(x / side);
        cell[axes[1]] = static_cast<std::uint16_t>(cells[axes[1]] - 1 - y / side);
        const std::uint32_t region = grid_.getNearest()[grid_.getShape().indexOf(cell)];
        const std::uint32_t color = colorAt(image, left + x, top + y);
        ASSERT_EQ(color, known_.emplace(region, color).first->second)
            << x << ' ' << y << " of plane " << place;
      }
  }

  /** No two regions are of one colour, and each is opaque and not white. */
  void
  expectDifferent() const
  {
    std::set<std::uint32_t> colors;
    for (const auto& [region, color] : known_) {
      std::uint8_t channels[4];
      std::memcpy(channels, &color, sizeof(channels));
      EXPECT_EQ(255, channels[3]);
      EXPECT_NE(white, color);
      colors.insert(color);
    }
    EXPECT_EQ(known_.size(), colors.size());
    EXPECT_GT(colors.size(), 1u);
  }

private:
  const VoronoiGrid& grid_;
  std::map<std::uint32_t, std::uint32_t> known_;
};

TEST(VoronoiSlices, OneSliceIsTheMiddlePlane)
{
  const VoronoiGrid grid = makeGrid({{30, 20, 5}}, 25);
  const Image image = drawVoronoiSlices(grid, 2, 1);
  ASSERT_EQ(300u, image.width);
  ASSERT_EQ(200u, image.height);
  Colors colors(grid);
  colors.expectPlane(image, {{0, 1, 2}}, 2, 0, 0, 10);
  colors.expectDifferent();
}

TEST(VoronoiSlices, EveryAxisIsTheWayToLookAlong)
{
  const VoronoiGrid grid = makeGrid({{10, 30, 15}}, 25);
  const Image along_x = drawVoronoiSlices(grid, 0, 1);
  const Image along_y = drawVoronoiSlices(grid, 1, 1);
  ASSERT_EQ(300u, along_x.width);
  ASSERT_EQ(150u, along_x.height);
  ASSERT_EQ(200u, along_y.width);
  ASSERT_EQ(300u, along_y.height);
  Colors colors(grid);
  colors.expectPlane(along_x, {{1, 2, 0}}, 5, 0, 0, 10);
  colors.expectPlane(along_y, {{0, 2, 1}}, 15, 0, 0, 20);
  colors.expectDifferent();
}

TEST(VoronoiSlices, SlicesStandInRowsOfThree)
{
  const VoronoiGrid grid = makeGrid({{30, 20, 5}}, 25);
  const Image image = drawVoronoiSlices(grid, 2, 5);
  ASSERT_GT(image.width, 900u);
  ASSERT_GT(image.height, 400u);
  const std::uint32_t gap = image.height - 400;
  ASSERT_EQ(900 + 2 * gap, image.width);
  Colors colors(grid);
  for (std::uint32_t slice = 0; slice < 5; ++slice)
    colors.expectPlane(image,
                       {{0, 1, 2}},
                       slice,
                       slice % 3 * (300 + gap),
                       slice / 3 * (200 + gap),
                       10);
  colors.expectDifferent();
  for (std::uint32_t y = 0; y < image.height; ++y)
    EXPECT_EQ(white, colorAt(image, 300, y));
  for (std::uint32_t x = 0; x < image.width; ++x)
    EXPECT_EQ(white, colorAt(image, x, 200));
  EXPECT_EQ(white, colorAt(image, image.width - 1, image.height - 1)); // no sixth one
}

TEST(VoronoiSlices, SlicesAreSpreadEvenly)
{
  const VoronoiGrid grid = makeGrid({{20, 30, 60}}, 200);
  const Image image = drawVoronoiSlices(grid, 2, 3);
  const std::uint32_t gap = (image.width - 3 * 200) / 2;
  Colors colors(grid);
  for (std::uint32_t slice = 0; slice < 3; ++slice)
    colors.expectPlane(image, {{0, 1, 2}}, 10 + 20 * slice, slice * (200 + gap), 0, 10);
}

TEST(VoronoiSlices, ThereAreNoMoreThanPlanes)
{
  const VoronoiGrid grid = makeGrid({{7, 6, 4}}, 9);
  EXPECT_EQ(drawVoronoiSlices(grid, 2, 4).color,
            drawVoronoiSlices(grid, 2, 1000).color);
  EXPECT_EQ(drawVoronoiSlices(grid, 2, 4).color,
            drawVoronoiSlices(grid, 2, std::numeric_limits<int>::max()).color);
}

TEST(VoronoiSlices, LargeSlicesHaveAPixelPerCell)
{
  const VoronoiGrid grid = makeGrid({{700, 3, 2}}, 50);
  const Image image = drawVoronoiSlices(grid, 2, 1);
  ASSERT_EQ(700u, image.width);
  ASSERT_EQ(3u, image.height);
  Colors colors(grid);
  colors.expectPlane(image, {{0, 1, 2}}, 1, 0, 0, 1);
}

TEST(VoronoiSlices, OneCellIsOneSquare)
{
  const VoronoiGrid grid = makeGrid({{1, 1, 1}}, 3);
  const Image image = drawVoronoiSlices(grid, 1, 6);
  EXPECT_EQ(300u, image.width);
  EXPECT_EQ(300u, image.height);
  EXPECT_EQ(colorAt(image, 0, 0), colorAt(image, 299, 299));
}

TEST(VoronoiSlices, SlicesFillAPictureOfAGivenSize)
{
  const VoronoiGrid grid = makeGrid({{30, 20, 5}}, 25);
  // Two slices of 15 pixels per cell, with 4 in between, in the middle of the height.
  const Image image = drawVoronoiSlices(grid, 2, 2, 904, 500);
  ASSERT_EQ(904u, image.width);
  ASSERT_EQ(500u, image.height);
  Colors colors(grid);
  colors.expectPlane(image, {{0, 1, 2}}, 1, 0, 100, 15);
  colors.expectPlane(image, {{0, 1, 2}}, 3, 454, 100, 15);
  for (std::uint32_t x = 0; x < image.width; ++x)
    for (const std::uint32_t y : {0u, 99u, 400u, 499u})
      EXPECT_EQ(white, colorAt(image, x, y));
  // Pixels of less than a cell, and of all sizes.
  for (const int size : {1, 2, 7, 29, 100}) {
    const Image small = drawVoronoiSlices(grid, 2, 5, size, 2 * size);
    EXPECT_EQ(static_cast<std::uint32_t>(size), small.width);
    EXPECT_EQ(static_cast<std::uint32_t>(2 * size), small.height);
  }
}

TEST(VoronoiSlices, RefusesNonsense)
{
  const VoronoiGrid grid = makeGrid({{3, 3, 3}}, 3);
  for (const int axis : {-1, 3})
    EXPECT_THROW(drawVoronoiSlices(grid, axis, 1), InvalidArgument) << axis;
  for (const int slices : {0, -1})
    EXPECT_THROW(drawVoronoiSlices(grid, 0, slices), InvalidArgument) << slices;
}

} // namespace test_voronoi_slices
