// SPDX-License-Identifier: BSD-3-Clause
// Colours of points: their own in either form, and those of a scalar field.
#include "io/random_dataset.h"
#include "render/point_colors.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace test_point_colors {

using pcl_uvol::ColorMap;
using pcl_uvol::colorPoints;
using pcl_uvol::hasColors;
using pcl_uvol::InvalidArgument;
using pcl_uvol::PointColors;
using pcl_uvol::Rgba;
using namespace uvol_test;

constexpr Rgba first_color = 0xff1e140a, second_color = 0xff000080; // 0xaabbggrr
constexpr std::array<std::array<std::uint8_t, 3>, 2> red_green_blue{
    {{10, 20, 30}, {128, 0, 0}}};

/** Two points of these colours. */
template <typename PointT>
pcl::PointCloud<PointT>
makePacked()
{
  pcl::PointCloud<PointT> cloud(2, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    cloud[i].r = red_green_blue[i][0];
    cloud[i].g = red_green_blue[i][1];
    cloud[i].b = red_green_blue[i][2];
    cloud[i].a = 7; // opacity is none of a surface
  }
  return cloud;
}

/** The same with a field for each channel, of one byte each. */
pcl_uvol::Dataset
makeChannels(const std::vector<FieldSpec>& specs)
{
  auto dataset = makeDataset(specs, 2, 1);
  for (const auto& field : dataset.cloud.fields)
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (std::size_t i = 0; i < 2; ++i)
        if (field.name == std::array<const char*, 3>{"red", "green", "blue"}[channel])
          dataset.cloud.data[i * dataset.cloud.point_step + field.offset] =
              red_green_blue[i][channel];
  return dataset;
}

pcl_uvol::Dataset
makeScalar(const std::vector<float>& values)
{
  auto dataset = makeDataset({{"q", Type::FLOAT32}}, values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    put(&dataset.cloud.data[i * dataset.cloud.point_step + 12], values[i]);
  return dataset;
}

TEST(PointColors, DistinguishTimeStamps)
{
  // A float holds seven digits.
  auto dataset = makeDataset({{"t", Type::FLOAT64}}, 5, 1);
  for (std::size_t i = 0; i < 5; ++i)
    put(&dataset.cloud.data[i * dataset.cloud.point_step + 12],
        1.6e9 + 0.25 * static_cast<double>(i));
  const PointColors colored =
      colorPoints(pcl_uvol::viewOf(dataset.cloud), "t", pcl_uvol::ColorMapping());
  EXPECT_EQ(1.6e9, colored.scale.low);
  EXPECT_EQ(1.6e9 + 1.0, colored.scale.high);
  EXPECT_EQ(ColorMap().apply({0.0f, 0.25f, 0.5f, 0.75f, 1.0f}, 0.0, 1.0),
            colored.colors);
}

TEST(PointColors, SeveralIsovaluesAreSeveral)
{
  pcl::PointCloud<pcl_uvol::PointIso> cloud(3, 1);
  EXPECT_FALSE(pcl_uvol::hasIsovalues(pcl_uvol::viewOf(cloud)));
  cloud[2].isovalue = 5.0f;
  EXPECT_TRUE(pcl_uvol::hasIsovalues(pcl_uvol::viewOf(cloud)));
  EXPECT_FALSE(
      pcl_uvol::hasIsovalues(pcl_uvol::viewOf(makePacked<pcl::PointXYZRGB>())));
}

PointColors
ownColors(const pcl_uvol::CloudView& cloud)
{
  return colorPoints(cloud, "rgb", pcl_uvol::ColorMapping());
}

void
expectTheTwo(const pcl_uvol::CloudView& cloud)
{
  EXPECT_TRUE(hasColors(cloud));
  for (const char* name : {"rgb", "rgba"}) {
    const auto colors = colorPoints(cloud, name, pcl_uvol::ColorMapping()).colors;
    EXPECT_EQ(colors, (std::vector<Rgba>{first_color, second_color}));
  }
}

TEST(PointColors, ArePackedOrThreeBytes)
{
  expectTheTwo(pcl_uvol::viewOf(makePacked<pcl::PointXYZRGB>()));
  expectTheTwo(pcl_uvol::viewOf(makePacked<pcl::PointXYZRGBA>()));
  const auto channels = makeChannels(
      {{"red", Type::UINT8}, {"green", Type::UINT8}, {"blue", Type::UINT8}});
  expectTheTwo(pcl_uvol::viewOf(channels.cloud));
  const auto mixed = makeChannels({{"blue", Type::UINT8},
                                   {"q", Type::FLOAT64},
                                   {"green", Type::UINT8},
                                   {"alpha", Type::UINT8},
                                   {"red", Type::UINT8}});
  expectTheTwo(pcl_uvol::viewOf(mixed.cloud));
}

TEST(PointColors, SurviveAPlyFile)
{
  const auto cloud = makePacked<pcl::PointXYZRGB>();
  pcl_uvol::Dataset dataset;
  pcl::toPCLPointCloud2(cloud, dataset.cloud);
  const TemporaryFolder folder;
  for (const bool ascii : {false, true}) {
    pcl_uvol::SaveOptions options;
    options.ascii = ascii;
    pcl_uvol::saveDataset(folder / "a.ply", dataset, options);
    const auto loaded = pcl_uvol::loadDataset(folder / "a.ply");
    expectTheTwo(pcl_uvol::viewOf(loaded.cloud));
  }
}

TEST(PointColors, PackedOnesComeFirst)
{
  auto dataset = makeChannels({{"red", Type::UINT8},
                               {"green", Type::UINT8},
                               {"blue", Type::UINT8},
                               {"rgb", Type::UINT32}});
  const std::size_t offset = dataset.cloud.fields.back().offset;
  for (std::size_t i = 0; i < 2; ++i)
    put(&dataset.cloud.data[i * dataset.cloud.point_step + offset],
        std::uint32_t{0x405060});
  EXPECT_EQ(ownColors(pcl_uvol::viewOf(dataset.cloud)).colors,
            (std::vector<Rgba>(2, 0xff605040)));
}

TEST(PointColors, OfOtherTypesOrChannelsAreNone)
{
  const std::vector<std::vector<FieldSpec>> none{
      {},
      {{"q", Type::FLOAT32}},
      {{"rgb", Type::FLOAT64}}, // as a table has it: not four bytes
      {{"red", Type::UINT8}, {"green", Type::UINT8}},
      {{"red", Type::FLOAT32}, {"green", Type::FLOAT32}, {"blue", Type::FLOAT32}},
      {{"red", Type::UINT8}, {"green", Type::UINT8}, {"blue", Type::UINT16}}};
  for (const auto& specs : none) {
    const auto dataset = makeDataset(specs, 2, 1);
    const auto view = pcl_uvol::viewOf(dataset.cloud);
    EXPECT_FALSE(hasColors(view)) << pcl_uvol::describeFields(view.fields);
    const std::string message = messageOf<InvalidArgument>([&] { ownColors(view); });
    EXPECT_NE(message.find(pcl_uvol::describeFields(view.fields)), std::string::npos)
        << message;
  }
}

TEST(PointColors, OfAFieldSpanItsRange)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values{3.0f, nan, -1.0f, 1.0f};
  const auto dataset = makeScalar(values);
  const ColorMap map("coolwarm");
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  const PointColors colored = colorPoints(view, "q", {map, std::nullopt, false});
  EXPECT_EQ(-1.0, colored.scale.low);
  EXPECT_EQ(3.0, colored.scale.high);
  EXPECT_EQ(colored.colors, map.apply(values, -1.0, 3.0));
  EXPECT_EQ(colored.colors[2], pcl_uvol::toRgba(map.at(0.0)));
  const std::array<double, 2> range{0.0, 10.0};
  const PointColors chosen = colorPoints(view, "q", {map, range, false});
  EXPECT_EQ(10.0, chosen.scale.high);
  EXPECT_EQ(chosen.colors, map.apply(values, 0.0, 10.0));
}

TEST(PointColors, InfiniteValuesDoNotWidenTheRange)
{
  const float infinity = std::numeric_limits<float>::infinity();
  const auto dataset = makeScalar({1.0f, infinity, 2.0f, -infinity});
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  const auto colored = colorPoints(view, "q", pcl_uvol::ColorMapping());
  EXPECT_EQ(1.0, colored.scale.low);
  EXPECT_EQ(2.0, colored.scale.high);
}

TEST(PointColors, AreLogarithmicOnRequest)
{
  const auto dataset = makeScalar({1e-9f, 1.0f, 10.0f, 1000.0f, 0.0f, -5.0f});
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  pcl_uvol::ColorMapping mapping;
  mapping.is_logarithmic = true;
  // Six decades of the twelve that there are, unless a range is given.
  EXPECT_NEAR(1e-3, colorPoints(view, "q", mapping).scale.low, 1e-12);
  mapping.range = {1.0, 1000.0};
  const PointColors colored = colorPoints(view, "q", mapping);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> places{0.0f, 0.0f, 1.0f / 3.0f, 1.0f, none, none};
  EXPECT_EQ(mapping.map.apply(places, 0.0, 1.0), colored.colors);
  pcl_uvol::Report report;
  warnOfLogarithms(view, "rgb", mapping, report);
  warnOfLogarithms(view, "q", pcl_uvol::ColorMapping(), report);
  EXPECT_TRUE(report.warnings.empty());
  warnOfLogarithms(view, "q", mapping, report);
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("no_logarithms", report.warnings[0].code);
  EXPECT_EQ(2.0, uvol_test::numberOf(report.warnings[0], "grey"));
  EXPECT_EQ(6.0, uvol_test::numberOf(report.warnings[0], "points"));
  mapping.range = {0.0, 1.0};
  EXPECT_THROW(colorPoints(view, "q", mapping), InvalidArgument);
  const auto negative = makeScalar({-1.0f, 0.0f});
  mapping.range.reset();
  EXPECT_THROW(colorPoints(pcl_uvol::viewOf(negative.cloud), "q", mapping),
               InvalidArgument);
}

TEST(PointColors, OfCategoriesAreThoseOfWholeNumbers)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const ColorMap map("tab10");
  const auto dataset = makeScalar({-1.0f, 0.0f, 3.0f, 15.0f, nan});
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  const auto colors = colorPoints(view, "q", {map, std::nullopt, false}).colors;
  EXPECT_EQ(0xffb4771fu, colors[1]); // 0xaabbggrr of matplotlib's "tab:blue"
  EXPECT_EQ(0xff2827d6u, colors[2]);
  EXPECT_EQ(pcl_uvol::toRgba(map.ofCategory(5.0)), colors[3]);
  EXPECT_EQ(0xff808080u, colors[0]);
  EXPECT_EQ(0xff808080u, colors[4]);
  EXPECT_EQ((std::vector<double>{-1.0, 0.0, 3.0, 15.0}),
            pcl_uvol::listCategories(view, "q", 4));
  EXPECT_TRUE(pcl_uvol::listCategories(view, "q", 3).empty());
  const auto fractions = makeScalar({0.0f, 0.5f});
  EXPECT_TRUE(
      pcl_uvol::listCategories(pcl_uvol::viewOf(fractions.cloud), "q", 3).empty());
}

TEST(PointColors, DistinguishCategoriesThatWouldShareAColor)
{
  const ColorMap map("tab10");
  const auto colorsOf = [&](const std::vector<float>& values) {
    const auto dataset = makeScalar(values);
    return colorPoints(pcl_uvol::viewOf(dataset.cloud), "q", {map, std::nullopt, false})
        .colors;
  };
  // 60 and 180 end in the same digit: the colours go by rank, and classes below 0 stay
  // grey.
  const auto ranked = colorsOf({180.0f, 60.0f, -1.0f});
  EXPECT_EQ(pcl_uvol::toRgba(map.ofCategory(1.0)), ranked[0]);
  EXPECT_EQ(pcl_uvol::toRgba(map.ofCategory(0.0)), ranked[1]);
  EXPECT_EQ(0xff808080u, ranked[2]);
  // Eleven numbers have to share ten colours.
  std::vector<float> many(11);
  std::iota(many.begin(), many.end(), 0.0f);
  const auto shared = colorsOf(many);
  EXPECT_EQ(shared[0], shared[10]);
}

TEST(PointColors, OfIsovaluesAreThoseOfTheirOrder)
{
  const ColorMap map("tab10");
  auto dataset = makeScalar({3.45f, -8.0f, 3.45f});
  for (auto& field : dataset.cloud.fields)
    if (field.name == "q")
      field.name = "isovalue";
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  const auto colors = colorPoints(view, "isovalue", {map, std::nullopt, false}).colors;
  EXPECT_EQ(pcl_uvol::toRgba(map.ofCategory(1.0)), colors[0]);
  EXPECT_EQ(pcl_uvol::toRgba(map.ofCategory(0.0)), colors[1]);
  EXPECT_EQ(colors[0], colors[2]);
  EXPECT_EQ(2u, pcl_uvol::listCategories(view, "isovalue", 10).size());
}

TEST(PointColors, OfFewCategoriesAreThoseOfOkabeAndIto)
{
  for (const std::size_t count : {2, 8, 9, 10, 11}) {
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 0.0f);
    const auto dataset = makeScalar(values);
    const auto view = pcl_uvol::viewOf(dataset.cloud);
    const ColorMap map = pcl_uvol::usualColorMapping(view, "q").map;
    EXPECT_EQ(count <= 10, map.isCategorical()) << count;
    if (count <= 10) {
      EXPECT_EQ(count <= 8 ? 8u : 10u, map.size()) << count;
    }
  }
  const ColorMap map("OkabeIto");
  EXPECT_EQ(0xff009fe6u, pcl_uvol::toRgba(map.ofCategory(0.0))); // 0xaabbggrr of orange
  EXPECT_EQ(0xffe9b456u, pcl_uvol::toRgba(map.ofCategory(1.0)));
  EXPECT_EQ(0xff000000u, pcl_uvol::toRgba(map.ofCategory(7.0)));
}

TEST(PointColors, RefuseAFieldThatIsUnknownOrWithoutANumber)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto dataset = makeScalar({nan, nan});
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  for (const char* name : {"q", "density"}) {
    const std::string message = messageOf<InvalidArgument>(
        [&] { colorPoints(view, name, pcl_uvol::ColorMapping()); });
    EXPECT_NE(message.find(name), std::string::npos) << message;
  }
}

} // namespace test_point_colors
