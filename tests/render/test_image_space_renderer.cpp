// SPDX-License-Identifier: BSD-3-Clause
// What a user of ImageSpaceRenderer relies on.
#include "render/renderer_setup.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace test_image_space_renderer {

using namespace uvol_test;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::ImageSpaceSettings;
using pcl_uvol::InvalidArgument;

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

TEST(ImageSpaceRenderer, ReturnsWhatItWasSetTo)
{
  Renderer renderer;
  EXPECT_FALSE(renderer.getCamera());
  EXPECT_EQ(renderer.getColorField(), "");
  EXPECT_FALSE(renderer.hasLogarithmicColors());
  EXPECT_FALSE(renderer.isHasty());
  Camera camera;
  camera.vertical_fov = 12.0;
  renderer.setCamera(camera);
  renderer.setColorField("T");
  renderer.setLogarithmicColors(true);
  renderer.setHasty(true);
  pcl_uvol::ImagePlanes planes;
  planes.id = !planes.id;
  renderer.setPlanes(planes);
  EXPECT_EQ(renderer.getCamera()->vertical_fov, 12.0);
  EXPECT_EQ(renderer.getColorField(), "T");
  EXPECT_TRUE(renderer.hasLogarithmicColors());
  EXPECT_TRUE(renderer.isHasty());
  EXPECT_EQ(renderer.getPlanes().id, planes.id);
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
  const std::vector<pcl_uvol::Rgba> green(cloud->size(), 0x00ff00);
  renderer.setPointColors(green);
  renderer.render(image);
  EXPECT_EQ(middle[0], 0);
  EXPECT_GT(middle[1], 100);
  renderer.setPointColors({0x00ff00});
  EXPECT_THROW(renderer.render(image), InvalidArgument);
  renderer.setPointColors({});
  renderer.setColorField("density");
  EXPECT_THROW(renderer.render(image), InvalidArgument);
}

TEST(ImageSpaceRenderer, DrawsItsIndicesOnly)
{
  const auto cloud = uvol_test::makeSphere(4000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 100, 100);
  const pcl::IndicesPtr some(new pcl::Indices);
  for (int i = 0; i < 4000; i += 2)
    some->push_back(i);
  Image image;
  renderer.render(image);
  const auto odd = [&] {
    return std::count_if(image.id.begin(), image.id.end(), [](std::uint32_t id) {
      return id != Image::background && id % 2 == 1;
    });
  };
  EXPECT_GT(odd(), 100);
  renderer.setIndices(some);
  renderer.render(image);
  EXPECT_EQ(odd(), 0);
  EXPECT_GT(seenPixels(image), 1000u);
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

} // namespace test_image_space_renderer
