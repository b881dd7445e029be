// SPDX-License-Identifier: BSD-3-Clause
// Transparent surfaces over each other, by themselves and as a renderer draws them.
#include "render/image_space/layer_blend.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>
#include <pcl/common/io.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace test_layer_blend {

using pcl_uvol::Background;
using pcl_uvol::Image;
using pcl_uvol::InvalidArgument;
using pcl_uvol::detail::SurfaceLayer;

/** A picture of one pixel. */
SurfaceLayer
makeLayer(const std::array<std::uint8_t, 4>& color,
          float depth,
          double unit,
          double opacity)
{
  SurfaceLayer layer;
  layer.image.width = layer.image.height = 1;
  layer.image.color.assign(color.begin(), color.end());
  layer.image.depth = {depth};
  layer.depth_unit = unit;
  layer.opacity = opacity;
  return layer;
}

std::vector<std::uint8_t>
blended(const std::vector<SurfaceLayer>& layers, const Background& background)
{
  Image image;
  pcl_uvol::detail::blendLayers(layers, background, true, 1, image);
  return image.color;
}

TEST(LayerBlend, LaysTheNearestOneOnTop)
{
  const Background white;
  const std::array<std::uint8_t, 4> red{200, 0, 0, 255}, blue{0, 0, 200, 255};
  // A quarter of red over blue, as distances say: depths are in units of their own.
  for (const bool red_is_first : {true, false}) {
    std::vector<SurfaceLayer> layers = {makeLayer(red, 0.9f, 1.0, 0.25),
                                        makeLayer(blue, 0.5f, 2.0, 1.0)};
    if (!red_is_first)
      std::swap(layers[0], layers[1]);
    EXPECT_EQ((std::vector<std::uint8_t>{50, 0, 150, 255}), blended(layers, white));
  }
  EXPECT_EQ((std::vector<std::uint8_t>{0, 0, 200, 255}),
            blended({makeLayer(red, 0.9f, 1.0, 0.25), makeLayer(blue, 0.4f, 2.0, 1.0)},
                    white));
  // White shines through both: 0.5 (200, 0, 0) + 0.5 (0.5 (0, 0, 200) + 0.5 255).
  EXPECT_EQ((std::vector<std::uint8_t>{164, 64, 114, 255}),
            blended({makeLayer(red, 0.1f, 1.0, 0.5), makeLayer(blue, 0.2f, 1.0, 0.5)},
                    white));
}

TEST(LayerBlend, KeepsTheOpacityOfEdgesAndGround)
{
  Background none;
  none.kind = Background::Kind::Transparent;
  // Half covered by a half transparent surface.
  EXPECT_EQ((std::vector<std::uint8_t>{10, 20, 30, 64}),
            blended({makeLayer({10, 20, 30, 128}, 0.5f, 1.0, 0.5)}, none));
  EXPECT_EQ((std::vector<std::uint8_t>{0, 0, 0, 0}),
            blended({makeLayer({10, 20, 30, 0}, 0.5f, 1.0, 1.0)}, none));
  EXPECT_EQ((std::vector<std::uint8_t>{0, 0, 0, 0}),
            blended({makeLayer({10, 20, 30, 255}, 0.5f, 1.0, 0.0)}, none));
  Background gradient;
  gradient.kind = Background::Kind::Gradient;
  gradient.top = {1.0f, 0.0f, 0.0f};
  gradient.color = {0.0f, 0.0f, 1.0f};
  EXPECT_EQ((std::vector<std::uint8_t>{128, 0, 128, 255}),
            blended({makeLayer({0, 0, 0, 0}, 0.5f, 1.0, 1.0)}, gradient));
}

/** Balls around the origin, one in the other. */
pcl::PointCloud<pcl_uvol::PointIso>::Ptr
makeBalls(const std::vector<std::array<float, 2>>& radii_and_isovalues)
{
  pcl::PointCloud<pcl_uvol::PointIso>::Ptr cloud(
      new pcl::PointCloud<pcl_uvol::PointIso>);
  constexpr int count = 4000;
  for (const auto& [radius, isovalue] : radii_and_isovalues)
    for (int i = 0; i < count; ++i) {
      const float z = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / count;
      const float angle = 2.3999632f * static_cast<float>(i),
                  ring = std::sqrt(1.0f - z * z);
      pcl_uvol::PointIso point;
      point.normal_x = ring * std::cos(angle);
      point.normal_y = ring * std::sin(angle);
      point.normal_z = z;
      point.x = radius * point.normal_x;
      point.y = radius * point.normal_y;
      point.z = radius * point.normal_z;
      point.isovalue = isovalue;
      cloud->push_back(point);
    }
  return cloud;
}

/** Pictures of surfaces that light goes through. */
class Transparency : public testing::Test {
protected:
  Transparency()
  {
    renderer_.setSize(120, 100);
  }

  Image
  draw(const pcl::PointCloud<pcl_uvol::PointIso>::Ptr& cloud,
       const std::vector<double>& opacities)
  {
    renderer_.setInputCloud(cloud);
    renderer_.setOpacities(opacities);
    Image image;
    renderer_.render(image);
    return image;
  }

  pcl_uvol::ImageSpaceRenderer<pcl_uvol::PointIso> renderer_;
};

TEST_F(Transparency, ShowsWhatIsWithin)
{
  const auto both = makeBalls({{1.0f, 2.0f}, {0.5f, 7.0f}});
  const pcl_uvol::Camera camera =
      pcl_uvol::Camera::fit({{0.0, 0.0, 0.0}, 1.0}, "iso", 30.0, 1.2);
  renderer_.setCamera(camera);
  const Image outer = draw(makeBalls({{1.0f, 2.0f}}), {}),
              inner = draw(makeBalls({{0.5f, 7.0f}}), {}),
              mixed = draw(both, {0.25, 1.0}), opaque = draw(both, {1.0}),
              clear = draw(both, {0.0, 1.0});
  const std::size_t middle = 4 * (50 * 120 + 60);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(0.25 * outer.color[middle + k] + 0.75 * inner.color[middle + k],
                mixed.color[middle + k],
                1.0);
  // Borders are rounded twice.
  for (std::size_t i = 0; i < outer.color.size(); ++i) {
    ASSERT_NEAR(outer.color[i], opaque.color[i], 1) << i;
    ASSERT_NEAR(inner.color[i], clear.color[i], 1) << i;
  }
}

TEST_F(Transparency, IsTheSameOnAnyNumberOfThreadsAndWhenDrawnAgain)
{
  const auto both = makeBalls({{1.0f, 2.0f}, {0.5f, 7.0f}});
  renderer_.setSupersampling(2);
  renderer_.setNumberOfThreads(1);
  const Image first = draw(both, {0.4, 0.9});
  renderer_.setNumberOfThreads(3);
  EXPECT_EQ(first.color, draw(both, {0.4, 0.9}).color);
  Image again;
  renderer_.render(again);
  EXPECT_EQ(first.color, again.color);
  EXPECT_EQ(both->size(), renderer_.getReport().getCount("points"));
  renderer_.setOpacities({0.9, 0.4});
  renderer_.render(again);
  EXPECT_NE(first.color, again.color);
}

TEST_F(Transparency, TakesACloudWithoutIsovaluesAsOneSurface)
{
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud(new pcl::PointCloud<pcl::PointNormal>);
  pcl::copyPointCloud(*makeBalls({{1.0f, 0.0f}}), *cloud);
  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> renderer;
  renderer.setSize(60, 50);
  renderer.setInputCloud(cloud);
  Image opaque, half;
  renderer.render(opaque);
  renderer.setOpacities({0.5});
  renderer.render(half);
  const std::size_t middle = 4 * (25 * 60 + 30);
  EXPECT_NEAR(0.5 * (255 + opaque.color[middle]), half.color[middle], 1.0);
  // Isovalues that are no numbers are none.
  const auto balls = makeBalls({{1.0f, std::nanf("")}});
  renderer_.setCamera(pcl_uvol::Camera::fit({{0.0, 0.0, 0.0}, 1.0}, "iso", 30.0, 1.2));
  EXPECT_EQ(draw(makeBalls({{1.0f, 1.0f}}), {0.5}).color, draw(balls, {0.5}).color);
}

TEST_F(Transparency, NeedsAnOpacityForEveryIsovalue)
{
  const auto both = makeBalls({{1.0f, 2.0f}, {0.5f, 7.0f}});
  for (const std::vector<double>& wrong : {std::vector<double>{0.1, 0.2, 0.3},
                                           std::vector<double>{0.1, 1.5},
                                           std::vector<double>{-0.1},
                                           std::vector<double>{std::nan("")}})
    EXPECT_THROW(draw(both, wrong), InvalidArgument);
  pcl_uvol::ImagePlanes planes;
  planes.depth = true;
  renderer_.setPlanes(planes);
  EXPECT_THROW(draw(both, {0.5}), InvalidArgument);
}

} // namespace test_layer_blend
