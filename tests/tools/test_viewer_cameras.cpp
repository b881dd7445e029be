// SPDX-License-Identifier: BSD-3-Clause
// Cameras of uvol_viewer: sides, and what the window is filled with.
#include "charts/color_bar.h"
#include "tools/viewer_test.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <vtkPropCollection.h>

#include <algorithm>
#include <string>
#include <utility>

namespace test_viewer_cameras {

using pcl_uvol::Image;
using uvol_test::columnsOf;
using uvol_test::covered;
using uvol_test::height;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::UvolViewer;
using uvol_test::width;

TEST_F(UvolViewer, KeysLookFromSidesAndPrintTheCamera)
{
  OpenWindow open(makeVolume(), "intensity", {});
  const std::pair<char, Eigen::Vector3d> sides[] = {
      {'x', {1, 0, 0}}, {'Y', {0, 1, 0}}, {'y', {0, -1, 0}}, {'z', {0, 0, 1}}};
  for (const auto& [key, from] : sides) {
    open.type(key);
    const Eigen::Vector3d sight = Eigen::Vector3d(open.camera().GetPosition()) -
                                  Eigen::Vector3d(open.camera().GetFocalPoint());
    EXPECT_LT((sight.normalized() - from).norm(), 1e-6) << key;
    EXPECT_GT(covered(open.shoot()), 500) << key;
  }
  testing::internal::CaptureStdout();
  open.type('p');
  const std::string camera = testing::internal::GetCapturedStdout();
  EXPECT_EQ(0u, camera.find("-eye ")) << camera;
  // 30 degrees for 140 of 180 rows, which are above the slider
  EXPECT_NE(std::string::npos, camera.find(" -up 0,1,0 -fov 38.018")) << camera;
}

/** Points of an ellipsoid of half axes of 1, 0.6 and 0.3, and one far from them. */
pcl_uvol::Dataset
makeEllipsoidAndOutlier()
{
  const auto points = uvol_test::makeSphere(6000, 1);
  const Eigen::Vector3f axes(1.0f, 0.6f, 0.3f);
  for (auto& point : *points) {
    point.getVector3fMap() = point.getVector3fMap().cwiseProduct(axes).eval();
    point.getNormalVector3fMap() =
        point.getNormalVector3fMap().cwiseQuotient(axes).normalized().eval();
  }
  points->push_back(points->front());
  points->back().getVector3fMap() = Eigen::Vector3f(40.0f, 30.0f, 20.0f);
  pcl_uvol::Dataset surface;
  pcl::toPCLPointCloud2(*points, surface.cloud);
  return surface;
}

TEST_F(UvolViewer, PointsFillTheWindow)
{
  OpenWindow open(makeEllipsoidAndOutlier(), "", {"-view", "front"});
  const auto expectFull = [&](const std::string& from) {
    const auto [first, last] = columnsOf(open.shoot()); // nine tenths
    EXPECT_NEAR(0.05 * width, first, 2.0) << from;
    EXPECT_NEAR(0.95 * width, last, 2.0) << from;
  };
  expectFull("front");
  for (const char key : std::string("xYzyXZ")) {
    open.type(key);
    expectFull(std::string(1, key));
  }
  for (int i = 0; i < 4; ++i)
    open.window->interactor().InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  EXPECT_EQ(0, columnsOf(open.shoot()).first);
  open.type('r');
  expectFull("r");
  open.type('k'); // half of it is left, and seen from where all was seen
  open.type('r');
  expectFull("k");
  pcl_uvol::Dataset other = makeEllipsoidAndOutlier();
  other.origin = {{500.0, 0.0, 0.0}};
  pcl_uvol::saveDataset("other.ply", other);
  open.drop({"other.ply"});
  expectFull("drop");
}

/** A box of pixels that differ in two pictures. */
struct ChangedPixels {
  int left = width, right = -1, top = height, bottom = -1;

  ChangedPixels(const Image& a, const Image& b)
  {
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const auto first = 4 * static_cast<std::size_t>(row * width + column);
        if (std::equal(&a.color[first], &a.color[first] + 3, &b.color[first]))
          continue;
        left = std::min(left, column);
        right = std::max(right, column);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
  }
};

/** The pixels that a window shows its surface in. */
ChangedPixels
findSurface(OpenWindow& open)
{
  const Image shown = open.shoot();
  vtkPropCollection& props = *open.renderer().GetViewProps();
  vtkProp& surface = *vtkProp::SafeDownCast(props.GetItemAsObject(0));
  surface.VisibilityOff();
  const Image without = open.shoot();
  surface.VisibilityOn();
  return {shown, without};
}

constexpr double free_height = 0.78 * height; // above the slider

/** The surface fills the part of the window left of the bar and above the slider. */
void
expectFitted(OpenWindow& open, double free_width, const std::string& from)
{
  const ChangedPixels seen = findSurface(open);
  EXPECT_GE(seen.left, 0) << from;
  EXPECT_LE(seen.right, free_width) << from;
  EXPECT_LE(seen.bottom, free_height) << from;
  EXPECT_NEAR(0.5 * free_width, 0.5 * (seen.left + seen.right), 3.0) << from;
  EXPECT_NEAR(0.5 * free_height, 0.5 * (seen.top + seen.bottom), 3.0) << from;
  EXPECT_NEAR(0.9,
              std::max((seen.right - seen.left) / free_width,
                       (seen.bottom - seen.top) / free_height),
              0.05)
      << from;
}

const double beside_bar = width - uvol_tools::colorBarWidth(width, height);

TEST_F(UvolViewer, SurfacesLieBesideTheBarAndAboveTheSlider)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front", "-color", "x"});
  expectFitted(open, beside_bar, "front");
  for (const char key : std::string("xzr")) {
    open.type(key);
    expectFitted(open, beside_bar, std::string(1, key));
  }
}

TEST_F(UvolViewer, SurfacesMakeRoomForABarThatComesAndTakeThatOfOneThatGoes)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front", "-color", "none"});
  expectFitted(open, width, "one colour");
  open.type('c');
  expectFitted(open, beside_bar, "a bar");
  open.type('c');
  expectFitted(open, beside_bar, "another bar");
  OpenWindow other(makeVolume(), "intensity", {"-view", "front", "-color", "x"});
  other.type('c');
  expectFitted(other, width, "no bar");
}

TEST_F(UvolViewer, ABarLeavesACameraThatIsPlacedWhereItIs)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "none", "-eye", "0.5,-9,0"});
  const auto expectPlaced = [&](double free_width, const std::string& how) {
    const ChangedPixels seen = findSurface(open);
    EXPECT_EQ(Eigen::Vector3d(0.5, -9.0, 0.0),
              Eigen::Vector3d(open.camera().GetPosition()))
        << how;
    EXPECT_NEAR(0.5 * free_width, 0.5 * (seen.left + seen.right), 4.0) << how;
  };
  expectPlaced(width, "one colour");
  open.type('c');
  expectPlaced(beside_bar, "a bar");
}

} // namespace test_viewer_cameras
