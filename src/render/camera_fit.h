// SPDX-License-Identifier: BSD-3-Clause
// Cameras that see all points of a cloud, as large as the image lets them.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/renderer.h>

#include <vector>

namespace pcl_uvol {

/** \brief What a camera is fitted to. */
struct FittedPoints {
  const CloudView& cloud;
  /** The discs of the points; none: points without discs, which all count. */
  const std::vector<FittedDisc>& discs;
  /** The camera turns all around them: they are in the image from everywhere. */
  bool turn = false;
};

/** \brief Move a camera, without turning it, to the place from which the points with
 * their discs fill that part of the image, in width or height, and lie in its middle.
 * The point looked at becomes the one at the points' middle distance, or for a camera
 * that turns, the one of the axis through the middle of their box. Points that lie in
 * less than two places leave the camera as it is.
 * \param aspect width / height
 * \param fill in (0, 1] */
PCL_UVOL_EXPORTS Camera
fitToPoints(const Camera& camera,
            const FittedPoints& points,
            double aspect,
            double fill = 0.9);

} // namespace pcl_uvol
