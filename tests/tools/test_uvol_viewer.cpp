// SPDX-License-Identifier: BSD-3-Clause
// uvol_viewer from the outside.
#include "tools/viewer_test.h"
#include "viewer/keys.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace test_uvol_viewer {

using pcl_uvol::Image;
using uvol_test::countColored;
using uvol_test::covered;
using uvol_test::makeVolume;
using uvol_test::runCommand;
using uvol_test::UvolViewer;

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

/** Expressions are computed at each surface, as uvol_isosurface does it. */
TEST_F(UvolViewer, IsosurfacesAreColoredByExpressions)
{
  pcl_uvol::saveDataset("volume.ply", makeVolume());
  const std::string look = " -view front -size 240x180 -background white";
  for (const std::string color : {"' log10(x+2)'", "'sqrt(error+intensity^2)'"}) {
    const auto result =
        runCommand("uvol_viewer volume.ply -field intensity -iso 0.5 -color " + color +
                   " -screenshot shown.png" + look);
    EXPECT_EQ(0, result.exit_code) << result.err;
    ASSERT_EQ(
        0,
        runCommand("uvol_isosurface volume.ply a.ply -field intensity -iso 0.5 && "
                   "uvol_render a.ply same.png -color " +
                   color + look)
            .exit_code);
    const int colored = countColored(read("same.png"));
    EXPECT_GT(colored, 1000);
    EXPECT_NEAR(colored, countColored(read("shown.png")), 0.1 * colored);
  }
  const auto wrong =
      runCommand("uvol_viewer volume.ply -field intensity -iso 0.5 -color 'log10(q)' "
                 "-screenshot wrong.png" +
                 look);
  EXPECT_EQ(1, wrong.exit_code);
  EXPECT_NE(std::string::npos, wrong.err.find("There is no field 'q'")) << wrong.err;
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

} // namespace test_uvol_viewer
