// SPDX-License-Identifier: BSD-3-Clause
// Projected points with the axes of their attributes: star coordinates as a picture
// (thesis 2.6).
#pragma once

#include "charts/paper.h"
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Where the unit of an attribute points to. */
struct ScatterAxis {
  std::string name;
  std::array<double, 3> direction;
};

/** \brief Draw points as dots, nearer ones over farther ones, and axes from the origin,
 * the longest one as long as most points reach. The picture holds 99 % of the points;
 * others may lie beyond its border.
 * \param points those that are not finite are not drawn
 * \param labels a colour per cluster, -1 grey; empty: one colour for all
 * \param view as in pcl_uvol::Camera::fit: "iso", "front", ...
 * \param paper usually 640 x 512 pixels
 * \throws pcl_uvol::InvalidArgument for an unknown view, a size that is not in [1,
 * 16384], or other labels than one per point */
pcl_uvol::Image
drawScatterPlot(const std::vector<std::array<float, 3>>& points,
                const std::vector<std::int32_t>& labels,
                const std::vector<ScatterAxis>& axes,
                const std::string& view,
                const Paper& paper = {});

} // namespace uvol_tools
