// SPDX-License-Identifier: BSD-3-Clause
// The box around what a picture shows, with axes in the unit of the data.
#pragma once

#include "charts/axis_letters.h"
#include "charts/perspective.h"
#include "charts/seen_box.h"
#include <pcl_uvol/render/renderer.h>

namespace uvol_tools {

/** \brief Draw what lies behind everything in the box, and around it: edges of faces
 * that look away from the eye.
 * \param has_ticks with grid lines on these faces, and round values, where an axis has
 * an edge at the outline of the box; letters stay within the camera's picture */
void
drawBoxBehind(pcl_uvol::Image& image,
              const Perspective& perspective,
              const DataBox& box,
              const MarkStyle& style,
              bool has_ticks);

/** \brief Draw the edges that lie before everything in the box, lightly. */
void
drawBoxBefore(pcl_uvol::Image& image,
              const Perspective& perspective,
              const DataBox& box,
              const MarkStyle& style);

} // namespace uvol_tools
