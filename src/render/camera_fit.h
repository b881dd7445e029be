// SPDX-License-Identifier: BSD-3-Clause
// Cameras that see all points of a cloud, as large as the image lets them.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/renderer.h>

namespace pcl_uvol {

/** \brief Move a camera, without turning it, to the place from which the points fill
 * that part of the image, in width or height, and lie in its middle. The point looked
 * at becomes the one at the points' middle distance. A cloud of less than two places
 * leaves the camera as it is.
 * \param aspect width / height
 * \param fill in (0, 1] */
PCL_UVOL_EXPORTS Camera
fitToPoints(const Camera& camera,
            const CloudView& cloud,
            double aspect,
            double fill = 0.9);

} // namespace pcl_uvol
