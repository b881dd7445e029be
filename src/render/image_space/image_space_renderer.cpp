// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/parallel.h"
#include "common/scalar_field.h"
#include "render/image_space/cpu_backend.h"
#include "render/image_space/footprint_need.h"
#include "render/image_space/layer_blend.h"
#include "render/image_space/wide_silhouettes.h"
#include "render/lighting.h"
#include "render/memory_need.h"
#include "render/point_colors.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr int largest_thickness = 7;

void
checkThreshold(const char* name, double value)
{
  if (!(value > 0.0) || !std::isfinite(value))
    throw InvalidArgument("render_setting_not_positive",
                          {{"name", name}, {"number", value}});
}

void
checkParameters(const ImageSpaceSettings& settings)
{
  constexpr int unlimited = std::numeric_limits<int>::max();
  checkRange("number of background fills", settings.background_fill, 0, unlimited);
  checkRange("number of occluded fills", settings.occluded_fill, 0, unlimited);
  checkRange("number of smoothings", settings.smoothing_iterations, 0, 6);
  checkRange(
      "thickness of silhouettes", settings.silhouette_thickness, 1, largest_thickness);
  checkThreshold("radius of the smallest disc", settings.smallest_disc);
  checkThreshold("distance of layers", settings.layer_distance);
  checkThreshold("threshold of silhouettes", settings.silhouette_threshold);
  checkThreshold("threshold of feature lines", settings.feature_threshold);
  checkThreshold("threshold of anti-aliasing", settings.anti_aliasing_threshold);
  if (!(settings.ambient_occlusion >= 0.0 && settings.ambient_occlusion <= 1.0))
    throw InvalidArgument("bad_ambient_occlusion",
                          {{"strength", settings.ambient_occlusion}});
  checkMaterial(settings.material);
  checkColor("lines", settings.line_color);
  checkBackground(settings.background);
  checkLights(settings.lights);
}

/** Mean of factor x factor pixels, weighted by their opacity. */
void
average(const Image& fine, int factor, Image& image)
{
  const auto f = static_cast<std::size_t>(factor);
  image.width = fine.width / static_cast<std::uint32_t>(factor);
  image.height = fine.height / static_cast<std::uint32_t>(factor);
  image.color.resize(4 * image.pixels());
  for (std::size_t row = 0; row < image.height; ++row)
    for (std::size_t column = 0; column < image.width; ++column) {
      std::uint32_t sum[4] = {0, 0, 0, 0};
      for (std::size_t dy = 0; dy < f; ++dy)
        for (std::size_t dx = 0; dx < f; ++dx) {
          const std::uint8_t* const pixel =
              &fine.color[4 * ((row * f + dy) * fine.width + column * f + dx)];
          sum[3] += pixel[3];
          for (int k = 0; k < 3; ++k)
            sum[k] += static_cast<std::uint32_t>(pixel[k]) * pixel[3];
        }
      std::uint8_t* const pixel = &image.color[4 * (row * image.width + column)];
      const auto count = static_cast<std::uint32_t>(factor * factor);
      for (int k = 0; k < 3; ++k)
        pixel[k] =
            static_cast<std::uint8_t>(sum[3] > 0 ? (sum[k] + sum[3] / 2) / sum[3] : 0);
      pixel[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
    }
}

/** Points of every isovalue; all of them where the cloud has none. */
std::map<double, std::vector<std::uint32_t>>
partByIsovalue(const CloudView& cloud, const pcl::Indices& indices)
{
  constexpr const char* field = "isovalue";
  std::map<double, std::vector<std::uint32_t>> parts;
  if (findField(cloud.fields, field) != nullptr) {
    const ScalarField isovalue(cloud.fields, field);
    for (const auto index : indices) {
      const double value = isovalue.read(cloud.point(static_cast<std::size_t>(index)));
      if (std::isfinite(value))
        parts[value].push_back(static_cast<std::uint32_t>(index));
    }
  }
  if (parts.empty())
    parts[0.0].assign(indices.begin(), indices.end());
  return parts;
}

} // namespace

ImageSpaceRendererBase::ImageSpaceRendererBase() = default;
ImageSpaceRendererBase::~ImageSpaceRendererBase() = default;

void
ImageSpaceRendererBase::forgetSurface()
{
  surface_.reset();
  prepared_.reset();
  layers_.clear();
}

void
ImageSpaceRendererBase::setPreparedSurface(
    const std::shared_ptr<PreparedSurface>& prepared)
{
  forgetSurface();
  prepared_ = prepared;
}

const SurfaceCloud&
ImageSpaceRendererBase::prepare(const CloudView& cloud,
                                const pcl::IndicesConstPtr& indices)
{
  if (surface_ && indices == drawn_)
    return *surface_;
  detail::checkIndices(*indices, cloud.count, "ImageSpaceRenderer");
  const double scale = std::max(supersampling_, 1);
  const bool is_there = prepared_ && opacities_.empty();
  checkMemoryOf("A picture",
                indices->size(),
                pictureBytes({is_there ? 0.0 : static_cast<double>(indices->size()),
                              scale * width_ * scale * height_,
                              opacities_.size(),
                              settings_.silhouettes && supersampling_ > 1}));
  surface_report_ = Report();
  if (prepared_) {
    if (prepared_->count_ != cloud.count || indices->size() != cloud.count)
      throw InvalidArgument(
          "surface_prepared_of_others",
          {{"prepared", prepared_->count_}, {"drawn", indices->size()}});
    surface_ = prepared_->surface_;
    surface_report_.merge(prepared_->report_);
  }
  else {
    const std::vector<std::uint32_t> use(indices->begin(), indices->end());
    startReport();
    {
      const StepTimer timer(report_, "prepare");
      surface_ = std::make_shared<SurfaceCloud>(cloud, use, threads_, report_);
    }
    surface_report_.merge(report_);
  }
  layers_.clear();
  drawn_ = indices;
  colored_ = false;
  return *surface_;
}

BoundingSphere
ImageSpaceRendererBase::findBounds(const CloudView& cloud,
                                   const pcl::IndicesConstPtr& indices)
{
  return prepare(cloud, indices).getBounds();
}

void
ImageSpaceRendererBase::colorSurface(const CloudView& cloud)
{
  std::vector<SurfaceCloud*> surfaces = {surface_.get()};
  for (const auto& layer : layers_)
    surfaces.push_back(layer.get());
  std::vector<Rgba> colors = point_colors_;
  if (!colors.empty() && colors.size() != cloud.count)
    throw InvalidArgument("colors_unlike_points",
                          {{"colors", colors.size()}, {"points", cloud.count}});
  if (colors.empty() && !color_field_.empty()) {
    PointColors found = colorPoints(
        cloud, color_field_, {color_map_, color_range_, logarithmic_colors_});
    used_range_ = {found.scale.low, found.scale.high};
    colors = std::move(found.colors);
  }
  for (SurfaceCloud* const surface : surfaces) {
    if (colors.empty())
      surface->setColor(toRgba(settings_.material.color));
    else
      surface->setColors(colors);
    if (supersampling_ == 1) // else the pixels around make them paler
      surface->fadeBridged(settings_.background.color);
  }
}

void
ImageSpaceRendererBase::prepareLayers(const CloudView& cloud,
                                      const pcl::Indices& indices)
{
  for (const double opacity : opacities_)
    if (!(opacity >= 0.0 && opacity <= 1.0))
      throw InvalidArgument("bad_opacity", {{"opacity", opacity}});
  if (layers_.empty()) {
    Report counted_before; // with the whole surface
    counted_before.progress = report_.progress;
    std::vector<std::shared_ptr<SurfaceCloud>> layers;
    for (const auto& [value, points] : partByIsovalue(cloud, indices))
      layers.push_back(
          std::make_shared<SurfaceCloud>(cloud, points, threads_, counted_before));
    layers_ = std::move(layers);
    colored_ = false;
  }
  if (opacities_.size() != 1 && opacities_.size() != layers_.size())
    throw InvalidArgument(
        "opacities_unlike_isovalues",
        {{"isovalues", layers_.size()}, {"opacities", opacities_.size()}});
}

void
ImageSpaceRendererBase::findFootprints(SurfaceCloud& surface, const View& view)
{
  if (!settings_.footprints || !needsFootprints(surface, view))
    return;
  const bool is_found = prepared_ && prepared_->surface_.get() == &surface &&
                        prepared_->applyFootprints(report_);
  if (!is_found && !is_hasty_)
    surface.computeFootprints(threads_, report_);
}

void
ImageSpaceRendererBase::renderLayers(const CloudView& cloud,
                                     const pcl::Indices& indices,
                                     const LayerPicture& picture,
                                     Image& image)
{
  startReport();
  report_.merge(surface_report_);
  prepareLayers(cloud, indices);
  updateColors(cloud);
  ImageSpaceSettings settings = picture.settings;
  settings.background.kind = Background::Kind::Transparent;
  ImagePlanes planes;
  planes.depth = true;
  std::vector<detail::SurfaceLayer> drawn;
  const StepTimer timer(report_, "frame");
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const View view = picture.find_view(layers_[i]->getBounds());
    findFootprints(*layers_[i], view);
    drawn.push_back({Image(),
                     static_cast<double>(view.far) / view.unit,
                     opacities_[std::min(i, opacities_.size() - 1)]});
    picture.backend.render(
        {*layers_[i], view, settings, planes, threads_}, drawn.back().image, report_);
  }
  detail::blendLayers(
      drawn, picture.settings.background, picture.with_depth, threads_, image);
}

void
ImageSpaceRendererBase::renderLayersFrom(const CloudView& cloud,
                                         const pcl::IndicesConstPtr& indices,
                                         const View& view,
                                         ImageSpaceBackend& backend,
                                         Image& image)
{
  checkParameters(settings_);
  const BoundingSphere bounds = prepare(cloud, indices).getBounds();
  ImageSpaceSettings settings = settings_;
  settings.background.kind = Background::Kind::Transparent;
  const auto find_view = [&](const BoundingSphere& part) {
    return view.ofPart(bounds, part);
  };
  renderLayers(cloud, *indices, {find_view, settings, backend, true}, image);
}

void
ImageSpaceRendererBase::updateColors(const CloudView& cloud)
{
  const Rgba color = toRgba(settings_.material.color);
  const Rgba behind = supersampling_ == 1 ? toRgba(settings_.background.color) : 0;
  if (colored_ && behind == color_behind_ && (!isUniform() || color == uniform_color_))
    return;
  colorSurface(cloud);
  uniform_color_ = color;
  color_behind_ = behind;
  colored_ = true;
}

void
ImageSpaceRendererBase::renderFrom(const CloudView& cloud,
                                   const pcl::IndicesConstPtr& indices,
                                   Image& image)
{
  checkParameters(settings_);
  checkPictureSize(View::largest_size / std::max(supersampling_, 1));
  if (supersampling_ > 1 && (planes_.depth || planes_.normal || planes_.id))
    throw InvalidArgument("planes_with_supersampling", {});
  const auto& bounds = prepare(cloud, indices).getBounds();
  const View view(
      cameraFor(bounds), bounds, width_ * supersampling_, height_ * supersampling_);
  if (!backend_)
    backend_ = std::make_shared<CpuBackend>();
  if (!opacities_.empty()) {
    if (planes_.depth || planes_.normal || planes_.id)
      throw InvalidArgument("planes_with_opacities", {});
    const Camera camera = cameraFor(bounds);
    const auto find_view = [&](const BoundingSphere& part) {
      return View(camera, part, width_ * supersampling_, height_ * supersampling_);
    };
    const bool is_fine = supersampling_ > 1;
    WideSilhouettes fine_backend(*backend_, supersampling_);
    renderLayers(cloud,
                 *indices,
                 {find_view, settings_, is_fine ? fine_backend : *backend_, false},
                 is_fine ? fine_ : image);
    if (is_fine)
      average(fine_, supersampling_, image);
    return;
  }
  drawFrom(cloud, indices, view, [&](const Frame& frame, Report& report) {
    if (supersampling_ == 1) {
      backend_->render(frame, image, report);
      return;
    }
    WideSilhouettes(*backend_, supersampling_)
        .render({frame.cloud, frame.view, frame.settings, frame.planes, frame.threads},
                fine_,
                report);
    average(fine_, supersampling_, image);
    image.depth.clear();
    image.normal.clear();
    image.id.clear();
  });
}

void
ImageSpaceRendererBase::drawFrom(const CloudView& cloud,
                                 const pcl::IndicesConstPtr& indices,
                                 const View& view,
                                 const Painter& painter)
{
  checkParameters(settings_);
  prepare(cloud, indices);
  updateColors(cloud);
  startReport();
  report_.merge(surface_report_);
  findFootprints(*surface_, view);
  const Frame frame{*surface_, view, settings_, planes_, threads_};
  const StepTimer timer(report_, "frame");
  painter(frame, report_);
}

} // namespace pcl_uvol
