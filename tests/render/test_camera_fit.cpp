// SPDX-License-Identifier: BSD-3-Clause
// Cameras that see all points, as large as may be.
#include "render/camera_choice.h"
#include "render/camera_fit.h"

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace test_camera_fit {

using pcl_uvol::Camera;
using pcl_uvol::FittedDisc;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** Random points of a box. */
Cloud
makeBox(const Eigen::Vector3f& center, const Eigen::Vector3f& half)
{
  Cloud cloud;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  for (int i = 0; i < 3000; ++i) {
    pcl::PointXYZ point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = center[axis] + half[axis] * place(engine);
    cloud.push_back(point);
  }
  return cloud;
}

/** The ends of points in the image, in parts of half its height. */
struct Ends {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;

  Ends(const Camera& camera, const Cloud& cloud)
  {
    const double half = std::tan(camera.vertical_fov * M_PI / 360.0);
    for (const auto& point : cloud) {
      if (!std::isfinite(point.x))
        continue;
      const Eigen::Vector3d c =
          camera.rotation() * (point.getVector3fMap().cast<double>() - camera.eye);
      EXPECT_GT(c.z(), 0.0);
      left = std::min(left, c.x() / c.z() / half);
      right = std::max(right, c.x() / c.z() / half);
      top = std::min(top, c.y() / c.z() / half);
      bottom = std::max(bottom, c.y() / c.z() / half);
    }
  }
};

Camera
fitToAll(const Camera& camera,
         const Cloud& cloud,
         double aspect,
         const pcl_uvol::ImageFill& fill)
{
  return pcl_uvol::fitToPoints(camera, {pcl_uvol::viewOf(cloud), {}}, aspect, fill);
}

TEST(CameraFit, PointsFillTheImageAndLieInItsMiddle)
{
  for (const Eigen::Vector3f& half : {Eigen::Vector3f(1.0f, 0.1f, 0.05f),
                                      Eigen::Vector3f(0.1f, 0.2f, 3.0f),
                                      Eigen::Vector3f(5e3f, 4e3f, 0.0f)})
    for (const std::string& view : Camera::viewNames())
      for (const double aspect : {0.5, 1.0, 2.0}) {
        Cloud cloud = makeBox({100.0f, -20.0f, 7.0f}, half);
        cloud[5].x = std::numeric_limits<float>::quiet_NaN();
        const Camera ball =
            Camera::fit({{0.0, 0.0, 0.0}, 1.0}, view, 40.0, aspect, 0.9);
        const Camera camera = fitToAll(ball, cloud, aspect, {0.8});
        EXPECT_LT((camera.rotation() - ball.rotation()).norm(), 1e-9);
        const Ends ends(camera, cloud);
        const double width = std::max(ends.right, -ends.left) / aspect,
                     height = std::max(ends.bottom, -ends.top);
        EXPECT_NEAR(0.8, std::max(width, height), 1e-3) << view << ' ' << aspect;
        // Where there is room to spare, perspective shifts them a bit.
        EXPECT_NEAR(ends.right, -ends.left, width > height ? 1e-3 : 0.3 * aspect);
        EXPECT_NEAR(ends.bottom, -ends.top, height > width ? 1e-3 : 0.3);
      }
}

TEST(CameraFit, LeavesTheCameraOfASinglePlaceAlone)
{
  const Camera camera = Camera::fit({{1.0, 2.0, 3.0}, 1.0}, "iso", 30.0, 1.0);
  Cloud cloud;
  EXPECT_EQ(camera.eye, fitToAll(camera, cloud, 1.0, {}).eye);
  cloud.push_back({1.0f, 2.0f, 3.0f});
  EXPECT_EQ(camera.eye, fitToAll(camera, cloud, 1.0, {}).eye);
}

/** Points of the borders of discs about points. */
Cloud
makeBorders(const Cloud& centers, const std::vector<FittedDisc>& discs)
{
  constexpr int steps = 3600;
  Cloud borders;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Eigen::Vector3f normal(discs[i].normal.data()),
        across = normal.unitOrthogonal(), up = normal.cross(across);
    for (int step = 0; step < steps; ++step) {
      const auto angle = static_cast<float>(2.0 * M_PI * step / steps);
      pcl::PointXYZ point = centers[i];
      point.getVector3fMap() +=
          discs[i].radius * (std::cos(angle) * across + std::sin(angle) * up);
      borders.push_back(point);
    }
  }
  return borders;
}

TEST(CameraFit, DiscsAreInTheImage)
{
  Cloud cloud;
  cloud.push_back({0.0f, 0.0f, 0.0f});
  cloud.push_back({4.0f, 1.0f, 0.5f});
  cloud.push_back({1.0f, 3.0f, 2.0f});
  const std::vector<FittedDisc> discs = {{0.5f, {0.0f, 0.0f, 1.0f}},
                                         {1.0f, {0.6f, 0.0f, 0.8f}},
                                         {0.2f, {0.0f, -1.0f, 0.0f}}};
  for (const std::string& view : Camera::viewNames())
    for (const double aspect : {0.5, 2.0}) {
      const Camera camera = pcl_uvol::fitToPoints(
          Camera::fit({{0.0, 0.0, 0.0}, 1.0}, view, 40.0, aspect, 0.9),
          {pcl_uvol::viewOf(cloud), discs},
          aspect,
          {0.8});
      const Ends ends(camera, makeBorders(cloud, discs));
      const double width = std::max(ends.right, -ends.left) / aspect,
                   height = std::max(ends.bottom, -ends.top);
      EXPECT_NEAR(0.8, std::max(width, height), 1e-5) << view << ' ' << aspect;
    }
}

TEST(CameraFit, PointsThatDoNotCountMoveNoCamera)
{
  Cloud cloud = makeBox({1.0f, 2.0f, 3.0f}, {3.0f, 2.0f, 1.0f});
  const Camera ball = Camera::fit({{0.0, 0.0, 0.0}, 1.0}, "iso", 30.0, 1.0);
  const Camera before = fitToAll(ball, cloud, 1.0, {});
  cloud.push_back({500.0f, -300.0f, 20.0f});
  std::vector<FittedDisc> discs(cloud.size(), {0.0f, {0.0f, 0.0f, 1.0f}});
  discs.back().radius = std::numeric_limits<float>::quiet_NaN();
  for (const auto& axis : {std::optional<Eigen::Vector3d>(),
                           std::optional<Eigen::Vector3d>(Eigen::Vector3d::UnitZ())}) {
    Cloud counted = cloud;
    counted.resize(cloud.size() - 1);
    const Camera expected =
        pcl_uvol::fitToPoints(ball, {pcl_uvol::viewOf(counted), {}, axis}, 1.0);
    const Camera camera =
        pcl_uvol::fitToPoints(ball, {pcl_uvol::viewOf(cloud), discs, axis}, 1.0);
    EXPECT_EQ(expected.eye, camera.eye);
    EXPECT_EQ(expected.at, camera.at);
  }
  EXPECT_NE(before.eye, fitToAll(ball, cloud, 1.0, {}).eye);
}

TEST(CameraFit, FillsAsMuchOfEachSideAsAskedFor)
{
  const pcl_uvol::ImageFill fill{0.5, 0.9, 0.8, 0.3};
  for (const std::string& view : Camera::viewNames())
    for (const double aspect : {0.5, 2.0}) {
      const Cloud cloud = makeBox({100.0f, -20.0f, 7.0f}, {1.0f, 3.0f, 2.0f});
      const Camera ball = Camera::fit({{0.0, 0.0, 0.0}, 1.0}, view, 40.0, aspect, 0.9);
      const Ends ends(fitToAll(ball, cloud, aspect, fill), cloud);
      EXPECT_GE(ends.left, -0.5 * aspect - 1e-9) << view << ' ' << aspect;
      EXPECT_LE(ends.right, 0.9 * aspect + 1e-9) << view << ' ' << aspect;
      EXPECT_GE(ends.top, -0.8 - 1e-9) << view << ' ' << aspect;
      EXPECT_LE(ends.bottom, 0.3 + 1e-9) << view << ' ' << aspect;
      const double width = (ends.right - ends.left) / (1.4 * aspect),
                   height = (ends.bottom - ends.top) / 1.1;
      EXPECT_NEAR(1.0, std::max(width, height), 1e-3) << view << ' ' << aspect;
    }
}

TEST(CameraFit, EveryFrameOfATurnIsFitted)
{
  const Cloud cloud = makeBox({100.0f, -20.0f, 7.0f}, {5.0f, 0.5f, 1.0f});
  const std::vector<FittedDisc> discs(cloud.size(), {0.1f, {0.0f, 0.0f, 1.0f}});
  const pcl_uvol::CloudView seen = pcl_uvol::viewOf(cloud);
  for (const char* const view : {"front", "left", "iso", "top", "bottom"})
    for (const double aspect : {0.5, 2.0}) {
      pcl_uvol::CameraChoice choice;
      choice.view = view;
      choice.fill = {0.8};
      choice.turns = true;
      pcl_uvol::SeenSurface surface{{{0.0, 0.0, 0.0}, 1.0}, &seen};
      surface.find_discs = [&](const Camera&) { return discs; };
      const Camera camera = pcl_uvol::chooseCamera(choice, surface, {}, aspect);
      double largest = 0.0;
      for (int degree = 0; degree < 360; ++degree) {
        const Camera turned = pcl_uvol::orbit(choice, camera, degree);
        // All views turn about z: from above, one still looks from there.
        EXPECT_NEAR(camera.eye.z(), turned.eye.z(), 1e-9);
        const Ends ends(turned, cloud);
        largest = std::max({largest,
                            std::max(ends.right, -ends.left) / aspect,
                            std::max(ends.bottom, -ends.top)});
      }
      EXPECT_LE(largest, 0.8) << view << ' ' << aspect;
      EXPECT_GE(largest, 0.75) << view << ' ' << aspect;
    }
}

} // namespace test_camera_fit
