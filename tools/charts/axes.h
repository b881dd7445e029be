// SPDX-License-Identifier: BSD-3-Clause
// Axes with ticks around the data of a plot.
#pragma once

#include "charts/drawing.h"

#include <string>

namespace uvol_tools {

/** \brief The centres of the outermost pixels of the data. */
struct PlotArea {
  int left, right, top, bottom;
};

/** \brief A linear scale along an axis: values at both ends. */
struct AxisScale {
  double low, high;

  /** \brief Where a value lies, 0 at the lower end and 1 at the upper one. */
  double
  placeOf(double value) const
  {
    return high > low ? (value - low) / (high - low) : 0.5;
  }
};

/** \brief Draw an axis below the data, with round values and a label.
 * \param font size, pixels
 * \param distance pixels between the data and the axis */
void
drawAxisBelow(pcl_uvol::Image& image,
              const PlotArea& area,
              int distance,
              const AxisScale& scale,
              const std::string& label,
              int font);

/** \brief The same to the left of the data; the label runs upwards. */
void
drawAxisLeft(pcl_uvol::Image& image,
             const PlotArea& area,
             int distance,
             const AxisScale& scale,
             const std::string& label,
             int font);

} // namespace uvol_tools
