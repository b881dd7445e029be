// SPDX-License-Identifier: BSD-3-Clause
// Shading, filters and lines against analytic truth (thesis 4.3.1, 4.3.3 to 4.3.5).
#include "render/image_space/frame.h"
#include "render/renderer_setup.h"

#include <algorithm>
#include <array>
#include <vector>

namespace test_shading {

using namespace uvol_test;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::ImageSpaceSettings;
using pcl_uvol::View;

TEST(Shading, IsBlinnPhong)
{
  const auto cloud = uvol_test::makeSphere(200000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 200, 200);
  ImageSpaceSettings& settings = renderer.settings();
  onlyProject(settings);
  pcl_uvol::Light directional, point;
  directional.follows_camera = false;
  directional.position = {1.0, 2.0, 3.0};
  directional.color = {0.6f, 0.5f, 0.4f};
  point.kind = pcl_uvol::Light::Kind::Point;
  point.follows_camera = false;
  point.position = {-2.0, 1.0, 2.5};
  point.color = {0.1f, 0.3f, 0.5f};
  settings.lights = {directional, point};
  settings.material.color = {0.7f, 0.5f, 0.9f};
  settings.cull_back_faces = true; // at the outline single points look away
  Image image;
  renderer.render(image);
  const Camera camera = cameraOf(renderer, 200, 200);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (image.id[i] == Image::background)
      continue;
    const auto& sample = (*cloud)[image.id[i]];
    const Eigen::Vector3d x = sample.getVector3fMap().cast<double>();
    const Eigen::Vector3d n = sample.getNormalVector3fMap().cast<double>();
    const Eigen::Vector3d v = (camera.eye - x).normalized();
    double color[3];
    const double surface[3] = {std::round(255 * 0.7) / 255,
                               std::round(255 * 0.5) / 255,
                               std::round(255 * 0.9) / 255};
    for (int k = 0; k < 3; ++k)
      color[k] = surface[k] * settings.material.ambient;
    for (const pcl_uvol::Light& light : settings.lights) {
      const Eigen::Vector3d l = light.kind == pcl_uvol::Light::Kind::Point
                                    ? Eigen::Vector3d((light.position - x).normalized())
                                    : Eigen::Vector3d(light.position.normalized());
      const double cosine = n.dot(l);
      if (cosine <= 0.0)
        continue;
      const double highlight = std::pow(std::max(0.0, n.dot((l + v).normalized())),
                                        settings.material.shininess);
      const float channels[3] = {light.color.r, light.color.g, light.color.b};
      for (int k = 0; k < 3; ++k)
        color[k] += channels[k] * (surface[k] * settings.material.diffuse * cosine +
                                   settings.material.specular * highlight);
    }
    // The place is that of the pixel's middle, not of the point.
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(image.color[4 * i + static_cast<std::size_t>(k)],
                  255.0 * std::min(1.0, color[k]),
                  4.0);
    ++compared;
  }
  EXPECT_GT(compared, 10000u);
}

/** Weights of Table 4.1, row by row. */
std::array<int, 9>
computeWeights(pcl_uvol::SmoothingFilter filter)
{
  if (filter == pcl_uvol::SmoothingFilter::Box)
    return {1, 1, 1, 1, 1, 1, 1, 1, 1};
  const int middle = filter == pcl_uvol::SmoothingFilter::Gaussian ? 4 : 16;
  return {1, 2, 1, 2, middle, 2, 1, 2, 1};
}

TEST(Smoothing, IsTable4_1WithoutTheBackground)
{
  using pcl_uvol::SmoothingFilter;
  const auto cloud = uvol_test::makeWaves(30000, 1);
  for (const auto filter : {SmoothingFilter::Box,
                            SmoothingFilter::Gaussian,
                            SmoothingFilter::AlleviatedGaussian}) {
    Renderer renderer;
    prepare(renderer, cloud, 150, 150);
    renderer.settings().anti_aliasing = false;
    renderer.settings().background.color = {0.0f, 0.0f, 0.0f};
    renderer.settings().smoothing = SmoothingFilter::None;
    Image rough, smooth;
    renderer.render(rough);
    renderer.settings().smoothing = filter;
    renderer.render(smooth);
    const auto weights = computeWeights(filter);
    int largest = 0;
    for (int row = 1; row < 149; ++row)
      for (int column = 1; column < 149; ++column) {
        const auto pixel = static_cast<std::size_t>(150 * row + column);
        if (rough.id[pixel] == Image::background)
          continue;
        double sum = 0.0, weight = 0.0;
        for (int k = 0; k < 9; ++k) {
          const auto there =
              static_cast<std::size_t>(150 * (row + k / 3 - 1) + column + k % 3 - 1);
          if (rough.id[there] == Image::background)
            continue;
          sum += weights[static_cast<std::size_t>(k)] * rough.color[4 * there];
          weight += weights[static_cast<std::size_t>(k)];
        }
        EXPECT_NEAR(smooth.color[4 * pixel], sum / weight, 1.01);
        largest = std::max(largest,
                           std::abs(smooth.color[4 * pixel] - rough.color[4 * pixel]));
      }
    EXPECT_GT(largest, 3); // there is something to be smoothed
  }
}

TEST(Lines, LieOnSilhouettesAndFeatures)
{
  const auto cloud = uvol_test::makeSphere(300000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 300, 300);
  const Camera camera =
      Camera::fit({{0.0, 0.0, 0.0}, 1.0}, from_above, upwards, 30.0, 1.0, 0.72);
  renderer.setCamera(camera);
  ImageSpaceSettings& settings = renderer.settings();
  settings.shading = settings.anti_aliasing = false;
  settings.silhouettes = true;
  settings.line_color = {1.0f, 0.0f, 0.0f};
  const Outline outline(camera, View(camera, renderer.getBounds(), 300, 300));
  std::size_t before = 0;
  for (const int thickness : {1, 3}) {
    settings.silhouette_thickness = thickness;
    Image image;
    renderer.render(image);
    std::size_t drawn = 0, at_outline = 0;
    for (int row = 0; row < 300; ++row)
      for (int column = 0; column < 300; ++column) {
        const std::uint8_t* const pixel =
            &image.color[static_cast<std::size_t>(4 * (300 * row + column))];
        if (pixel[0] > 200 && pixel[1] < 100) {
          ++drawn;
          at_outline += std::abs(outline.beyond(column, row)) < thickness + 2.0 ? 1 : 0;
        }
      }
    // About a ring of that thickness; where the surface is steep points stand out.
    EXPECT_GT(static_cast<double>(at_outline), 0.9 * static_cast<double>(drawn));
    EXPECT_GT(drawn, static_cast<std::size_t>(0.7 * thickness * 6.28 * outline.radius));
    EXPECT_GT(drawn, before);
    before = drawn;
  }
}

TEST(Lines, FeatureLinesFollowEdges)
{
  // Two planes that meet in a right angle along the y axis.
  SurfaceCloudPtr roof(new pcl::PointCloud<pcl::PointNormal>);
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 200; ++j) {
      pcl::PointNormal point;
      point.x = 0.01f * static_cast<float>(i) - 0.995f;
      point.y = 0.01f * static_cast<float>(j) - 0.995f;
      point.z = -std::abs(point.x);
      point.normal_x = point.x < 0.0f ? -0.70710678f : 0.70710678f;
      point.normal_z = 0.70710678f;
      roof->push_back(point);
    }
  Renderer renderer;
  prepare(renderer, roof, 200, 200);
  Camera camera = Camera::fit(
      {{0.0, 0.0, -0.5}, 1.5}, Eigen::Vector3d(0.0, 0.0, 1.0), upwards, 30.0, 1.0);
  renderer.setCamera(camera);
  ImageSpaceSettings& settings = renderer.settings();
  settings.shading = settings.anti_aliasing = false;
  settings.feature_lines = true;
  Image image;
  renderer.render(image);
  std::size_t on_edge = 0, elsewhere = 0;
  for (int row = 60; row < 140; ++row)
    for (int column = 0; column < 200; ++column)
      if (image.color[static_cast<std::size_t>(4 * (200 * row + column))] < 100)
        ++(std::abs(column - 99.5) < 4.0 ? on_edge : elsewhere);
  EXPECT_GE(on_edge, 80u);
  EXPECT_EQ(elsewhere, 0u);
}

TEST(AntiAliasing, SoftensTheOutlineOnly)
{
  const auto cloud = uvol_test::makeSphere(300000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 300, 300);
  renderer.settings().background.kind = pcl_uvol::Background::Kind::Transparent;
  renderer.settings().anti_aliasing = false;
  Image jagged, soft;
  renderer.render(jagged);
  renderer.settings().anti_aliasing = true;
  renderer.render(soft);
  std::size_t partial = 0;
  for (std::size_t i = 0; i < soft.pixels(); ++i) {
    EXPECT_TRUE(jagged.color[4 * i + 3] == 0 || jagged.color[4 * i + 3] == 255);
    const std::uint8_t opacity = soft.color[4 * i + 3];
    partial += opacity > 0 && opacity < 255 ? 1 : 0;
  }
  EXPECT_GT(partial, 500u);
  EXPECT_LT(partial, 3000u);
}

TEST(Background, PlainGradientAndTransparent)
{
  const auto cloud = uvol_test::makeSphere(1000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 64, 64);
  auto& background = renderer.settings().background;
  Image image;
  background.color = {0.2f, 0.4f, 0.6f};
  renderer.render(image);
  EXPECT_EQ(image.color[0], 51);
  EXPECT_EQ(image.color[1], 102);
  EXPECT_EQ(image.color[2], 153);
  EXPECT_EQ(image.color[3], 255);
  background.kind = pcl_uvol::Background::Kind::Gradient;
  background.top = {1.0f, 1.0f, 1.0f};
  renderer.render(image);
  EXPECT_GT(image.color[0], 250);
  EXPECT_LT(image.color[image.color.size() - 4], 56);
  background.kind = pcl_uvol::Background::Kind::Transparent;
  renderer.render(image);
  EXPECT_EQ(image.color[3], 0);
  EXPECT_EQ(image.color[4 * (32 * 64 + 32) + 3], 255);
}

} // namespace test_shading
