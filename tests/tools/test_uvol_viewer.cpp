// SPDX-License-Identifier: BSD-3-Clause
// uvol_viewer from the outside.
#include "tools/sentences.h"
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
  auto result = uvol_test::runWell("uvol_viewer volume.ply -field intensity -iso 0.5" +
                                   options + "half.png");
  EXPECT_EQ("", result.err);
  EXPECT_NE(std::string::npos, result.out.find("isopoints")) << result.out;
  result = uvol_test::runWell("uvol_viewer volume.ply -field intensity -json" +
                              options + "middle.png");
  EXPECT_EQ('{', result.out.front());
  EXPECT_GT(covered(read("half.png")), 1500);
  EXPECT_TRUE(read("middle.png").color != read("half.png").color);

  // Several isovalues, as uvol_render draws them
  const std::string look =
      " -opacity 1,0.4 -background white -no-bar -eye 0,-3,0 -size 240x180";
  result = uvol_test::runWell("uvol_viewer volume.ply -field intensity -iso 0.3,0.6 "
                              "-screenshot two.png" +
                              look);
  uvol_test::runWell("uvol_isosurface volume.ply two.ply -field intensity -iso "
                     "0.3,0.6 && uvol_render two.ply same.png" +
                     look);
  const int colored = countColored(read("same.png"));
  EXPECT_GT(colored, 1000);
  EXPECT_NEAR(colored, countColored(read("two.png")), 0.1 * colored);

  pcl_uvol::Dataset sphere;
  pcl::toPCLPointCloud2(*uvol_test::makeSphere(6000, 1), sphere.cloud);
  pcl_uvol::saveDataset("sphere.ply", sphere);
  result = uvol_test::runWell("uvol_viewer sphere.ply -background black" + options +
                              "sphere.png");
  // As uvol_render draws it
  uvol_test::runWell("uvol_render sphere.ply same.png -background black -view front "
                     "-size 240x180");
  const Image drawn = read("same.png");
  const auto expectSame = [&](const Image& shown) {
    int different = 0;
    for (std::size_t i = 0; i < shown.color.size(); ++i)
      different += std::abs(shown.color[i] - drawn.color[i]) > 8;
    EXPECT_LT(different, static_cast<int>(shown.color.size()) / 50);
  };
  EXPECT_NE(std::string::npos, result.out.find("backend: cpu (")) << result.out;
  expectSame(read("sphere.png"));
  result = uvol_test::runWell("uvol_viewer sphere.ply -background black -backend gl" +
                              options + "gl.png");
  EXPECT_NE(std::string::npos, result.out.find("backend: vtk")) << result.out;
  expectSame(read("gl.png"));
}

/** Expressions are computed at each surface, as uvol_isosurface does it. */
TEST_F(UvolViewer, IsosurfacesAreColoredByExpressions)
{
  pcl_uvol::saveDataset("volume.ply", makeVolume());
  const std::string look = " -view front -size 240x180 -background white";
  for (const std::string color : {"' log10(x+2)'", "'sqrt(error+intensity^2)'"}) {
    uvol_test::runWell("uvol_viewer volume.ply -field intensity -iso 0.5 -color " +
                       color + " -screenshot shown.png" + look);
    uvol_test::runWell("uvol_isosurface volume.ply a.ply -field intensity -iso 0.5 && "
                       "uvol_render a.ply same.png -color " +
                       color + look);
    const int colored = countColored(read("same.png"));
    EXPECT_GT(colored, 1000);
    EXPECT_NEAR(colored, countColored(read("shown.png")), 0.1 * colored);
  }
  uvol_test::expectError(
      runCommand("uvol_viewer volume.ply -field intensity -iso 0.5 -color 'log10(q)' "
                 "-json -screenshot wrong.png" +
                 look),
      "unknown_operand",
      R"("q")");
}

TEST_F(UvolViewer, WrongUseIsOneSentence)
{
  pcl_uvol::saveDataset("volume.ply", makeVolume());
  uvol_test::writeFile("empty.csv", "x,y,z,f\n");
  uvol_test::writeFile("equal.csv", "x,y,z,f\n0,0,0,1\n1,0,0,1\n");
  for (const auto& [arguments, code, value] :
       {std::tuple("volume.ply -iso 1", "command_line", "-field"),
        std::tuple("volume.ply -wrong", "command_line", "-wrong"),
        std::tuple("volume.ply -background transparent", "command_line", "transparent"),
        std::tuple("volume.ply -supersample 2", "command_line", "-supersample"),
        std::tuple("volume.ply -screenshot out.jpg", "unwritten_ending", ".png"),
        std::tuple("volume.ply -field none", "unknown_lone_field", "intensity"),
        std::tuple("volume.ply -field intensity -iso 1e9",
                   "isovalue_beyond_range",
                   "1000000000"),
        std::tuple("volume.ply -color none_such", "unknown_lone_field", "none_such"),
        std::tuple("equal.csv -field f", "all_values_equal", "f"),
        std::tuple("empty.csv", "no_points", "empty.csv"),
        std::tuple("gone.ply", "no_such_file", "gone.ply")}) {
    SCOPED_TRACE(arguments);
    uvol_test::expectError(
        runCommand(std::string("uvol_viewer -json ") + arguments), code, value);
  }
}

void
expectAdvice(const std::string& environment, const std::string& code)
{
  const auto result = runCommand(environment + " uvol_viewer in.ply -json");
  uvol_test::expectError(result, code);
  EXPECT_NE(std::string::npos, result.err.find("uvol_render")) << result.err;
}

TEST(UvolViewerWithoutDisplay, SaysSoAndNamesTheToolForIt)
{
  expectAdvice("env -u DISPLAY", "no_display");
  expectAdvice("DISPLAY=", "no_display");
  expectAdvice("DISPLAY=:987", "display_not_opened");
  expectAdvice("DISPLAY=nonsense", "display_not_opened");
  if (!uvol_test::VirtualDisplay::isInstalled())
    GTEST_SKIP() << "Xvfb is not installed";
  const uvol_test::VirtualDisplay without_opengl({"-extension", "GLX"});
  expectAdvice("", "display_without_opengl");
}

TEST(UvolViewerWithoutDisplay, HelpNamesEveryKey)
{
  const auto result = uvol_test::runWell("env -u DISPLAY uvol_viewer -h");
  EXPECT_NE(std::string::npos, result.out.find(uvol_tools::describeKeys()));
  EXPECT_NE(std::string::npos, result.out.find("-iso"));
}

} // namespace test_uvol_viewer
