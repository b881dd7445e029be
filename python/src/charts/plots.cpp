// SPDX-License-Identifier: BSD-3-Clause
// Plots of slices, lines and projections.
#include "charts/bindings.h"
#include "charts/line_plot.h"
#include "charts/scatter_plot.h"
#include "charts/slice_plot.h"
#include "shared/convert.h"

#include <array>
#include <cstdint>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

py::array_t<std::uint8_t>
toPixels(Image&& image)
{
  const auto height = static_cast<py::ssize_t>(image.height),
             width = static_cast<py::ssize_t>(image.width);
  return toArray(std::move(image.color), {height, width, 4});
}

/** An axis of a slice: coordinates at its ends, and what is written beside it. */
using SliceAxis = std::tuple<double, double, std::string>;

/** Draw a slice as uvol_probe does.
 * \param values the lowest row first, shape (height, width)
 * \param range of the colours; none: that of the values within bounds
 * \param samples across, up, and the value of each that is drawn as well */
py::tuple
drawSlice(const py::array_t<float, py::array::c_style | py::array::forcecast>& values,
          const SliceAxis& across,
          const SliceAxis& up,
          const std::string& title,
          const std::string& colormap,
          const std::optional<std::array<double, 2>>& range,
          const std::array<double, 2>& bounds,
          bool is_logarithmic,
          const std::vector<double>& contours,
          const std::vector<std::array<double, 3>>& samples)
{
  uvol_tools::SlicePlot plot;
  plot.height = static_cast<std::size_t>(values.shape(0));
  plot.width = static_cast<std::size_t>(values.shape(1));
  plot.values.assign(values.data(), values.data() + values.size());
  plot.across = {std::get<0>(across), std::get<1>(across)};
  plot.up = {std::get<0>(up), std::get<1>(up)};
  plot.across_label = std::get<2>(across);
  plot.up_label = std::get<2>(up);
  plot.title = title;
  plot.map = ColorMap(colormap);
  plot.scale = range ? ColorScale{(*range)[0], (*range)[1], is_logarithmic}
                     : uvol_tools::findColorScale(
                           plot.values, {bounds[0], bounds[1]}, is_logarithmic);
  plot.contours = contours;
  for (const auto& [place_across, place_up, value] : samples)
    plot.samples.push_back({place_across, place_up, value});
  const ColorScale scale = plot.scale;
  return py::make_tuple(toPixels(drawSlicePlot(plot)), scale.low, scale.high);
}

py::array_t<std::uint8_t>
drawLine(const std::vector<double>& distances,
         const std::vector<double>& values,
         const std::vector<double>& errors,
         const std::string& abscissa,
         const std::string& ordinate)
{
  return toPixels(
      uvol_tools::drawProfile({distances, values, errors, abscissa, ordinate}));
}

/** Draw projected points as uvol_project does.
 * \param axes names and directions of the attributes */
py::array_t<std::uint8_t>
drawScatter(const std::vector<std::array<float, 3>>& places,
            const std::vector<std::int32_t>& labels,
            const std::vector<std::pair<std::string, std::array<double, 3>>>& axes,
            const std::string& view,
            int width,
            int height)
{
  std::vector<uvol_tools::ScatterAxis> named;
  named.reserve(axes.size());
  for (const auto& [name, direction] : axes)
    named.push_back({name, direction});
  return toPixels(
      uvol_tools::drawScatterPlot(places, labels, named, view, {width, height}));
}

} // namespace

void
bindPlots(py::module_& module)
{
  module.def("draw_slice", &drawSlice);
  module.def("draw_line", &drawLine);
  module.def("draw_scatter", &drawScatter);
}

} // namespace pcl_uvol::python
