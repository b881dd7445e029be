// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/render/image_space/cpu_backend.h>
#include <pcl_uvol/render/image_space/impl/image_space_renderer.hpp>

#include <pcl/impl/pcl_base.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr double default_fov = 30.0;

/** Blocks whose points lie closer, in pixels, need no footprints: the masks close what
 * is left open. Random points then have 1.6 in a pixel. */
constexpr float dense_spacing = 0.8f;

void
checkThreshold(const char* name, double value)
{
  if (!(value > 0.0) || !std::isfinite(value))
    throw InvalidArgument(std::string("The ") + name + " is a number above 0, not " +
                          std::to_string(value) + ".");
}

void
checkRange(const char* name, int value, int low, int high)
{
  if (value < low || value > high)
    throw InvalidArgument(std::string("The ") + name + " lies between " +
                          std::to_string(low) + " and " + std::to_string(high) +
                          ", and is not " + std::to_string(value) + ".");
}

void
checkColor(const char* name, const Color& color)
{
  for (const float channel : {color.r, color.g, color.b})
    if (!(channel >= 0.0f) || !std::isfinite(channel))
      throw InvalidArgument(std::string("The colour of ") + name +
                            " has finite parts of 0 or more, not " +
                            std::to_string(channel) + ".");
}

void
checkLighting(const ImageSpaceSettings& settings)
{
  const Material& material = settings.material;
  for (const double factor :
       {material.ambient, material.diffuse, material.specular, material.shininess})
    if (!(factor >= 0.0) || !std::isfinite(factor))
      throw InvalidArgument("The factors of a material are finite and 0 or more, not " +
                            std::to_string(factor) + ".");
  checkColor("the material", material.color);
  checkColor("lines", settings.line_color);
  checkColor("the background", settings.background.color);
  checkColor("the background", settings.background.top);
  for (const Light& light : settings.lights) {
    checkColor("a light", light.color);
    if (!light.position.allFinite() ||
        (light.kind == Light::Kind::Directional && light.position.isZero(0.0)))
      throw InvalidArgument(
          "A light comes from a finite place, or from a direction that "
          "is not zero.");
  }
}

void
checkSettings(const ImageSpaceSettings& settings)
{
  constexpr int unlimited = std::numeric_limits<int>::max();
  checkRange("number of background fills", settings.background_fill, 0, unlimited);
  checkRange("number of occluded fills", settings.occluded_fill, 0, unlimited);
  checkRange("number of smoothings", settings.smoothing_iterations, 0, 6);
  checkRange("thickness of silhouettes", settings.silhouette_thickness, 1, 7);
  checkThreshold("distance of layers", settings.layer_distance);
  checkThreshold("threshold of silhouettes", settings.silhouette_threshold);
  checkThreshold("threshold of feature lines", settings.feature_threshold);
  checkThreshold("threshold of anti-aliasing", settings.anti_aliasing_threshold);
  checkLighting(settings);
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

/** The four bytes of a colour field: blue, green, red, opacity, as PCL packs them. */
std::vector<Rgba>
readColors(const CloudView& cloud)
{
  const pcl::PCLPointField* field = findField(cloud.fields, "rgb");
  if (field == nullptr)
    field = findField(cloud.fields, "rgba");
  if (field == nullptr || datatypeSize(field->datatype) != sizeof(Rgba))
    throw InvalidArgument("The cloud has no colours (rgb or rgba); its fields are " +
                          describeFields(cloud.fields) + ".");
  std::vector<Rgba> colors(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    std::uint32_t packed;
    std::memcpy(&packed, cloud.point(i) + field->offset, sizeof packed);
    colors[i] = 0xff000000u | (packed & 0xff) << 16 | (packed & 0xff00) |
                ((packed >> 16) & 0xff);
  }
  return colors;
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
  const std::vector<std::uint32_t> use(indices->begin(), indices->end());
  surface_report_ = Report();
  const StepTimer timer(surface_report_, "prepare");
  surface_ = std::make_shared<SurfaceCloud>(cloud, use, threads_, surface_report_);
  drawn_ = indices;
  colored_ = false;
  return *surface_;
}

void
ImageSpaceRendererBase::colorSurface(const CloudView& cloud)
{
  if (color_field_.empty()) {
    surface_->setColor(toRgba(settings_.material.color));
    return;
  }
  if (color_field_ == "rgb" || color_field_ == "rgba") {
    surface_->setColors(readColors(cloud));
    return;
  }
  const ScalarField field(cloud.fields, color_field_);
  std::vector<float> values(cloud.count);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    values[i] = static_cast<float>(field.read(cloud.point(i)));
    if (std::isfinite(values[i])) {
      low = std::min<double>(low, values[i]);
      high = std::max<double>(high, values[i]);
    }
  }
  if (low > high)
    throw InvalidArgument("All values of " + color_field_ + " are without a number.");
  used_range_ = color_range_.value_or(std::array<double, 2>{low, high});
  surface_->setColors(color_map_.apply(values, used_range_[0], used_range_[1]));
}

void
ImageSpaceRendererBase::renderFrom(const CloudView& cloud,
                                   const pcl::IndicesConstPtr& indices,
                                   Image& image)
{
  checkSettings(settings_);
  checkRange("supersampling", supersampling_, 1, 8);
  checkRange("width", width_, 1, View::largest_size / supersampling_);
  checkRange("height", height_, 1, View::largest_size / supersampling_);
  if (supersampling_ > 1 && (planes_.depth || planes_.normal || planes_.id))
    throw InvalidArgument("Planes of an image cannot be averaged: render depth, normal "
                          "or id without supersampling.");
  const auto& bounds = prepare(cloud, indices).getBounds();
  const Camera camera = camera_.value_or(
      Camera::fit(bounds, "iso", default_fov, static_cast<double>(width_) / height_));
  const View view(camera, bounds, width_ * supersampling_, height_ * supersampling_);
  if (!backend_)
    backend_ = std::make_shared<CpuBackend>();
  drawFrom(cloud, indices, view, [&](const Frame& frame, Report& report) {
    if (supersampling_ == 1) {
      backend_->render(frame, image, report);
      return;
    }
    backend_->render(frame, fine_, report);
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
  checkSettings(settings_);
  prepare(cloud, indices);
  const Color& color = settings_.material.color;
  if (!colored_ || (color_field_.empty() && toRgba(color) != uniform_color_)) {
    colorSurface(cloud);
    uniform_color_ = toRgba(color);
    colored_ = true;
  }
  report_ = surface_report_;
  if (settings_.footprints && needsFootprints(*surface_, view))
    surface_->computeFootprints(threads_, report_);
  const Frame frame{*surface_, view, settings_, planes_, threads_};
  const StepTimer timer(report_, "frame");
  painter(frame, report_);
}

template class PCL_UVOL_EXPORTS ImageSpaceRenderer<PointIso>;
template class PCL_UVOL_EXPORTS ImageSpaceRenderer<pcl::PointNormal>;
template class PCL_UVOL_EXPORTS ImageSpaceRenderer<pcl::PCLPointCloud2>;

} // namespace pcl_uvol
