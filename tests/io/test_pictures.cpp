// SPDX-License-Identifier: BSD-3-Clause
// Images as PNG files, and the colour bar drawn into them.
#include "support/environment.h"
#include "support/png.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/color_bar.h>
#include <pcl_uvol/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace {

using pcl_uvol::ColorMap;
using pcl_uvol::Image;
using pcl_uvol::IOError;

/** Every pixel tells its place. */
Image
makeImage(std::uint32_t width, std::uint32_t height, std::uint8_t opacity)
{
  Image image;
  image.width = width;
  image.height = height;
  image.color.resize(4 * static_cast<std::size_t>(width) * height);
  std::uint8_t* pixel = image.color.data();
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column, pixel += 4) {
      pixel[0] = static_cast<std::uint8_t>(column);
      pixel[1] = static_cast<std::uint8_t>(row);
      pixel[2] = static_cast<std::uint8_t>(column ^ row);
      pixel[3] = opacity;
    }
  return image;
}

Image
makePlain(std::uint32_t width, std::uint32_t height, std::uint8_t gray)
{
  Image image = makeImage(width, height, 255);
  for (std::size_t i = 0; i < image.color.size(); ++i)
    if (i % 4 != 3)
      image.color[i] = gray;
  return image;
}

const std::uint8_t*
pixelAt(const Image& image, std::uint32_t column, std::uint32_t row)
{
  return &image.color[4 * (static_cast<std::size_t>(row) * image.width + column)];
}

TEST(Png, KeepsEveryPixelInItsPlace)
{
  const uvol_test::TemporaryFolder folder;
  const std::string path = folder / "out.png";
  for (const auto& [opacity, expected] : {std::pair(255, 3), std::pair(77, 4)}) {
    const Image image = makeImage(37, 21, static_cast<std::uint8_t>(opacity));
    pcl_uvol::savePng(path, image);
    int channels = 0;
    const Image read = uvol_test::readPng(path, channels);
    EXPECT_EQ(expected, channels);
    EXPECT_EQ(image.width, read.width);
    EXPECT_EQ(image.height, read.height);
    EXPECT_EQ(image.color, read.color);
  }
}

TEST(Png, RefusesOtherNamesFoldersAndNoPixels)
{
  const uvol_test::TemporaryFolder folder;
  const Image image = makeImage(2, 2, 255);
  EXPECT_THROW(pcl_uvol::savePng(folder / "out.jpg", image), IOError);
  EXPECT_THROW(pcl_uvol::savePng("/nowhere/out.png", image), IOError);
  EXPECT_THROW(pcl_uvol::savePng(folder / "out.png", Image()),
               pcl_uvol::InvalidArgument);
  EXPECT_THROW(pcl_uvol::checkPngPath(folder / "out"), IOError);
  EXPECT_NO_THROW(pcl_uvol::checkPngPath(folder / "OUT.PNG"));
  EXPECT_TRUE(folder.list().empty());
}

TEST(ColorBar, ShowsTheMapWithItsLowEndBelow)
{
  Image image = makePlain(400, 300, 255);
  const ColorMap map;
  pcl_uvol::drawColorBar(image, map, -1.0, 3.0, "density");
  // The bar: the only colourful column beside the right border.
  std::uint32_t first = image.height, last = 0, column = image.width - 12;
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const std::uint8_t* const pixel = pixelAt(image, column, row);
    if (pixel[0] != pixel[1] || pixel[1] != pixel[2]) {
      first = std::min(first, row);
      last = std::max(last, row);
    }
  }
  ASSERT_GT(last, first + 150);
  const auto expectColor = [&](std::uint32_t row, double position) {
    const pcl_uvol::Color color = map.at(position);
    EXPECT_NEAR(255.0f * color.r, pixelAt(image, column, row)[0], 3.0);
    EXPECT_NEAR(255.0f * color.g, pixelAt(image, column, row)[1], 3.0);
    EXPECT_NEAR(255.0f * color.b, pixelAt(image, column, row)[2], 3.0);
  };
  expectColor(first, 1.0);
  expectColor((first + last) / 2, 0.5);
  expectColor(last, 0.0);
}

TEST(ColorBar, WritesReadableLettersOnAnyGround)
{
  for (const std::uint8_t gray : {std::uint8_t(255), std::uint8_t(0)}) {
    const Image before = makePlain(400, 300, gray);
    Image image = before;
    pcl_uvol::drawColorBar(image, ColorMap(), 0.0, 1.0, "density");
    std::size_t ink = 0;
    for (std::uint32_t row = 0; row < image.height; ++row)
      for (std::uint32_t column = 0; column < 370; ++column)
        ink += std::abs(pixelAt(image, column, row)[0] - gray) > 100 ? 1 : 0;
    EXPECT_GT(ink, 50u) << int(gray);
  }
}

TEST(ColorBar, TakesAnyRangeAndLeavesSmallImagesAlone)
{
  Image image = makePlain(300, 200, 255);
  EXPECT_NO_THROW(pcl_uvol::drawColorBar(image, ColorMap(), 2.0, 2.0, "constant"));
  EXPECT_NO_THROW(pcl_uvol::drawColorBar(image, ColorMap(), -1e30, 1e-30, ""));
  EXPECT_NO_THROW(
      pcl_uvol::drawColorBar(image, ColorMap(), 1.0, 1.0 + 1e-15, "narrow"));
  const Image small = makePlain(100, 200, 255);
  Image drawn = small;
  pcl_uvol::drawColorBar(drawn, ColorMap(), 0.0, 1.0, "density");
  EXPECT_EQ(small.color, drawn.color);
}

} // namespace
