// SPDX-License-Identifier: BSD-3-Clause
// Scenes for the tests of the ray tracer.
#pragma once

#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace uvol_test {

using Vector = Eigen::Vector3d;

/** \brief A surface that shines by itself: all light is ambient. */
inline pcl_uvol::RayMaterial
glowing(float r, float g, float b)
{
  pcl_uvol::RayMaterial material;
  material.color = {r, g, b};
  material.ambient = 1.0;
  material.diffuse = material.specular = 0.0;
  return material;
}

/** \brief A surface that is only seen by what it mirrors and lets through. */
inline pcl_uvol::RayMaterial
clear(double mirrored, double let_through, double index = 1.0)
{
  pcl_uvol::RayMaterial material = glowing(0.0f, 0.0f, 0.0f);
  material.reflectivity = mirrored;
  material.transparency = let_through;
  material.refractive_index = index;
  return material;
}

inline pcl_uvol::Light
lightFrom(const Vector& place,
          pcl_uvol::Light::Kind kind = pcl_uvol::Light::Kind::Point)
{
  pcl_uvol::Light light;
  light.kind = kind;
  light.follows_camera = false;
  light.position = place;
  return light;
}

inline pcl_uvol::Camera
looking(const Vector& eye, const Vector& at, double fov, const Vector& up = {0, 0, 1})
{
  pcl_uvol::Camera camera;
  camera.eye = eye;
  camera.at = at;
  camera.up = up;
  camera.vertical_fov = fov;
  return camera;
}

/** \brief A square picture of a scene. */
inline pcl_uvol::Image
trace(const pcl_uvol::Scene& scene,
      const pcl_uvol::Camera& camera,
      int size,
      int depth = 4,
      unsigned threads = 0)
{
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(camera);
  tracer.setSize(size, size);
  tracer.setNumberOfThreads(threads);
  tracer.settings().depth = depth;
  tracer.setNormalPlane(true);
  pcl_uvol::Image image;
  tracer.render(image);
  return image;
}

/** \brief A channel of a pixel, in [0, 1]. */
inline double
channelAt(const pcl_uvol::Image& image, int column, int row, int channel = 0)
{
  const auto pixel =
      static_cast<std::size_t>(row) * image.width + static_cast<std::size_t>(column);
  return image.color[4 * pixel + static_cast<std::size_t>(channel)] / 255.0;
}

/** \brief Direction of the ray through a pixel of a square picture. */
inline Vector
rayThrough(const pcl_uvol::Camera& camera, int size, int column, int row)
{
  const Eigen::Matrix3d axes = camera.rotation();
  const double half = std::tan(camera.vertical_fov * M_PI / 360.0);
  const double x = (2.0 * (column + 0.5) / size - 1.0) * half;
  const double y = (2.0 * (row + 0.5) / size - 1.0) * half;
  return (axes.row(2) + x * axes.row(0) + y * axes.row(1)).transpose().normalized();
}

/** \brief A disc with one normal everywhere. */
inline pcl_uvol::PointSplat
discAt(const Vector& center, const Vector& normal, double radius)
{
  pcl_uvol::PointSplat splat;
  const Vector n = normal.normalized();
  splat.getVector3fMap() = center.cast<float>();
  splat.getNormalVector3fMap() = n.cast<float>();
  splat.getTangentVector3fMap() = n.unitOrthogonal().cast<float>();
  splat.radius = static_cast<float>(radius);
  return splat;
}

/** \brief An object of splats, one colour each. */
inline pcl_uvol::SplatObject
objectOf(const std::vector<pcl_uvol::PointSplat>& splats,
         const std::vector<pcl_uvol::Rgba>& colors = {})
{
  const pcl::PointCloud<pcl_uvol::PointSplat>::Ptr cloud(
      new pcl::PointCloud<pcl_uvol::PointSplat>);
  for (const pcl_uvol::PointSplat& splat : splats)
    cloud->push_back(splat);
  pcl_uvol::SplatObject object;
  object.splats = cloud;
  object.colors = colors;
  object.material = glowing(1.0f, 1.0f, 1.0f);
  return object;
}

} // namespace uvol_test
