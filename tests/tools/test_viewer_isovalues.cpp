// SPDX-License-Identifier: BSD-3-Clause
// Isovalues in the window of uvol_viewer: slider, steps and what is typed.
#include "tools/viewer_test.h"

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

namespace test_viewer_isovalues {

using pcl_uvol::Image;
using uvol_test::covered;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::UvolViewer;

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

} // namespace test_viewer_isovalues
