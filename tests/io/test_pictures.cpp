// SPDX-License-Identifier: BSD-3-Clause
// Images as PNG files.
#include "support/environment.h"
#include "support/png.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace test_pictures {

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

TEST(Png, SaysHowLargeItIsPrinted)
{
  const uvol_test::TemporaryFolder folder;
  const std::string path = folder / "out.png";
  const Image image = makeImage(37, 21, 255);
  pcl_uvol::savePng(path, image, {{"Title", "of 300 dpi"}}, 300.0);
  int channels = 0;
  EXPECT_EQ(image.color, uvol_test::readPng(path, channels).color);
  // 300 / 0.0254 = 11811 dots per meter, behind the first chunk, with its checksum.
  const std::string expected("\0\0\0\x09pHYs\0\0\x2e\x23\0\0\x2e\x23\1\x78\xa5\x3f\x76",
                             21);
  EXPECT_EQ(33u, uvol_test::readFile(path).find(expected));
  pcl_uvol::savePng(path, image);
  EXPECT_EQ(std::string::npos, uvol_test::readFile(path).find("pHYs"));
  for (const double resolution : {-1.0, 1e7, std::nan("")})
    EXPECT_THROW(pcl_uvol::encodePng(image, {}, resolution), pcl_uvol::InvalidArgument);
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

} // namespace test_pictures
