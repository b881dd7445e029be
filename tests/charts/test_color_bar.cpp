// SPDX-License-Identifier: BSD-3-Clause
// The bar of colours that is drawn into pictures.
#include "charts/color_bar.h"
#include "charts/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace test_color_bar {

using pcl_uvol::ColorMap;
using pcl_uvol::Image;

Image
makePlain(std::uint32_t width, std::uint32_t height, std::uint8_t gray)
{
  Image image;
  image.width = width;
  image.height = height;
  image.color.resize(4 * static_cast<std::size_t>(width) * height, gray);
  for (std::size_t i = 3; i < image.color.size(); i += 4)
    image.color[i] = 255;
  return image;
}

const std::uint8_t*
pixelAt(const Image& image, std::uint32_t column, std::uint32_t row)
{
  return &image.color[4 * (static_cast<std::size_t>(row) * image.width + column)];
}

TEST(ColorBar, ShowsTheMapWithItsLowEndBelow)
{
  Image image = makePlain(400, 300, 255);
  const ColorMap map;
  uvol_tools::drawColorBar(image, map, {-1.0, 3.0}, "density");
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
    uvol_tools::drawColorBar(image, ColorMap(), {0.0, 1.0}, "density");
    std::size_t ink = 0;
    for (std::uint32_t row = 0; row < image.height; ++row)
      for (std::uint32_t column = 0; column < 370; ++column)
        ink += std::abs(pixelAt(image, column, row)[0] - gray) > 100 ? 1 : 0;
    EXPECT_GT(ink, 50u) << int(gray);
  }
}

TEST(ColorBar, HasRoomBesideThePicture)
{
  for (const auto& [width, height] : {std::pair(1024, 768), std::pair(200, 900)}) {
    const int bar = uvol_tools::colorBarWidth(width, height);
    EXPECT_GT(bar, 20);
    EXPECT_LE(bar, width / 3);
    const Image before = makePlain(
        static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 255);
    Image image = before;
    uvol_tools::drawColorBar(image, ColorMap(), {-123.4, 56.7}, "T");
    for (std::uint32_t row = 0; width > 500 && row < image.height; ++row)
      for (std::uint32_t column = 0; column < image.width - static_cast<unsigned>(bar);
           ++column)
        ASSERT_EQ(255, pixelAt(image, column, row)[0]);
  }
  EXPECT_EQ(0, uvol_tools::colorBarWidth(100, 2000));
}

TEST(ColorBar, BreaksALongTitle)
{
  const std::string title = "A rather long label for a colour bar (kg m-2 s-1)";
  for (const auto& [width, height] : {std::pair(1024, 1024), std::pair(400, 300)})
    for (const std::string& text : {title, std::string(2000, 'x')}) {
      Image image = makePlain(
          static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 255);
      const uvol_tools::TextKeeper keeper;
      uvol_tools::drawColorBar(image, ColorMap(), {0.0, 1.0}, text);
      std::string whole;
      double lowest = 0.0;
      for (const uvol_tools::TextLine& line : keeper.getLines()) {
        const Eigen::AlignedBox2d box = uvol_tools::boxAround(line);
        EXPECT_GE(box.min().x(), width - uvol_tools::colorBarWidth(width, height) - 8);
        EXPECT_GE(box.min().y(), 0.0);
        EXPECT_LT(box.max().y(), height);
        if (line.text.empty() || line.text.find_first_of("01") == 0)
          continue;
        EXPECT_GE(box.min().y() + 1.0, lowest); // below the line before
        lowest = box.max().y();
        whole += (whole.empty() ? "" : " ") + line.text;
      }
      if (text == title)
        EXPECT_EQ(title, whole);
      else
        EXPECT_EQ("x ..", whole.substr(whole.size() - 4));
    }
}

TEST(AxisLabels, DistinguishValues)
{
  using uvol_tools::labelValues;
  using Texts = std::vector<std::string>;
  EXPECT_EQ((Texts{"0", "0.5", "1"}), labelValues({0.0, 0.5, 1.0}).texts);
  EXPECT_EQ((Texts{"-1", "0", "1"}), labelValues({-1.0, 1e-17, 1.0}).texts);
  EXPECT_EQ((Texts{"1", "1.0001", "1.0002"}), labelValues({1.0, 1.0001, 1.0002}).texts);
  const auto stamps = labelValues({1.6e9, 1.6e9 + 30.0, 1.6e9 + 60.0});
  EXPECT_EQ((Texts{"0", "30", "60"}), stamps.texts);
  EXPECT_EQ("+ 1600000000", stamps.offset);
  const auto around = labelValues({1599999950.0, 1.6e9, 1600000050.0});
  EXPECT_EQ((Texts{"-50", "0", "50"}), around.texts);
  EXPECT_EQ("+ 1600000000", around.offset);
  const auto near_one = labelValues({0.99999999, 1.0, 1.00000001});
  EXPECT_EQ((Texts{"-1e-08", "0", "1e-08"}), near_one.texts);
  EXPECT_EQ("+ 1", near_one.offset);
  const auto later = labelValues({1234567801.0, 1234567831.0, 1234567861.0});
  EXPECT_EQ((Texts{"1", "31", "61"}), later.texts);
  EXPECT_EQ("+ 1234567800", later.offset);
  const auto below = labelValues({-1600000050.0, -1.6e9});
  EXPECT_EQ((Texts{"-50", "0"}), below.texts);
  EXPECT_EQ("- 1600000000", below.offset);
  EXPECT_EQ("", labelValues({60.0, 180.0}).offset);
  // One notation for all of them
  EXPECT_EQ((Texts{"0", "5e-05", "1e-04"}), labelValues({0.0, 5e-5, 1e-4}).texts);
  EXPECT_EQ((Texts{"-5e+05", "0", "5e+05", "1e+06", "1.5e+06"}),
            labelValues({-5e5, 0.0, 5e5, 1e6, 1.5e6}).texts);
  EXPECT_EQ((Texts{"9.995e+05", "1e+06"}), labelValues({999500.0, 1e6}).texts);
  EXPECT_EQ((Texts{"100000", "150000"}), labelValues({1e5, 1.5e5}).texts);
  EXPECT_EQ((Texts{"7"}), labelValues({7.0}).texts);
  // and no digits of rounding
  const auto small = labelValues({4500000.00005, 4500000.0001, 4500000.00015});
  EXPECT_EQ((Texts{"5e-05", "1e-04", "1.5e-04"}), small.texts);
  EXPECT_EQ("+ 4500000", small.offset);
}

TEST(ColorBar, WritesDecadesBesideALogarithmicScale)
{
  using uvol_tools::listTicks;
  const auto expectNear = [](const std::vector<double>& expected,
                             const std::vector<double>& found) {
    ASSERT_EQ(expected.size(), found.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(expected[i], found[i], 1e-12 * expected[i]);
  };
  expectNear({1e-3, 1e-2, 0.1, 1.0}, listTicks({1e-3, 1.5, true}));
  expectNear({2.0, 5.0, 10.0, 20.0}, listTicks({1.5, 30.0, true}));
  Image image = makePlain(400, 300, 255);
  const ColorMap map;
  uvol_tools::drawColorBar(image, map, {1e-3, 1.0, true}, "density");
  EXPECT_NE(makePlain(400, 300, 255).color, image.color);
}

TEST(ColorBar, DistinguishesValuesOfANarrowLogarithmicScale)
{
  using Texts = std::vector<std::string>;
  const auto labelsOf = [](double low, double high) {
    const auto labels = uvol_tools::labelBar({low, high, true}, 0.05);
    Texts texts;
    for (const auto& label : labels.values)
      texts.push_back(label.text);
    return std::pair(texts, labels.offset);
  };
  EXPECT_EQ(std::pair(Texts({"0.3", "0.4", "0.5", "0.6"}), std::string()),
            labelsOf(0.3, 0.6));
  EXPECT_EQ(std::pair(Texts({"-1e-05", "-5e-06", "0", "5e-06", "1e-05"}),
                      std::string("+ 0.6")),
            labelsOf(0.59999, 0.60001));
  EXPECT_EQ(std::pair(Texts({"1", "20", "40", "61"}), std::string("+ 1234567800")),
            labelsOf(1234567801.0, 1234567861.0));
  EXPECT_EQ(std::pair(Texts({"0.001235", "0.01", "0.1", "1"}), std::string()),
            labelsOf(0.0012346, 1.0));
  const auto places = uvol_tools::labelBar({0.3, 0.6, true}, 0.05).values;
  EXPECT_NEAR(std::log2(0.4 / 0.3), places[1].place, 1e-9);
}

TEST(ColorBar, HasOneColorAndOneLabelForOneValue)
{
  for (const bool is_logarithmic : {false, true}) {
    const pcl_uvol::ColorScale scale{0.6, 0.6, is_logarithmic};
    const auto labels = uvol_tools::labelBar(scale, 0.05).values;
    ASSERT_EQ(1u, labels.size());
    EXPECT_EQ("0.6", labels[0].text);
    EXPECT_EQ(0.5, labels[0].place);

    Image image = makePlain(400, 300, 255);
    const ColorMap map;
    uvol_tools::drawColorBar(image, map, scale, "rho");
    const auto ink = uvol_tools::inkOf(map.at(0.5)); // as the points have it
    std::size_t rows = 0;
    for (std::uint32_t row = 0; row < image.height; ++row) {
      const std::uint8_t* const pixel = pixelAt(image, image.width - 12, row);
      if (pixel[0] == pixel[1] && pixel[1] == pixel[2])
        continue; // ground and letters
      ++rows;
      EXPECT_TRUE(std::equal(ink.begin(), ink.end(), pixel)) << row;
    }
    EXPECT_EQ(180u, rows);
  }
}

TEST(ColorBar, ListsCategories)
{
  Image image = makePlain(400, 300, 255);
  const ColorMap map("tab10");
  uvol_tools::drawCategories(
      image,
      {{-1.0, map.ofCategory(-1.0)}, {0.0, map.at(0.0)}, {2.0, map.ofCategory(2.0)}},
      "label");
  const auto countColor = [&](double category) {
    const pcl_uvol::Rgba color = pcl_uvol::toRgba(map.ofCategory(category));
    std::size_t count = 0, row = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const std::uint8_t* const pixel = &image.color[4 * i];
      if ((color & 0xff) == pixel[0] && (color >> 8 & 0xff) == pixel[1] &&
          (color >> 16 & 0xff) == pixel[2]) {
        ++count;
        row += i / image.width;
      }
    }
    return std::pair(count, count > 0 ? row / count : 0);
  };
  EXPECT_GT(countColor(0.0).first, 100u);
  EXPECT_EQ(countColor(0.0).first, countColor(2.0).first);
  EXPECT_EQ(countColor(1.0).first, 0u);
  EXPECT_GT(countColor(0.0).second, countColor(2.0).second);
}

TEST(ColorBar, TakesAnyRangeAndLeavesSmallImagesAlone)
{
  Image image = makePlain(300, 200, 255);
  EXPECT_NO_THROW(uvol_tools::drawColorBar(image, ColorMap(), {2.0, 2.0}, "constant"));
  EXPECT_NO_THROW(uvol_tools::drawColorBar(image, ColorMap(), {-1e30, 1e-30}, ""));
  EXPECT_NO_THROW(
      uvol_tools::drawColorBar(image, ColorMap(), {1.0, 1.0 + 1e-15}, "narrow"));
  const Image small = makePlain(100, 200, 255);
  Image drawn = small;
  uvol_tools::drawColorBar(drawn, ColorMap(), {0.0, 1.0}, "density");
  EXPECT_EQ(small.color, drawn.color);
}

} // namespace test_color_bar
