// SPDX-License-Identifier: BSD-3-Clause
// Pictures of points with normals, on the CPU: no display, no OpenGL.
#include "charts/bindings.h"
#include "charts/color_bar.h"
#include "charts/figure.h"
#include "charts/look.h"
#include "common/memory.h"
#include "common/parameter_json.h"
#include "render/image_space/frame.h"
#include "render/ray_tracing/fitted_splats.h"
#include "render/ray_tracing/gap_dots.h"
#include "render/stretch_surface.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include "surface/splat_input.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

void
applyPasses(const PictureParameters& parameters, ImageSpaceSettings& settings)
{
  const PassParameters& passes = parameters.passes;
  settings.cull_back_faces = parameters.culling;
  settings.footprints = parameters.footprints;
  settings.background_fill = passes.fill;
  settings.occluded_fill = passes.occluded;
  settings.layer_distance = passes.layers;
  settings.shading = passes.shading;
  settings.ambient_occlusion = passes.occlusion;
  settings.smoothing = passes.smoothing;
  settings.smoothing_iterations = passes.smoothings;
  settings.silhouettes = parameters.silhouettes;
  settings.silhouette_threshold = passes.silhouette_threshold;
  settings.silhouette_thickness = parameters.thickness;
  settings.feature_lines = parameters.features;
  settings.feature_threshold = passes.feature_threshold;
  if (parameters.line_color)
    settings.line_color = toColor(*parameters.line_color);
  settings.anti_aliasing = passes.antialias;
  settings.anti_aliasing_threshold = passes.antialias_threshold;
}

/** Points that are ready to be drawn from any side. */
class Painter {
public:
  /** \param json parameters of pictures
   * \param ray_json those of rays; none: the points are drawn in image space */
  Painter(const DatasetPtr& surface,
          const std::string& json,
          const std::optional<std::string>& ray_json,
          unsigned threads,
          const py::object& progress)
      : look_(readPictureParameters(json))
      , points_(surface)
      , threads_(threads)
  {
    if (ray_json)
      rays_ = readJson<RayParameters>(*ray_json);
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      preparation_.progress = callback;
      prepare();
      preparation_.progress = nullptr;
    });
  }

  /** \param frame of a full turn
   * \return pixels, field, values at the ends of the colours, and the report */
  py::tuple
  draw(int frame, const py::object& progress)
  {
    Image picture;
    Report report = preparation_;
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      picture = drawPoints(frame, callback, report);
      if (has_legend_)
        uvol_tools::drawLegend(
            picture, cloud_, points_->labels, field_, mapping_, range_, field_);
      makeFigure(look_).drawTitle(picture);
    });
    const auto height = static_cast<py::ssize_t>(picture.height);
    const auto width = static_cast<py::ssize_t>(picture.width);
    return py::make_tuple(toArray(std::move(picture.color), {height, width, 4}),
                          toText(field_),
                          range_,
                          describe(report));
  }

private:
  /** The report, and in it the parameters as JSON. */
  py::dict
  describe(const Report& report) const
  {
    py::dict entries = toDict(report);
    entries["parameters"] = toText(writeJson(look_));
    if (rays_)
      entries["ray_parameters"] = toText(writeJson(*rays_));
    return entries;
  }

  /** The picture without what explains it. */
  Image
  drawPoints(int frame, const ProgressCallback& callback, Report& report)
  {
    try {
      if (rays_)
        return drawBy(tracer_, frame, callback, report);
      Image picture = drawBy(renderer_, frame, callback, report);
      range_ = renderer_.getColorRange();
      return picture;
    }
    catch (const std::bad_alloc&) {
      throw NotEnoughMemory("memory_for_picture",
                            {{"width", look_.width}, {"height", look_.height}});
    }
  }

  void
  prepare()
  {
    if (look_.exaggerate) {
      points_ = std::make_shared<Dataset>(*points_);
      stretchSurface(*points_, look_.exaggerate->matrix());
    }
    cloud_ = viewOf(points_->cloud);
    field_ = findColorField(look_, cloud_);
    if (!field_.empty())
      mapping_ = makeColorMapping(look_, cloud_, points_->labels, field_);
    has_legend_ = look_.bar && uvol_tools::hasLegend(cloud_, points_->labels, field_);
    uvol_tools::warnOfNames(cloud_, points_->labels, field_, preparation_);
    warnOfLogarithms(cloud_, field_, mapping_, preparation_);
    if (rays_)
      prepareTracer();
    else
      prepareRenderer();
  }

  void
  prepareRenderer()
  {
    renderer_.setInputCloud(pcl::PCLPointCloud2::ConstPtr(points_, &points_->cloud));
    ImageSpaceSettings& settings = renderer_.settings();
    applyPasses(look_, settings);
    settings.background = getBackgroundOfViews();
    settings.material = makeMaterial(look_);
    settings.lights = makeLights(look_);
    renderer_.setColorField(field_);
    renderer_.setColorMap(mapping_.map);
    renderer_.setLogarithmicColors(mapping_.is_logarithmic);
    if (const auto& range = mapping_.range)
      renderer_.setColorRange((*range)[0], (*range)[1]);
    renderer_.setOpacities(look_.opacity);
    renderer_.setNumberOfThreads(threads_);
    const int largest = std::max(look_.width, look_.height);
    const int usual = 2 * largest <= View::largest_size ? 2 : 1;
    renderer_.setSupersampling(look_.supersample > 0 ? look_.supersample : usual);
    if (look_.footprints) {
      prepared_ = std::make_shared<PreparedSurface>(
          points_->cloud, threads_, preparation_.progress);
      renderer_.setPreparedSurface(prepared_);
    }
  }

  void
  prepareTracer()
  {
    Scene scene;
    scene.lights = makeLights(look_);
    scene.background = getBackgroundOfViews();
    coverPoints(scene);
    tracer_.setScene(scene);
    RayTracingSettings& settings = tracer_.settings();
    settings.depth = rays_->depth;
    settings.shadows = rays_->shadows;
    settings.light_samples = rays_->light_samples;
    settings.occlusion_samples = rays_->occlusion;
    settings.occlusion_distance = rays_->occlusion_distance;
    settings.cull_back_faces = rays_->culling;
    tracer_.setNumberOfThreads(threads_);
    tracer_.setSupersampling(std::max(look_.supersample, 1));
  }

  /** Add the points to a scene, which has its background. */
  void
  coverPoints(Scene& scene)
  {
    const Splats splats = findSplats(cloud_,
                                     rays_->splats.value_or(SplatParameters()),
                                     rays_->splats.has_value(),
                                     threads_,
                                     preparation_);
    if (splats.cloud.empty())
      throw InvalidArgument("picture_without_splats", {});
    fitted_splats_ = std::make_unique<FittedSplats>(splats, points_->cloud, threads_);
    SplatObject object;
    if (!field_.empty()) {
      const auto colored = colorPoints(cloud_, field_, mapping_);
      range_ = {colored.scale.low, colored.scale.high};
      for (const std::uint32_t source : splats.sources)
        object.colors.push_back(colored.colors[source]);
    }
    object.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(splats.cloud);
    static_cast<Material&>(object.material) = makeMaterial(look_);
    object.material.reflectivity = rays_->reflect;
    object.material.transparency = rays_->transparent;
    object.material.refractive_index = rays_->index;
    object.two_sided = splats.two_sided;
    object.rims = splats.rims;
    addWithDots(std::move(object),
                cloud_,
                splats.sources,
                std::min(look_.width, look_.height),
                scene);
  }

  /** All views of a frame.
   * \param report gets that of the last one */
  template <typename RendererT>
  Image
  drawBy(RendererT& renderer,
         int frame,
         const ProgressCallback& progress,
         Report& report) const
  {
    renderer.setProgressCallback(progress);
    uvol_tools::Ground ground{
        makeBackground(look_), look_.width, look_.height, look_.width};
    if (has_legend_)
      ground.views_width -= uvol_tools::colorBarWidth(look_.width, look_.height);
    if (look_.exaggerate)
      ground.factors = look_.exaggerate->matrix();
    ground.turns = look_.frames > 1;
    ground.zoom = look_.zoom;
    Image picture = makeFigure(look_).drawViews(
        {cloud_,
         renderer.getBounds(),
         points_->origin,
         std::nullopt,
         [&](const Camera& camera, const auto& cell) {
           return findFittedDiscs(camera, cell.width, cell.height);
         }},
        ground,
        [&](const SeenSurface& seen, const auto& cell) {
          return makeCamera(
              look_, seen, points_->origin, cell, 360.0 * frame / look_.frames);
        },
        [&](const Camera& camera, const auto& cell, Image& image) {
          renderer.setSize(cell.width, cell.height);
          renderer.setCamera(camera);
          renderer.render(image);
        });
    report.merge(renderer.getReport());
    return picture;
  }

  std::vector<FittedDisc>
  findFittedDiscs(const Camera& camera, int width, int height) const
  {
    if (prepared_)
      return prepared_->findFittedDiscs(camera, width, height);
    if (fitted_splats_)
      return fitted_splats_->find(camera, width, height);
    return {};
  }

  Background
  getBackgroundOfViews() const
  {
    return makeFigure(look_).getBackgroundOfViews(makeBackground(look_));
  }

  PictureParameters look_;
  std::optional<RayParameters> rays_;
  DatasetPtr points_;
  CloudView cloud_;
  std::string field_;
  ColorMapping mapping_;
  bool has_legend_ = false;
  unsigned threads_;
  std::array<double, 2> range_{{0.0, 1.0}};
  Report preparation_;
  ImageSpaceRenderer<pcl::PCLPointCloud2> renderer_;
  std::shared_ptr<PreparedSurface> prepared_; // null: points without discs, or rays
  RayTracer tracer_;
  std::unique_ptr<FittedSplats> fitted_splats_; // that it draws
};

} // namespace

void
bindPictures(py::module_& module)
{
  py::class_<Painter>(module, "Painter")
      .def(py::init<const DatasetPtr&,
                    const std::string&,
                    const std::optional<std::string>&,
                    unsigned,
                    const py::object&>())
      .def("draw", &Painter::draw);
}

} // namespace pcl_uvol::python
