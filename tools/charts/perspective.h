// SPDX-License-Identifier: BSD-3-Clause
// Where a camera sees a place: for lines and letters over a rendered picture.
#pragma once

#include <pcl_uvol/render/renderer.h>

#include <Eigen/Geometry>

#include <array>

namespace uvol_tools {

/** \brief Column and row in a picture; coordinates of pixel centres are whole. */
using Pixel = std::array<double, 2>;

/** \brief A camera with the size of its picture and the place of it in a larger one. */
class Perspective {
public:
  /** \param left, top of the camera's picture in the larger one, pixels */
  Perspective(const pcl_uvol::Camera& camera, int width, int height, int left, int top);

  /** \brief Right, down and forward of a place, seen from the eye. */
  Eigen::Vector3d
  seenFromEye(const Eigen::Vector3d& place) const
  {
    return turn_ * (place - eye_);
  }

  /** \brief Right, down and forward parts of a direction. */
  Eigen::Vector3d
  turned(const Eigen::Vector3d& direction) const
  {
    return turn_ * direction;
  }

  /** \brief The pixel of a place in front of the eye, which seenFromEye() gives. */
  Pixel
  pixelOf(const Eigen::Vector3d& seen) const
  {
    return {center_[0] + focal_ * seen.x() / seen.z(),
            center_[1] + focal_ * seen.y() / seen.z()};
  }

  /** \brief Pixels that a length across the line of sight takes at a distance from the
   * eye. */
  double
  pixelsOf(double length, double distance) const
  {
    return focal_ * length / distance;
  }

  /** \brief The camera's picture within the larger one, pixels. */
  const Eigen::AlignedBox2d&
  getFrame() const
  {
    return frame_;
  }

  const Eigen::Vector3d&
  getEye() const
  {
    return eye_;
  }

private:
  Eigen::Matrix3d turn_;
  Eigen::Vector3d eye_;
  double focal_;
  Pixel center_;
  Eigen::AlignedBox2d frame_;
};

} // namespace uvol_tools
