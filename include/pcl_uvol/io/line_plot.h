// SPDX-License-Identifier: BSD-3-Clause
// A small picture of how figures change from step to step.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/image.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A name and a value for each of the abscissas 1, 2, ... */
struct PlotLine {
  std::string name;
  std::vector<double> values;
};

/** \brief Draw up to four lines on a logarithmic ordinate, 720 x 440 pixels, with a
 * legend. Values that are not positive leave a gap. */
PCL_UVOL_EXPORTS Image
drawLinePlot(const std::vector<PlotLine>& lines, const std::string& abscissa);

} // namespace pcl_uvol
