// SPDX-License-Identifier: BSD-3-Clause
// uvol_raytrace from the outside: scenes, clouds, what the command line changes, and
// uvol_isosurface -raytrace.
#include "support/environment.h"
#include "support/png.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <utility>

namespace test_uvol_raytrace {

using uvol_test::CommandResult;
using uvol_test::runCommand;

pcl_uvol::Image
read(const std::string& path)
{
  int channels = 0;
  return uvol_test::readPng(path, channels);
}

class RaytraceTool : public testing::Test {
protected:
  CommandResult
  run(const std::string& arguments) const
  {
    return runCommand("uvol_raytrace " + arguments);
  }

  /** The file of a scene with a ball of that colour in its middle. */
  std::string
  sceneOf(const std::string& color) const
  {
    const std::string path = folder_ / "ball.scene";
    uvol_test::writeFile(path,
                         "size 40 30\n"
                         "background 0 0 0\n"
                         "camera eye 0 -9 0 at 0 0 0\n"
                         "material m ambient 1 diffuse 0 specular 0 color " +
                             color + "\nsphere 0 0 0 1 material m\n");
    return path;
  }

  /** A torus as isopoints. */
  std::string
  surface(const std::string& options = "") const
  {
    const std::string samples = folder_ / "samples.pcd", path = folder_ / "torus.ply";
    uvol_test::runWell("uvol_generate " + samples + " -field torus -n 20000");
    uvol_test::runWell("uvol_isosurface " + samples + " " + path + " -iso 0" + options);
    return path;
  }

  void
  expectError(const std::string& arguments,
              const std::string& code,
              const std::string& value) const
  {
    SCOPED_TRACE(arguments);
    uvol_test::expectError(run(arguments + " -json"), code, value);
    EXPECT_FALSE(std::filesystem::exists(picture_));
  }

  const uvol_test::TemporaryFolder folder_;
  const std::string picture_ = folder_ / "out.png";
};

TEST_F(RaytraceTool, DrawsAScene)
{
  const CommandResult result =
      uvol_test::succeeded(run(sceneOf("1 0 0") + " " + picture_ + " -json"));
  EXPECT_TRUE(nlohmann::json::parse(result.out).at("counts").contains("primary_rays"))
      << result.out;
  const auto image = read(picture_);
  ASSERT_EQ(40u, image.width);
  ASSERT_EQ(30u, image.height);
  EXPECT_EQ(255, image.color[4 * (15 * 40 + 20)]);
  EXPECT_EQ(0, image.color[4 * (15 * 40 + 20) + 1]);
  EXPECT_EQ(0, image.color[0]);
}

TEST_F(RaytraceTool, TheCommandLineComesBeforeTheScene)
{
  const std::string scene = sceneOf("1 0 0");
  uvol_test::succeeded(
      run(scene + " " + picture_ +
          " -size 20 -background 0,1,0 -eye 30,0,0 -supersample 2 -depth 0"));
  const auto image = read(picture_);
  ASSERT_EQ(20u, image.width);
  EXPECT_EQ(255, image.color[1]);
  // From farther away the ball is smaller.
  int red = 0;
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel)
    red += image.color[4 * pixel] > 128 ? 1 : 0;
  EXPECT_GT(red, 1);
  EXPECT_LT(red, 12);
}

TEST_F(RaytraceTool, OptionsChangeTheCameraOfASceneOneByOne)
{
  const std::string scene = folder_ / "view.scene";
  uvol_test::writeFile(scene,
                       "size 40 30\n"
                       "camera eye 0 -9 0 at 0.5 0 0.2 up 1 0 1 fov 20\n"
                       "sphere 0 0 0 1\n");
  const auto draw = [&](const std::string& options) {
    const CommandResult result = run(scene + " " + picture_ + " -no-shadows" + options);
    EXPECT_EQ(0, result.exit_code) << options << ": " << result.err;
    return read(picture_).color;
  };
  const std::string eye = " -eye 0,-9,0", at = " -at 0.5,0,0.2", up = " -up 1,0,1",
                    fov = " -fov 20";
  const auto plain = draw("");
  EXPECT_EQ(plain, draw(eye + at + up + fov));
  for (const auto& [changed, others] :
       {std::pair(std::string(" -eye 4,-8,1"), at + up + fov),
        std::pair(std::string(" -at 0,0,0"), eye + up + fov),
        std::pair(std::string(" -up 0,0,1"), eye + at + fov),
        std::pair(std::string(" -fov 35"), eye + at + up)}) {
    EXPECT_EQ(draw(changed + others), draw(changed)) << changed;
    EXPECT_NE(plain, draw(changed)) << changed;
  }
  uvol_test::writeFile(scene, "size 40 30\nsphere 0 0 0 1\n");
  std::filesystem::remove(picture_);
  expectError(scene + " " + picture_ + " -at 0,0,0", "command_line", "-eye");
}

TEST_F(RaytraceTool, DrawsPointsAndSplatsAlike)
{
  // Points in gaps are drawn as dots, which splats know nothing of.
  const std::string torus = surface(" -drop-bridged"), splats = folder_ / "splats.ply",
                    other = folder_ / "other.png";
  const std::string look = " -size 64 -reflect 0.2 -depth 2 -color mean_curvature";
  ASSERT_EQ(0, run(torus + " " + picture_ + look).exit_code);
  ASSERT_EQ(0, runCommand("uvol_splats " + torus + " " + splats).exit_code);
  uvol_test::succeeded(run(splats + " " + other + look));
  // Ranges of colours are those of all points or of all splats: a highlight may be
  // white in one of the pictures only.
  const auto a = read(picture_), b = read(other);
  int different = 0, drawn = 0;
  for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) {
    const bool is_drawn = a.color[4 * pixel] != 255 || a.color[4 * pixel + 1] != 255;
    drawn += is_drawn ? 1 : 0;
    const bool is_other = b.color[4 * pixel] != 255 || b.color[4 * pixel + 1] != 255;
    different += is_drawn != is_other ? 1 : 0;
  }
  EXPECT_GT(drawn, 500);
  EXPECT_LE(different, 1);
}

TEST_F(RaytraceTool, OrbitsAndReportsInJson)
{
  const CommandResult result = uvol_test::succeeded(
      run(sceneOf("1 1 1") + " " + picture_ + " -orbit 3 -size 10 -json"));
  EXPECT_NE(std::string::npos, result.out.find("\"primary_rays\"")) << result.out;
  for (const char* frame : {"out_0.png", "out_1.png", "out_2.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / frame)) << frame;
}

TEST_F(RaytraceTool, PicturesOfScenesSayWhereTheyAreFrom)
{
  const std::string scene = folder_ / "torus.scene";
  uvol_test::writeFile(scene,
                       "size 40 30\ncamera eye 0 -9 0.5 at 0 0 0.25 fov 20\n"
                       "cloud \"" +
                           surface() + "\"\n");
  for (const auto& [options, camera] :
       {std::pair("", "-eye 0,-9,0.5 -at 0,0,0.25 -up 0,0,1 -fov 20"),
        std::pair(" -eye 1,-8,0.5", "-eye 1,-8,0.5 -at 0,0,0.25 -up 0,0,1 -fov 20")}) {
    uvol_test::succeeded(run(scene + " " + picture_ + options));
    const std::string bytes = uvol_test::readFile(picture_);
    EXPECT_NE(std::string::npos, bytes.find(std::string("Camera\0", 7) + camera))
        << options;
    EXPECT_NE(std::string::npos,
              bytes.find(std::string("Isovalue\0"
                                     "0",
                                     10)));
  }
}

TEST_F(RaytraceTool, IsosurfacesAreTracedAtOnce)
{
  const std::string samples = folder_ / "s.pcd", out = folder_ / "s.ply";
  uvol_test::runWell("uvol_generate " + samples + " -field torus -n 20000");
  const std::string extract = "uvol_isosurface " + samples + " " + out + " -iso 0 ";
  EXPECT_EQ(2, runCommand(extract + "-raytrace").exit_code);
  const CommandResult result =
      uvol_test::runWell(extract + "-raytrace -png " + picture_ +
                         " -size 50 -reflect 0.3 -delta 0.001 -v");
  EXPECT_NE(std::string::npos, result.out.find("picture_trace")) << result.out;
  EXPECT_EQ(50u, read(picture_).width);
  const std::string bare = folder_ / "bare.png",
                    small =
                        extract + "-size 50 -no-shadows -color none -raytrace -png ";
  ASSERT_EQ(0, runCommand(small + bare).exit_code);
  ASSERT_EQ(0, runCommand(small + picture_ + " -occlusion-rays 16").exit_code);
  EXPECT_NE(read(bare).color, read(picture_).color);
  uvol_test::expectError(runCommand(small + picture_ + " -json -occlusion 0.5"),
                         "command_line",
                         "-occlusion-rays");
  // Whatever image space has
  const std::string help = runCommand("uvol_isosurface -h 'Drawing points'").out +
                           runCommand("uvol_isosurface -h Lines").out +
                           "  -silhouettes \n  -features \n";
  const std::regex line("\n  -([a-z-]+) ([a-z0-9,]*)");
  std::size_t refused = 0;
  for (std::sregex_iterator option(help.begin(), help.end(), line), end; option != end;
       ++option, ++refused) {
    const std::map<std::string, std::string> values{
        {"", ""}, {"n", "1"}, {"number", "0.5"}, {"none", "none"}, {"r,g,b", "0,0,0"}};
    const std::string name = " -" + (*option)[1].str() + ' ';
    uvol_test::expectError(
        runCommand(small + picture_ + " -json" + name + values.at((*option)[2])),
        "command_line",
        name.substr(1));
  }
  EXPECT_EQ(16u, refused);
}

/** Where a picture shows something on a white ground. */
std::vector<bool>
coverOf(const pcl_uvol::Image& image)
{
  std::vector<bool> cover;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    cover.push_back(image.color[4 * i] < 250);
  return cover;
}

TEST_F(RaytraceTool, CullsAsRenderingInImageSpaceDoes)
{
  // Half of a torus, of which the inside is seen from below.
  const std::string half = folder_ / "half.ply", drawn = folder_ / "drawn.png",
                    samples = folder_ / "samples.pcd",
                    look = " -size 60 -color none -view bottom -culling ";
  surface();
  const std::string extract = "uvol_isosurface " + samples + " " + half +
                              " -iso 0 -where 'z>0' -raytrace -png " + picture_ + look;
  ASSERT_EQ(0, runCommand(extract).exit_code);
  const auto by_pipeline = read(picture_);
  ASSERT_EQ(0, run(half + " " + picture_ + look).exit_code);
  const auto traced = read(picture_);
  EXPECT_EQ(by_pipeline.color, traced.color);
  ASSERT_EQ(0, runCommand("uvol_render " + half + " " + drawn + look).exit_code);
  const std::vector<bool> cover = coverOf(traced), other = coverOf(read(drawn));
  const auto covered = std::count(cover.begin(), cover.end(), true);
  int different = 0;
  for (std::size_t i = 0; i < cover.size(); ++i)
    different += cover[i] != other[i];
  EXPECT_LT(different, 60);
  uvol_test::succeeded(
      run(half + " " + picture_ + " -size 60 -color none -view bottom"));
  const std::vector<bool> whole = coverOf(read(picture_));
  EXPECT_LT(covered, std::count(whole.begin(), whole.end(), true) / 2);
}

TEST_F(RaytraceTool, RefusesWhatIsWrong)
{
  const std::string scene = sceneOf("1 1 1"), torus = surface();
  expectError("", "command_line", "<in>");
  expectError(scene + " " + picture_ + " -reflect 0.1", "command_line", "-reflect");
  expectError(scene + " " + picture_ + " -color f", "command_line", "-color");
  expectError(torus + " " + picture_ + " -folder x", "command_line", "-folder");
  expectError(torus + " " + picture_ + " -reflect 0.6 -transparent 0.6",
              "command_line",
              "-transparent");
  expectError(torus + " " + picture_ + " -index 0", "command_line", "-index");
  expectError(torus + " " + picture_ + " -depth -1", "command_line", "-depth");
  expectError(torus + " " + picture_ + " -delta 0", "command_line", "-delta");
  expectError(torus + " " + picture_ + " -lambda 2", "command_line", "-lambda");
  expectError(
      torus + " " + picture_ + " -color unknown", "unknown_lone_field", "\"unknown\"");
  expectError("missing.scene " + picture_, "no_such_file", "missing.scene");
  expectError("missing.ply " + picture_, "no_such_file", "missing.ply");
  uvol_test::writeFile(folder_ / "bad.scene", "sphere 0 0 0 1\nspehre 0 0 0 1\n");
  expectError((folder_ / "bad.scene") + " " + picture_, "unknown_word", R"("spehre")");
  uvol_test::writeFile(folder_ / "none.csv", "x,y,z\n");
  expectError((folder_ / "none.csv") + " " + picture_, "no_points", "none.csv");
}

TEST_F(RaytraceTool, PrintsEqualWarningsOnce)
{
  uvol_test::writeFile(folder_ / "c.csv",
                       "x,y,z,rho\n0,0,0,1\n1,0,0,2\n0,1,0,3\n1,1,0,4\n");
  std::string scene = "size 40 30\ncamera eye 0 -9 0 at 0 0 0\n";
  for (int i = 0; i < 30; ++i)
    scene += "cloud c.csv at " + std::to_string(i) + " 0 0\n";
  uvol_test::writeFile(folder_ / "many.scene", scene);
  const auto warnings =
      uvol_test::jsonOf(run((folder_ / "many.scene") + " " + picture_ + " -json"))
          .at("warnings");
  ASSERT_EQ(1u, warnings.size()) << warnings;
  EXPECT_EQ(30, warnings[0].at("times"));
}

TEST_F(RaytraceTool, EstimatesNormalsAndSaysSo)
{
  const std::string points = folder_ / "points.csv";
  std::string text = "x,y,z\n";
  uvol_test::Random random(1);
  for (int i = 0; i < 500; ++i)
    text += std::to_string(random.uniform()) + "," + std::to_string(random.uniform()) +
            ",0\n";
  uvol_test::writeFile(points, text);
  const CommandResult result =
      uvol_test::succeeded(run(points + " " + picture_ + " -size 20 -json"));
  EXPECT_TRUE(uvol_test::hasMessage(result, "estimated_normals")) << result.out;
}

} // namespace test_uvol_raytrace
