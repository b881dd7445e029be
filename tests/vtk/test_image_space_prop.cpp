// SPDX-License-Identifier: BSD-3-Clause
// The prop in windows of VTK and PCL: among other props, and against the CPU's picture.
#include "support/screenshot.h"
#include "support/surfaces.h"
#include "support/virtual_display.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/vtk/image_space_prop.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/visualization/pcl_visualizer.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cmath>

namespace test_image_space_prop {

using pcl_uvol::Image;
using pcl_uvol::ImageSpaceProp;
using uvol_test::screenshot;

constexpr int width = 200, height = 150;
const Eigen::Vector3d eye(0.6, -0.4, 4.5);
/** The centre of the red sphere, which intersects the cloud: a sphere of radius 1 about
 * 0. */
const Eigen::Vector3d center(0.5, 0.3, 0.5);
constexpr double radius = 0.6;

pcl::PCLPointCloud2::Ptr
makeCloud()
{
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(20000, 3), *cloud);
  return cloud;
}

/** Distance along a ray of unit direction to a sphere; infinite without a hit. */
double
distance(const Eigen::Vector3d& direction, const Eigen::Vector3d& middle, double r)
{
  const Eigen::Vector3d to_middle = middle - eye;
  const double along = to_middle.dot(direction);
  const double inside = r * r - to_middle.squaredNorm() + along * along;
  return inside > 0.0 ? along - std::sqrt(inside) : INFINITY;
}

/** Direction of the ray through a pixel of a window of that height. */
Eigen::Vector3d
rayThrough(int column, int row, int window_width, int window_height, double fov)
{
  pcl_uvol::Camera camera;
  camera.eye = eye;
  camera.vertical_fov = fov;
  const double focal = 0.5 * window_height / std::tan(fov * M_PI / 360.0);
  const Eigen::Vector3d local((column + 0.5 - 0.5 * window_width) / focal,
                              (row + 0.5 - 0.5 * window_height) / focal,
                              1.0);
  return (camera.rotation().transpose() * local).normalized();
}

/** Where one of the spheres is nearer by a margin it is seen: the red one or the grey
 * cloud. */
void
expectNearerSphereSeen(const Image& image, double fov)
{
  constexpr double margin = 0.1; // PCL's sphere is a coarse polyhedron
  int red = 0, grey = 0, wrong = 0;
  for (int row = 0; row < static_cast<int>(image.height); ++row)
    for (int column = 0; column < static_cast<int>(image.width); ++column) {
      const auto ray = rayThrough(column,
                                  row,
                                  static_cast<int>(image.width),
                                  static_cast<int>(image.height),
                                  fov);
      const double to_cloud = distance(ray, Eigen::Vector3d::Zero(), 1.0);
      const double to_sphere = distance(ray, center, radius - margin);
      const double to_larger = distance(ray, center, radius + margin);
      const auto* const pixel = &image.color[4 * (row * image.width + column)];
      const bool is_red = pixel[0] > 40 && pixel[1] < pixel[0] / 2;
      const bool is_grey = pixel[0] > 20 && pixel[1] > pixel[0] * 3 / 4;
      if (to_sphere + margin < to_cloud) {
        ++red;
        wrong += !is_red;
      }
      else if (to_cloud + margin < to_larger && std::isfinite(to_cloud)) {
        ++grey;
        wrong += !is_grey;
      }
    }
  EXPECT_GT(red, 400);
  EXPECT_GT(grey, 1500);
  EXPECT_LE(wrong, (red + grey) / 100);
}

class ImageSpacePropTest : public uvol_test::DisplayTest,
                           public testing::WithParamInterface<pcl_uvol::WindowBackend> {
protected:
  void
  SetUp() override
  {
    DisplayTest::SetUp();
    if (IsSkipped())
      return;
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);
    place(*renderer_->GetActiveCamera());
    prop_->setBackend(GetParam());
    prop_->setInputCloud(makeCloud());
    renderer_->AddViewProp(prop_);
    watch(*prop_);
  }

  static void
  place(vtkCamera& camera)
  {
    camera.SetPosition(eye.data());
    camera.SetFocalPoint(0.0, 0.0, 0.0);
    camera.SetViewUp(0.0, 1.0, 0.0);
    camera.SetViewAngle(30.0);
  }

  /** Count what a prop complains of. */
  void
  watch(ImageSpaceProp& prop)
  {
    vtkNew<vtkCallbackCommand> counter;
    counter->SetClientData(this);
    counter->SetCallback([](vtkObject*, unsigned long, void* test, void* text) {
      static_cast<ImageSpacePropTest*>(test)->errors_ += static_cast<char*>(text);
      ++static_cast<ImageSpacePropTest*>(test)->error_count_;
    });
    prop.AddObserver(vtkCommand::ErrorEvent, counter);
  }

  Image
  shoot()
  {
    renderer_->ResetCameraClippingRange();
    return screenshot(*window_);
  }

  /** A red sphere of VTK's. */
  void
  addSphere(const Eigen::Vector3d& middle, double r)
  {
    vtkNew<vtkSphereSource> source;
    source->SetCenter(middle.data());
    source->SetRadius(r);
    source->SetThetaResolution(32);
    source->SetPhiResolution(32);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> sphere;
    sphere->SetMapper(mapper);
    sphere->GetProperty()->SetColor(1.0, 0.0, 0.0);
    renderer_->AddActor(sphere);
  }

  /** Pixels that are not the black background. */
  static int
  covered(const Image& image)
  {
    int count = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      count += image.color[4 * i] > 0;
    return count;
  }

  /** What the CPU draws for a camera, on black. */
  Image
  drawOnCpu(const pcl_uvol::Camera& camera,
            const pcl::PCLPointCloud2::Ptr& cloud,
            int scale = 1)
  {
    pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> cpu;
    cpu.setInputCloud(cloud);
    cpu.settings() = prop_->renderer().settings();
    cpu.settings().background.color = {0.0f, 0.0f, 0.0f};
    cpu.setSize(scale * width, scale * height);
    cpu.setCamera(camera);
    Image image;
    cpu.render(image);
    return image;
  }

  static void
  expectSame(const Image& expected, const Image& image)
  {
    ASSERT_EQ(expected.pixels(), image.pixels());
    int seen = 0, different = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      bool is_seen = false, is_same = true;
      for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) {
        is_seen = is_seen || expected.color[k] > 0 || image.color[k] > 0;
        is_same = is_same && std::abs(expected.color[k] - image.color[k]) <= 2;
      }
      seen += is_seen;
      different += !is_same;
    }
    EXPECT_GT(seen, 3000);
    EXPECT_LE(different, seen / 100);
  }

  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<ImageSpaceProp> prop_;
  std::string errors_;
  int error_count_ = 0;
};

TEST_P(ImageSpacePropTest, LooksAsOnTheCpu)
{
  prop_->renderer().settings().silhouettes = true;
  pcl_uvol::Camera camera;
  camera.eye = eye;
  expectSame(drawOnCpu(camera, makeCloud()), shoot());
  // From elsewhere, in another part of the window
  camera = {{-3.0, 1.0, 2.0}, {0.3, 0.0, 0.2}, {0.2, 0.0, 1.0}, 42.0};
  vtkCamera& seen_by = *renderer_->GetActiveCamera();
  seen_by.SetPosition(camera.eye.data());
  seen_by.SetFocalPoint(camera.at.data());
  seen_by.SetViewUp(camera.up.data());
  seen_by.SetViewAngle(camera.vertical_fov);
  window_->SetSize(2 * width, 2 * height);
  renderer_->SetViewport(0.5, 0.0, 1.0, 0.5);
  const Image window = shoot();
  Image part;
  part.width = width;
  part.height = height;
  for (std::size_t row = height; row < 2 * height; ++row)
    part.color.insert(part.color.end(),
                      &window.color[4 * (row * window.width + width)],
                      &window.color[4 * (row * window.width + width)] + 4 * width);
  expectSame(drawOnCpu(camera, makeCloud()), part);
  EXPECT_EQ("", errors_);
}

TEST_P(ImageSpacePropTest, ReportsWhatDraws)
{
  EXPECT_EQ("none", prop_->describeBackend());
  shoot();
  const bool is_by_cpu = GetParam() == pcl_uvol::WindowBackend::Cpu;
  EXPECT_EQ(is_by_cpu, prop_->describeBackend().rfind("cpu (", 0) == 0)
      << prop_->describeBackend();
  // The display of the tests has no graphics card.
  prop_->setBackend(pcl_uvol::WindowBackend::Auto);
  shoot();
  EXPECT_EQ(0u, prop_->describeBackend().rfind("cpu (", 0));
}

TEST_P(ImageSpacePropTest, ParallelProjectionsAreThoseOfVtk)
{
  vtkCamera& seen_by = *renderer_->GetActiveCamera();
  seen_by.ParallelProjectionOn();
  seen_by.SetParallelScale(eye.norm() * std::tan(15.0 * M_PI / 180.0));
  pcl_uvol::Camera camera;
  camera.eye = eye;
  expectSame(drawOnCpu(camera.parallel(), makeCloud()), shoot());
  // Beside the middle of the window, and of the camera's sight
  seen_by.SetWindowCenter(0.2, -0.1);
  seen_by.SetFocalPoint(0.1, -0.3, 0.5);
  const Image cloud = shoot();
  const int seen = covered(cloud);
  addSphere({0.0, 0.0, 0.0}, 0.95);
  const Image before = shoot(); // of the sphere
  EXPECT_TRUE(before.color == cloud.color);
  addSphere({0.0, 0.0, 0.0}, 1.05);
  const Image behind = shoot();
  int grey = 0;
  for (std::size_t i = 0; i < behind.pixels(); ++i)
    grey += behind.color[4 * i + 1] > 0;
  EXPECT_LT(grey, seen / 50);
  EXPECT_NEAR(seen, covered(behind), 0.12 * seen);
  EXPECT_EQ("", errors_);
}

/** A green sphere of half the radius inside a blue one: isovalues 1 and 2. */
pcl::PCLPointCloud2::Ptr
makeShells()
{
  const auto sphere = uvol_test::makeSphere(20000, 3);
  pcl::PointCloud<pcl_uvol::PointIso> shells;
  for (const float part : {0.5f, 1.0f})
    for (const pcl::PointNormal& point : *sphere) {
      pcl_uvol::PointIso shell;
      shell.getVector3fMap() = part * point.getVector3fMap();
      shell.getNormalVector3fMap() = point.getNormalVector3fMap();
      shell.isovalue = 2.0f * part;
      shells.push_back(shell);
    }
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(shells, *cloud);
  return cloud;
}

TEST_P(ImageSpacePropTest, LightPassesIsovalues)
{
  const pcl::PCLPointCloud2::Ptr shells = makeShells();
  pcl_uvol::Camera camera;
  camera.eye = eye;
  for (const std::vector<double>& opacities :
       {std::vector<double>{1.0, 0.4}, std::vector<double>{0.3}}) {
    pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> cpu;
    cpu.setInputCloud(shells);
    cpu.setSize(width, height);
    cpu.setCamera(camera);
    prop_->setInputCloud(shells);
    for (pcl_uvol::ImageSpaceRendererBase* const renderer :
         {static_cast<pcl_uvol::ImageSpaceRendererBase*>(&cpu), &prop_->renderer()}) {
      renderer->setColorField("isovalue");
      renderer->setOpacities(opacities);
    }
    cpu.settings().background.color = {0.0f, 0.0f, 0.0f};
    Image expected;
    cpu.render(expected);
    expectSame(expected, shoot());
  }
  // Too many for the isovalues
  prop_->renderer().setOpacities({1.0, 0.5, 0.2});
  shoot();
  EXPECT_NE(std::string::npos, errors_.find("2 isovalues")) << errors_;
}

TEST_P(ImageSpacePropTest, DragsAreDrawnCoarserByTheCpu)
{
  const bool is_by_cpu = GetParam() == pcl_uvol::WindowBackend::Cpu;
  const Image still = shoot();
  window_->SetDesiredUpdateRate(15.0);
  prop_->setDragTime(INFINITY);
  EXPECT_EQ(still.color, shoot().color);
  prop_->setDragTime(0.0);
  const Image dragged = shoot();
  EXPECT_EQ(is_by_cpu, still.color != dragged.color);
  // The same surface in the same place; its soft border is four times as wide.
  EXPECT_NEAR(covered(still), covered(dragged), 0.2 * covered(still));
  double difference = 0.0;
  for (std::size_t i = 0; i < still.color.size(); ++i)
    difference += std::abs(still.color[i] - dragged.color[i]);
  EXPECT_LT(difference / static_cast<double>(still.color.size()), 7.0);
  // hides and is hidden as before
  addSphere(center, radius);
  expectNearerSphereSeen(shoot(), 30.0);
  window_->SetDesiredUpdateRate(0.001);
  renderer_->RemoveAllViewProps();
  renderer_->AddViewProp(prop_);
  EXPECT_EQ(still.color, shoot().color);
}

TEST_P(ImageSpacePropTest, TheNearerPropIsSeen)
{
  addSphere(center, radius);
  expectNearerSphereSeen(shoot(), 30.0);
  renderer_->RemoveViewProp(prop_); // and in the other order
  renderer_->AddViewProp(prop_);
  // and between two props that VTK draws in the same way, one of them in a corner
  addSphere({-1.2, -0.9, 0.0}, 0.1);
  EXPECT_GT(covered(shoot()), 3000);
  const Image image = shoot();
  expectNearerSphereSeen(image, 30.0);
  int red = 0;
  for (int row = height / 2; row < height; ++row)
    for (int column = 0; column < width / 2; ++column) {
      const auto* const pixel = &image.color[4 * (row * width + column)];
      red += pixel[0] > 40 && pixel[1] == 0;
    }
  EXPECT_NEAR(100, red, 40);
}

TEST_P(ImageSpacePropTest, WorksInPclVisualizer)
{
  pcl::visualization::PCLVisualizer viewer("prop", true);
  viewer.setSize(width, height);
  viewer.setBackgroundColor(0.0, 0.0, 0.0);
  viewer.addSphere(
      pcl::PointXYZ(0.5f, 0.3f, 0.5f), static_cast<float>(radius), 1.0, 0.0, 0.0);
  viewer.getRendererCollection()->GetFirstRenderer()->AddViewProp(prop_);
  // Drawn after the prop, in points of VTK's own size
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  points->push_back({1.0f, -0.8f, 1.0f});
  viewer.addPointCloud<pcl::PointXYZ>(points, "points");
  viewer.setPointCloudRenderingProperties(
      pcl::visualization::PCL_VISUALIZER_POINT_SIZE, 9, "points");
  viewer.setPointCloudRenderingProperties(
      pcl::visualization::PCL_VISUALIZER_COLOR, 0.0, 0.0, 1.0, "points");
  viewer.setCameraPosition(eye[0], eye[1], eye[2], 0, 0, 0, 0, 1, 0);
  viewer.setCameraFieldOfView(30.0 * M_PI / 180.0);
  for (int frame = 0; frame < 2; ++frame) {
    const Image image = screenshot(*viewer.getRenderWindow());
    expectNearerSphereSeen(image, 30.0);
    int blue = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      blue += image.color[4 * i + 2] > 200 && image.color[4 * i] < 50;
    EXPECT_NEAR(81, blue, 20);
  }
  EXPECT_EQ("", errors_);
}

TEST_P(ImageSpacePropTest, FramesItselfWhereverItIs)
{
  const double* const bounds = prop_->GetBounds();
  ASSERT_NE(nullptr, bounds);
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(i % 2 == 0 ? -1.0 : 1.0, bounds[i], 0.01);
  renderer_->ResetCamera();
  const int before = covered(shoot());
  // VTK fits the ball around the box of the unit ball: that one is seen under an angle
  // with the sine sin(15 degrees) / sqrt(3).
  const double in_pixels = 0.5 * height * std::tan(std::asin(0.149429)) / 0.267949;
  EXPECT_NEAR(M_PI * in_pixels * in_pixels, before, 0.06 * before);
  // The same picture from twice as far, of something twice as large
  prop_->SetScale(2.0);
  prop_->SetPosition(10.0, 20.0, 30.0);
  prop_->RotateZ(90.0);
  EXPECT_NEAR(12.0, prop_->GetBounds()[1], 0.02);
  renderer_->ResetCamera();
  EXPECT_NEAR(before, covered(shoot()), 0.01 * before);
  EXPECT_EQ("", errors_);
}

TEST_P(ImageSpacePropTest, WhatItCannotDrawIsReportedOnce)
{
  prop_->SetScale(1.0, 2.0, 1.0);
  EXPECT_EQ(0, covered(shoot()));
  EXPECT_EQ(0, covered(shoot()));
  EXPECT_EQ(1, error_count_);
  EXPECT_NE(std::string::npos, errors_.find("scale")) << errors_;
  prop_->SetScale(1.0);
  prop_->renderer().settings().layer_distance = NAN;
  EXPECT_EQ(0, covered(shoot()));
  EXPECT_EQ(2, error_count_);
  prop_->renderer().settings().layer_distance = 1e-4;
  EXPECT_GT(covered(shoot()), 3000);

  pcl::PCLPointCloud2::Ptr without_points(new pcl::PCLPointCloud2(*makeCloud()));
  without_points->width = without_points->row_step = 0;
  without_points->data.clear();
  pcl::PCLPointCloud2::Ptr without_fields(new pcl::PCLPointCloud2(*makeCloud()));
  without_fields->fields.clear();
  for (const auto& cloud : {without_points, without_fields}) {
    error_count_ = 0;
    prop_->setInputCloud(cloud);
    EXPECT_EQ(nullptr, prop_->GetBounds());
    EXPECT_EQ(0, covered(shoot()));
    EXPECT_EQ(0, covered(shoot()));
    EXPECT_EQ(1, error_count_) << errors_;
  }
  prop_->setInputCloud(nullptr);
  EXPECT_EQ(nullptr, prop_->GetBounds());
  EXPECT_EQ(0, covered(shoot()));
  EXPECT_EQ(1, error_count_);
  prop_->setInputCloud(makeCloud());
  EXPECT_GT(covered(shoot()), 3000);
}

TEST_P(ImageSpacePropTest, SeveralPropsAndWindows)
{
  const int alone = covered(shoot());
  vtkNew<ImageSpaceProp> second;
  second->setInputCloud(makeCloud());
  second->SetPosition(0.0, 0.5, 0.0);
  renderer_->AddViewProp(second);
  EXPECT_GT(covered(shoot()), alone + 500);
  renderer_->RemoveViewProp(second);
  EXPECT_EQ(alone, covered(shoot()));

  vtkNew<vtkRenderWindow> other_window;
  other_window->SetMultiSamples(4);
  other_window->SetSize(2 * width, height);
  vtkNew<vtkRenderer> other_renderer;
  other_renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  other_window->AddRenderer(other_renderer);
  place(*other_renderer->GetActiveCamera());
  other_renderer->AddViewProp(prop_);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_NEAR(alone, covered(screenshot(*other_window)), 0.01 * alone);
    EXPECT_EQ(alone, covered(shoot()));
  }
  EXPECT_EQ("", errors_);
}

TEST_P(ImageSpacePropTest, GoesInAnyOrder)
{
  const int seen = covered(shoot());
  auto* const window = vtkRenderWindow::New();
  auto* const renderer = vtkRenderer::New();
  auto* const prop = ImageSpaceProp::New();
  watch(*prop);
  prop->setInputCloud(makeCloud());
  renderer->AddViewProp(prop);
  place(*renderer->GetActiveCamera());
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  window->Render();
  window->Delete(); // first of all, while the prop has been drawn in it
  renderer->RemoveViewProp(prop);
  renderer->Delete();
  renderer_->AddViewProp(prop); // and lives on in another one
  EXPECT_EQ(seen, covered(shoot()));
  prop->ReleaseGraphicsResources(window_);
  EXPECT_EQ(seen, covered(shoot()));
  renderer_->RemoveViewProp(prop);
  EXPECT_EQ(seen, covered(shoot()));
  prop->Delete();
  window_->Finalize(); // a window that opens again
  EXPECT_EQ(seen, covered(shoot()));
  EXPECT_EQ("", errors_);
}

TEST_P(ImageSpacePropTest, TilesMakeALargerPicture)
{
  renderer_->ResetCameraClippingRange();
  pcl_uvol::Camera camera;
  camera.eye = eye;
  expectSame(drawOnCpu(camera, makeCloud(), 2), screenshot(*window_, 2));
  EXPECT_EQ("", errors_);
}

INSTANTIATE_TEST_SUITE_P(By,
                         ImageSpacePropTest,
                         testing::Values(pcl_uvol::WindowBackend::OpenGl,
                                         pcl_uvol::WindowBackend::Cpu),
                         [](const auto& backend) {
                           return std::string(toWord(backend.param));
                         });

} // namespace test_image_space_prop
