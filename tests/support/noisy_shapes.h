// SPDX-License-Identifier: BSD-3-Clause
// Distance fields with noise, and how good an isosurface of them is.
#pragma once

#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace uvol_test {

/** \brief A solid whose distance function is known; lengths in spacings. */
struct Shape {
  const char* name;
  double extent;          ///< half of the side of the cube that holds the samples
  std::size_t components; ///< of its surface
  std::function<double(const Eigen::Vector3d&)> distance; ///< positive inside
};

/** \brief `sphere` of radius 22, `torus` of radii 22 and 9, `two_spheres` of radius 22,
 * 4 apart. */
Shape
makeShape(const std::string& name);

/** \brief A shape that smoothing may take away: `sphere` or `cylinder` of that radius,
 * `sheet` of that thickness, `torus` whose tube has that radius, `waves` of that length
 * and a sixth of it high. */
Shape
makeSmallShape(const std::string& name, double size);

/** \brief Samples of about spacing 1 at the surface; intensity: the distance with
 * Gaussian noise. */
struct NoisyCloud {
  Shape shape;
  bool clustered;
  double noise; ///< standard deviation
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud;
};

/** \brief Uniform samples about a shape.
 * \param noise in spacings */
NoisyCloud
makeNoisyCloud(const Shape& shape, double noise, std::uint64_t seed);

/** \param clustered with a density that falls with the squared distance from the centre
 * \param noise part of the radius 22 */
NoisyCloud
makeNoisyCloud(const std::string& shape,
               bool clustered,
               double noise,
               std::uint64_t seed);

/** \brief The zero level of the intensity. */
pcl::PointCloud<pcl_uvol::PointIso>
isopoints(const pcl::PointCloud<pcl::PointXYZI>::ConstPtr& cloud,
          pcl_uvol::Interpolation interpolation,
          double isovalue = 0.0);

/** \brief The deviation of isopoints from the true surface; those near the border of
 * the cube do not count. */
struct SurfaceQuality {
  double rms;             ///< of the deviation
  double whole_rms;       ///< that with those near the border
  double shift;           ///< its mean; positive: the surface has shrunk
  double normal_rms;      ///< degrees
  std::size_t components; ///< of the graph that links isopoints closer than 2
};

SurfaceQuality
measure(const NoisyCloud& noisy, const pcl::PointCloud<pcl_uvol::PointIso>& surface);

} // namespace uvol_test
