// SPDX-License-Identifier: BSD-3-Clause
// The pinhole camera that both renderers share.
#pragma once

#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A ball around what is to be seen, in units of the cloud. */
struct BoundingSphere {
  Eigen::Vector3d center{0.0, 0.0, 0.0};
  double radius = 0.0;
};

/** \brief Clouds are drawn in their own unit of length, which is 1, but for those whose
 * radius is beyond 2^-20 to 2^20: a power of two brings it near 1, so that squares of
 * lengths are numbers in float.
 * \param bounds of the cloud */
PCL_UVOL_EXPORTS double
chooseLengthUnit(const BoundingSphere& bounds);

/** \brief Perspective projection from a point, in the coordinates of the cloud.
 *
 * Parallel projection is that from far away: in a picture of 1024 pixels that an object
 * fills with the field of view parallel_fov, none of its points is more than 0.3 pixels
 * off. */
struct PCL_UVOL_EXPORTS Camera {
  /** A vertical field of view, in degrees, that shows no perspective. */
  static constexpr double parallel_fov = 0.05;

  Eigen::Vector3d eye{0.0, 0.0, 1.0};
  Eigen::Vector3d at{0.0, 0.0, 0.0}; ///< looked at: the centre of the image
  Eigen::Vector3d up{0.0, 1.0, 0.0}; ///< upwards in the image, of any length
  double vertical_fov = 30.0;        ///< degrees, in (0, 180)

  /** \brief Right, down, forward: orthonormal rows of the rotation from the cloud's to
   * the camera's directions.
   * \throws InvalidArgument for non-finite numbers, eye = at, up along the line of
   * sight, or a field of view outside (0, 180) */
  Eigen::Matrix3d
  rotation() const;

  /** \brief Look at the centre of a sphere from a direction, so far away that the
   * sphere fills that part of the image's smaller side.
   * \param from towards the eye, of any length
   * \param aspect width / height
   * \param fill in (0, 1]
   * \param sphere what shall be seen
   * \param up direction that is upwards in the image, not along from
   * \param vertical_fov field of view in degrees, in (0, 180) */
  static Camera
  fit(const BoundingSphere& sphere,
      const Eigen::Vector3d& from,
      const Eigen::Vector3d& up,
      double vertical_fov,
      double aspect,
      double fill = 0.9);

  /** \brief A camera by the name of its side: front, back, left, right, top, bottom,
   * iso (from the front, the right and above). x points to the right of the front view,
   * z upwards.
   * \param sphere what shall be seen
   * \param view name of the side
   * \param vertical_fov field of view in degrees, in (0, 180)
   * \param aspect width / height
   * \param fill part of the smaller side of the image, in (0, 1]
   * \throws InvalidArgument for another name */
  static Camera
  fit(const BoundingSphere& sphere,
      const std::string& view,
      double vertical_fov,
      double aspect,
      double fill = 0.9);

  /** \brief The names of the sides. */
  static const std::vector<std::string>&
  viewNames();

  /** \brief The same view by parallel projection: what lies around the point looked at
   * keeps its size. */
  Camera
  parallel() const;

  /** \brief Turned about the upward axis through the point looked at.
   * \param angle degrees, counter-clockwise as seen from above */
  Camera
  orbited(double angle) const;
};

} // namespace pcl_uvol
