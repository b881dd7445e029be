// SPDX-License-Identifier: BSD-3-Clause
// Frames of a window while the camera goes round a surface, whole and as a mouse drags
// it, and steps of the isovalue, one by one and as a slider is dragged, as in
// uvol_viewer, by OpenGL and by the CPU whose picture OpenGL shows. Needs a display:
//   xvfb-run -s "-screen 0 1280x1024x24" build/release/bin/window samples.ply FIELD
//   ISOVALUE...
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
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
#include <memory>
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

/** Takes the isovalues in turn, and looks at each from several sides. */
void
run(IsosurfacePipeline& pipeline,
    IsosurfacePipelineParameters parameters,
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
  std::size_t points = 0;
  const auto step = [&](double isovalue, bool is_hasty) {
    parameters.isosurface.isovalues = {isovalue};
    pipeline.setParameters(parameters);
    const auto result = std::make_shared<IsosurfaceResult>(pipeline.run());
    points = result->surface.cloud.width;
    prop->renderer().setHasty(is_hasty);
    prop->setInputCloud({result, &result->surface.cloud});
    if (steps.empty())
      renderer->ResetCamera();
    window->Render();
  };
  step(isovalues.front(), false); // builds the tree and compiles shaders
  for (const double isovalue : isovalues) {
    slid.push_back(measure([&] { step(isovalue, true); }));
    steps.push_back(measure([&] { step(isovalue, false); }));
    for (int side = 0; side < 18; ++side) {
      const bool is_dragged = side >= 9;
      window->SetDesiredUpdateRate(is_dragged ? 15.0 : 1e-4); // as VTK's interactors
      (is_dragged ? dragged : frames).push_back(measure([&] {
        renderer->GetActiveCamera()->Azimuth(7.0);
        renderer->ResetCameraClippingRange();
        window->Render();
      }));
    }
  }
  std::printf("%s: %zu points, frame %.1f ms, dragged %.1f ms, step of the isovalue "
              "%.1f ms, slid %.1f ms\n",
              prop->describeBackend().c_str(),
              points,
              findMedian(frames),
              findMedian(dragged),
              findMedian(steps),
              findMedian(slid));
}

} // namespace

int
main(int argc, char** argv)
try {
  if (argc < 5) {
    std::fprintf(stderr, "usage: window samples.ply FIELD ISOVALUE ISOVALUE...\n");
    return 2;
  }
  IsosurfacePipeline pipeline;
  pipeline.setInput(std::make_shared<const Dataset>(loadDataset(argv[1])));
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = argv[2];
  std::vector<double> isovalues;
  for (int i = 3; i < argc; ++i)
    isovalues.push_back(std::atof(argv[i]));
  for (const WindowBackend backend : {WindowBackend::OpenGl, WindowBackend::Cpu})
    run(pipeline, parameters, isovalues, backend);
  return 0;
}
catch (const std::exception& error) {
  std::fprintf(stderr, "window: %s\n", error.what());
  return 1;
}
