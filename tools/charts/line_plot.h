// SPDX-License-Identifier: BSD-3-Clause
// A small picture of how figures change from step to step.
#pragma once

#include <pcl_uvol/render/image.h>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A name and a value for each of the abscissas 1, 2, ... */
struct PlotLine {
  std::string name;
  std::vector<double> values;
};

/** \brief Draw up to four lines on a logarithmic ordinate, 720 x 440 pixels, with a
 * legend. Values that are not positive leave a gap. */
pcl_uvol::Image
drawLinePlot(const std::vector<PlotLine>& lines, const std::string& abscissa);

} // namespace uvol_tools
