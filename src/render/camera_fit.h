// SPDX-License-Identifier: BSD-3-Clause
// Cameras that see all points of a cloud, as large as the image lets them.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/renderer.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief How much of an image is filled: from its middle, parts of the ways to its
 * borders, in (0, 1]. */
struct ImageFill {
  double left = 0.9, right = left, top = left, bottom = left;

  /** \brief The least part, which is filled to all sides. */
  double
  least() const
  {
    return std::min({left, right, top, bottom});
  }
};

/** \brief What a camera is fitted to. */
struct FittedPoints {
  const CloudView& cloud;
  /** The discs of the points; none: points without discs, which all count. */
  const std::vector<FittedDisc>& discs;
  /** The direction that the camera turns about all around them: they are in the image
   * from everywhere. */
  std::optional<Eigen::Vector3d> axis = std::nullopt;
};

/** \brief Move a camera, without turning it, to the place from which the points with
 * their discs fill that part of the image, in width or height, and lie in its middle.
 * One that turns fills as much on the right as on the left, and above as below. The
 * point looked at becomes the one at the points' middle distance, or for a camera that
 * turns, the one of the axis through the middle of their box. Points that lie in less
 * than two places leave the camera as it is.
 * \param aspect width / height */
PCL_UVOL_EXPORTS Camera
fitToPoints(const Camera& camera,
            const FittedPoints& points,
            double aspect,
            const ImageFill& fill = {});

} // namespace pcl_uvol
