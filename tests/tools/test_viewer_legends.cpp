// SPDX-License-Identifier: BSD-3-Clause
// The bar in the window of uvol_viewer, and what pictures show beside theirs.
#include "charts/color_bar.h"
#include "tools/viewer_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace test_viewer_legends {

using pcl_uvol::Image;
using uvol_test::height;
using uvol_test::makeVolume;
using uvol_test::OpenWindow;
using uvol_test::runCommand;
using uvol_test::UvolViewer;
using uvol_test::width;

const int beside_bar = width - uvol_tools::colorBarWidth(width, height);

const std::uint8_t*
pixelOf(const Image& image, int column, int row)
{
  return &image.color[4 * static_cast<std::size_t>(row * width + column)];
}

/** Pixels of the bar's columns that differ above the slider. */
int
countDifferentInBar(const Image& a, const Image& b)
{
  int count = 0;
  for (int row = 0; row < height * 3 / 4; ++row)
    for (int column = beside_bar; column < width; ++column) {
      const std::uint8_t* const first = pixelOf(a, column, row);
      count += !std::equal(first, first + 3, pixelOf(b, column, row));
    }
  return count;
}

TEST_F(UvolViewer, ShowsTheBarOfPictures)
{
  const std::vector<std::vector<const char*>> looks = {
      {"-color", "x"},
      {"-color", "x", "-background", "black"},
      {"-color",
       "y",
       "-range",
       "1600000000,1600000012",
       "-label",
       "time (s since 1970)"},
      {"-color", "edge_length", "-log", "-range", "4e8,2e10"}};
  int number = 0;
  for (const auto& look : looks) {
    OpenWindow open(makeVolume(), "intensity", look);
    for (int i = 0; i < 8; ++i) // the surface does not reach below the bar
      open.window->interactor().InvokeEvent(vtkCommand::MouseWheelForwardEvent);
    const Image shown = open.shoot();
    open.type('s');
    const Image saved = read("uvol_viewer_" + std::to_string(++number) + ".png");
    EXPECT_EQ(0, countDifferentInBar(shown, saved)) << look[1];
    open.type('c'); // one colour
    EXPECT_LT(500, countDifferentInBar(open.shoot(), saved)) << look[1];
  }
}

/** Pixels left of the bar and above the slider which show a surface in one of two
 * pictures only.
 * \param rows by which the second one lies lower */
int
countDifferentOutlines(const Image& a, const Image& b, int rows)
{
  constexpr int white = 250;
  int count = 0;
  for (int row = 0; row + rows < height * 3 / 4; ++row)
    for (int column = 0; column < beside_bar; ++column)
      count += (pixelOf(a, column, row)[1] < white) !=
               (pixelOf(b, column, row + rows)[1] < white);
  return count;
}

TEST_F(UvolViewer, PicturesShowWhatTheWindowShowsWhenABarHasCome)
{
  OpenWindow open(makeVolume(), "intensity", {"-view", "front", "-color", "none"});
  open.type('c');
  for (const bool is_near : {false, true}) { // then it is cut on both sides
    for (int i = 0; is_near && i < 4; ++i)
      open.window->interactor().InvokeEvent(vtkCommand::MouseWheelForwardEvent);
    const Image shown = open.shoot();
    open.type('s');
    open.type('e');
    testing::internal::CaptureStdout();
    open.type('p');
    std::string camera = testing::internal::GetCapturedStdout();
    camera.pop_back(); // the end of the line
    const std::string number = is_near ? "2" : "1";
    uvol_test::runWell("uvol_render uvol_viewer_" + number +
                       ".ply drawn.png -color mean_curvature -size " +
                       std::to_string(width) + "x" + std::to_string(height) + " " +
                       camera);
    constexpr int lower = (height - height * 78 / 100) / 2; // there is no slider
    for (const std::string& name :
         {"uvol_viewer_" + number + ".png", std::string("drawn.png")})
      EXPECT_LT(countDifferentOutlines(shown, read(name), lower), width * height / 100)
          << name << camera;
  }
}

} // namespace test_viewer_legends
