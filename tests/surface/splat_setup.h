// SPDX-License-Identifier: BSD-3-Clause
// Splats of a cloud, and where places lie from them.
#pragma once

#include "support/surfaces.h"
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstring>
#include <string>
#include <vector>

namespace uvol_test {

using SplatCloud = pcl::PointCloud<pcl_uvol::PointSplat>;
using SplatStage = pcl_uvol::SplatGeneration<pcl::PointNormal>;

/** \param delta a length */
inline SplatCloud
makeSplats(const SurfaceCloudPtr& cloud, double delta, double lambda)
{
  SplatStage generation;
  generation.setInputCloud(cloud);
  generation.setAbsoluteDelta(delta);
  generation.setLambda(lambda);
  SplatCloud splats;
  generation.compute(splats);
  return splats;
}

/** \brief A splat in double precision. */
struct Disc {
  Eigen::Vector3d center;
  Eigen::Matrix3d axes; ///< rows: u, v and the normal
  double radius, error;
  Eigen::Vector2d tilt, slope;

  explicit Disc(const pcl_uvol::PointSplat& splat)
      : center(splat.getVector3fMap().cast<double>())
      , radius(splat.radius)
      , error(splat.error)
      , tilt(splat.tilt_u, splat.tilt_v)
      , slope(splat.slope_u, splat.slope_v)
  {
    axes.row(0) = splat.getTangentVector3fMap().cast<double>();
    axes.row(2) = splat.getNormalVector3fMap().cast<double>();
    axes.row(1) = axes.row(2).cross(axes.row(0));
  }

  Eigen::Vector3d
  normal() const
  {
    return axes.row(2);
  }

  /** \brief Lengths along u, v and the normal. */
  Eigen::Vector3d
  local(const Eigen::Vector3d& place) const
  {
    return axes * (place - center);
  }

  /** \brief True for a place of a surface above, below or on the disc that faces the
   * same side. */
  bool
  covers(const Eigen::Vector3d& place, const Eigen::Vector3d& place_normal) const
  {
    // Coordinates are float: a point on the border is found a little beyond it.
    constexpr double rounding = 1e-6;
    return normal().dot(place_normal) > 0.0 &&
           local(place).head<2>().norm() <= radius + rounding;
  }

  /** \brief The field of normals at a place (equation 4.1). */
  Eigen::Vector3d
  normalAt(const Eigen::Vector3d& place) const
  {
    const Eigen::Vector2d uv = local(place).head<2>() / radius;
    const Eigen::Vector2d turn = tilt + slope.cwiseProduct(uv);
    return (axes.transpose() * Eigen::Vector3d(turn.x(), turn.y(), 1.0)).normalized();
  }
};

inline std::vector<Disc>
discsOf(const SplatCloud& splats)
{
  return {splats.begin(), splats.end()};
}

inline Eigen::Vector3d
positionOf(const pcl::PointNormal& point)
{
  return point.getVector3fMap().cast<double>();
}

inline Eigen::Vector3d
normalOf(const pcl::PointNormal& point)
{
  return point.getNormalVector3fMap().cast<double>();
}

/** \brief The numbers of a splat, without the padding between them. */
inline std::vector<float>
numbersOf(const pcl_uvol::PointSplat& s)
{
  return {s.x,
          s.y,
          s.z,
          s.normal_x,
          s.normal_y,
          s.normal_z,
          s.tangent_x,
          s.tangent_y,
          s.tangent_z,
          s.radius,
          s.error,
          s.tilt_u,
          s.tilt_v,
          s.slope_u,
          s.slope_v};
}

inline std::string
bytesOf(const SplatCloud& splats)
{
  std::string bytes;
  for (const pcl_uvol::PointSplat& splat : splats) {
    const std::vector<float> numbers = numbersOf(splat);
    bytes.append(reinterpret_cast<const char*>(numbers.data()),
                 numbers.size() * sizeof(float));
  }
  return bytes;
}

} // namespace uvol_test
