// SPDX-License-Identifier: BSD-3-Clause
// A slice through a field as a figure: colours, contour lines, axes and a bar.
#pragma once

#include "charts/axes.h"
#include "charts/paper.h"
#include "render/color_scale.h"
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A sample near the slice. */
struct SliceSample {
  double across, up; ///< its place along the axes
  double value;
};

/** \brief What a figure shows. */
struct SlicePlot {
  std::size_t width = 0, height = 0; ///< of the values, at least 1
  std::vector<float> values;         ///< the lowest row first; NaN: none
  AxisScale across{}, up{};          ///< at the centres of the outermost values
  std::string across_label, up_label, title;
  pcl_uvol::ColorMap map;
  pcl_uvol::ColorScale scale;
  std::vector<double> contours;
  std::vector<SliceSample> samples;
  Paper paper; ///< its size: usually that of the values, see drawSlicePlot()
};

/** \brief The range of the finite values: of those above 0 for a logarithmic plot, and
 * then no more than most_decades.
 * \param bounds values beyond them, where a model overshoots, do not count
 * \return the bounds if no value lies within */
pcl_uvol::ColorScale
findColorScale(const std::vector<float>& values,
               const AxisScale& bounds,
               bool is_logarithmic);

/** \brief Draw a figure, a pixel or a square of pixels for each value: about 512 pixels
 * along the longer side at least, and what axes and bar need around; or as large as the
 * paper has room for. A slice that is too thin for the numbers beside it is stretched.
 * Where there is no value the figure is light grey. */
pcl_uvol::Image
drawSlicePlot(const SlicePlot& plot);

} // namespace uvol_tools
