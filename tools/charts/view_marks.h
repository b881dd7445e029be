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

/** \brief A bar of a round length, as long as there is room for. */
struct ScaleBar {
  double width = 0.0; ///< pixels; 0: there is none
  std::string text;   ///< its length

  /** \param pixels_per_unit of the data
   * \param longest pixels
   * \param unit of the data; "": none */
  ScaleBar(double pixels_per_unit, double longest, const std::string& unit);
};

/** \brief Where drawScaleBar() draws, from the right end of the bar. */
MarkBox
findScaleBarBox(const ScaleBar& bar, int font);

/** \brief Draw a bar with its length above it. */
void
drawScaleBar(pcl_uvol::Image& image,
             const Pixel& right_end,
             const ScaleBar& bar,
             const MarkStyle& style);

} // namespace uvol_tools
