// SPDX-License-Identifier: BSD-3-Clause
#include "noisy_shapes.h"

#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace uvol_test {

namespace {

constexpr double radius = 22.0;

/** Room around a shape, in spacings, and around what is measured of it. */
constexpr double room = 8.0, rim = 3.0;

/** Isopoints closer than that belong to one component. */
constexpr double link = 2.0;

std::size_t
countComponents(const pcl::PointCloud<pcl_uvol::PointIso>& surface)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  for (const pcl_uvol::PointIso& point : surface)
    points->push_back({point.x, point.y, point.z});
  if (points->empty())
    return 0;
  pcl::search::KdTree<pcl::PointXYZ> search;
  search.setInputCloud(points);
  std::vector<bool> known(points->size(), false);
  std::size_t components = 0;
  pcl::Indices near;
  std::vector<float> sq_dists;
  for (std::size_t i = 0; i < points->size(); ++i) {
    if (known[i])
      continue;
    ++components;
    known[i] = true;
    std::vector<std::size_t> open = {i};
    while (!open.empty()) {
      const std::size_t here = open.back();
      open.pop_back();
      search.radiusSearch((*points)[here], link, near, sq_dists);
      for (const int j : near)
        if (!known[static_cast<std::size_t>(j)]) {
          known[static_cast<std::size_t>(j)] = true;
          open.push_back(static_cast<std::size_t>(j));
        }
    }
  }
  return components;
}

Eigen::Vector3d
gradientOf(const Shape& shape, const Eigen::Vector3d& x)
{
  constexpr double step = 1e-4;
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(axis);
    gradient[axis] =
        (shape.distance(x + offset) - shape.distance(x - offset)) / (2.0 * step);
  }
  return gradient;
}

} // namespace

Shape
makeShape(const std::string& name)
{
  if (name == "sphere")
    return {"sphere", radius + room, 1, [](const Eigen::Vector3d& x) {
              return radius - x.norm();
            }};
  if (name == "torus")
    return {"torus", radius + 9.0 + room, 1, [](const Eigen::Vector3d& x) {
              return 9.0 - std::hypot(std::hypot(x[0], x[1]) - radius, x[2]);
            }};
  return {"two_spheres", 2.0 * radius + 2.0 + room, 2, [](const Eigen::Vector3d& x) {
            const double along = std::abs(x[0]) - (radius + 2.0);
            return radius - std::hypot(along, x[1], x[2]);
          }};
}

Shape
makeSmallShape(const std::string& name, double size)
{
  constexpr double pi = 3.14159265358979, half_side = 14.0;
  if (name == "sphere")
    return {"sphere", size + room, 1, [size](const Eigen::Vector3d& x) {
              return size - x.norm();
            }};
  if (name == "cylinder")
    return {"cylinder", half_side, 1, [size](const Eigen::Vector3d& x) {
              return size - std::hypot(x[0], x[1]);
            }};
  if (name == "sheet")
    return {"sheet", half_side, 2, [size](const Eigen::Vector3d& x) {
              return 0.5 * size - std::abs(x[2]);
            }};
  if (name == "torus")
    return {"torus", 3.5 * size + room, 1, [size](const Eigen::Vector3d& x) {
              return size - std::hypot(std::hypot(x[0], x[1]) - 2.5 * size, x[2]);
            }};
  const double height = size / 12.0, k = 2.0 * pi / size;
  return {"waves", half_side, 1, [height, k](const Eigen::Vector3d& x) {
            const double a = k * x[0], b = k * x[1];
            const double slope =
                height * k *
                std::hypot(std::cos(a) * std::sin(b), std::sin(a) * std::cos(b));
            return (height * std::sin(a) * std::sin(b) - x[2]) / std::hypot(1.0, slope);
          }};
}

namespace {

NoisyCloud
drawSamples(const Shape& shape, bool clustered, double noise, std::uint64_t seed)
{
  constexpr double pi = 3.14159265358979;
  NoisyCloud noisy{
      shape,
      clustered,
      noise,
      pcl::PointCloud<pcl::PointXYZI>::Ptr(new pcl::PointCloud<pcl::PointXYZI>)};
  const double extent = noisy.shape.extent;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-extent, extent),
      length(0.0, std::sqrt(3.0) * extent);
  std::normal_distribution<double> normal;
  // Density 1, or (radius / r)^2: as many samples in every shell of equal thickness.
  const auto tries =
      static_cast<std::size_t>(clustered ? 4.0 * pi * radius * radius * length.max()
                                         : std::pow(2.0 * extent, 3));
  for (std::size_t i = 0; i < tries; ++i) {
    Eigen::Vector3d x;
    if (clustered) {
      x = Eigen::Vector3d(normal(random), normal(random), normal(random));
      x *= length(random) / x.norm();
    }
    else
      x = Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random));
    const double value = noisy.shape.distance(x) + noisy.noise * normal(random);
    // Samples far outside of the shape are of no use to anybody.
    if (x.cwiseAbs().maxCoeff() > extent || noisy.shape.distance(x) < -room)
      continue;
    pcl::PointXYZI point;
    point.getVector3fMap() = x.cast<float>();
    point.intensity = static_cast<float>(value);
    noisy.cloud->push_back(point);
  }
  return noisy;
}

} // namespace

NoisyCloud
makeNoisyCloud(const Shape& shape, double noise, std::uint64_t seed)
{
  return drawSamples(shape, false, noise, seed);
}

NoisyCloud
makeNoisyCloud(const std::string& name,
               bool clustered,
               double noise,
               std::uint64_t seed)
{
  return drawSamples(makeShape(name), clustered, noise * radius, seed);
}

pcl::PointCloud<pcl_uvol::PointIso>
isopoints(const pcl::PointCloud<pcl::PointXYZI>::ConstPtr& cloud,
          pcl_uvol::Interpolation interpolation,
          double isovalue)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(isovalue);
  extraction.setInterpolation(interpolation);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  return surface;
}

SurfaceQuality
measure(const NoisyCloud& noisy, const pcl::PointCloud<pcl_uvol::PointIso>& surface)
{
  constexpr double degrees = 180.0 / 3.14159265358979;
  double sum = 0.0, squares = 0.0, all_squares = 0.0, angles = 0.0, count = 0.0;
  for (const pcl_uvol::PointIso& point : surface) {
    const Eigen::Vector3d x = point.getVector3fMap().cast<double>();
    const double inside = noisy.shape.distance(x);
    all_squares += inside * inside;
    if (x.cwiseAbs().maxCoeff() > noisy.shape.extent - rim)
      continue;
    ++count;
    const Eigen::Vector3d outwards = -gradientOf(noisy.shape, x);
    const Eigen::Vector3d normal = point.getNormalVector3fMap().cast<double>();
    const double angle =
        degrees * std::acos(std::clamp(normal.dot(outwards.normalized()), -1.0, 1.0));
    sum += inside;
    squares += inside * inside;
    angles += angle * angle;
  }
  return {std::sqrt(squares / count),
          std::sqrt(all_squares / static_cast<double>(surface.size())),
          sum / count,
          std::sqrt(angles / count),
          countComponents(surface)};
}

} // namespace uvol_test
