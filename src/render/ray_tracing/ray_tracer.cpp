// SPDX-License-Identifier: BSD-3-Clause
#include "common/constants.h"
#include "common/parallel.h"
#include "render/lighting.h"
#include "render/ray_tracing/ray_shader.h"
#include "render/ray_tracing/world.h"
#include "surface/splat_input.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace pcl_uvol {

namespace {

/** Pixels of a tile's side: rays of a tile meet the same boxes. */
constexpr int tile_size = 16;

void
checkMaterial(const RayMaterial& material)
{
  pcl_uvol::checkMaterial(static_cast<const Material&>(material));
  const double mirrored = material.reflectivity, through = material.transparency;
  // Sums of decimal fractions may be a bit more than 1.
  constexpr double rounding = 1e-9;
  if (!(mirrored >= 0.0 && through >= 0.0 && mirrored + through <= 1.0 + rounding))
    throw InvalidArgument("material_beyond_one",
                          {{"reflectivity", mirrored}, {"transparency", through}});
  if (!(material.refractive_index > 0.0) || !std::isfinite(material.refractive_index))
    throw InvalidArgument("bad_refractive_index",
                          {{"index", material.refractive_index}});
}

void
checkSplats(const SplatObject& object)
{
  if (!object.splats || object.splats->empty())
    throw InvalidArgument("object_without_splats", {});
  if (!object.colors.empty() && object.colors.size() != object.splats->size())
    throw InvalidArgument(
        "colors_unlike_splats",
        {{"splats", object.splats->size()}, {"colors", object.colors.size()}});
  if (!object.rims.empty() && object.rims.size() != object.splats->size())
    throw InvalidArgument(
        "rims_unlike_splats",
        {{"splats", object.splats->size()}, {"rims", object.rims.size()}});
  for (const PointSplat& splat : *object.splats)
    if (!isDrawable(splat))
      throw InvalidArgument("object_with_bad_splat", {});
}

void
checkScene(const Scene& scene)
{
  if (scene.splats.empty() && scene.spheres.empty() && scene.planes.empty())
    throw InvalidArgument("scene_without_objects", {});
  for (const SplatObject& object : scene.splats) {
    checkMaterial(object.material);
    checkSplats(object);
  }
  for (const SphereObject& sphere : scene.spheres) {
    checkMaterial(sphere.material);
    if (!sphere.center.allFinite() || !(sphere.radius > 0.0) ||
        !std::isfinite(sphere.radius))
      throw InvalidArgument("bad_sphere", {});
  }
  for (const PlaneObject& plane : scene.planes) {
    checkMaterial(plane.material);
    checkColor("a plane's squares", plane.other_color);
    if (!plane.point.allFinite() || !plane.normal.allFinite() ||
        plane.normal.isZero(0.0) || !(plane.square >= 0.0))
      throw InvalidArgument("bad_plane", {});
  }
  checkLights(scene.lights);
  checkBackground(scene.background);
}

void
checkParameters(const RayTracingSettings& settings)
{
  constexpr int most_samples = 4096, most_depth = 10000;
  checkRange("depth of ray tracing", settings.depth, 0, most_depth);
  checkRange("number of shadow rays", settings.light_samples, 1, most_samples);
  checkRange("number of occlusion rays", settings.occlusion_samples, 0, most_samples);
  if (!(settings.occlusion_distance >= 0.0))
    throw InvalidArgument("bad_occlusion_distance", {});
}

/** Primary rays of an image. */
class Raster {
public:
  Raster(const Camera& camera, int width, int height, int supersampling)
      : eye_(camera.eye)
      , axes_(camera.rotation())
      , width_(width * supersampling)
      , height_(height * supersampling)
      , step_(2.0 * std::tan(camera.vertical_fov * pi / 360.0) / height_)
  {
  }

  /** Through the centre of a pixel of the finer grid. */
  Ray
  at(int column, int row) const
  {
    const double x = (column + 0.5 - 0.5 * width_) * step_;
    const double y = (row + 0.5 - 0.5 * height_) * step_;
    const Eigen::Vector3d direction =
        (axes_.row(2) + x * axes_.row(0) + y * axes_.row(1)).transpose();
    return {eye_, direction.normalized()};
  }

  /** Another one for every pixel. */
  std::uint64_t
  numberOf(int column, int row) const
  {
    return static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(width_) +
           static_cast<std::uint64_t>(column);
  }

  /** From 0 below to 1 above. */
  double
  heightOf(int row) const
  {
    return 1.0 - (row + 0.5) / height_;
  }

private:
  Eigen::Vector3d eye_;
  Eigen::Matrix3d axes_;
  int width_, height_;
  double step_;
};

/** Mean of the rays of a pixel, as bytes; colours are weighted by their opacity.
 * \param normal null, or set to the mean of the normals, of length 1 or 0 */
void
shadePixel(RayShader& shader,
           const Raster& raster,
           int column,
           int row,
           int supersampling,
           std::uint8_t* bytes,
           float* normal)
{
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();
  for (int dy = 0; dy < supersampling; ++dy)
    for (int dx = 0; dx < supersampling; ++dx) {
      const int x = column * supersampling + dx, y = row * supersampling + dy;
      const ShadedRay shaded =
          shader.shade(raster.at(x, y), raster.heightOf(y), raster.numberOf(x, y));
      const double opacity = shaded.color[3];
      sum.head<3>() += opacity * shaded.color.head<3>().cwiseMin(1.0);
      sum[3] += opacity;
      normals += shaded.normal;
    }
  for (int channel = 0; channel < 3; ++channel)
    bytes[channel] =
        toByte(static_cast<float>(sum[3] > 0.0 ? sum[channel] / sum[3] : 0.0));
  bytes[3] = toByte(static_cast<float>(sum[3] / (supersampling * supersampling)));
  if (normal != nullptr)
    for (int axis = 0; axis < 3; ++axis)
      normal[axis] = static_cast<float>(normals.normalized()[axis]);
}

} // namespace

RayTracer::RayTracer() = default;
RayTracer::~RayTracer() = default;

void
RayTracer::setScene(const Scene& scene)
{
  checkScene(scene);
  scene_ = scene;
  world_.reset();
  build_report_ = Report();
}

const World&
RayTracer::build()
{
  if (!scene_ && !world_)
    throw InvalidArgument("ray_tracer_without_scene", {});
  if (!world_) {
    startReport();
    world_ = std::make_unique<World>(std::move(*scene_), threads_, report_);
    build_report_.merge(report_);
    scene_.reset();
  }
  return *world_;
}

BoundingSphere
RayTracer::getBounds()
{
  return build().bounds();
}

void
RayTracer::render(Image& image)
{
  checkParameters(settings_);
  checkPictureSize(largest_size);
  const World& world = build();
  startReport();
  report_.merge(build_report_);
  const Camera camera = cameraFor(world.bounds());
  const Raster raster(camera, width_, height_, supersampling_);
  Image traced;
  traced.width = static_cast<std::uint32_t>(width_);
  traced.height = static_cast<std::uint32_t>(height_);
  traced.color.resize(4 * traced.pixels());
  if (has_normals_)
    traced.normal.resize(3 * traced.pixels());
  const int columns = (width_ + tile_size - 1) / tile_size;
  const int rows = (height_ + tile_size - 1) / tile_size;
  const auto tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  RayCounts counts;
  std::mutex counting;
  {
    StepTimer step(report_, "trace", tiles);
    parallelBlocks(tiles, 1, threads_, [&](std::size_t tile, std::size_t) {
      RayShader shader(world, settings_, camera);
      const int left = static_cast<int>(tile) % columns * tile_size;
      const int top = static_cast<int>(tile) / columns * tile_size;
      for (int row = top; row < std::min(top + tile_size, height_); ++row)
        for (int column = left; column < std::min(left + tile_size, width_); ++column) {
          const auto pixel = static_cast<std::size_t>(row) * traced.width +
                             static_cast<std::size_t>(column);
          shadePixel(shader,
                     raster,
                     column,
                     row,
                     supersampling_,
                     &traced.color[4 * pixel],
                     has_normals_ ? &traced.normal[3 * pixel] : nullptr);
        }
      step.advance(1);
      const std::lock_guard<std::mutex> lock(counting);
      counts.primary += shader.counts().primary;
      counts.secondary += shader.counts().secondary;
      counts.shadow += shader.counts().shadow;
    });
  }
  report_.count("primary_rays", counts.primary);
  report_.count("secondary_rays", counts.secondary);
  report_.count("shadow_rays", counts.shadow);
  image = std::move(traced);
}

} // namespace pcl_uvol
