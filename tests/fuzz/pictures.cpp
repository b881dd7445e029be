// SPDX-License-Identifier: BSD-3-Clause
// Pictures of any points, splats, spheres and planes.
#include "promises.h"
#include "random_cloud.h"
#include "surface/splat_fields.h"
#include "surface/splat_input.h"
#include "targets.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/surface/splat_generation.h>

namespace uvol_fuzz {

namespace {

constexpr int picture_size = 12;

void
requirePicture(const pcl_uvol::Image& image)
{
  require(image.width == picture_size && image.height == picture_size,
          "a picture has the size asked for");
  require(image.color.size() == 4 * image.pixels(), "pixels have colours");
}

Eigen::Vector3d
takePlace(Bytes& bytes)
{
  const double x = bytes.take<float>(), y = bytes.take<float>(),
               z = bytes.take<float>();
  return {x, y, z};
}

/** A camera anywhere, unless it shall fit what is drawn. */
void
placeCamera(pcl_uvol::Renderer& renderer, Bytes& input)
{
  renderer.setSize(picture_size, picture_size);
  renderer.setNumberOfThreads(1);
  if (input.flip())
    return;
  pcl_uvol::Camera camera;
  camera.eye = takePlace(input);
  camera.at = takePlace(input);
  camera.vertical_fov = input.take<std::uint8_t>();
  renderer.setCamera(camera);
}

} // namespace

void
traceRays(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::RayTracer tracer;
  placeCamera(tracer, input);
  tracer.settings().depth = static_cast<int>(input.choose(4));
  tracer.settings().light_samples = 2;
  tracer.settings().occlusion_samples = static_cast<int>(input.choose(3));
  pcl_uvol::Scene scene;
  pcl_uvol::RayMaterial material;
  material.reflectivity = 0.1 * static_cast<double>(input.choose(11));
  material.transparency = 0.1 * static_cast<double>(input.choose(11));
  material.refractive_index = 0.25 * static_cast<double>(input.choose(12));
  if (input.flip())
    scene.spheres.push_back({takePlace(input), input.take<float>(), material});
  if (input.flip())
    scene.planes.push_back({takePlace(input), takePlace(input), material, 1.0, {}});
  const auto cloud = takeCloud(input, pcl_uvol::splat_fields);
  refusalOf([&] {
    pcl_uvol::Report report;
    const auto splats = std::make_shared<pcl::PointCloud<pcl_uvol::PointSplat>>(
        pcl_uvol::readSplats(pcl_uvol::viewOf(*cloud), report).cloud);
    scene.splats.push_back({splats, {}, material, false, {}});
  });
  refusalOf([&] {
    tracer.setScene(scene);
    pcl_uvol::Image image;
    tracer.render(image);
    requirePicture(image);
  });
}

void
renderPoints(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  placeCamera(renderer, input);
  auto& settings = renderer.settings();
  settings.cull_back_faces = input.flip();
  settings.footprints = input.flip();
  settings.silhouettes = input.flip();
  settings.feature_lines = input.flip();
  renderer.setSupersampling(1 + static_cast<int>(input.choose(2)));
  if (input.flip())
    renderer.setColorField("value");
  renderer.setInputCloud(
      takeCloud(input,
                std::array<const char*, 7>{
                    "x", "y", "z", "normal_x", "normal_y", "normal_z", "value"}));
  refusalOf([&] {
    pcl_uvol::Image image;
    renderer.render(image);
    requirePicture(image);
  });
}

} // namespace uvol_fuzz
