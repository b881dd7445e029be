// SPDX-License-Identifier: BSD-3-Clause
// The box around what a picture shows, with axes in the unit of the data.
#pragma once

#include "charts/drawing.h"
#include "charts/perspective.h"
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Geometry>

#include <string>

namespace uvol_tools {

/** \brief A box and what its axes say. */
struct DataBox {
  Eigen::AlignedBox3d box;                           ///< as the camera sees it
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< added to its coordinates, ...
  Eigen::Vector3d factors = Eigen::Vector3d::Ones(); ///< ... which are then divided
  std::string unit;                                  ///< of the data; "": none
};

/** \brief How lines and letters look. */
struct MarkStyle {
  int font; ///< size, pixels
  Ink ink;
};

/** \brief Draw what lies behind everything in the box, and around it: edges of faces
 * that look away from the eye.
 * \param has_ticks with grid lines on these faces, and round values, where an axis has
 * an edge at the outline of the box */
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
