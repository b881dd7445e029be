// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "render/image_space/cpu_backend.h"
#include "render/lighting.h"
#include "render/point_colors.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Blocks whose points lie closer, in pixels, need no footprints: the masks close what
 * is left open. Random points then have 4 in a pixel. */
constexpr float dense_spacing = 0.5f;

constexpr int largest_thickness = 7;

void
checkThreshold(const char* name, double value)
{
  if (!(value > 0.0) || !std::isfinite(value))
    throw InvalidArgument(std::string("The ") + name + " is a number above 0, not " +
                          std::to_string(value) + ".");
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
  checkMaterial(settings.material);
  checkColor("lines", settings.line_color);
  checkBackground(settings.background);
  checkLights(settings.lights);
}

/** Lengths in pixels of the picture in finer ones; lines at most as wide as they can
 * be.
 */
ImageSpaceSettings
scaledSettings(ImageSpaceSettings settings, int supersampling)
{
  // A line of thickness t is 2 t - 1 pixels wide.
  const int thickness =
      (supersampling * (2 * settings.silhouette_thickness - 1) + 2) / 2;
  settings.silhouette_thickness = std::min(thickness, largest_thickness);
  settings.smallest_disc *= supersampling;
  return settings;
}

/** True if points of some block in front of the eye lie too far apart on the screen. */
bool
needsFootprints(const SurfaceCloud& cloud, const View& view)
{
  const auto& blocks = cloud.getBlocks();
  return std::any_of(blocks.begin(), blocks.end(), [&](const SurfaceBlock& block) {
    float z = view.translation[2];
    for (int axis = 0; axis < 3; ++axis)
      z += view.rotation[6 + axis] * block.center[axis];
    const float nearest = std::max(z - block.radius, view.near);
    return z + block.radius > view.near &&
           block.mean_spacing * view.focal > dense_spacing * nearest;
  });
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

} // namespace

ImageSpaceRendererBase::ImageSpaceRendererBase() = default;
ImageSpaceRendererBase::~ImageSpaceRendererBase() = default;

void
ImageSpaceRendererBase::forgetSurface()
{
  surface_.reset();
}

const SurfaceCloud&
ImageSpaceRendererBase::prepare(const CloudView& cloud,
                                const pcl::IndicesConstPtr& indices)
{
  if (surface_ && indices == drawn_)
    return *surface_;
  detail::checkIndices(*indices, cloud.count, "ImageSpaceRenderer");
  const std::vector<std::uint32_t> use(indices->begin(), indices->end());
  surface_report_ = Report();
  const StepTimer timer(surface_report_, "prepare");
  surface_ = std::make_shared<SurfaceCloud>(cloud, use, threads_, surface_report_);
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
  if (color_field_.empty()) {
    surface_->setColor(toRgba(settings_.material.color));
    return;
  }
  const PointColors colors =
      colorPoints(cloud, color_field_, {color_map_, color_range_, logarithmic_colors_});
  used_range_ = {colors.scale.low, colors.scale.high};
  surface_->setColors(colors.colors);
}

void
ImageSpaceRendererBase::renderFrom(const CloudView& cloud,
                                   const pcl::IndicesConstPtr& indices,
                                   Image& image)
{
  checkParameters(settings_);
  checkPictureSize(View::largest_size / std::max(supersampling_, 1));
  if (supersampling_ > 1 && (planes_.depth || planes_.normal || planes_.id))
    throw InvalidArgument("Planes of an image cannot be averaged: render depth, normal "
                          "or id without supersampling.");
  const auto& bounds = prepare(cloud, indices).getBounds();
  const View view(
      cameraFor(bounds), bounds, width_ * supersampling_, height_ * supersampling_);
  if (!backend_)
    backend_ = std::make_shared<CpuBackend>();
  drawFrom(cloud, indices, view, [&](const Frame& frame, Report& report) {
    if (supersampling_ == 1) {
      backend_->render(frame, image, report);
      return;
    }
    const ImageSpaceSettings settings = scaledSettings(settings_, supersampling_);
    backend_->render({frame.cloud, frame.view, settings, frame.planes, frame.threads},
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
  const Color& color = settings_.material.color;
  if (!colored_ || (color_field_.empty() && toRgba(color) != uniform_color_)) {
    colorSurface(cloud);
    uniform_color_ = toRgba(color);
    colored_ = true;
  }
  startReport();
  report_.merge(surface_report_);
  if (settings_.footprints && needsFootprints(*surface_, view))
    surface_->computeFootprints(threads_, report_);
  const Frame frame{*surface_, view, settings_, planes_, threads_};
  const StepTimer timer(report_, "frame");
  painter(frame, report_);
}

} // namespace pcl_uvol
