// SPDX-License-Identifier: BSD-3-Clause
// How far pictures of a surface are from what it looks like: points as we draw them,
// beside VTK's mesh of as many vertices with multisampling, and VTK's Gaussian splats
// of the same points. The truth is a mesh of 16 times as many vertices with 8 x 8
// samples per pixel. White light from the eye, no highlights. VTK needs a display
// (xvfb-run). usage: picture_quality [pixels [points ...]]
#include "support/surfaces.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace {

using pcl_uvol::Camera;

constexpr float gray = 0.8f;
constexpr std::size_t truth_samples = 8, truth_vertices = 16;

/** Brightness of pixels, row by row from the top, from 0 to 255. */
using Picture = std::vector<double>;

Camera
makeCamera()
{
  return Camera::fit({{0.0, 0.0, 0.0}, 3.42},
                     Eigen::Vector3d(0.1, 0.2, 1.0),
                     Eigen::Vector3d::UnitY(),
                     30.0,
                     1.0,
                     0.95);
}

/** Milliseconds that a frame takes: the median of several. */
double
timeFrame(const std::function<void()>& draw)
{
  constexpr std::size_t frames = 5;
  std::vector<double> times;
  draw();
  for (std::size_t i = 0; i < frames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    draw();
    times.push_back(std::chrono::duration<double, std::milli>(
                        std::chrono::steady_clock::now() - start)
                        .count());
  }
  std::nth_element(times.begin(), times.begin() + frames / 2, times.end());
  return times[frames / 2];
}

vtkSmartPointer<vtkPolyData>
toVtk(const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const auto& point : cloud) {
    points->InsertNextPoint(point.x, point.y, point.z);
    normals->InsertNextTuple3(point.normal_x, point.normal_y, point.normal_z);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->SetNormals(normals);
  return data;
}

/** Places around the tube of so many vertices, of which there are eight times as many
 * along it. */
std::size_t
countAround(std::size_t vertices)
{
  return static_cast<std::size_t>(std::sqrt(static_cast<double>(vertices) / 8.0));
}

uvol_test::SurfaceCloudPtr
makeVertices(std::size_t count)
{
  const std::size_t around = countAround(count);
  return uvol_test::makeKnotLattice(8 * around, around);
}

/** A mesh of about so many vertices. */
vtkSmartPointer<vtkPolyData>
makeMesh(std::size_t vertices)
{
  const std::size_t around = countAround(vertices), along = 8 * around;
  const auto data = toVtk(*makeVertices(vertices));
  vtkNew<vtkCellArray> triangles;
  const auto vertexOf = [&](std::size_t i, std::size_t j) {
    return static_cast<vtkIdType>((i % along) * around + j % around);
  };
  for (std::size_t i = 0; i < along; ++i)
    for (std::size_t j = 0; j < around; ++j) {
      const vtkIdType corners[] = {vertexOf(i, j),
                                   vertexOf(i + 1, j),
                                   vertexOf(i + 1, j + 1),
                                   vertexOf(i, j + 1)};
      triangles->InsertNextCell({corners[0], corners[1], corners[2]});
      triangles->InsertNextCell({corners[0], corners[2], corners[3]});
    }
  data->SetPolys(triangles);
  return data;
}

/** A window of VTK that shows one thing. */
class VtkView {
public:
  VtkView(vtkMapper* mapper, int pixels, int multisamples)
      : pixels_(pixels)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(gray, gray, gray);
    actor->GetProperty()->SetAmbient(0.0);
    actor->GetProperty()->SetDiffuse(1.0);
    actor->GetProperty()->SetSpecular(0.0);
    renderer_->AddActor(actor);
    renderer_->SetBackground(1.0, 1.0, 1.0);
    window_->SetMultiSamples(multisamples);
    window_->OffScreenRenderingOn();
    window_->SetSize(pixels, pixels);
    window_->AddRenderer(renderer_);
    const Camera camera = makeCamera();
    vtkCamera* const eye = renderer_->GetActiveCamera();
    eye->SetPosition(camera.eye.data());
    eye->SetFocalPoint(camera.at.data());
    eye->SetViewUp(camera.up.data());
    eye->SetViewAngle(camera.vertical_fov);
    renderer_->ResetCameraClippingRange();
  }

  Picture
  draw()
  {
    window_->Render();
    vtkNew<vtkUnsignedCharArray> bytes;
    window_->GetPixelData(0, 0, pixels_ - 1, pixels_ - 1, 0, bytes);
    const auto side = static_cast<vtkIdType>(pixels_);
    Picture picture;
    for (vtkIdType row = side; row-- > 0;) // the lowest one is VTK's first
      for (vtkIdType column = 0; column < side; ++column)
        picture.push_back(bytes->GetTypedComponent(row * side + column, 0));
    return picture;
  }

  double
  time()
  {
    return timeFrame([this] {
      renderer_->GetActiveCamera()->Azimuth(0.01); // else nothing is drawn again
      window_->Render();
      window_->WaitForCompletion();
    });
  }

private:
  int pixels_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

Picture
averaged(const Picture& fine, std::size_t pixels)
{
  const std::size_t side = pixels * truth_samples;
  Picture picture(pixels * pixels);
  for (std::size_t i = 0; i < fine.size(); ++i)
    picture[i / side / truth_samples * pixels + i % side / truth_samples] +=
        fine[i] / (truth_samples * truth_samples);
  return picture;
}

vtkSmartPointer<vtkPolyDataMapper>
mapMesh(std::size_t vertices)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(makeMesh(vertices));
  return mapper;
}

/** Roots of mean squares of differences: over the pixels that show the surface, and
 * over those of them that are not near its outline. */
struct Errors {
  double all, inside;
};

/** Whether the pixels around one show the surface alone. */
bool
isInside(const Picture& truth, std::size_t pixel)
{
  constexpr std::ptrdiff_t near = 2;
  const auto side = static_cast<std::ptrdiff_t>(std::sqrt(truth.size()));
  const auto column = static_cast<std::ptrdiff_t>(pixel) % side,
             row = static_cast<std::ptrdiff_t>(pixel) / side;
  for (std::ptrdiff_t y = row - near; y <= row + near; ++y)
    for (std::ptrdiff_t x = column - near; x <= column + near; ++x)
      if (x < 0 || y < 0 || x >= side || y >= side ||
          !(truth[static_cast<std::size_t>(y * side + x)] < 255.0))
        return false;
  return true;
}

Errors
compare(const Picture& picture, const Picture& truth)
{
  double all = 0.0, inside = 0.0;
  std::size_t of_all = 0, of_inside = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (picture[i] < 255.0 || truth[i] < 255.0) {
      const double square = (picture[i] - truth[i]) * (picture[i] - truth[i]);
      all += square;
      ++of_all;
      if (isInside(truth, i)) {
        inside += square;
        ++of_inside;
      }
    }
  return {std::sqrt(all / static_cast<double>(of_all)),
          std::sqrt(inside / static_cast<double>(of_inside))};
}

void
tell(const std::string& name, const Errors& errors, double milliseconds)
{
  std::printf("%-44s %8.2f %8.2f %10.1f\n",
              name.c_str(),
              errors.all,
              errors.inside,
              milliseconds);
}

void
measureOurs(const std::string& name,
            const uvol_test::SurfaceCloudPtr& cloud,
            int supersampling,
            int pixels,
            const Picture& truth)
{
  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> renderer;
  renderer.setInputCloud(cloud);
  renderer.setSize(pixels, pixels);
  renderer.setCamera(makeCamera());
  renderer.setSupersampling(supersampling);
  pcl_uvol::Material& material = renderer.settings().material;
  material.ambient = material.specular = 0.0;
  material.diffuse = 1.0;
  material.color = {gray, gray, gray};
  pcl_uvol::Light light;
  light.position = {0.0, 0.0, 1.0};
  renderer.settings().lights = {light};
  pcl_uvol::Image image;
  const double milliseconds = timeFrame([&] { renderer.render(image); });
  Picture picture(image.pixels());
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = image.color[4 * i];
  tell("ours, " + name + ", " + std::to_string(supersampling) + " x " +
           std::to_string(supersampling) + " samples",
       compare(picture, truth),
       milliseconds);
}

void
measureVtk(const std::string& name,
           vtkMapper* mapper,
           int multisamples,
           int pixels,
           const Picture& truth)
{
  VtkView view(mapper, pixels, multisamples);
  const Picture picture = view.draw();
  tell(name, compare(picture, truth), view.time());
}

void
measure(std::size_t points, int pixels)
{
  const auto side = static_cast<std::size_t>(pixels);
  const Picture truth = averaged(VtkView(mapMesh(truth_vertices * points),
                                         pixels * static_cast<int>(truth_samples),
                                         0)
                                     .draw(),
                                 side);
  std::printf("%zu points, %d x %d pixels: rms of 255, off the outline, ms per frame\n",
              points,
              pixels,
              pixels);
  const auto cloud = uvol_test::makeTorusKnot(points, 1);
  for (const int supersampling : {1, 2, 3})
    measureOurs("random points", cloud, supersampling, pixels, truth);
  for (const int supersampling : {2, 3})
    measureOurs(
        "the mesh's vertices", makeVertices(points), supersampling, pixels, truth);
  const auto mesh = mapMesh(points);
  for (const int multisamples : {0, 4, 8})
    measureVtk("VTK's mesh, multisamples asked for: " + std::to_string(multisamples),
               mesh,
               multisamples,
               pixels,
               truth);
  vtkNew<vtkPointGaussianMapper> splats;
  splats->SetInputData(toVtk(*cloud));
  splats->EmissiveOff();
  constexpr double area = 80.0; // of the knot
  splats->SetScaleFactor(std::sqrt(area / static_cast<double>(points)));
  measureVtk("VTK's Gaussian splats", splats, 0, pixels, truth);
}

} // namespace

int
main(int argc, char** argv)
{
  if (std::getenv("DISPLAY") == nullptr) {
    std::fprintf(stderr, "VTK needs a display: run it by xvfb-run.\n");
    return 1;
  }
  const int pixels = argc > 1 ? std::atoi(argv[1]) : 512;
  std::vector<std::size_t> points;
  for (int i = 2; i < argc; ++i)
    points.push_back(static_cast<std::size_t>(std::atol(argv[i])));
  if (points.empty())
    points = {30000, 100000, 544000};
  for (const std::size_t count : points)
    measure(count, pixels);
  return 0;
}
