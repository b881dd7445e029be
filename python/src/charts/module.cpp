// SPDX-License-Identifier: BSD-3-Clause
// The extension _charts: legends beside pictures, written by VTK's letters.
#include "charts/color_bar.h"
#include "shared/convert.h"
#include "shared/look.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <array>
#include <pybind11/stl.h>
#include <string>

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

} // namespace
} // namespace pcl_uvol::python

PYBIND11_MODULE(_charts, module)
{
  using namespace pcl_uvol::python;
  py::module_::import("pcl_uvol._core"); // the dataset's class
  module.def("bar_width", &uvol_tools::colorBarWidth);
  module.def("draw_legend", &drawLegend);
}
