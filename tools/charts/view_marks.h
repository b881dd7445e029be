// SPDX-License-Identifier: BSD-3-Clause
// Directions and lengths in a picture of a surface.
#pragma once

#include "charts/data_box.h"
#include "charts/perspective.h"
#include <pcl_uvol/render/renderer.h>

#include <string>

namespace uvol_tools {

/** \brief The pixels around a mark, from its centre. */
struct MarkBox {
  int left, right, top, bottom;
};

/** \brief Where drawTriad() draws. */
MarkBox
findTriadBox(const Perspective& perspective, double length, int font);

/** \brief Draw the directions of x, y and z from a pixel on, the nearest one on top.
 * \param length of an axis that lies across the line of sight, pixels */
void
drawTriad(pcl_uvol::Image& image,
          const Perspective& perspective,
          const Pixel& center,
          double length,
          const MarkStyle& style);

/** \brief The largest of 1, 2 or 5 times a power of ten that is not larger. */
double
roundedDown(double length);

/** \brief Draw a bar of a round length, at most that long, with its length above it.
 * \param right_end of the bar
 * \param pixels_per_unit of the data
 * \param longest pixels */
void
drawScaleBar(pcl_uvol::Image& image,
             const Pixel& right_end,
             double pixels_per_unit,
             double longest,
             const std::string& unit,
             const MarkStyle& style);

} // namespace uvol_tools
