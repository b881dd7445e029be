// SPDX-License-Identifier: BSD-3-Clause
// The window of uvol_viewer, moved by events of mouse and keys, for its tests.
#pragma once

#include "support/environment.h"
#include "support/png.h"
#include "support/surfaces.h"
#include "support/virtual_display.h"
#include "tools/json_warnings.h"
#include "viewer/viewer_window.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace uvol_test {

using pcl_uvol::Image;

constexpr int width = 240, height = 180;

/** Random samples of an ellipsoid's function: 1 on half axes of 1, 1/2 and 1/3. */
inline pcl_uvol::Dataset
makeVolume()
{
  pcl::PointCloud<pcl::PointXYZI> points;
  Random random(7);
  for (int i = 0; i < 15000; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.y = static_cast<float>(random.uniform() - 0.5);
    point.z = static_cast<float>(random.uniform() - 0.5);
    point.intensity = Eigen::Vector3f(point.x, 2.0f * point.y, 3.0f * point.z).norm();
    points.push_back(point);
  }
  pcl_uvol::Dataset volume;
  pcl::toPCLPointCloud2(points, volume.cloud);
  return volume;
}

/** A display, and a temporary folder to work in. */
class UvolViewer : public DisplayTest {
protected:
  void
  SetUp() override
  {
    DisplayTest::SetUp();
    std::filesystem::current_path(folder_ / "");
  }

  void
  TearDown() override
  {
    std::filesystem::current_path("/");
  }

  static Image
  read(const std::string& path)
  {
    int channels;
    Image image = readPng(path, channels);
    EXPECT_EQ(static_cast<std::uint32_t>(width), image.width) << path;
    EXPECT_EQ(static_cast<std::uint32_t>(height), image.height) << path;
    return image;
  }

  TemporaryFolder folder_;
};

/** The window of a cloud, with the options of the tool. */
class OpenWindow {
public:
  OpenWindow(pcl_uvol::Dataset data,
             const std::string& field,
             std::vector<const char*> arguments,
             const Eigen::Vector3d& factors = Eigen::Vector3d::Ones())
      : surface(std::move(data), field, 0, factors)
  {
    arguments.insert(arguments.begin(), {"uvol_viewer", "-size", "240x180"});
    look.declareScene(options);
    look.declareExaggeration(options);
    look.declarePasses(options);
    options.parse(static_cast<int>(arguments.size()), arguments.data());
    look.check(options);
    if (!field.empty())
      surface.setIsoValue(0.5);
    const auto read = [this, field](const std::string& path) {
      return uvol_tools::ShownFile{
          {pcl_uvol::loadDataset(path), field, 0}, look, pcl_uvol::Report()};
    };
    window = std::make_unique<uvol_tools::ViewerWindow>(
        "in", surface, look, options, pcl_uvol::WindowBackend::Auto, read);
  }

  void
  drop(const std::vector<const char*>& paths)
  {
    vtkNew<vtkStringArray> files;
    for (const char* const path : paths)
      files->InsertNextValue(path);
    window->interactor().InvokeEvent(vtkCommand::DropFilesEvent, files);
  }

  std::string
  title()
  {
    return window->interactor().GetRenderWindow()->GetWindowName();
  }

  /** Move the mouse with the left button held, in pixels from the lower left. */
  void
  drag(int x0, int y0, int x1, int y1)
  {
    vtkRenderWindowInteractor& mouse = window->interactor();
    mouse.SetEventInformation(x0, y0);
    mouse.InvokeEvent(vtkCommand::MouseMoveEvent);
    mouse.InvokeEvent(vtkCommand::LeftButtonPressEvent);
    mouse.SetEventInformation(x1, y1);
    mouse.InvokeEvent(vtkCommand::MouseMoveEvent);
    mouse.InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
    if (waits)
      window->finish();
  }

  void
  click(int x, int y)
  {
    drag(x, y, x, y);
  }

  void
  pointAt(int x, int y)
  {
    window->interactor().SetEventInformation(x, y);
    window->interactor().InvokeEvent(vtkCommand::MouseMoveEvent);
  }

  vtkRenderer&
  renderer()
  {
    return *window->interactor().GetRenderWindow()->GetRenderers()->GetFirstRenderer();
  }

  /** Pull the slider from its isovalue to another one. */
  void
  slide(double isovalue)
  {
    const auto& range = surface.getRange();
    const auto place = [&](double value) {
      const double part = (value - range[0]) / (range[1] - range[0]);
      return static_cast<int>(width * (0.1 + 0.8 * part));
    };
    const int y = static_cast<int>(0.12 * height);
    drag(place(surface.getIsoValue()), y, place(isovalue), y);
  }

  void
  type(char key)
  {
    vtkRenderWindowInteractor& keyboard = window->interactor();
    const int* const at = keyboard.GetEventPosition();
    keyboard.SetEventInformation(at[0], at[1], 0, 0, key);
    keyboard.InvokeEvent(vtkCommand::KeyPressEvent);
    keyboard.InvokeEvent(vtkCommand::CharEvent);
    if (waits)
      window->finish();
  }

  vtkCamera&
  camera()
  {
    return *renderer().GetActiveCamera();
  }

  Image
  shoot()
  {
    window->save("shot.png");
    int channels;
    return readPng("shot.png", channels);
  }

  bool waits = true; // for the surface that events ask for
  uvol_tools::ShownSurface surface;
  uvol_tools::RenderOptions look;
  uvol_tools::Options options{"uvol_viewer", "", ""};
  std::unique_ptr<uvol_tools::ViewerWindow> window;
};

/** Pixels of a grey surface in the upper three quarters, where no slider is. */
inline int
covered(const Image& image)
{
  int count = 0;
  for (std::size_t i = 0; i < image.pixels() * 3 / 4; ++i)
    count += image.color[4 * i] < 240;
  return count;
}

/** Pixels that are no shade of grey. */
inline int
countColored(const Image& image)
{
  int count = 0;
  for (std::size_t i = 0; i < image.pixels() * 3 / 4; ++i)
    count += std::abs(image.color[4 * i] - image.color[4 * i + 2]) > 40;
  return count;
}

/** First and last column that a surface covers in the middle rows. */
inline std::pair<int, int>
columnsOf(const Image& image)
{
  int first = width, last = -1;
  for (int row = height / 4; row < 3 * height / 4; ++row)
    for (int column = 0; column < width; ++column)
      if (image.color[4 * static_cast<std::size_t>(row * width + column)] < 200) {
        first = std::min(first, column);
        last = std::max(last, column);
      }
  return {first, last};
}

} // namespace uvol_test
