// SPDX-License-Identifier: BSD-3-Clause
// Frames of a window while the camera goes round a surface, whole and as a mouse drags
// it, and steps of the isovalue, until the whole surface is drawn and until something
// is as a slider is dragged, as in uvol_viewer, by OpenGL and by the CPU whose picture
// OpenGL shows. Needs a display:
//   xvfb-run -s "-screen 0 1280x1024x24" build/release/bin/window samples.ply FIELD
//   ISOVALUE...
#include "viewer/shown_surface.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/vtk/image_space_prop.h>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace {

using namespace pcl_uvol;

double
measure(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() -
                                                   start)
      .count();
}

double
findMedian(std::vector<double> times)
{
  std::nth_element(
      times.begin(), times.begin() + static_cast<long>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

/** How fine frames are to be, as VTK's interactors and sliders ask for. @{ */
constexpr double moving_rate = 15.0, still_rate = 1e-4;
/** @} */

std::size_t
countPoints(const uvol_tools::ShownSurface& surface)
{
  return surface.getCloud() ? surface.getCloud()->width : 0;
}

/** Takes the isovalues in turn, and looks at each from several sides. */
void
run(uvol_tools::ShownSurface& surface,
    const std::vector<double>& isovalues,
    WindowBackend backend)
{
  vtkNew<ImageSpaceProp> prop;
  prop->setBackend(backend);
  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(prop);
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(1024, 768);
  window->AddRenderer(renderer);
  std::vector<double> steps, slid, frames, dragged;
  std::size_t points = 0, drafted = 0;
  const auto show = [&](double rate) {
    prop->setInputCloud(surface.getCloud(), surface.getPrepared());
    window->SetDesiredUpdateRate(rate);
    window->Render();
  };
  const auto step = [&](double isovalue) {
    surface.setIsoValue(isovalue);
    surface.finish();
    show(still_rate);
  };
  const auto slide = [&](double isovalue) {
    surface.setIsoValue(isovalue);
    while (!surface.update())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    show(moving_rate);
  };
  step(isovalues.front()); // builds the tree and compiles shaders
  renderer->ResetCamera();
  slide(isovalues.front()); // the same for drafts
  for (const double isovalue : isovalues) {
    surface.finish();
    slid.push_back(measure([&] { slide(isovalue); }));
    drafted = countPoints(surface);
    surface.finish();
    steps.push_back(measure([&] { step(isovalue); }));
    points = countPoints(surface);
    for (int side = 0; side < 18; ++side) {
      const bool is_dragged = side >= 9;
      window->SetDesiredUpdateRate(is_dragged ? moving_rate : still_rate);
      (is_dragged ? dragged : frames).push_back(measure([&] {
        renderer->GetActiveCamera()->Azimuth(7.0);
        renderer->ResetCameraClippingRange();
        window->Render();
      }));
    }
  }
  std::printf("%s: %zu points, frame %.1f ms, dragged %.1f ms, step of the isovalue "
              "%.1f ms, slid %.1f ms (%zu points)\n",
              prop->describeBackend().c_str(),
              points,
              findMedian(frames),
              findMedian(dragged),
              findMedian(steps),
              findMedian(slid),
              drafted);
}

} // namespace

int
main(int argc, char** argv)
try {
  if (argc < 5) {
    std::fprintf(stderr, "usage: window samples.ply FIELD ISOVALUE ISOVALUE...\n");
    return 2;
  }
  uvol_tools::ShownSurface surface(loadDataset(argv[1]), argv[2], 0);
  std::vector<double> isovalues;
  for (int i = 3; i < argc; ++i)
    isovalues.push_back(std::atof(argv[i]));
  for (const WindowBackend backend : {WindowBackend::OpenGl, WindowBackend::Cpu})
    run(surface, isovalues, backend);
  return 0;
}
catch (const std::exception& error) {
  std::fprintf(stderr, "window: %s\n", error.what());
  return 1;
}
