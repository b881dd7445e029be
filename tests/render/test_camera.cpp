// SPDX-License-Identifier: BSD-3-Clause
// The camera: directions, fitting, and how a view projects.
#include "render/image_space/frame.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/renderer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test_camera {

using pcl_uvol::BoundingSphere;
using pcl_uvol::Camera;
using pcl_uvol::InvalidArgument;
using pcl_uvol::View;

constexpr double pi = 3.14159265358979323846;

TEST(Camera, LooksAlongOrthonormalAxes)
{
  Camera camera;
  camera.eye = {3.0, -4.0, 5.0};
  camera.at = {1.0, 1.0, 0.5};
  camera.up = {0.0, 0.3, 2.0};
  const Eigen::Matrix3d rows = camera.rotation();
  EXPECT_TRUE((rows * rows.transpose()).isIdentity(1e-12));
  EXPECT_NEAR(rows.determinant(), 1.0, 1e-12);
  EXPECT_TRUE((rows * (camera.at - camera.eye).normalized())
                  .isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_LT((rows * camera.up).y(), 0.0); // y points down
  EXPECT_NEAR((rows * camera.up).x(), 0.0, 1e-12);
}

TEST(Camera, FittedSphereFillsItsPartOfTheImage)
{
  const BoundingSphere sphere{{10.0, 20.0, -5.0}, 3.0};
  for (const double aspect : {0.5, 1.0, 2.0}) {
    const Camera camera = Camera::fit(sphere, "iso", 40.0, aspect, 0.72);
    EXPECT_EQ(camera.at, sphere.center);
    // The radius of the outline: the angle of the tangents.
    const double sine = sphere.radius / (camera.eye - camera.at).norm();
    const double half = std::tan(20.0 * pi / 180.0) * std::min(1.0, aspect);
    EXPECT_NEAR(std::tan(std::asin(sine)) / half, 0.72, 1e-9);
  }
}

TEST(Camera, ParallelProjectionKeepsSizesAtAnyDistance)
{
  Camera camera;
  camera.eye = {3.0, -4.0, 5.0};
  camera.at = {1.0, 1.0, 0.5};
  camera.up = {0.0, 0.3, 2.0};
  const Camera far = camera.parallel();
  const Eigen::Matrix3d rows = far.rotation();
  EXPECT_TRUE(rows.isApprox(camera.rotation(), 1e-12));
  // Half the height of a picture is 512 pixels, of which the ball around at fills them.
  const double half = std::tan(0.5 * camera.vertical_fov * pi / 180.0) *
                      (camera.eye - camera.at).norm();
  const double focal = 512.0 / std::tan(0.5 * far.vertical_fov * pi / 180.0);
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0}) {
        Eigen::Vector3d place(x, y, z);
        place *= half / std::max(place.norm(), 1.0);
        const Eigen::Vector3d seen = rows * (camera.at + place - far.eye),
                              offset = rows * place;
        for (int axis = 0; axis < 2; ++axis)
          EXPECT_NEAR(512.0 / half * offset[axis], focal * seen[axis] / seen.z(), 0.3);
      }
}

TEST(Camera, NamedViewsLookFromTheirSides)
{
  const BoundingSphere sphere{{0.0, 0.0, 0.0}, 1.0};
  const auto from = [&](const std::string& view) {
    return Camera::fit(sphere, view, 30.0, 1.0).eye.normalized();
  };
  EXPECT_TRUE(from("front").isApprox(-Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(from("right").isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(from("top").isApprox(Eigen::Vector3d::UnitZ()));
  // In the front view x points to the right, z upwards.
  const Eigen::Matrix3d rows = Camera::fit(sphere, "front", 30.0, 1.0).rotation();
  EXPECT_TRUE(rows.row(0).transpose().isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(rows.row(1).transpose().isApprox(-Eigen::Vector3d::UnitZ()));
  for (const std::string& view : Camera::viewNames())
    EXPECT_NO_THROW(Camera::fit(sphere, view, 30.0, 1.0).rotation()) << view;
}

TEST(Camera, OrbitComesBack)
{
  const Camera camera = Camera::fit({{1.0, 2.0, 3.0}, 2.0}, "iso", 30.0, 1.0);
  const Camera quarter = camera.orbited(90.0);
  EXPECT_NEAR((quarter.eye - quarter.at).norm(), (camera.eye - camera.at).norm(), 1e-9);
  EXPECT_NEAR(quarter.eye.z(), camera.eye.z(), 1e-9);
  EXPECT_TRUE(quarter.orbited(270.0).eye.isApprox(camera.eye, 1e-9));
  EXPECT_FALSE(quarter.eye.isApprox(camera.eye, 1e-3));
}

TEST(Camera, RefusesWhatCannotLook)
{
  const Camera good;
  EXPECT_NO_THROW(good.rotation());
  Camera bad = good;
  bad.at = bad.eye;
  EXPECT_THROW(bad.rotation(), InvalidArgument);
  bad = good;
  bad.up = bad.at - bad.eye;
  EXPECT_THROW(bad.rotation(), InvalidArgument);
  bad = good;
  bad.eye.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(bad.rotation(), InvalidArgument);
  for (const double degrees : {0.0, 180.0, -10.0}) {
    bad = good;
    bad.vertical_fov = degrees;
    EXPECT_THROW(bad.rotation(), InvalidArgument) << degrees;
  }
  EXPECT_THROW(Camera::fit({}, "above", 30.0, 1.0), InvalidArgument);
  EXPECT_NO_THROW(Camera::fit({}, "top", 30.0, 1.0).rotation()); // one point
}

TEST(View, ProjectsTheCentreAndTheBorder)
{
  const BoundingSphere sphere{{5.0, 0.0, 0.0}, 1.0};
  const Camera camera = Camera::fit(sphere, "front", 30.0, 2.0, 0.9);
  const View view(camera, sphere, 200, 100);
  EXPECT_FLOAT_EQ(view.translation[0], 0.0f);
  EXPECT_FLOAT_EQ(view.translation[1], 0.0f);
  EXPECT_FLOAT_EQ(view.center_x, 100.0f + View::guard);
  EXPECT_FLOAT_EQ(view.center_y, 50.0f + View::guard);
  // Half of the height at the distance 1.
  EXPECT_NEAR(50.0 / view.focal, std::tan(15.0 * pi / 180.0), 1e-6);
  EXPECT_GT(view.far, view.translation[2] + 1.0f);
}

TEST(View, RefusesSizesWithoutOrWithTooManyPixels)
{
  const BoundingSphere sphere{{0.0, 0.0, 0.0}, 1.0};
  const Camera camera = Camera::fit(sphere, "front", 30.0, 1.0);
  for (const int size : {0, -1, View::largest_size + 1, 1 << 20}) {
    EXPECT_THROW(View(camera, sphere, size, 10), InvalidArgument) << size;
    EXPECT_THROW(View(camera, sphere, 10, size), InvalidArgument) << size;
  }
  EXPECT_NO_THROW(View(camera, sphere, View::largest_size, 1));
}

} // namespace test_camera
