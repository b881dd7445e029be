// SPDX-License-Identifier: BSD-3-Clause
// Image-space rendering on the CPU against brute force and analytic truth.
#include "support/surfaces.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/image_space/cpu_backend.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace {

using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::ImageSpaceSettings;
using pcl_uvol::InvalidArgument;
using pcl_uvol::View;
using uvol_test::SurfaceCloudPtr;
using Renderer = pcl_uvol::ImageSpaceRenderer<pcl::PointNormal>;

const Eigen::Vector3d from_above(0.3, 0.2, 1.0), upwards(0.0, 1.0, 0.0);

/** A renderer of all planes, the cloud in full view. */
void
prepare(Renderer& renderer, const SurfaceCloudPtr& cloud, int width, int height)
{
  renderer.setInputCloud(cloud);
  renderer.setSize(width, height);
  pcl_uvol::ImagePlanes planes;
  planes.depth = planes.normal = planes.id = true;
  renderer.setPlanes(planes);
  renderer.setCamera(Camera::fit(renderer.getBounds(),
                                 from_above,
                                 upwards,
                                 30.0,
                                 static_cast<double>(width) / height,
                                 0.72));
}

Camera
cameraOf(Renderer& renderer, int width, int height)
{
  return Camera::fit(renderer.getBounds(),
                     from_above,
                     upwards,
                     30.0,
                     static_cast<double>(width) / height,
                     0.72);
}

void
onlyProject(ImageSpaceSettings& settings)
{
  settings.footprints = false;
  settings.background_fill = settings.occluded_fill = 0;
  settings.smoothing = pcl_uvol::SmoothingFilter::None;
  settings.anti_aliasing = false;
}

std::size_t
seenPixels(const Image& image)
{
  std::size_t seen = 0;
  for (const std::uint32_t id : image.id)
    seen += id != Image::background ? 1 : 0;
  return seen;
}

/** Depth and point per pixel of the image with a border around it, by brute force. */
struct Oracle {
  int width, height, border;
  std::vector<double> depth;
  std::vector<std::uint32_t> id;

  Oracle(const View& view, int image_border)
      : width(view.width + 2 * image_border)
      , height(view.height + 2 * image_border)
      , border(image_border)
      , depth(static_cast<std::size_t>(width * height), 1.0)
      , id(depth.size(), Image::background)
  {
  }

  std::size_t
  at(int row, int column) const
  {
    return static_cast<std::size_t>(row * width + column);
  }

  void
  project(const pcl::PointCloud<pcl::PointNormal>& cloud,
          const Camera& camera,
          const View& view)
  {
    const Eigen::Matrix3d rows = camera.rotation();
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d x = cloud[i].getVector3fMap().cast<double>();
      const Eigen::Vector3d c = rows * (x - camera.eye);
      if (cloud[i].getNormalVector3fMap().cast<double>().dot(camera.eye - x) < 0.0)
        continue;
      const int column = static_cast<int>(
          std::floor(border + 0.5 * view.width + view.focal * c.x() / c.z()));
      const int row = static_cast<int>(
          std::floor(border + 0.5 * view.height + view.focal * c.y() / c.z()));
      if (column < 0 || row < 0 || column >= width || row >= height)
        continue;
      const double d = c.norm() / view.far;
      if (d < depth[at(row, column)]) {
        depth[at(row, column)] = d;
        id[at(row, column)] = i;
      }
    }
  }

  /** One iteration of Figure 4.8; white tells which cells a mask wants white. */
  void
  fill(bool occluded, double layer_distance)
  {
    static constexpr int ring[8][2] = {
        {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}};
    const Oracle before = *this;
    for (int row = 1; row + 1 < height; ++row)
      for (int column = 1; column + 1 < width; ++column) {
        const std::size_t here = at(row, column);
        if ((before.id[here] == Image::background) == occluded)
          continue;
        bool is_white[8], is_beyond = false;
        std::size_t nearest = here;
        for (int k = 0; k < 8; ++k) {
          const std::size_t there = at(row + ring[k][0], column + ring[k][1]);
          const bool is_background = before.id[there] == Image::background;
          is_white[k] = occluded
                            ? is_background || before.depth[there] >=
                                                   before.depth[here] - layer_distance
                            : is_background;
          if (!is_background &&
              (nearest == here || before.depth[there] < before.depth[nearest]))
            nearest = there;
        }
        for (int k = 0; k < 8; ++k)
          is_beyond |= is_white[k] && is_white[(k + 1) % 8] && is_white[(k + 2) % 8] &&
                       is_white[(k + 3) % 8];
        if (!is_beyond) {
          depth[here] = before.depth[nearest];
          id[here] = before.id[nearest];
        }
      }
  }

  /** Pixels of the image in which it differs. */
  std::size_t
  differences(const Image& image) const
  {
    std::size_t count = 0;
    for (int row = 0; row < static_cast<int>(image.height); ++row)
      for (int column = 0; column < static_cast<int>(image.width); ++column)
        count += image.id[static_cast<std::size_t>(row) * image.width +
                          static_cast<std::size_t>(column)] !=
                         id[at(row + border, column + border)]
                     ? 1
                     : 0;
    return count;
  }
};

TEST(Projection, EqualsBruteForce)
{
  const auto cloud = uvol_test::makeTorusKnot(30000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 210, 160);
  onlyProject(renderer.settings());
  Image image;
  renderer.render(image);
  const Camera camera = cameraOf(renderer, 210, 160);
  const View view(camera, renderer.getBounds(), 210, 160);
  Oracle oracle(view, View::guard);
  oracle.project(*cloud, camera, view);
  EXPECT_GT(seenPixels(image), 4000u);
  // Points on the border between two pixels round to either.
  EXPECT_LE(oracle.differences(image), 8u);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (image.id[i] == Image::background) {
      EXPECT_EQ(image.depth[i], 1.0f);
      continue;
    }
    const Eigen::Vector3d x = (*cloud)[image.id[i]].getVector3fMap().cast<double>();
    EXPECT_NEAR(image.depth[i], (x - camera.eye).norm() / view.far, 1e-6);
  }
}

TEST(PixelFilling, EqualsTheMasksOfTheThesis)
{
  const auto cloud = uvol_test::makeTorusKnot(10000, 1);
  for (const int iterations : {1, 2, 5, 40}) {
    Renderer renderer;
    prepare(renderer, cloud, 210, 160);
    onlyProject(renderer.settings());
    renderer.settings().background_fill = iterations;
    renderer.settings().occluded_fill = iterations;
    Image image;
    renderer.render(image);
    const Camera camera = cameraOf(renderer, 210, 160);
    const View view(camera, renderer.getBounds(), 210, 160);
    Oracle oracle(view, View::guard);
    oracle.project(*cloud, camera, view);
    EXPECT_GT(oracle.differences(image), 500u); // there is something to be filled
    for (int i = 0; i < iterations; ++i)
      oracle.fill(false, 0.0);
    for (int i = 0; i < iterations; ++i)
      oracle.fill(true, renderer.settings().layer_distance);
    EXPECT_LE(oracle.differences(image), 40u) << iterations;
  }
}

/** A sphere of radius 1 about the origin in the image: its outline is a circle. */
struct Outline {
  double center_x, center_y, radius;

  Outline(const Camera& camera, const View& view)
  {
    const Eigen::Vector3d c = camera.rotation() * -camera.eye;
    // Seen along its axis: the fitted camera looks at the centre.
    radius = view.focal * std::tan(std::asin(1.0 / c.norm()));
    center_x = 0.5 * view.width;
    center_y = 0.5 * view.height;
  }

  double
  beyond(int column, int row) const
  {
    return std::hypot(column + 0.5 - center_x, row + 0.5 - center_y) - radius;
  }
};

/** Renders a sphere of that many points; returns pixels left open inside, and how far
 * the outline grew in its 99th percentile. */
std::pair<std::size_t, double>
drawSphere(std::size_t points, int size)
{
  Renderer renderer;
  const auto cloud = uvol_test::makeSphere(points, 1);
  prepare(renderer, cloud, size, size);
  Camera camera =
      Camera::fit({{0.0, 0.0, 0.0}, 1.0}, from_above, upwards, 30.0, 1.0, 0.72);
  renderer.setCamera(camera);
  Image image;
  renderer.render(image);
  const View view(camera, renderer.getBounds(), size, size);
  const Outline outline(camera, view);
  std::size_t open = 0;
  std::vector<double> growth;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const bool is_seen =
          image.id[static_cast<std::size_t>(row * size + column)] != Image::background;
      const double beyond = outline.beyond(column, row);
      open += !is_seen && beyond < -1.5 ? 1 : 0;
      if (is_seen && beyond > 0.0)
        growth.push_back(beyond);
    }
  std::sort(growth.begin(), growth.end());
  return {open, growth.empty() ? 0.0 : growth[growth.size() * 99 / 100]};
}

TEST(Footprints, CloseASphereAtAnyDensity)
{
  // The first is that of the thesis: 0.13 points per pixel look towards the eye.
  for (const auto& [points, size] : {std::pair(113000, 1024),
                                     std::pair(113000, 512),
                                     std::pair(113000, 300),
                                     std::pair(20000, 512),
                                     std::pair(3000, 700)}) {
    const auto [open, growth] = drawSphere(static_cast<std::size_t>(points), size);
    const double spacing =
        std::sqrt(4.0 * 3.14159265 / points) * 0.36 * size; // in pixels
    EXPECT_EQ(open, 0u) << points << " points, " << size;
    EXPECT_LE(growth, std::max(1.0, 0.7 * spacing)) << points << " points, " << size;
  }
}

TEST(Footprints, AreNotDrawnWithoutThem)
{
  Renderer renderer;
  prepare(renderer, uvol_test::makeSphere(3000, 1), 500, 500);
  renderer.settings().footprints = false;
  Image image;
  renderer.render(image);
  EXPECT_LT(seenPixels(image), 4000u);
}

TEST(Footprints, OccludedLayersDoNotShineThrough)
{
  // The inner sphere has half the radius.
  const auto outer = uvol_test::makeSphere(60000, 1);
  auto inner = *uvol_test::makeSphere(60000, 2);
  for (auto& point : inner)
    point.getVector3fMap() *= 0.5f;
  for (const int size : {150, 400, 900}) {
    Renderer renderer;
    prepare(renderer, uvol_test::joined(*outer, inner), size, size);
    Image image;
    renderer.render(image);
    std::size_t shining = 0;
    for (const std::uint32_t id : image.id)
      shining += id != Image::background && id >= outer->size() ? 1 : 0;
    EXPECT_EQ(shining, 0u) << size;
  }
}

TEST(Footprints, CloseTenfoldZoomAndStayOnTheSurface)
{
  const auto cloud = uvol_test::makeTorusKnot(60000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 300, 300);
  Camera camera = cameraOf(renderer, 300, 300);
  camera.at = Eigen::Vector3d(3.0, 0.0, 0.0); // t = 0: on the tube
  camera.eye = camera.at + 12.0 * Eigen::Vector3d(0.2, 0.1, 1.0);
  camera.vertical_fov = 2.0;
  renderer.setCamera(camera);
  Image image;
  renderer.render(image);
  EXPECT_EQ(seenPixels(image), image.pixels());
}

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
weightsOf(pcl_uvol::SmoothingFilter filter)
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
    const auto weights = weightsOf(filter);
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

TEST(ImageSpaceRenderer, GivesTheSameBytesOnAnyNumberOfThreads)
{
  const auto cloud = uvol_test::joined(*uvol_test::makeTorusKnot(40000, 1),
                                       *uvol_test::makeSphere(500, 2));
  for (const int size : {97, 640}) {
    Image first;
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
      Renderer renderer;
      renderer.setNumberOfThreads(threads);
      prepare(renderer, cloud, size, size + 31);
      renderer.settings().silhouettes = renderer.settings().feature_lines = true;
      Image image;
      renderer.render(image);
      if (first.color.empty())
        first = image;
      EXPECT_EQ(image.color, first.color) << threads;
      EXPECT_EQ(image.depth, first.depth) << threads;
      EXPECT_EQ(image.normal, first.normal) << threads;
      EXPECT_EQ(image.id, first.id) << threads;
    }
  }
}

TEST(ImageSpaceRenderer, GivesTheSameBytesWhateverWasDrawnBefore)
{
  const auto cloud = uvol_test::makeTorusKnot(20000, 1);
  Renderer fresh, used;
  prepare(used, cloud, 333, 222);
  Image image, expected;
  used.render(image);
  used.setSize(320, 222); // the same stride of rows
  used.render(image);
  prepare(fresh, cloud, 333, 222);
  fresh.setSize(320, 222);
  fresh.render(expected);
  EXPECT_EQ(image.color, expected.color);
  EXPECT_EQ(image.id, expected.id);
}

TEST(ImageSpaceRenderer, IsTheSamePictureFarFromTheOrigin)
{
  const auto near = uvol_test::makeSphere(20000, 1);
  SurfaceCloudPtr far(new pcl::PointCloud<pcl::PointNormal>(*near));
  for (auto& point : *far)
    point.getVector3fMap() += Eigen::Vector3f(1024.0f, -2048.0f, 512.0f);
  Renderer a, b;
  prepare(a, near, 128, 128);
  prepare(b, far, 128, 128);
  Image image_a, image_b;
  a.render(image_a);
  b.render(image_b);
  std::size_t different = 0;
  for (std::size_t i = 0; i < image_a.color.size(); ++i)
    different += std::abs(image_a.color[i] - image_b.color[i]) > 8 ? 1 : 0;
  EXPECT_LT(different, image_a.color.size() / 100);
}

TEST(ImageSpaceRenderer, ColoursByFieldAndByRgb)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal>::Ptr cloud(
      new pcl::PointCloud<pcl::PointXYZRGBNormal>);
  const auto sphere = uvol_test::makeSphere(50000, 1);
  for (const auto& point : *sphere) {
    pcl::PointXYZRGBNormal colored;
    colored.getVector3fMap() = point.getVector3fMap();
    colored.getNormalVector3fMap() = point.getNormalVector3fMap();
    colored.curvature = point.y; // from the lower to the upper half
    colored.r = 255;
    colored.g = colored.b = 0;
    cloud->push_back(colored);
  }
  pcl::PCLPointCloud2::Ptr blob(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*cloud, *blob);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(blob);
  renderer.setSize(100, 100);
  renderer.setCamera(
      Camera::fit(renderer.getBounds(), Eigen::Vector3d(0, 0, 1), upwards, 30.0, 1.0));
  renderer.settings().material.specular = 0.0;
  Image image;
  renderer.setColorField("rgb");
  renderer.render(image);
  const auto* const middle = &image.color[4 * (50 * 100 + 50)];
  EXPECT_GT(middle[0], 100);
  EXPECT_EQ(middle[1], 0);
  renderer.setColorField("curvature");
  renderer.render(image);
  EXPECT_NEAR(renderer.getColorRange()[0], -1.0, 0.01);
  EXPECT_NEAR(renderer.getColorRange()[1], 1.0, 0.01);
  const auto* const top = &image.color[4 * (20 * 100 + 50)];
  const auto* const bottom = &image.color[4 * (80 * 100 + 50)];
  EXPECT_GT(top[1], top[2]);       // green to yellow
  EXPECT_GT(bottom[2], bottom[1]); // violet
  renderer.setColorField("density");
  EXPECT_THROW(renderer.render(image), InvalidArgument);
}

TEST(ImageSpaceRenderer, SupersamplingAverages)
{
  Renderer renderer;
  const auto cloud = uvol_test::makeSphere(50000, 1);
  renderer.setInputCloud(cloud);
  renderer.setSize(100, 80);
  Image once, twice;
  renderer.render(once);
  renderer.setSupersampling(2);
  renderer.render(twice);
  EXPECT_EQ(twice.width, 100u);
  EXPECT_EQ(twice.height, 80u);
  ASSERT_EQ(twice.color.size(), once.color.size());
  double difference = 0.0;
  for (std::size_t i = 0; i < once.color.size(); ++i)
    difference += std::abs(once.color[i] - twice.color[i]);
  EXPECT_LT(difference / static_cast<double>(once.color.size()), 4.0);
  EXPECT_GT(difference, 0.0);
}

TEST(ImageSpaceRenderer, DrawsTheInsideFromWithin)
{
  // The camera in the middle of a sphere whose normals point inwards.
  auto cloud = uvol_test::makeSphere(50000, 1);
  for (auto& point : *cloud)
    point.getNormalVector3fMap() *= -1.0f;
  Renderer renderer;
  prepare(renderer, cloud, 200, 150);
  Camera camera;
  camera.eye = {0.1, 0.0, 0.0};
  camera.at = {1.0, 0.5, 0.2};
  camera.vertical_fov = 90.0;
  renderer.setCamera(camera);
  Image image;
  renderer.render(image);
  EXPECT_EQ(seenPixels(image), image.pixels());
}

TEST(ImageSpaceRenderer, PointsBehindTheCameraAreNotSeen)
{
  Renderer renderer;
  prepare(renderer, uvol_test::makeSphere(5000, 1), 50, 50);
  Camera camera;
  camera.eye = {0.0, 0.0, 5.0};
  camera.at = {0.0, 0.0, 9.0};
  renderer.setCamera(camera);
  Image image;
  renderer.render(image);
  EXPECT_EQ(seenPixels(image), 0u);
}

TEST(ImageSpaceRenderer, DrawsOnePoint)
{
  Renderer renderer;
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  pcl::PointNormal point;
  point.normal_x = 0.3f;
  point.normal_y = -1.0f;
  point.normal_z = 0.5f;
  cloud->push_back(point);
  renderer.setInputCloud(cloud);
  renderer.setSize(9, 9);
  pcl_uvol::ImagePlanes planes;
  planes.id = true;
  renderer.setPlanes(planes);
  Image image;
  renderer.render(image);
  EXPECT_EQ(seenPixels(image), 1u);
  EXPECT_EQ(image.id[4 * 9 + 4], 0u);
}

TEST(ImageSpaceRenderer, RefusesBadInput)
{
  Image image;
  Renderer renderer;
  EXPECT_THROW(renderer.render(image), InvalidArgument);
  renderer.setInputCloud(SurfaceCloudPtr(new pcl::PointCloud<pcl::PointNormal>));
  EXPECT_THROW(renderer.render(image), InvalidArgument);
  prepare(renderer, uvol_test::makeSphere(100, 1), 10, 10);
  EXPECT_NO_THROW(renderer.render(image));
  for (const auto& [width, height] :
       {std::pair(0, 10), std::pair(10, 0), std::pair(-5, 10), std::pair(20000, 10)}) {
    renderer.setSize(width, height);
    EXPECT_THROW(renderer.render(image), InvalidArgument) << width << " x " << height;
  }
  renderer.setSize(10, 10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](const std::function<void(ImageSpaceSettings&)>& spoil) {
    const ImageSpaceSettings good = renderer.settings();
    spoil(renderer.settings());
    EXPECT_THROW(renderer.render(image), InvalidArgument);
    renderer.settings() = good;
  };
  refuses([&](auto& s) { s.layer_distance = nan; });
  refuses([&](auto& s) { s.silhouette_threshold = 0.0; });
  refuses([&](auto& s) { s.silhouette_thickness = 8; });
  refuses([&](auto& s) { s.smoothing_iterations = -1; });
  refuses([&](auto& s) { s.background_fill = -1; });
  refuses([&](auto& s) { s.material.shininess = -1.0; });
  refuses([&](auto& s) { s.material.diffuse = nan; });
  refuses([&](auto& s) { s.material.color.g = static_cast<float>(nan); });
  refuses([&](auto& s) { s.lights[0].position.setZero(); });
  refuses([&](auto& s) { s.lights[1].position.x() = nan; });
  refuses([&](auto& s) { s.lights[0].color.r = -1.0f; });
  refuses([&](auto& s) { s.background.color.b = static_cast<float>(nan); });
  EXPECT_NO_THROW(renderer.render(image));
  renderer.setSupersampling(2);
  EXPECT_THROW(renderer.render(image), InvalidArgument); // planes cannot be averaged
}

} // namespace
