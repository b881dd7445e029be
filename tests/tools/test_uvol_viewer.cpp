// SPDX-License-Identifier: BSD-3-Clause
// uvol_viewer from the outside, and its window moved by events of mouse and keys.
#include "charts/color_bar.h"
#include "support/environment.h"
#include "support/png.h"
#include "support/surfaces.h"
#include "support/virtual_display.h"
#include "viewer/keys.h"
#include "viewer/opacity_choice.h"
#include "viewer/point_picking.h"
#include "viewer/viewer_window.h"
#include <pcl_uvol/common/point_types.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <thread>

namespace {

using pcl_uvol::Image;
using uvol_test::runCommand;

constexpr int width = 240, height = 180;

/** Random samples of an ellipsoid's function: 1 on half axes of 1, 1/2 and 1/3. */
pcl_uvol::Dataset
makeVolume()
{
  pcl::PointCloud<pcl::PointXYZI> points;
  uvol_test::Random random(7);
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
class UvolViewer : public uvol_test::DisplayTest {
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
    Image image = uvol_test::readPng(path, channels);
    EXPECT_EQ(static_cast<std::uint32_t>(width), image.width) << path;
    EXPECT_EQ(static_cast<std::uint32_t>(height), image.height) << path;
    return image;
  }

  uvol_test::TemporaryFolder folder_;
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
    return uvol_test::readPng("shot.png", channels);
  }

  bool waits = true; // for the surface that events ask for
  uvol_tools::ShownSurface surface;
  uvol_tools::RenderOptions look;
  uvol_tools::Options options{"uvol_viewer", "", ""};
  std::unique_ptr<uvol_tools::ViewerWindow> window;
};

/** Pixels of a grey surface in the upper three quarters, where no slider is. */
int
covered(const Image& image)
{
  int count = 0;
  for (std::size_t i = 0; i < image.pixels() * 3 / 4; ++i)
    count += image.color[4 * i] < 240;
  return count;
}

// The first test: VTK's loop also serves earlier interactors that are gone.
TEST_F(UvolViewer, TheLoopShowsNewSurfacesUntilAKeyEndsIt)
{
  OpenWindow open(makeVolume(), "intensity", {});
  open.waits = false;
  open.slide(0.8);
  EXPECT_NEAR(0.8, open.surface.getIsoValue(), 0.05);
  const double center = open.camera().GetFocalPoint()[0];
  open.drag(120, 100, 160, 100); // the window goes on
  EXPECT_NE(center, open.camera().GetPosition()[0]);
  struct Watch {
    OpenWindow& open;
    pcl::PCLPointCloud2::ConstPtr before;
    int looks;
  } watch{open, open.surface.getCloud(), 0};
  EXPECT_TRUE(open.surface.isBusy());
  vtkNew<vtkCallbackCommand> look;
  look->SetClientData(&watch);
  look->SetCallback([](vtkObject*, unsigned long, void* data, void*) {
    Watch& w = *static_cast<Watch*>(data);
    if (++w.looks <= 3) { // one surface is ready, and the next one asked for
      w.open.type('+');
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      w.open.type('+');
    }
    else if (!w.open.surface.isBusy() || w.looks == 400)
      w.open.type('q');
  });
  const unsigned long looks =
      open.window->interactor().AddObserver(vtkCommand::TimerEvent, look);
  open.window->interactor().CreateRepeatingTimer(50);
  open.window->run();
  open.window->interactor().RemoveObserver(looks);
  EXPECT_TRUE(open.window->interactor().GetDone());
  EXPECT_FALSE(open.surface.isBusy());
  EXPECT_GT(open.surface.getCloud()->width, watch.before->width);
  EXPECT_GT(open.surface.getIsoValue(), 0.85);

  // The last one is drawn as if there had been no others before it.
  OpenWindow other(makeVolume(), "intensity", {});
  other.surface.setIsoValue(open.surface.getIsoValue());
  other.window->finish();
  open.type('y');
  other.type('y');
  const Image last = open.shoot(), same = other.shoot();
  const auto above_slider = static_cast<std::ptrdiff_t>(last.color.size() * 3 / 4);
  EXPECT_TRUE(std::equal(
      last.color.begin(), last.color.begin() + above_slider, same.color.begin()));
  open.slide(0.4); // goes with the window
}

TEST_F(UvolViewer, MouseAndSliderMoveCameraAndIsovalue)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const Image first = open.shoot();
  EXPECT_GT(covered(first), 1500);

  // Turned, the ellipsoid shows its other axes: less of it is seen from its tip.
  const Eigen::Vector3d eye(open.camera().GetPosition());
  open.drag(120, 100, 200, 100);
  const Image turned = open.shoot();
  EXPECT_GT((Eigen::Vector3d(open.camera().GetPosition()) - eye).norm(), 0.3);
  EXPECT_LT(covered(turned), covered(first) * 8 / 10);
  EXPECT_EQ(0.5, open.surface.getIsoValue());

  // The slider changes the isovalue and leaves the camera where it is.
  const Eigen::Vector3d turned_eye(open.camera().GetPosition());
  open.slide(0.8);
  EXPECT_NEAR(0.8, open.surface.getIsoValue(), 0.05);
  EXPECT_EQ(turned_eye, Eigen::Vector3d(open.camera().GetPosition()));
  const double growth = static_cast<double>(covered(open.shoot())) / covered(turned);
  EXPECT_GT(growth, 1.8); // (0.8 / 0.5)^2 and perspective, but for what is cut off
  open.type('-');
  EXPECT_LT(open.surface.getIsoValue(), 0.8);

  // Back again, to a pixel of the slider: about the same picture
  open.camera().SetPosition(eye.data());
  open.camera().SetViewUp(0.0, 0.0, 1.0);
  open.slide(0.5);
  EXPECT_NEAR(covered(first), covered(open.shoot()), 0.2 * covered(first));

  // The wheel comes nearer, r shows the whole again.
  const double before = open.camera().GetDistance();
  for (int i = 0; i < 4; ++i)
    open.window->interactor().InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  EXPECT_LT(open.camera().GetDistance(), 0.8 * before);
  open.type('r');
  EXPECT_GT(open.camera().GetDistance(), 0.9 * before);
}

TEST_F(UvolViewer, IsovaluesWithoutPointsShowNothing)
{
  OpenWindow open(makeVolume(), "intensity", {});
  open.slide(open.surface.getRange()[1]);
  open.type('+'); // beyond the range
  EXPECT_EQ(open.surface.getRange()[1], open.surface.getIsoValue());
  EXPECT_LT(covered(open.shoot()), 200);
  open.slide(0.5);
  EXPECT_GT(covered(open.shoot()), 1500);
}

TEST_F(UvolViewer, KeysSwitchPasses)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  OpenWindow open(sphere, "", {"-feature-threshold", "0.0001"});
  const Image first = open.shoot();
  for (const char key : std::string("1234567")) {
    open.type(key);
    EXPECT_TRUE(open.shoot().color != first.color) << key;
    open.type(key);
    EXPECT_TRUE(open.shoot().color == first.color) << key;
  }
  open.type('7');
  const Image without_footprints = open.shoot();
  open.type('8'); // and now there are holes
  EXPECT_LT(covered(open.shoot()), covered(without_footprints) * 9 / 10);
  open.type('9'); // the far side is seen through them
  EXPECT_GT(covered(open.shoot()), 1000);
  open.type('x');
  open.type('+');
}

TEST_F(UvolViewer, MShowsAMeshAndThePointsAgain)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "mean_curvature"});
  const Image points = open.shoot();
  open.type('m');
  EXPECT_GT(open.surface.getTriangles().size(), 1000u);
  const Image mesh = open.shoot();
  EXPECT_NEAR(covered(points), covered(mesh), 0.1 * covered(points));
  EXPECT_TRUE(points.color != mesh.color);
  open.type('c'); // one colour
  EXPECT_TRUE(mesh.color != open.shoot().color);
  const std::size_t triangles = open.surface.getTriangles().size();
  open.slide(0.3);
  EXPECT_LT(open.surface.getTriangles().size(), triangles / 2);
  open.type('m');
  EXPECT_TRUE(open.surface.getTriangles().empty());

  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  OpenWindow of_points(sphere, "", {});
  of_points.type('m'); // tells that there are no samples
  EXPECT_FALSE(of_points.surface.isMeshed());
}

TEST_F(UvolViewer, KeysForColorsHelpAndPictures)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "mean_curvature"});
  const Image colored = open.shoot();
  open.type('c');
  const Image plain = open.shoot();
  EXPECT_TRUE(plain.color != colored.color);
  open.type('c');
  EXPECT_TRUE(plain.color != open.shoot().color);
  open.type('h');
  EXPECT_TRUE(plain.color != open.shoot().color);
  open.type('s');
  open.type('s');
  EXPECT_EQ(3u, folder_.list().size());
  const Image drawn = read("uvol_viewer_2.png");
  open.type('S');
  const Image traced = read("uvol_viewer_3.png");
  EXPECT_TRUE(traced.color != drawn.color); // there are shadows
  EXPECT_NEAR(covered(drawn), covered(traced), 0.03 * covered(drawn));
}

TEST_F(UvolViewer, PointsAreFoundUnderTheMouse)
{
  // So small that a point of the front is at hand everywhere.
  OpenWindow open(makeVolume(), "intensity", {"-view", "front", "-zoom", "0.6"});
  open.shoot();
  const pcl::PCLPointCloud2& cloud = *open.surface.getCloud();
  const auto find = [&](double column, double row) {
    return uvol_tools::findPointAt(cloud, open.renderer(), column, row);
  };
  // From the front the ellipsoid's half axis of a quarter points to the eye.
  const int row = height * 61 / 100; // of the middle of what is free above the slider
  const auto middle = find(0.5 * width, row);
  ASSERT_TRUE(middle);
  const float* const p = pcl_uvol::viewOf(cloud).xyz(*middle);
  EXPECT_NEAR(0.0, p[0], 0.06);
  EXPECT_NEAR(-0.25, p[1], 0.02);
  EXPECT_NEAR(0.0, p[2], 0.06);
  EXPECT_FALSE(find(2.0, height - 2.0));

  const std::string text = uvol_tools::describePoint(cloud, {{1e6, 0.0, 0.0}}, *middle);
  EXPECT_EQ(0u, text.find(p[0] < 0.0f ? "x 999999.9" : "x 1000000")) << text;
  EXPECT_NE(std::string::npos, text.find("\nintensity 0.5")) << text;

  open.click(width / 2, row);
  const Image told = open.shoot();
  open.click(2, height - 2);
  EXPECT_TRUE(told.color != open.shoot().color);
  open.pointAt(width / 2, row);
  open.type('f');
  const Eigen::Vector3d center(open.camera().GetFocalPoint());
  EXPECT_EQ(Eigen::Vector3d(p[0], p[1], p[2]), center);
  open.pointAt(2, height - 2);
  open.type('f'); // no point is there
  EXPECT_EQ(center, Eigen::Vector3d(open.camera().GetFocalPoint()));
}

TEST_F(UvolViewer, AKeyCutsAwayWhatLiesInFront)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const std::size_t whole = open.surface.getCloud()->width;
  const double depth = open.camera().GetFocalPoint()[1];
  open.type('k');
  const auto checkCut = [&] {
    const pcl_uvol::CloudView cut = pcl_uvol::viewOf(*open.surface.getCloud());
    for (std::size_t i = 0; i < cut.count; ++i)
      EXPECT_GE(static_cast<double>(cut.xyz(i)[1]), depth - 1e-6);
  };
  checkCut();
  EXPECT_NEAR(0.5, static_cast<double>(open.surface.getCloud()->width) / whole, 0.05);
  open.type('+'); // stays cut
  checkCut();
  open.type('-');
  open.type('m'); // a mesh has all of its vertices
  EXPECT_GT(open.surface.getTriangles().size(), 1000u);
  for (const pcl_uvol::Triangle& triangle : open.surface.getTriangles())
    for (const std::uint32_t vertex : triangle)
      ASSERT_LT(vertex, open.surface.getCloud()->width);
  EXPECT_GT(covered(open.shoot()), 1500);
  open.type('m'); // points are cut again
  checkCut();
  open.type('k');
  EXPECT_EQ(whole, open.surface.getCloud()->width);
}

TEST_F(UvolViewer, IsovaluesAreTyped)
{
  OpenWindow open(makeVolume(), "intensity", {});
  const auto typeAll = [&](const std::string& keys) {
    for (const char key : keys)
      open.type(key);
    return open.surface.getIsoValue();
  };
  EXPECT_EQ(0.4, typeAll("=0.45\b\r"));
  EXPECT_EQ(0.3, typeAll("=x3e-1\r"));
  EXPECT_EQ(0.3, typeAll("=0.\x1b")); // given up
  EXPECT_EQ(0.3, typeAll("=1e\r"));   // no number
  EXPECT_EQ(0.3, typeAll("=99\r"));   // beyond the range
  EXPECT_EQ(0.3, typeAll("=\r"));
  const Image before = open.shoot();
  open.type('4'); // is a pass again
  EXPECT_TRUE(before.color != open.shoot().color);
}

TEST_F(UvolViewer, FilesAreDroppedOnIt)
{
  pcl_uvol::Dataset volume = makeVolume();
  pcl_uvol::saveDataset("same.ply", volume);
  const pcl_uvol::CloudView points = pcl_uvol::viewOf(volume.cloud);
  const auto field = std::find_if(volume.cloud.fields.begin(),
                                  volume.cloud.fields.end(),
                                  [](const auto& f) { return f.name == "intensity"; });
  for (std::size_t i = 0; i < points.count; ++i) {
    float value;
    std::uint8_t* const place =
        &volume.cloud.data[i * volume.cloud.point_step + field->offset];
    std::memcpy(&value, place, sizeof(value));
    value = 1000.0f * value + 1000.0f;
    std::memcpy(place, &value, sizeof(value));
  }
  pcl_uvol::saveDataset("other.ply", volume);
  uvol_test::writeFile("equal.csv", "x,y,z,intensity\n0,0,0,1\n1,0,0,1\n");
  uvol_test::writeFile("none.csv", "x,y,z\n0,0,0\n1,0,0\n");

  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const std::size_t width_at_half = open.surface.getCloud()->width;
  open.type('i');
  open.slide(0.7);
  const auto isovalues = open.surface.getIsoValues();
  const auto before = open.surface.getCloud();
  open.drop({});
  for (const char* const bad : {"gone.ply", "equal.csv", "none.csv"}) {
    open.drop({bad, "same.ply"});
    EXPECT_EQ(before, open.surface.getCloud()) << bad;
    EXPECT_EQ(isovalues, open.surface.getIsoValues()) << bad;
    EXPECT_EQ("uvol_viewer in (h: keys)", open.title());
  }
  open.type('k'); // cuts the old surface
  open.drop({"same.ply"});
  EXPECT_EQ("uvol_viewer same.ply (h: keys)", open.title());
  EXPECT_EQ(isovalues, open.surface.getIsoValues());
  EXPECT_EQ(before->width, open.surface.getCloud()->width);

  open.drop({"other.ply", "same.ply"});
  EXPECT_EQ("uvol_viewer other.ply (h: keys)", open.title());
  ASSERT_EQ(1u, open.surface.getIsoValues().size());
  EXPECT_NEAR(1000.0, open.surface.getRange()[0], 50.0);
  open.slide(1500.0); // by the new range
  EXPECT_NEAR(1500.0, open.surface.getIsoValue(), 40.0);
  EXPECT_NEAR(width_at_half,
              open.surface.getCloud()->width,
              0.1 * static_cast<double>(width_at_half));
  EXPECT_GT(covered(open.shoot()), 1500);
}

TEST_F(UvolViewer, DroppedPointsThatCannotBeDrawnLeaveTheOldOnes)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  uvol_test::writeFile("nowhere.csv", "x,y,z\n,,\n,,\n");
  OpenWindow open(sphere, "", {});
  sphere.origin = {{100.0, 0.0, 0.0}};
  pcl_uvol::saveDataset("far.ply", sphere);
  const Image before = open.shoot();
  open.drop({"nowhere.csv"});
  EXPECT_EQ("uvol_viewer in (h: keys)", open.title());
  EXPECT_NEAR(covered(before), covered(open.shoot()), 0.01 * covered(before));
  open.drop({"far.ply"});
  EXPECT_EQ("uvol_viewer far.ply (h: keys)", open.title());
  EXPECT_GT(covered(open.shoot()), 1000);
}

std::vector<double>
isovaluesOf(const pcl::PCLPointCloud2& cloud)
{
  return pcl_uvol::listCategories(pcl_uvol::viewOf(cloud), "isovalue", 20);
}

/** Pixels that are no shade of grey. */
int
countColored(const Image& image)
{
  int count = 0;
  for (std::size_t i = 0; i < image.pixels() * 3 / 4; ++i)
    count += std::abs(image.color[4 * i] - image.color[4 * i + 2]) > 40;
  return count;
}

TEST_F(UvolViewer, IsovaluesAreKeptColoredAndLetLightThrough)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front"});
  const int colored = countColored(open.shoot()); // of the triad
  open.type('i');
  open.type('i'); // once is enough
  EXPECT_EQ((std::vector<double>{0.5, 0.5}), open.surface.getIsoValues());
  EXPECT_EQ(1u, isovaluesOf(*open.surface.getCloud()).size());
  open.slide(0.3);
  ASSERT_EQ(2u, open.surface.getIsoValues().size());
  EXPECT_EQ(0.5, open.surface.getIsoValues()[0]);
  EXPECT_EQ(2u, isovaluesOf(*open.surface.getCloud()).size());
  const Image outer = open.shoot();
  EXPECT_GT(countColored(outer), colored + 1000);
  open.type('o');
  const Image clear = open.shoot();
  EXPECT_TRUE(clear.color != outer.color);
  EXPECT_NEAR(covered(outer), covered(clear), 0.05 * covered(outer));
  open.type('s');
  EXPECT_GT(countColored(read("uvol_viewer_1.png")), 1000);
  open.type('o');
  EXPECT_TRUE(clear.color != open.shoot().color);
  open.slide(open.surface.getRange()[0]); // which has no points: one is left
  EXPECT_EQ(1u, isovaluesOf(*open.surface.getCloud()).size());
  EXPECT_GT(covered(open.shoot()), 1500);
  open.slide(0.3);
  open.type('o'); // all are opaque
  EXPECT_GT(countColored(open.shoot()), colored + 1000);
  open.type('c'); // one colour
  EXPECT_EQ(colored, countColored(open.shoot()));
  open.type('m');
  EXPECT_GT(open.surface.getTriangles().size(), 1000u);
  open.type('I');
  EXPECT_EQ(1u, open.surface.getIsoValues().size());
  EXPECT_NEAR(0.3, open.surface.getIsoValue(), 0.05);
  EXPECT_EQ(1u, isovaluesOf(*open.surface.getCloud()).size());
}

/** Cubes around the origin, a corner in each octant.
 * \param sides half of those of each cube, by isovalue */
pcl::PCLPointCloud2
makeCubes(const std::vector<std::pair<float, float>>& sides)
{
  pcl::PointCloud<pcl_uvol::PointIso> points;
  for (const auto& [isovalue, side] : sides)
    for (int corner = 0; corner < 8; ++corner) {
      pcl_uvol::PointIso point;
      for (int axis = 0; axis < 3; ++axis)
        point.data[axis] = (corner >> axis & 1) != 0 ? side : -side;
      point.isovalue = isovalue;
      points.push_back(point);
    }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  return cloud;
}

TEST(OpacityChoice, FollowsTheIsovaluesThatHavePoints)
{
  using Opacities = std::vector<double>;
  const auto three = makeCubes({{0.1f, 3.0f}, {0.2f, 1.0f}, {0.4f, 2.0f}});
  const auto two = makeCubes({{0.1f, 3.0f}, {0.4f, 2.0f}});
  pcl::PCLPointCloud2 plain;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(10, 1), plain);

  uvol_tools::OpacityChoice opaque({});
  EXPECT_EQ(Opacities(), opaque.find(three, {}));
  EXPECT_EQ(0.6, opaque.next());
  EXPECT_EQ((Opacities{0.6, 1.0, 0.6}), opaque.find(three, {}));
  EXPECT_EQ((Opacities{0.6, 1.0}), opaque.find(two, {0.1, 0.2, 0.4}));
  EXPECT_EQ(Opacities(), opaque.find(plain, {}));
  EXPECT_EQ(0.3, opaque.next());
  EXPECT_EQ((Opacities{0.3, 1.0, 0.3}), opaque.find(three, {}));
  EXPECT_EQ(1.0, opaque.next());
  EXPECT_EQ(Opacities(), opaque.find(three, {}));

  uvol_tools::OpacityChoice given({0.5, 0.25});
  EXPECT_EQ((Opacities{0.5, 0.25, 0.25}), given.find(three, {}));
  EXPECT_EQ((Opacities{0.5, 0.25}), given.find(two, {}));
  // The lowest of those that were asked for has no points.
  EXPECT_EQ((Opacities{0.25, 0.25}), given.find(two, {0.4, 0.1, 0.05, 0.4}));
  EXPECT_EQ((Opacities{0.5}), given.find(plain, {}));
  EXPECT_EQ(1.0, given.next());
  EXPECT_EQ(0.6, given.next());
  EXPECT_EQ(0.3, given.next());
  EXPECT_GT(0.0, given.next());
  EXPECT_EQ((Opacities{0.5, 0.25, 0.25}), given.find(three, {}));
}

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

/** First and last column that a surface covers in the middle rows. */
std::pair<int, int>
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

TEST_F(UvolViewer, SurfacesLieBesideTheBarAndAboveTheSlider)
{
  // In so small a window the bar takes less than in a picture.
  const double free_width = width - uvol_tools::colorBarWidth(width, height),
               free_height = 0.78 * height;
  OpenWindow open(makeVolume(), "intensity", {"-view", "front", "-color", "x"});
  const auto find = [&] {
    const Image shown = open.shoot();
    vtkPropCollection& props = *open.renderer().GetViewProps();
    vtkProp& surface = *vtkProp::SafeDownCast(props.GetItemAsObject(0));
    surface.VisibilityOff();
    const Image without = open.shoot();
    surface.VisibilityOn();
    return ChangedPixels(shown, without);
  };
  const auto expectFitted = [&](const std::string& from) {
    const ChangedPixels seen = find();
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
  };
  expectFitted("front");
  for (const char key : std::string("xzr")) {
    open.type(key);
    expectFitted(std::string(1, key));
  }
  // The picture that is saved has the bar beside the surface as well, and no slider.
  open.type('s');
  const Image saved = read("uvol_viewer_1.png");
  int last = -1;
  for (int column = 0; column < static_cast<int>(free_width); ++column)
    if (saved.color[4 * static_cast<std::size_t>(height / 2 * width + column)] < 240)
      last = column;
  EXPECT_GT(last, width / 2);
  EXPECT_LT(last, free_width - 2.0);
}

/** Length in pixels of the dark line in the lower right corner. */
int
barLength(const Image& image)
{
  int length = 0;
  const auto row = static_cast<std::size_t>(height - 18);
  for (int column = 3 * width / 4; column < width; ++column)
    length += image.color[4 * (row * width + static_cast<std::size_t>(column))] < 100;
  return length;
}

TEST_F(UvolViewer, ABarTellsLengths)
{
  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  OpenWindow open(sphere, "", {"-eye", "0,-10,0", "-at", "0,0,0"});
  // 33.6 pixels per unit: 1, and not 2, is no longer than 48 pixels.
  constexpr double tangent = 0.267949; // of 15 degrees
  EXPECT_NEAR(0.5 * height / (10.0 * tangent), barLength(open.shoot()), 3.0);
  open.camera().SetPosition(0.0, -16.0, 0.0); // 2
  EXPECT_NEAR(2 * 0.5 * height / (16.0 * tangent), barLength(open.shoot()), 3.0);

  OpenWindow equally(sphere, "", {"-view", "front"}, {2.0, 2.0, 2.0});
  equally.camera().SetPosition(0.0, -20.0, 0.0); // sees it as large
  EXPECT_NEAR(0.5 * height / (10.0 * tangent), barLength(equally.shoot()), 3.0);
  OpenWindow unequally(sphere, "", {}, {1.0, 1.0, 2.0});
  EXPECT_EQ(0, barLength(unequally.shoot()));
}

TEST_F(UvolViewer, StretchesWhatItShowsAndNotTheData)
{
  pcl_uvol::Dataset volume = makeVolume();
  volume.origin = {{100.0, 0.0, 1000.0}};
  OpenWindow open(volume, "intensity", {"-view", "front"}, {1.0, 1.0, 3.0});
  // As high as it is wide
  const float* const shown = pcl_uvol::viewOf(*open.surface.getCloud()).xyz(7);
  const float* const data = pcl_uvol::viewOf(*open.surface.getData()).xyz(7);
  EXPECT_EQ(data[0], shown[0]);
  EXPECT_EQ(data[1], shown[1]);
  EXPECT_EQ(3.0f * data[2], shown[2]);
  const auto radius = open.surface.getBounds().radius;
  EXPECT_NEAR(0.5, radius, 0.02);

  open.type('e');
  const pcl_uvol::Dataset saved = pcl_uvol::loadDataset("uvol_viewer_1.ply");
  ASSERT_EQ(open.surface.getData()->width, saved.cloud.width);
  const float* const first = pcl_uvol::viewOf(saved.cloud).xyz(7);
  EXPECT_NEAR(data[2] + 1000.0, first[2] + saved.origin[2], 1e-3);
  // The options that are printed give the same view.
  testing::internal::CaptureStdout();
  open.type('p');
  std::istringstream camera(testing::internal::GetCapturedStdout());
  std::string option, eye;
  camera >> option >> eye;
  OpenWindow again(volume,
                   "intensity",
                   {"-exaggerate", "1,1,3", "-eye", eye.c_str(), "-at", "100,0,1000"},
                   {1.0, 1.0, 3.0});
  const Eigen::Vector3d place(open.camera().GetPosition());
  EXPECT_LT((Eigen::Vector3d(again.camera().GetPosition()) - place).norm(), 1e-3);

  open.type('k'); // at the centre, of what is shown
  open.type('z');
  open.type('k');
  open.type('k');
  const pcl_uvol::CloudView cut = pcl_uvol::viewOf(*open.surface.getCloud());
  EXPECT_EQ(cut.count, pcl_uvol::viewOf(*open.surface.getData()).count);
  for (std::size_t i = 0; i < cut.count; ++i)
    EXPECT_LT(cut.xyz(i)[2], 0.1f);
  EXPECT_GT(cut.count, 100u);

  pcl_uvol::saveDataset("volume.ply", volume);
  const std::string look = " -exaggerate 1,1,3 -view front -size 240x180 ";
  auto result =
      runCommand("uvol_viewer volume.ply -field intensity -iso 0.5 -screenshot "
                 "shown.png" +
                 look);
  ASSERT_EQ(0, result.exit_code) << result.err;
  result = runCommand("uvol_isosurface volume.ply half.ply -field intensity -iso 0.5 "
                      "-png drawn.png" +
                      look);
  ASSERT_EQ(0, result.exit_code) << result.err;
  const auto [left, right] = columnsOf(read("drawn.png"));
  const auto [shown_left, shown_right] = columnsOf(read("shown.png"));
  EXPECT_NEAR(left + right, shown_left + shown_right, 2);
  // As large as it fits above the slider
  EXPECT_NEAR(0.78 * (right - left), shown_right - shown_left, 2);
}

TEST_F(UvolViewer, KeysSaveASurfaceAndAPictureThatRenderDrawsAgain)
{
  OpenWindow open(makeVolume(), "intensity", {"-color", "none"});
  open.type('e');
  const pcl_uvol::Dataset saved = pcl_uvol::loadDataset("uvol_viewer_1.ply");
  EXPECT_EQ(open.surface.getCloud()->width, saved.cloud.width);
  open.type('h'); // letters of the window are not in the picture
  open.type('s');
  testing::internal::CaptureStdout();
  open.type('p');
  std::string camera = testing::internal::GetCapturedStdout();
  camera.pop_back(); // the end of the line
  const std::string command =
      "uvol_render uvol_viewer_1.ply same.png -color none -size " +
      std::to_string(width) + "x" + std::to_string(height) + " " + camera;
  const auto result = runCommand(command);
  ASSERT_EQ(0, result.exit_code) << command << ": " << result.err;
  const Image first = read("uvol_viewer_1.png"), same = read("same.png");
  ASSERT_EQ(first.color.size(), same.color.size());
  int different = 0;
  for (std::size_t i = 0; i < first.color.size(); ++i)
    different += std::abs(first.color[i] - same.color[i]) > 2;
  EXPECT_LT(different, static_cast<int>(first.color.size()) / 200);
}

TEST_F(UvolViewer, TheToolSavesWhatItShows)
{
  pcl_uvol::saveDataset("volume.ply", makeVolume());
  const std::string options = " -size 240x180 -view front -screenshot ";
  auto result = runCommand("uvol_viewer volume.ply -field intensity -iso 0.5" +
                           options + "half.png");
  ASSERT_EQ(0, result.exit_code) << result.err;
  EXPECT_EQ("", result.err);
  EXPECT_NE(std::string::npos, result.out.find("isopoints")) << result.out;
  result = runCommand("uvol_viewer volume.ply -field intensity -json" + options +
                      "middle.png");
  ASSERT_EQ(0, result.exit_code) << result.err;
  EXPECT_EQ('{', result.out.front());
  EXPECT_GT(covered(read("half.png")), 1500);
  EXPECT_TRUE(read("middle.png").color != read("half.png").color);

  // Several isovalues, as uvol_render draws them
  const std::string look =
      " -opacity 1,0.4 -background white -no-bar -eye 0,-3,0 -size 240x180";
  result = runCommand("uvol_viewer volume.ply -field intensity -iso 0.3,0.6 "
                      "-screenshot two.png" +
                      look);
  ASSERT_EQ(0, result.exit_code) << result.err;
  ASSERT_EQ(0,
            runCommand("uvol_isosurface volume.ply two.ply -field intensity -iso "
                       "0.3,0.6 && uvol_render two.ply same.png" +
                       look)
                .exit_code);
  const int colored = countColored(read("same.png"));
  EXPECT_GT(colored, 1000);
  EXPECT_NEAR(colored, countColored(read("two.png")), 0.1 * colored);

  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  pcl_uvol::saveDataset("sphere.ply", sphere);
  result =
      runCommand("uvol_viewer sphere.ply -background black" + options + "sphere.png");
  EXPECT_EQ(0, result.exit_code) << result.err;
  // As uvol_render draws it
  ASSERT_EQ(0,
            runCommand("uvol_render sphere.ply same.png -background black -view front "
                       "-size 240x180")
                .exit_code);
  const Image drawn = read("same.png");
  const auto expectSame = [&](const Image& shown) {
    int different = 0;
    for (std::size_t i = 0; i < shown.color.size(); ++i)
      different += std::abs(shown.color[i] - drawn.color[i]) > 8;
    EXPECT_LT(different, static_cast<int>(shown.color.size()) / 50);
  };
  EXPECT_NE(std::string::npos, result.out.find("backend: cpu (")) << result.out;
  expectSame(read("sphere.png"));
  result = runCommand("uvol_viewer sphere.ply -background black -backend gl" + options +
                      "gl.png");
  EXPECT_EQ(0, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.out.find("backend: vtk")) << result.out;
  expectSame(read("gl.png"));
}

TEST_F(UvolViewer, WrongUseIsOneSentence)
{
  pcl_uvol::saveDataset("volume.ply", makeVolume());
  uvol_test::writeFile("empty.csv", "x,y,z,f\n");
  uvol_test::writeFile("equal.csv", "x,y,z,f\n0,0,0,1\n1,0,0,1\n");
  const std::tuple<const char*, int, const char*> cases[] = {
      {"volume.ply -iso 1", 2, "-field"},
      {"volume.ply -wrong", 2, "-wrong"},
      {"volume.ply -background transparent", 2, "transparent"},
      {"volume.ply -supersample 2", 2, "-supersample"},
      {"volume.ply -screenshot out.jpg", 1, ".png"},
      {"volume.ply -field none", 1, "intensity"},
      {"volume.ply -field intensity -iso 1e9", 1, "range"},
      {"volume.ply -color none_such", 1, "none_such"},
      {"equal.csv -field f", 1, "equal"},
      {"empty.csv", 1, "no points"},
      {"gone.ply", 1, "gone.ply"}};
  for (const auto& [arguments, exit_code, text] : cases) {
    const auto result = runCommand(std::string("uvol_viewer ") + arguments);
    EXPECT_EQ(exit_code, result.exit_code) << arguments;
    EXPECT_NE(std::string::npos, result.err.find(text)) << result.err;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  }
}

void
expectAdvice(const std::string& environment)
{
  const auto result = runCommand(environment + " uvol_viewer in.ply");
  EXPECT_EQ(1, result.exit_code);
  EXPECT_NE(std::string::npos, result.err.find("uvol_render")) << result.err;
  EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
}

TEST(UvolViewerWithoutDisplay, SaysSoAndNamesTheToolForIt)
{
  expectAdvice("env -u DISPLAY");
  expectAdvice("DISPLAY=");
  expectAdvice("DISPLAY=:987");
  expectAdvice("DISPLAY=nonsense");
  if (!uvol_test::VirtualDisplay::isInstalled())
    GTEST_SKIP() << "Xvfb is not installed";
  const uvol_test::VirtualDisplay without_opengl({"-extension", "GLX"});
  expectAdvice("");
}

TEST(UvolViewerWithoutDisplay, HelpNamesEveryKey)
{
  const auto result = runCommand("env -u DISPLAY uvol_viewer -h");
  EXPECT_EQ(0, result.exit_code);
  EXPECT_NE(std::string::npos, result.out.find(uvol_tools::describeKeys()));
  EXPECT_NE(std::string::npos, result.out.find("-iso"));
}

} // namespace
