// SPDX-License-Identifier: BSD-3-Clause
// The extension _charts: legends beside pictures, plots of slices and lines, written by
// VTK's letters, and web pages.
#include "charts/color_bar.h"
#include "charts/line_plot.h"
#include "charts/slice_plot.h"
#include "render/stretch_surface.h"
#include "render/surface_cloud.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include "shared/look.h"
#include "web/surface_page.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace pcl_uvol::python {
namespace {

/** Draw what the colours of a picture stand for at its right border.
 * \param pixels are changed
 * \param json parameters that the picture was drawn with
 * \param range values at the ends of its colours */
void
drawLegend(py::array_t<std::uint8_t, py::array::c_style>& pixels,
           const Dataset& points,
           const std::string& json,
           const std::array<double, 2>& range)
{
  const PictureParameters parameters = readPictureParameters(json);
  const CloudView cloud = viewOf(points.cloud);
  const std::string field = findColorField(parameters, cloud);
  const ColorMapping mapping = makeColorMapping(parameters, cloud, field);
  Image image;
  image.height = static_cast<std::uint32_t>(pixels.shape(0));
  image.width = static_cast<std::uint32_t>(pixels.shape(1));
  image.color.assign(pixels.data(), pixels.data() + pixels.size());
  const auto categories =
      uvol_tools::listNamedCategories(cloud, points.labels, field, mapping.map);
  if (categories.empty())
    uvol_tools::drawColorBar(
        image, mapping.map, {range[0], range[1], mapping.is_logarithmic}, field);
  else
    uvol_tools::drawCategories(image, categories, field);
  std::copy(image.color.begin(), image.color.end(), pixels.mutable_data());
}

/** Write a surface as a web page, as uvol_render does.
 * \param json parameters of pictures
 * \param has_bar whether the page says what its colours stand for
 * \return the report */
py::dict
writePage(const std::string& path,
          const Dataset& surface,
          const std::string& json,
          bool has_bar,
          unsigned threads,
          const py::object& progress)
{
  const PictureParameters parameters = readPictureParameters(json);
  Report report;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    Dataset points = surface;
    if (parameters.exaggerate)
      stretchSurface(points, parameters.exaggerate->matrix());
    const CloudView cloud = viewOf(points.cloud);
    std::vector<std::uint32_t> all(cloud.count);
    std::iota(all.begin(), all.end(), 0u);
    SurfaceCloud discs(cloud, all, threads, report);
    if (parameters.footprints)
      discs.computeFootprints(threads, report);
    uvol_tools::SurfacePage page;
    page.title = std::filesystem::path(path).stem().string();
    page.camera = makeCamera(parameters, discs.getBounds(), points.origin, &cloud);
    page.material = makeMaterial(parameters);
    page.lights = makeLights(parameters);
    page.background = makeBackground(parameters).color;
    const std::string field = findColorField(parameters, cloud);
    if (field.empty())
      discs.setColor(toRgba(page.material.color));
    else {
      const ColorMapping mapping = makeColorMapping(parameters, cloud, field);
      const PointColors colors = colorPoints(cloud, field, mapping);
      discs.setColors(colors.colors);
      if (has_bar) {
        page.field = field;
        page.map = mapping.map;
        page.scale = colors.scale;
        page.categories =
            uvol_tools::listNamedCategories(cloud, points.labels, field, mapping.map);
      }
    }
    discs.fadeBridged(page.background);
    writeSurfacePage(path, discs, page);
    report.progress = nullptr;
  });
  return toDict(report);
}

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
 * \param range of the colours; none: that of the values within bounds */
py::tuple
drawSlice(const py::array_t<float, py::array::c_style | py::array::forcecast>& values,
          const SliceAxis& across,
          const SliceAxis& up,
          const std::string& title,
          const std::string& colormap,
          const std::optional<std::array<double, 2>>& range,
          const std::array<double, 2>& bounds,
          bool is_logarithmic,
          const std::vector<double>& contours)
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

} // namespace
} // namespace pcl_uvol::python

PYBIND11_MODULE(_charts, module)
{
  using namespace pcl_uvol::python;
  py::module_::import("pcl_uvol._core"); // the dataset's class
  module.def("bar_width", &uvol_tools::colorBarWidth);
  module.def("draw_legend", &drawLegend);
  module.def("write_page", &writePage);
  module.def("draw_slice", &drawSlice);
  module.def("draw_line", &drawLine);
}
