// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as web pages.
#include "charts/bindings.h"
#include "charts/color_bar.h"
#include "charts/look.h"
#include "render/stretch_surface.h"
#include "render/surface_cloud.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include "web/surface_page.h"
#include <pcl_uvol/common/cloud_view.h>

#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** Write a surface as a web page, as uvol_render does.
 * \param json parameters of pictures
 * \return the report */
py::dict
writePage(const std::string& path,
          const Dataset& surface,
          const std::string& json,
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
    SeenSurface seen{discs.getBounds(), &cloud};
    if (parameters.footprints) {
      Footprints found = discs.findFootprints(threads, report);
      seen.find_discs = [fitted = discs.listFittedDiscs(found, cloud.count)](
                            const Camera&) { return fitted; };
      discs.setFootprints(std::move(found));
    }
    uvol_tools::SurfacePage page;
    page.title = std::filesystem::path(path).stem().string();
    page.camera = makeCamera(parameters, seen, points.origin, {0, 0, 1, 1, ""});
    page.material = makeMaterial(parameters);
    page.lights = makeLights(parameters);
    page.background = makeBackground(parameters).color;
    const std::string field = findColorField(parameters, cloud);
    uvol_tools::warnOfNames(cloud, points.labels, field, report);
    if (field.empty())
      discs.setColor(toRgba(page.material.color));
    else {
      const ColorMapping mapping =
          makeColorMapping(parameters, cloud, points.labels, field);
      warnOfLogarithms(cloud, field, mapping, report);
      const PointColors colors = colorPoints(cloud, field, mapping);
      discs.setColors(colors.colors);
      if (parameters.bar && uvol_tools::hasLegend(cloud, points.labels, field)) {
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

} // namespace

void
bindPages(py::module_& module)
{
  module.def("write_page", &writePage);
}

} // namespace pcl_uvol::python
