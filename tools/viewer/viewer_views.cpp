// SPDX-License-Identifier: BSD-3-Clause
// Cameras of the window, and what it saves.
#include "viewer/keys.h"
#include "viewer/viewer_window.h"
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <vtkCamera.h>

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

} // namespace

void
ViewerWindow::setCamera(const pcl_uvol::Camera& camera)
{
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
ViewerWindow::lookFrom(const std::string& side)
{
  const int* const size = window_->GetSize();
  setCamera(pcl_uvol::Camera::fit(surface_.getBounds(),
                                  side,
                                  renderer_->GetActiveCamera()->GetViewAngle(),
                                  static_cast<double>(size[0]) / size[1]));
}

void
ViewerWindow::printCamera()
{
  std::cout << describeCamera(getCamera(),
                              {{},
                               Eigen::Vector3d(surface_.getOrigin().data()),
                               Eigen::Vector3d::Ones(),
                               ""})
            << std::endl;
  show("printed the camera");
}

void
ViewerWindow::savePicture()
{
  if (!surface_.getCloud())
    throw pcl_uvol::InvalidArgument("There is no surface to draw.");
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(surface_.getCloud());
  renderer.settings() = prop_->renderer().settings();
  colors_->colorLike(renderer);
  const int* const size = window_->GetSize();
  renderer.setSize(size[0], size[1]);
  renderer.setSupersampling(look_.getSupersampling());
  renderer.setCamera(getCamera());
  pcl_uvol::Image image;
  renderer.render(image);
  colors_->drawLegend(image);
  const std::string name = freeName(".png");
  pcl_uvol::savePng(name, image);
  show("saved " + name);
}

void
ViewerWindow::saveSurface()
{
  if (!surface_.getCloud())
    throw pcl_uvol::InvalidArgument("There is no surface to save.");
  const std::string name = freeName(".ply");
  pcl_uvol::Dataset surface;
  surface.cloud = *surface_.getCloud();
  surface.origin = surface_.getOrigin();
  pcl_uvol::saveDataset(name, surface);
  show("saved " + name);
}

} // namespace uvol_tools
