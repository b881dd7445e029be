// SPDX-License-Identifier: BSD-3-Clause
// Cameras of the window, what it saves, and files that it opens.
#include "charts/color_bar.h"
#include "shared/ray_options.h"
#include "surface/splat_input.h"
#include "viewer/keys.h"
#include "viewer/viewer_window.h"
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <vtkCamera.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

namespace uvol_tools {

namespace {

/** uvol_viewer_1.png, or the next number that no file has. */
std::string
freeName(const std::string& ending)
{
  const auto name = [&ending](int number) {
    return "uvol_viewer_" + std::to_string(number) + ending;
  };
  int number = 1;
  while (std::filesystem::exists(name(number)))
    ++number;
  return name(number);
}

/** The field of view of a picture that is so many times as high. */
double
angleOfHigher(double degrees, double growth)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  return 2.0 * std::atan(growth * std::tan(0.5 * degree * degrees)) / degree;
}

} // namespace

PictureCell
ViewerWindow::findFreePart() const
{
  constexpr double above_slider = 0.78; // part of the height
  const int* const size = window_->GetSize();
  int width = size[0], height = size[1];
  if (colors_->hasLegend())
    width -= colorBarWidth(width, height);
  if (!surface_.getField().empty())
    height = static_cast<int>(above_slider * height);
  return ViewOptions::wholePicture(std::max(1, width), std::max(1, height));
}

void
ViewerWindow::centerView()
{
  const PictureCell free = findFreePart();
  const int* const size = window_->GetSize();
  renderer_->GetActiveCamera()->SetWindowCenter(
      1.0 - static_cast<double>(free.width) / size[0],
      static_cast<double>(free.height) / size[1] - 1.0);
}

void
ViewerWindow::setCamera(const pcl_uvol::Camera& camera)
{
  centerView();
  vtkCamera& view = *renderer_->GetActiveCamera();
  view.SetPosition(camera.eye.data());
  view.SetFocalPoint(camera.at.data());
  view.SetViewUp(camera.up.data());
  view.SetViewAngle(camera.vertical_fov);
  renderer_->ResetCameraClippingRange();
}

pcl_uvol::Camera
ViewerWindow::getCamera() const
{
  vtkCamera& view = *renderer_->GetActiveCamera();
  pcl_uvol::Camera camera;
  camera.eye = Eigen::Vector3d(view.GetPosition());
  camera.at = Eigen::Vector3d(view.GetFocalPoint());
  camera.up = Eigen::Vector3d(view.GetViewUp());
  camera.vertical_fov = view.GetViewAngle();
  return camera;
}

void
ViewerWindow::withSeenSurface(
    const std::function<void(const pcl_uvol::SeenSurface&, const PictureCell&)>& call)
{
  const PictureCell cell = findFreePart();
  pcl_uvol::SeenSurface seen{surface_.getBounds()};
  if (!surface_.getCloud()) {
    call(seen, cell);
    return;
  }
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(*surface_.getCloud());
  seen.cloud = &cloud;
  if (const auto prepared = surface_.getPrepared();
      prepared && prop_->renderer().settings().footprints)
    seen.find_discs = [&cell, prepared](const pcl_uvol::Camera& camera) {
      return prepared->findFittedDiscs(camera, cell.width, cell.height);
    };
  call(seen, cell);
}

void
ViewerWindow::lookFirst(bool is_placed)
{
  withSeenSurface([&](const auto& seen, const auto& cell) {
    pcl_uvol::Camera camera = look_.makeCamera(seen, surface_.getDrawnOrigin(), cell);
    if (!is_placed)
      camera.vertical_fov =
          angleOfHigher(camera.vertical_fov,
                        static_cast<double>(window_->GetSize()[1]) / cell.height);
    setCamera(camera);
    if (!is_placed)
      fitted_ = getCamera();
  });
}

void
ViewerWindow::lookAtAll(pcl_uvol::Camera camera)
{
  withSeenSurface([&](const auto& seen, const auto& cell) {
    camera.eye += seen.bounds.center - camera.at;
    camera.at = seen.bounds.center;
    const double whole_angle = camera.vertical_fov;
    camera.vertical_fov = angleOfHigher(
        whole_angle, static_cast<double>(cell.height) / window_->GetSize()[1]);
    camera = fitToSurface(camera, seen, static_cast<double>(cell.width) / cell.height);
    camera.vertical_fov = whole_angle;
    setCamera(camera);
    fitted_ = getCamera();
  });
}

bool
ViewerWindow::isFitted() const
{
  const pcl_uvol::Camera camera = getCamera();
  return camera.eye == fitted_.eye && camera.at == fitted_.at &&
         camera.up == fitted_.up && camera.vertical_fov == fitted_.vertical_fov;
}

void
ViewerWindow::lookFrom(const std::string& side)
{
  const int* const size = window_->GetSize();
  lookAtAll(pcl_uvol::Camera::fit(surface_.getBounds(),
                                  side,
                                  renderer_->GetActiveCamera()->GetViewAngle(),
                                  static_cast<double>(size[0]) / size[1]));
}

void
ViewerWindow::printCamera()
{
  std::cout << describeCamera(getCamera(),
                              {{},
                               Eigen::Vector3d(surface_.getDrawnOrigin().data()),
                               surface_.getFactors(),
                               ""})
            << std::endl;
  show("printed the camera");
}

template <typename RendererT>
pcl_uvol::Image
ViewerWindow::drawPicture(RendererT& renderer)
{
  const int* const size = window_->GetSize();
  Ground ground{prop_->renderer().settings().background, size[0], size[1], size[0]};
  if (colors_->hasLegend())
    ground.views_width -= colorBarWidth(size[0], size[1]);
  renderer.setSupersampling(look_.getSupersampling());
  pcl_uvol::Image picture = Figure().drawViews(
      {pcl_uvol::viewOf(*surface_.getCloud()),
       surface_.getBounds(),
       surface_.getDrawnOrigin()},
      ground,
      [this](const auto&, const auto&) { return getCamera(); },
      [&](const pcl_uvol::Camera& camera, const PictureCell& cell, auto& image) {
        renderer.setSize(cell.width, cell.height);
        renderer.setCamera(camera);
        renderer.render(image);
      });
  colors_->drawLegend(picture);
  return picture;
}

void
ViewerWindow::savePicture()
{
  if (!surface_.getCloud())
    throw pcl_uvol::InvalidArgument("no_surface_to_draw", {});
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(surface_.getCloud());
  renderer.settings() = prop_->renderer().settings();
  colors_->colorLike(renderer);
  renderer.setOpacities(prop_->renderer().getOpacities());
  const std::string name = freeName(".png");
  pcl_uvol::savePng(name, drawPicture(renderer));
  show("saved " + name);
}

void
ViewerWindow::saveRayTracedPicture()
{
  if (!surface_.getCloud())
    throw pcl_uvol::InvalidArgument("no_surface_to_draw", {});
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(*surface_.getCloud());
  const pcl_uvol::ImageSpaceSettings& settings = prop_->renderer().settings();
  const int* const size = window_->GetSize();
  pcl_uvol::RayMaterial material;
  static_cast<pcl_uvol::Material&>(material) = settings.material;
  pcl_uvol::Report report;
  pcl_uvol::Scene scene =
      makeSplatScene(cloud,
                     pcl_uvol::findSplats(cloud, {}, false, 0, report),
                     colors_->colorPoints(*surface_.getCloud()),
                     material,
                     std::min(size[0], size[1]));
  scene.lights = settings.lights;
  scene.background = settings.background;
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.settings().cull_back_faces = settings.cull_back_faces;
  const std::string name = freeName(".png");
  pcl_uvol::savePng(name, drawPicture(tracer));
  show("saved " + name);
}

void
ViewerWindow::saveSurface()
{
  if (!surface_.getCloud())
    throw pcl_uvol::InvalidArgument("no_surface_to_save", {});
  const std::string name = freeName(".ply");
  pcl_uvol::Dataset surface;
  surface.cloud = *surface_.getData();
  surface.origin = surface_.getOrigin();
  pcl_uvol::saveDataset(name, surface);
  show("saved " + name);
}

ShownFile
ViewerWindow::readFile(const std::string& path)
{
  ShownFile file = open_(path);
  ShownSurface& surface = file.surface;
  if (surface.getField().empty())
    return file;
  surface.setMeshed(surface_.isMeshed());
  // A further state of the same samples is compared at the same isovalues.
  const auto& isovalues = surface_.getIsoValues();
  const auto& range = surface.getRange();
  if (std::all_of(isovalues.begin(), isovalues.end(), [&range](double isovalue) {
        return isovalue >= range[0] && isovalue <= range[1];
      })) {
    surface.setIsoValues(isovalues);
    surface.finish();
  }
  if (!surface.getCloud()) {
    surface.setIsoValues({surface.proposeIsoValue()});
    surface.finish();
  }
  if (!surface.getCloud())
    throw pcl_uvol::InvalidArgument("no_points_at_isovalues", {{"path", path}});
  return file;
}

void
ViewerWindow::openFile(const std::string& path)
{
  finish();
  show("reading " + path);
  render();
  ShownFile file = readFile(path);
  std::unique_ptr<ColorChoice> colors;
  const auto exchange = [&] {
    std::swap(surface_, file.surface);
    std::swap(look_, file.look);
    std::swap(colors_, colors);
  };
  const pcl_uvol::Camera before = getCamera();
  exchange();
  try {
    colors_ = std::make_unique<ColorChoice>(look_, *surface_.getCloud());
    showOtherSurface();
    lookAtAll(before);
    render();
    if (!error_.empty())
      throw pcl_uvol::Exception(error_);
  }
  catch (...) { // it is no surface that can be drawn
    exchange();
    showOtherSurface();
    setCamera(before);
    throw;
  }
  nameWindow(path);
  std::string warnings;
  for (const pcl_uvol::Message& warning : file.report.warnings)
    warnings += (warnings.empty() ? "" : "\n") +
                warning.text(pcl_uvol::ParameterNames::Options);
  show(warnings);
}

void
ViewerWindow::showOtherSurface()
{
  showSurface();
  if (!surface_.getField().empty())
    fitSlider();
}

} // namespace uvol_tools
