// SPDX-License-Identifier: BSD-3-Clause
// Frames per second of image-space rendering, beside VTK's point mapper, which draws
// the points alone: no hole filled, nothing smoothed. VTK needs a display (xvfb-run).
#include "support/surfaces.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <benchmark/benchmark.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <cstdlib>
#include <map>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace {

using pcl_uvol::Camera;

uvol_test::SurfaceCloudPtr
knot(std::size_t points)
{
  static std::map<std::size_t, uvol_test::SurfaceCloudPtr> clouds;
  auto& cloud = clouds[points];
  if (!cloud)
    cloud = uvol_test::makeTorusKnot(points, 1);
  return cloud;
}

Camera
knotCamera(double aspect)
{
  // The knot covers about half of the picture.
  return Camera::fit({{0.0, 0.0, 0.0}, 3.42},
                     Eigen::Vector3d(0.1, 0.2, 1.0),
                     Eigen::Vector3d::UnitY(),
                     30.0,
                     aspect,
                     0.95);
}

void
reportPasses(benchmark::State& state, const pcl_uvol::Report& report)
{
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(report.getCount("points")));
  for (const auto& [pass, milliseconds] : report.milliseconds)
    state.counters[pass] = milliseconds;
  state.counters["frames_per_second"] = benchmark::Counter(
      static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/** \param state points, width, height, 1 for silhouettes and feature lines */
void
imageSpace(benchmark::State& state)
{
  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> renderer;
  renderer.setInputCloud(knot(static_cast<std::size_t>(state.range(0))));
  const int width = static_cast<int>(state.range(1)),
            height = static_cast<int>(state.range(2));
  renderer.setSize(width, height);
  renderer.setCamera(knotCamera(static_cast<double>(width) / height));
  renderer.settings().silhouettes = renderer.settings().feature_lines =
      state.range(3) != 0;
  pcl_uvol::Image image;
  renderer.render(image); // sorts the points
  for ([[maybe_unused]] const auto& iteration : state)
    renderer.render(image);
  reportPasses(state, renderer.getReport());
  state.SetLabel(renderer.describeBackend());
}

vtkSmartPointer<vtkPolyData>
toVtk(const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkCellArray> vertices;
  normals->SetNumberOfComponents(3);
  for (const auto& point : cloud) {
    const vtkIdType id = points->InsertNextPoint(point.x, point.y, point.z);
    normals->InsertNextTuple3(point.normal_x, point.normal_y, point.normal_z);
    vertices->InsertNextCell(1, &id);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetNormals(normals);
  return data;
}

/** \param state points, width, height */
void
vtkPointMapper(benchmark::State& state)
{
  if (std::getenv("DISPLAY") == nullptr) {
    state.SkipWithError("VTK needs a display: run it by xvfb-run");
    return;
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(toVtk(*knot(static_cast<std::size_t>(state.range(0)))));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->BackfaceCullingOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->OffScreenRenderingOn();
  window->SetSize(static_cast<int>(state.range(1)), static_cast<int>(state.range(2)));
  window->AddRenderer(renderer);
  const Camera camera = knotCamera(static_cast<double>(state.range(1)) /
                                   static_cast<double>(state.range(2)));
  renderer->GetActiveCamera()->SetPosition(camera.eye.data());
  renderer->GetActiveCamera()->SetFocalPoint(camera.at.data());
  renderer->GetActiveCamera()->SetViewUp(camera.up.data());
  renderer->GetActiveCamera()->SetViewAngle(camera.vertical_fov);
  renderer->ResetCameraClippingRange();
  window->Render();
  for ([[maybe_unused]] const auto& iteration : state) {
    renderer->GetActiveCamera()->Azimuth(0.01); // a frame like the last is not drawn
    window->Render();
    window->WaitForCompletion();
  }
  state.counters["frames_per_second"] = benchmark::Counter(
      static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

BENCHMARK(imageSpace)
    ->ArgNames({"points", "width", "height", "lines"})
    ->Args({544000, 1024, 1024, 0})
    ->Args({544000, 1024, 1024, 1})
    ->Args({544000, 512, 512, 1})
    ->Args({10000000, 1920, 1080, 0})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(vtkPointMapper)
    ->ArgNames({"points", "width", "height"})
    ->Args({544000, 1024, 1024})
    ->Args({544000, 512, 512})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
