// SPDX-License-Identifier: BSD-3-Clause
// Frames per second of image-space rendering, beside VTK's point mapper, which draws
// the points alone: no hole filled, nothing smoothed. VTK needs a display (xvfb-run).
#include "generation/mesh_scatter.h"
#include "radial_cloud.h"
#include "support/environment.h"
#include "support/surfaces.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <benchmark/benchmark.h>
#include <pcl/common/io.h>
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

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace {

using pcl_uvol::Camera;

/** What is drawn: the knot of many measurements, and the surfaces of thesis Table 4.6
 * with as many points. */
enum Surface { Knot, LargeKnot, Sphere, Dragon, Blade, Isosurface };

uvol_test::SurfaceCloudPtr
scatter(const std::string& file, std::uint64_t points)
{
  const std::string folder = uvol_test::dataFolder();
  if (folder.empty())
    return nullptr;
  const pcl_uvol::Mesh mesh = pcl_uvol::loadMesh(folder + "/scans/" + file);
  const uvol_test::SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  for (const auto& [position, normal] : pcl_uvol::scatterOverMesh(mesh, points, 1)) {
    pcl::PointNormal point;
    std::copy(position.begin(), position.end(), point.data);
    std::copy(normal.begin(), normal.end(), point.data_n);
    cloud->push_back(point);
  }
  return cloud;
}

/** The isosurface of four million samples of the radial test. */
uvol_test::SurfaceCloudPtr
isosurface()
{
  const auto& radial = radialCloud(4000000);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValue(radial.radius);
  extraction.setOutside(pcl_uvol::Outside::Higher);
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  extraction.extract(isopoints);
  const uvol_test::SurfaceCloudPtr cloud(new pcl::PointCloud<pcl::PointNormal>);
  pcl::copyPointCloud(isopoints, *cloud);
  return cloud;
}

uvol_test::SurfaceCloudPtr
make(Surface surface)
{
  switch (surface) {
  case Knot:
    return uvol_test::makeTorusKnot(544000, 1);
  case LargeKnot:
    return uvol_test::makeTorusKnot(10000000, 1);
  case Sphere:
    return uvol_test::makeSphere(113000, 1);
  case Dragon:
    return scatter("dragon_res3.ply", 437000);
  case Blade:
    return scatter("turbineblade.ply", 883000);
  default:
    return isosurface();
  }
}

/** Null without the folder of real data. */
uvol_test::SurfaceCloudPtr
makeSearchCloud(Surface surface)
{
  static std::map<Surface, uvol_test::SurfaceCloudPtr> clouds;
  auto& cloud = clouds[surface];
  if (!cloud)
    cloud = make(surface);
  return cloud;
}

Camera
cameraOf(Surface surface,
         pcl_uvol::ImageSpaceRenderer<pcl::PointNormal>& renderer,
         double aspect)
{
  // The knot covers about half of the picture.
  if (surface == Knot || surface == LargeKnot)
    return Camera::fit({{0.0, 0.0, 0.0}, 3.42},
                       Eigen::Vector3d(0.1, 0.2, 1.0),
                       Eigen::Vector3d::UnitY(),
                       30.0,
                       aspect,
                       0.95);
  return Camera::fit(renderer.getBounds(), "front", 30.0, aspect);
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

/** \param state surface, width, height, lines: 1 for silhouettes and feature lines; 1
 * for ambient occlusion */
void
imageSpace(benchmark::State& state)
{
  const auto surface = static_cast<Surface>(state.range(0));
  const auto cloud = makeSearchCloud(surface);
  if (!cloud) {
    state.SkipWithError("the folder of real data is not there ($PCL_UVOL_DATA)");
    return;
  }
  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> renderer;
  renderer.setInputCloud(cloud);
  const int width = static_cast<int>(state.range(1)),
            height = static_cast<int>(state.range(2));
  renderer.setSize(width, height);
  renderer.setCamera(cameraOf(surface, renderer, static_cast<double>(width) / height));
  renderer.settings().silhouettes = renderer.settings().feature_lines =
      state.range(3) != 0;
  renderer.settings().ambient_occlusion = static_cast<double>(state.range(4));
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

/** \param state surface, width, height */
void
vtkPointMapper(benchmark::State& state)
{
  if (std::getenv("DISPLAY") == nullptr) {
    state.SkipWithError("VTK needs a display: run it by xvfb-run");
    return;
  }
  const auto surface = static_cast<Surface>(state.range(0));
  const auto cloud = makeSearchCloud(surface);
  if (!cloud) {
    state.SkipWithError("the folder of real data is not there ($PCL_UVOL_DATA)");
    return;
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(toVtk(*cloud));
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
  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> ours; // knows the bounds
  ours.setInputCloud(cloud);
  const Camera camera = cameraOf(surface,
                                 ours,
                                 static_cast<double>(state.range(1)) /
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

void
ours(benchmark::internal::Benchmark* bench)
{
  bench->ArgNames({"surface", "width", "height", "lines", "occlusion"});
  for (const Surface surface : {Knot, Sphere, Dragon, Blade, Isosurface})
    for (const int size : {512, 1024})
      for (const int lines : {0, 1})
        bench->Args({surface, size, size, lines, 0});
  for (const Surface surface : {Knot, Dragon})
    bench->Args({surface, 1024, 1024, 0, 1});
  bench->Args({LargeKnot, 1920, 1080, 0, 0});
}

void
peers(benchmark::internal::Benchmark* bench)
{
  bench->ArgNames({"surface", "width", "height"});
  for (const Surface surface : {Knot, Sphere, Dragon, Blade, Isosurface})
    for (const int size : {512, 1024})
      bench->Args({surface, size, size});
}

BENCHMARK(imageSpace)->Apply(ours)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(vtkPointMapper)->Apply(peers)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
