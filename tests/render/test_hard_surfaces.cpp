// SPDX-License-Identifier: BSD-3-Clause
// Pictures, by the settings that renderers start with, of surfaces that are not clean,
// closed and outward: normals that point inwards, open sheets, sheets that nearly
// touch, isovalues close to each other, outliers.
#include "render/renderer_setup.h"
#include <pcl_uvol/common/point_types.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace test_hard_surfaces {

using namespace uvol_test;
using pcl_uvol::Camera;
using pcl_uvol::Image;

/** Mean difference of two pictures in the red channel. */
double
meanDifference(const Image& a, const Image& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels(); ++i)
    sum += std::abs(a.color[4 * i] - b.color[4 * i]);
  return sum / static_cast<double>(a.pixels());
}

Image
draw(const SurfaceCloudPtr& cloud, int size)
{
  Renderer renderer;
  prepare(renderer, cloud, size, size);
  Image image;
  renderer.render(image);
  return image;
}

TEST(HardSurfaces, ABallWithNormalsThatPointInwardsLooksLikeTheOther)
{
  const auto outward = makeSphere(20000, 1);
  const SurfaceCloudPtr inward(new pcl::PointCloud<pcl::PointNormal>(*outward));
  for (auto& point : *inward)
    point.getNormalVector3fMap() *= -1.0f;
  const Image front = draw(outward, 300), back = draw(inward, 300);
  EXPECT_LT(meanDifference(front, back), 1.0);
  EXPECT_NEAR(static_cast<double>(seenPixels(front)),
              static_cast<double>(seenPixels(back)),
              0.005 * static_cast<double>(seenPixels(front)));
}

/** Pixels of a ball of few points, in light from the left, that are darker than the
 * left half of it can be. */
std::size_t
countDarkAtTheLitOutline(const Image& image)
{
  std::size_t dark = 0;
  for (std::size_t row = image.height / 3; row < 2 * image.height / 3; ++row)
    for (std::size_t column = 0; column < image.width / 3; ++column)
      dark += image.color[4 * (row * image.width + column)] < 30 ? 1 : 0;
  return dark;
}

TEST(HardSurfaces, DiscsThatStandOutAtOutlinesAreLitAsTheSideAroundThem)
{
  const auto outward = makeSphere(700, 1);
  const SurfaceCloudPtr inward(new pcl::PointCloud<pcl::PointNormal>(*outward));
  for (auto& point : *inward)
    point.getNormalVector3fMap() *= -1.0f;
  for (const auto& cloud : {outward, inward}) {
    Renderer renderer;
    prepare(renderer, cloud, 300, 300);
    pcl_uvol::Light light;
    light.position = {-1.0, 0.0, 0.3};
    renderer.settings().lights = {light};
    renderer.settings().material.ambient = 0.0;
    renderer.settings().material.specular = 0.0;
    Image image;
    renderer.render(image);
    EXPECT_LE(countDarkAtTheLitOutline(image), 3u) << (cloud == inward);
  }
}

/** Random points of the square of side 2 at a height. */
template <typename PointT>
void
addSheet(float z, float normal_z, std::size_t n, pcl::PointCloud<PointT>& cloud)
{
  std::mt19937_64 engine(cloud.size() + 1);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  for (std::size_t i = 0; i < n; ++i) {
    PointT point;
    point.x = place(engine);
    point.y = place(engine);
    point.z = z;
    point.normal_z = normal_z;
    cloud.push_back(point);
  }
}

Camera
cameraAbove()
{
  Camera camera;
  camera.eye = {0.0, 0.0, 3.0};
  camera.at = {0.0, 0.0, 0.0};
  camera.up = upwards;
  camera.vertical_fov = 30.0;
  return camera;
}

TEST(HardSurfaces, ASheetIsSeenFromBothSides)
{
  const SurfaceCloudPtr up(new pcl::PointCloud<pcl::PointNormal>),
      down(new pcl::PointCloud<pcl::PointNormal>);
  addSheet(0.0f, 1.0f, 4000, *up);
  addSheet(0.0f, -1.0f, 4000, *down);
  for (const auto& sheet : {up, down}) {
    Renderer renderer;
    prepare(renderer, sheet, 200, 200);
    renderer.setCamera(cameraAbove());
    Image image;
    renderer.render(image);
    EXPECT_EQ(image.pixels(), seenPixels(image));
    EXPECT_GT(image.color[4 * (100 * 200 + 100)], 120); // lit
    renderer.settings().cull_back_faces = true;
    renderer.render(image);
    EXPECT_EQ(sheet == up ? image.pixels() : 0u, seenPixels(image));
  }
}

/** The parts of pixels of the middle that are neither as they would be with the upper
 * sheet alone, nor with the lower one: blended from both. */
template <typename PointT>
double
partOfMixed(const pcl::PointCloud<PointT>& cloud, const std::string& field)
{
  pcl_uvol::ImageSpaceRenderer<PointT> renderer;
  renderer.setInputCloud(cloud.makeShared());
  renderer.setSize(400, 400);
  renderer.setCamera(cameraAbove());
  renderer.setColorField(field);
  renderer.settings().material.ambient = 1.0;
  renderer.settings().material.diffuse = 0.0;
  renderer.settings().material.specular = 0.0;
  renderer.settings().smoothing = pcl_uvol::SmoothingFilter::None;
  Image image;
  renderer.render(image);
  const pcl_uvol::Rgba low = pcl_uvol::toRgba(pcl_uvol::ColorMap().at(0.0)),
                       high = pcl_uvol::toRgba(pcl_uvol::ColorMap().at(1.0));
  std::size_t mixed = 0, of_high = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const auto distance = [&](pcl_uvol::Rgba color) {
      int most = 0;
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most,
                        std::abs(image.color[4 * i + k] -
                                 static_cast<int>(color >> (8 * k) & 0xff)));
      return most;
    };
    mixed += std::min(distance(low), distance(high)) > 8 ? 1 : 0;
    of_high += distance(high) <= 8 ? 1 : 0;
  }
  EXPECT_GT(of_high, image.pixels() * 9 / 10); // the upper sheet
  return static_cast<double>(mixed) / static_cast<double>(image.pixels());
}

TEST(HardSurfaces, DiscsDoNotBlendIntoTheOtherSide)
{
  // Footprints are some 0.06, and the sheets a tenth of that apart.
  pcl::PointCloud<pcl::PointXYZINormal> cloud;
  addSheet(0.006f, 1.0f, 1000, cloud);
  for (auto& point : cloud)
    point.intensity = 1.0f;
  addSheet(0.0f, -1.0f, 1000, cloud);
  EXPECT_LT(partOfMixed(cloud, "intensity"), 0.02);
}

TEST(HardSurfaces, DiscsDoNotBlendIntoAnotherIsovalue)
{
  pcl::PointCloud<pcl_uvol::PointIso> cloud;
  addSheet(0.006f, 1.0f, 1000, cloud);
  for (auto& point : cloud)
    point.isovalue = 180.0f;
  addSheet(0.0f, 1.0f, 1000, cloud);
  for (std::size_t i = 1000; i < cloud.size(); ++i)
    cloud[i].isovalue = 60.0f;
  EXPECT_LT(partOfMixed(cloud, "isovalue"), 0.02);
}

/** Pixels darker than a level. */
std::size_t
countDark(const Image& image, int level)
{
  std::size_t dark = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    dark += image.color[4 * i] < level ? 1 : 0;
  return dark;
}

TEST(HardSurfaces, AnOutlyingNormalMakesNoBlackSquare)
{
  // As dense as pixels, so that every one of them has its own point.
  const SurfaceCloudPtr plane(new pcl::PointCloud<pcl::PointNormal>);
  for (int y = -300; y <= 300; ++y)
    for (int x = -300; x <= 300; ++x) {
      pcl::PointNormal point;
      point.x = 0.004f * static_cast<float>(x);
      point.y = 0.004f * static_cast<float>(y);
      point.normal_z = 1.0f;
      if (x == 0 && y == 0)
        point.getNormalVector3fMap() = Eigen::Vector3f(0.8f, 0.0f, 0.6f);
      plane->push_back(point);
    }
  Renderer renderer;
  prepare(renderer, plane, 200, 200);
  renderer.setCamera(cameraAbove());
  renderer.settings().footprints = false;
  renderer.settings().feature_lines = true;
  renderer.settings().smoothing = pcl_uvol::SmoothingFilter::None;
  Image image;
  renderer.render(image);
  EXPECT_LE(countDark(image, 60), 1u);
}

TEST(HardSurfaces, SilhouettesAreAsWideWithSupersampling)
{
  // A wall, before which its upper half stands once more: the line lies in the middle.
  // Discs of fewer points would make a jagged edge, whose line is as much wider.
  const SurfaceCloudPtr wall(new pcl::PointCloud<pcl::PointNormal>);
  for (int y = -300; y <= 300; ++y)
    for (int x = -300; x <= 300; ++x) {
      pcl::PointNormal point;
      point.x = 0.005f * static_cast<float>(x);
      point.y = 0.005f * static_cast<float>(y);
      point.normal_z = 1.0f;
      wall->push_back(point);
      point.z = 0.5f;
      if (y > 0)
        wall->push_back(point);
    }
  Renderer renderer;
  renderer.setInputCloud(wall);
  renderer.setSize(120, 120);
  renderer.setCamera(Camera::fit(
      {{0.0, 0.0, 0.0}, 1.0}, Eigen::Vector3d::UnitZ(), upwards, 30.0, 1.0));
  renderer.settings().shading = renderer.settings().anti_aliasing = false;
  renderer.settings().silhouettes = true;
  for (const int thickness : {1, 2, 7})
    for (const int supersampling : {1, 2, 3, 8})
      for (const bool is_clear : {false, true}) {
        renderer.settings().silhouette_thickness = thickness;
        renderer.setSupersampling(supersampling);
        renderer.setOpacities(is_clear ? std::vector<double>{1.0}
                                       : std::vector<double>());
        Image image;
        renderer.render(image);
        double ink = 0.0; // of a column, in pixels
        for (std::size_t row = 0; row < image.height; ++row)
          ink += 1.0 - image.color[4 * (row * image.width + 60)] / 255.0;
        EXPECT_NEAR(2.0 * thickness - 1.0, ink, 0.3)
            << thickness << ' ' << supersampling << ' ' << is_clear;
      }
}

} // namespace test_hard_surfaces
