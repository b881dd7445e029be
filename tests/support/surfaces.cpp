// SPDX-License-Identifier: BSD-3-Clause
#include "support/surfaces.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace uvol_test {

namespace {

constexpr double pi = 3.14159265358979323846;

using Random = std::uniform_real_distribution<double>;

pcl::PointNormal
makePoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal)
{
  pcl::PointNormal point;
  point.getVector3fMap() = position.cast<float>();
  point.getNormalVector3fMap() = normal.normalized().cast<float>();
  return point;
}

Eigen::Vector3d
onKnot(double t)
{
  const double r = 2.0 + std::cos(3.0 * t);
  return {r * std::cos(2.0 * t), r * std::sin(2.0 * t), -std::sin(3.0 * t)};
}

/** A place on the tube; the bumps are waves of its radius. */
Eigen::Vector3d
onTube(double t, double angle)
{
  constexpr double step = 1e-4;
  const Eigen::Vector3d tangent = (onKnot(t + step) - onKnot(t - step)).normalized();
  const Eigen::Vector3d side = tangent.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = side.cross(tangent);
  const double radius = 0.42 + 0.02 * std::sin(40.0 * t) * std::cos(6.0 * angle);
  return onKnot(t) + radius * (std::cos(angle) * side + std::sin(angle) * up);
}

constexpr double step = 1e-4;

/** The normal of the tube, to the outside: as long as the area between two steps of
 * both parameters. */
Eigen::Vector3d
tubeNormal(double t, double angle)
{
  const Eigen::Vector3d normal =
      (onTube(t, angle + step) - onTube(t, angle - step))
          .cross(onTube(t - step, angle) - onTube(t + step, angle));
  const double side = normal.dot(onTube(t, angle) - onKnot(t)) < 0.0 ? -1.0 : 1.0;
  return side * normal;
}

} // namespace

SurfaceCloudPtr
makeSphere(std::size_t n, std::uint64_t seed)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d position =
        Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
    cloud->push_back(makePoint(position, position));
  }
  return cloud;
}

SurfaceCloudPtr
makeTorusKnot(std::size_t n, std::uint64_t seed)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  std::mt19937_64 engine(seed);
  Random turn(0.0, 2.0 * pi);
  Random lot(0.0, 1.0);
  constexpr double largest_area = 4.0; // per unit of both parameters: 3.6 at most
  while (cloud->size() < n) {
    const double t = turn(engine), angle = turn(engine);
    const Eigen::Vector3d normal = tubeNormal(t, angle);
    if (lot(engine) * largest_area > normal.norm() / (4.0 * step * step))
      continue; // few points where the parameters lie close
    cloud->push_back(makePoint(onTube(t, angle), normal));
  }
  return cloud;
}

SurfaceCloudPtr
makeKnotLattice(std::size_t along, std::size_t around)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  const auto stepOf = [](std::size_t i, std::size_t count) {
    return 2.0 * pi * static_cast<double>(i) / static_cast<double>(count);
  };
  for (std::size_t i = 0; i < along; ++i)
    for (std::size_t j = 0; j < around; ++j) {
      const double t = stepOf(i, along), angle = stepOf(j, around);
      cloud->push_back(makePoint(onTube(t, angle), tubeNormal(t, angle)));
    }
  return cloud;
}

SurfaceCloudPtr
makeWaves(std::size_t n, std::uint64_t seed)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  std::mt19937_64 engine(seed);
  Random place(-1.0, 1.0);
  constexpr double height = 0.1, waves = 7.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = place(engine), y = place(engine);
    const Eigen::Vector3d slope(
        -height * waves * std::cos(waves * x) * std::cos(waves * y),
        height * waves * std::sin(waves * x) * std::sin(waves * y),
        1.0);
    cloud->push_back(
        makePoint({x, y, height * std::sin(waves * x) * std::cos(waves * y)}, slope));
  }
  return cloud;
}

SurfaceCloudPtr
joined(const pcl::PointCloud<pcl::PointNormal>& first,
       const pcl::PointCloud<pcl::PointNormal>& second)
{
  SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>(first));
  *cloud += second;
  return cloud;
}

} // namespace uvol_test
