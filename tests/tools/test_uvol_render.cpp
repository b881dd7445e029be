// SPDX-License-Identifier: BSD-3-Clause
// uvol_render and the pictures of uvol_isosurface from the outside.
#include "support/environment.h"
#include "support/png.h"
#include "support/surfaces.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

namespace test_uvol_render {

using uvol_test::runCommand;

class RenderTool : public uvol_test::ToolTest {
protected:
  RenderTool()
      : ToolTest("uvol_render", "out.png")
  {
    in_ = folder_ / "in.ply";
  }

  void
  SetUp() override
  {
    pcl_uvol::Dataset sphere;
    pcl::toPCLPointCloud2(*uvol_test::makeSphere(5000, 1), sphere.cloud);
    pcl_uvol::saveDataset(in_, sphere);
  }

  std::vector<std::uint8_t>
  pixels() const
  {
    int channels = 0;
    return uvol_test::readPng(out_, channels).color;
  }
};

/** Width, height and channels of a PNG file, from its header. */
struct PngHeader {
  int width = 0, height = 0, channels = 0;

  explicit PngHeader(const std::string& path)
  {
    const std::string bytes = uvol_test::readFile(path);
    if (bytes.size() < 26 || bytes.compare(0, 4, "\x89PNG") != 0)
      return;
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = at; i < at + 4; ++i)
        value = value * 256 + static_cast<unsigned char>(bytes[i]);
      return value;
    };
    width = number(16);
    height = number(20);
    channels = bytes[25] == 6 ? 4 : bytes[25] == 2 ? 3 : 0;
  }
};

TEST_F(RenderTool, WritesAPictureOfTheSizeThatIsAskedFor)
{
  auto result = uvol_test::succeeded(run("-size 320x200"));
  EXPECT_EQ("", result.err);
  PngHeader header(out_);
  EXPECT_EQ(320, header.width);
  EXPECT_EQ(200, header.height);
  EXPECT_EQ(3, header.channels);
  result = uvol_test::succeeded(run("-size 64 -background transparent -supersample 2"));
  header = PngHeader(out_);
  EXPECT_EQ(64, header.width);
  EXPECT_EQ(64, header.height);
  EXPECT_EQ(4, header.channels);
}

TEST_F(RenderTool, ColorsWithoutLightAreThoseOfTheMap)
{
  uvol_test::succeeded(
      run("-size 128 -supersample 1 -no-shading -color x*0+1 -range 0,2 -no-bar "
          "-no-antialias "
          "-smoothing none -colormap gray"));
  const auto flat = pixels();
  int grey = 0;
  for (std::size_t i = 0; i < flat.size(); i += 4)
    if (flat[i] != 255) {
      EXPECT_NEAR(127.5, flat[i], 1.0);
      ++grey;
    }
  EXPECT_GT(grey, 128 * 128 / 4);
  EXPECT_TRUE(
      uvol_test::hasMessage(run("-size 128 -no-shading -json"), "white_on_white"));
  for (const char* seen :
       {"-silhouettes", "-features", "-background black", "-color normal_z"})
    EXPECT_EQ("", run(std::string("-size 128 -no-shading ") + seen).err) << seen;
}

TEST_F(RenderTool, EveryModeIsAPictureOfItsOwn)
{
  ASSERT_EQ(0, run("-size 128").exit_code);
  const auto plain = pixels();
  for (const char* options : {"-silhouettes",
                              "-features -feature-threshold 0.0001",
                              "-no-shading",
                              "-no-antialias",
                              "-smoothing none",
                              "-smoothing box",
                              "-smoothings 3",
                              "-no-footprints",
                              "-view top",
                              "-eye 3,1,2",
                              "-fov 10",
                              "-parallel",
                              "-parallel -eye 3,1,2 -at 0.1,0,0",
                              "-background black",
                              "-background gradient",
                              "-background 0.1,0.5,0.2",
                              "-color normal_z",
                              "-color normal_z -no-bar",
                              "-color normal_z -colormap inferno",
                              "-color normal_z -range -2,2",
                              "-surface-color 1,0,0",
                              "-supersample 1",
                              "-lights -1,0,0",
                              "-ambient 0.5",
                              "-diffuse 0.1",
                              "-specular 0",
                              "-shininess 3",
                              "-silhouettes -line-color 0,0,1",
                              "-silhouettes -thickness 3"}) {
    const auto result = run(std::string("-size 128 ") + options);
    EXPECT_EQ(0, result.exit_code) << options << ": " << result.err;
    EXPECT_TRUE(plain != pixels()) << options;
  }
  ASSERT_EQ(0, run("-size 128 -view iso -color none -backend cpu").exit_code);
  EXPECT_TRUE(plain == pixels());
}

TEST_F(RenderTool, FiguresExplainThePicture)
{
  ASSERT_EQ(0, run("-size 256x200").exit_code);
  const auto plain = pixels();
  for (const char* options : {"-ticks",
                              "-ticks -unit km",
                              "-ticks -exaggerate 1,1,3",
                              "-ticks -orbit 1 -background gradient",
                              "-box",
                              "-triad",
                              "-scale-bar",
                              "-scale-bar -unit km",
                              "-scale-bar -exaggerate 2,2,2",
                              "-title sphere",
                              "-views iso,top,front",
                              "-views iso,top -color normal_z -ticks -triad",
                              "-box -background transparent",
                              "-triad -views top,iso -background black"}) {
    const auto result = run(std::string("-size 256x200 ") + options);
    EXPECT_EQ(0, result.exit_code) << options << ": " << result.err;
    EXPECT_EQ(plain.size(), pixels().size()) << options;
    EXPECT_TRUE(plain != pixels()) << options;
  }
  ASSERT_EQ(0, run("-size 256x200 -color normal_z").exit_code);
  const auto named_by_field = pixels();
  ASSERT_EQ(0, run("-size 256x200 -color normal_z -label 'slope (1)'").exit_code);
  EXPECT_TRUE(named_by_field != pixels());
  ASSERT_EQ(0, run("-size 256x200 -color normal_z -label normal_z").exit_code);
  EXPECT_TRUE(named_by_field == pixels());
  for (const char* options :
       {"-views nowhere",
        "-views iso,,top",
        "-views iso -view top",
        "-views top -eye 1,2,3",
        "-unit km",
        "-scale-bar -exaggerate 1,1,2",
        "-size 20 -title t",
        "-size 40 -views iso,top,front,left,right,back,bottom,iso,top,front"}) {
    const auto result = run(options);
    EXPECT_EQ(2, result.exit_code) << options;
    EXPECT_NE("", result.err) << options;
  }
  const auto page =
      runCommand("uvol_render " + in_ + " " + folder_ / "page.html" + " -ticks");
  EXPECT_EQ(2, page.exit_code);
}

TEST_F(RenderTool, ViewsSideBySideAreTheViewsThemselves)
{
  ASSERT_EQ(0, run("-size 200x100 -views front,top -background transparent").exit_code);
  const auto both = pixels();
  ASSERT_EQ(0, run("-size 100 -view top -background transparent").exit_code);
  const auto top = pixels();
  std::size_t differences = 0;
  for (std::size_t row = 30; row < 100; ++row) // below the name of the view
    for (std::size_t k = 0; k < 400; ++k)
      differences += both[800 * row + 400 + k] != top[400 * row + k] ? 1 : 0;
  EXPECT_EQ(0u, differences);
}

TEST_F(RenderTool, PicturesSayWhereTheyAreFrom)
{
  ASSERT_EQ(0, run("-size 64 -view right -title 'a b' -threads 1").exit_code);
  const std::string one = uvol_test::readFile(out_);
  EXPECT_NE(std::string::npos,
            one.find(std::string("Command\0", 8) +
                     "uvol_render in.ply out.png -size 64 -view right -title 'a b'"));
  EXPECT_NE(std::string::npos, one.find(std::string("Software\0", 9) + "pcl_uvol "));
  const std::string other = folder_ / "other.png";
  uvol_test::runWell("uvol_render " + in_ + " " + other +
                     " -size 64 -view right -title 'a b' -threads 2");
  EXPECT_TRUE(one == uvol_test::readFile(other));

  // The camera gives the same picture again.
  ASSERT_EQ(0, run("-size 90 -view left -zoom 1.5 -exaggerate 1,2,4").exit_code);
  const auto pictured = pixels();
  const std::string bytes = uvol_test::readFile(out_);
  const std::size_t camera = bytes.find(std::string("Camera\0-eye", 11));
  ASSERT_NE(std::string::npos, camera);
  const std::size_t begin = camera + 7;
  // The chunk's length stands before its name.
  const std::string length = bytes.substr(camera - 8, 4);
  const auto size = static_cast<std::size_t>(static_cast<unsigned char>(length[3])) +
                    256u * static_cast<unsigned char>(length[2]);
  uvol_test::succeeded(
      run("-size 90 -exaggerate 1,2,4 " + bytes.substr(begin, size - 7)));
  const auto repeated = pixels();
  ASSERT_EQ(pictured.size(), repeated.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < pictured.size(); ++i)
    different += std::abs(pictured[i] - repeated[i]) > 2 ? 1 : 0;
  EXPECT_LT(different, pictured.size() / 500);
}

TEST_F(RenderTool, PicturesHaveTheSizeThatTheyArePrintedWith)
{
  const std::string of_300_dpi("pHYs\0\0\x2e\x23\0\0\x2e\x23\1", 13);
  for (const auto& [options, width, height, says_300] :
       {std::tuple("-size 25.4x12.7mm", 300, 150, true),
        std::tuple("-size 2.54x1.27cm -dpi 600", 600, 300, false),
        std::tuple("-size 1in", 300, 300, true),
        std::tuple("-size 70x40 -dpi 300", 70, 40, true),
        std::tuple("-size 70x40", 70, 40, false)}) {
    const auto result = run(options);
    ASSERT_EQ(0, result.exit_code) << options << result.err;
    const PngHeader header(out_);
    EXPECT_EQ(width, header.width) << options;
    EXPECT_EQ(height, header.height) << options;
    EXPECT_EQ(says_300, uvol_test::readFile(out_).find(of_300_dpi) != std::string::npos)
        << options;
  }
  const std::string figure = folder_ / "figure.svg";
  uvol_test::runWell("uvol_render " + in_ + " " + figure +
                     " -size 76.2x50.8mm -color normal_z");
  const std::string text = uvol_test::readFile(figure);
  EXPECT_NE(std::string::npos, text.find("width=\"3in\" height=\"2in\""));
  // 7 points, at 300 dots per inch.
  EXPECT_NE(std::string::npos, text.find("font-size=\"29\""));
}

TEST_F(RenderTool, OrbitWritesNumberedFrames)
{
  uvol_test::succeeded(run("-size 32 -orbit 12"));
  const auto names = folder_.list();
  ASSERT_EQ(13u, names.size());
  EXPECT_EQ("out_00.png", names[1]);
  EXPECT_EQ("out_11.png", names[12]);
}

TEST_F(RenderTool, OrbitsOfAllViewsGoAboutTheUpwardDirection)
{
  // The sphere's colours by height are rings from above, in all frames.
  ASSERT_EQ(0, run("-orbit 4 -size 60 -view top -color z -no-bar").exit_code);
  std::vector<std::vector<std::uint8_t>> frames;
  for (const char* frame : {"out_0.png", "out_1.png", "out_2.png"}) {
    int channels = 0;
    frames.push_back(uvol_test::readPng(folder_ / frame, channels).color);
  }
  const auto distance = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < frames[a].size(); ++i)
      sum += std::abs(frames[a][i] - frames[b][i]);
    return sum / static_cast<double>(frames[a].size());
  };
  EXPECT_LT(distance(0, 1), 4.0);
  EXPECT_LT(distance(0, 2), 4.0);
}

TEST_F(RenderTool, ReportsValuesThatHaveNoLogarithm)
{
  for (const char* tool : {"uvol_render ", "uvol_raytrace "}) {
    const auto result = uvol_test::runWell(
        tool + in_ + " " + out_ + " -size 60 -view front -no-bar -color z -log -json");
    EXPECT_EQ(
        5000,
        uvol_test::warnedValues(nlohmann::json::parse(result.out), "no_logarithms")
            .at("points"));
    // The lower half is grey.
    int gray = 0, colourful = 0;
    const auto picture = pixels();
    for (std::size_t i = 0; i + 3 <= picture.size(); i += 3) {
      const bool is_gray = std::abs(picture[i] - picture[i + 1]) < 4 &&
                           std::abs(picture[i] - picture[i + 2]) < 4;
      gray += is_gray && picture[i] < 250 ? 1 : 0;
      colourful += is_gray ? 0 : 1;
    }
    EXPECT_GT(gray, 300) << tool;
    EXPECT_GT(colourful, 300) << tool;
  }
}

TEST_F(RenderTool, ReportNamesBackendAndPasses)
{
  const auto result = uvol_test::succeeded(run("-size 64 -json"));
  for (const char* word : {"\"backend\": \"cpu",
                           "\"project\"",
                           "\"fill_background\"",
                           "\"shade\"",
                           "\"smooth\"",
                           "\"anti_alias\"",
                           "\"points\": 5000"})
    EXPECT_NE(std::string::npos, result.out.find(word)) << word << '\n' << result.out;
}

TEST_F(RenderTool, PointsWithoutNormalsAreDrawnWithAWarning)
{
  const std::string bare = folder_ / "bare.csv";
  uvol_test::writeFile(bare, "x,y,z\n0,0,0\n1,0,0\n0,1,0\n1,1,0.1\n0.5,0.5,0\n");
  const auto result =
      uvol_test::runWell("uvol_render " + bare + " " + out_ + " -size 32 -json");
  EXPECT_TRUE(uvol_test::hasMessage(result, "estimated_normals")) << result.out;
}

TEST_F(RenderTool, RefusesWrongCommandLines)
{
  for (const char* options :
       {"-size 0x10",        "-size 10x",        "-size 10mmx20mm",
        "-size mm",          "-size nanxinfmm",  "-size -3mm",
        "-size 40000",       "-size 10x-3",      "-size ten",
        "-view above",       "-eye 1,2",         "-eye 1,2,3 -view top",
        "-at 0,0,0",         "-fov 0",           "-background pink",
        "-background 1,2,3", "-range 2,1",       "-orbit 0",
        "-supersample 9",    "-thickness 8",     "-lights 0,0,0",
        "-lights 1,2",       "-smoothing blur",  "-backend vulkan",
        "-colormap jet",     "-parallel -fov 9", "-backend cpu -device 0",
        "-device -1",        "-nonsense"}) {
    const auto result = run(options);
    EXPECT_EQ(2, result.exit_code) << options << ": " << result.err;
    EXPECT_EQ("", result.out) << options;
  }
  EXPECT_EQ(2, runCommand("uvol_render " + in_).exit_code);
}

TEST_F(RenderTool, FailsInOneSentenceAndLeavesNothingBehind)
{
  const std::string empty = folder_ / "empty.csv";
  uvol_test::writeFile(empty, "x,y,z\n");
  for (const std::string& command :
       {"uvol_render " + empty + " " + out_,
        "uvol_render missing.ply " + out_,
        "uvol_render " + in_ + " " + (folder_ / "out.jpg"),
        "uvol_render " + in_ + " /nowhere/out.png",
        "uvol_render " + in_ + " " + out_ + " -color density",
        "uvol_render " + in_ + " " + out_ + " -color rgb",
        "uvol_render " + in_ + " " + out_ + " -device 999",
        "uvol_render " + in_ + " " + out_ + " -eye 0,0,5 -up 0,0,1 -at 0,0,0"}) {
    const auto result = runCommand(command);
    EXPECT_EQ(1, result.exit_code) << command;
    EXPECT_EQ("", result.out) << command;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n'))
        << command << '\n'
        << result.err;
  }
  EXPECT_EQ((std::vector<std::string>{"empty.csv", "in.ply"}), folder_.list());
}

TEST_F(RenderTool, IsosurfaceDrawsItsResult)
{
  const std::string samples = folder_ / "samples.pcd", surface = folder_ / "out.ply";
  ASSERT_EQ(0, runCommand("uvol_generate " + samples + " -n 20000").exit_code);
  const std::string extract =
      "uvol_isosurface " + samples + " " + surface + " -png " + out_ + " -size 100x80 ";
  auto result = uvol_test::runWell(extract + "-iso 8 -color mean_curvature -view top");
  EXPECT_EQ(100, PngHeader(out_).width);
  EXPECT_EQ(80, PngHeader(out_).height);
  // A surface without points is no failure, but there is nothing to be drawn.
  std::remove(out_.c_str());
  result = uvol_test::runWell(extract + "-iso 1e9 -json");
  EXPECT_TRUE(uvol_test::hasMessage(result, "nothing_to_draw")) << result.out;
  EXPECT_EQ((std::vector<std::string>{"in.ply", "out.ply", "samples.pcd"}),
            folder_.list());
  EXPECT_EQ(2, runCommand(extract + "-iso 8 -view above").exit_code);
}

/** The text between two others; "" if they are not there. */
std::string
textBetween(const std::string& text,
            const std::string& before,
            const std::string& after)
{
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos)
    return "";
  const std::size_t first = begin + before.size();
  const std::size_t end = text.find(after, first);
  return end == std::string::npos ? "" : text.substr(first, end - first);
}

TEST_F(RenderTool, WritesAWebPageThatNeedsNothingElse)
{
  uvol_test::runWell("uvol_render " + in_ + " " + folder_ / "page.html" +
                     " -background black -color normal_x");
  const std::string html = uvol_test::readFile(folder_ / "page.html");
  for (const char* const elsewhere : {"http:", "https:", "src=", "import "})
    EXPECT_EQ(html.find(elsewhere), std::string::npos) << elsewhere;
  const std::string facts =
      textBetween(html, "type=\"application/json\">", "</script>");
  for (const char* const fact : {"\"count\":5000",
                                 "\"title\":\"page\"",
                                 "\"ink\":\"white\"",
                                 "\"title\":\"normal_x\"",
                                 "\"fov\":30.0"})
    EXPECT_NE(facts.find(fact), std::string::npos) << fact << " in " << facts;
  const std::string points =
      textBetween(html, "type=\"application/octet-stream\">", "</script>");
  EXPECT_EQ(points.size(), (5000u * 16u + 2u) / 3u * 4u);
  // Every point of a unit ball, in 16 bits and base64: none at its centre.
  EXPECT_EQ(points.find("AAAAAAAAAAAAAAAA"), std::string::npos);
}

TEST_F(RenderTool, RefusesOptionsOfPicturesForAWebPage)
{
  uvol_test::expectError(runCommand("uvol_render " + in_ + " " + folder_ / "page.html" +
                                    " -json -size 20x20"),
                         "command_line",
                         "-size");
}

/** A browser without a window; "" if there is none. */
std::string
findBrowser()
{
  for (const char* const name : {"chromium", "google-chrome"})
    if (runCommand(std::string("command -v ") + name).exit_code == 0)
      return name;
  return "";
}

TEST_F(RenderTool, WebPageLooksLikeThePictureInABrowser_long)
{
  const std::string browser = findBrowser();
  if (browser.empty())
    GTEST_SKIP() << "there is no chromium here";
  const std::string page = folder_ / "page.html", shot = folder_ / "shot.png";
  ASSERT_EQ(
      runCommand("uvol_render " + in_ + " " + page + " -color normal_z").exit_code, 0);
  ASSERT_EQ(run("-size 600x600 -color normal_z -no-bar").exit_code, 0);
  uvol_test::runWell(
      browser +
      " --headless --no-sandbox --use-angle=swiftshader"
      " --enable-unsafe-swiftshader --hide-scrollbars --window-size=600,600"
      " --virtual-time-budget=5000 --user-data-dir=" +
      folder_ / "profile" + " --screenshot=" + shot + " file://" + page);
  int channels = 0;
  const pcl_uvol::Image picture = uvol_test::readPng(out_, channels),
                        seen = uvol_test::readPng(shot, channels);
  ASSERT_EQ(seen.width, picture.width);
  ASSERT_EQ(seen.height, picture.height);
  // Away from the legend and the note: the ball, and what is around it.
  double difference = 0.0;
  std::size_t count = 0;
  for (std::uint32_t row = 40; row < 540; ++row)
    for (std::uint32_t column = 0; column < 480; ++column, ++count)
      for (int channel = 0; channel < 3; ++channel)
        difference +=
            std::abs(picture.color[4 * (std::size_t{row} * 600 + column) + channel] -
                     seen.color[4 * (std::size_t{row} * 600 + column) + channel]);
  EXPECT_LT(difference / (3.0 * static_cast<double>(count)), 4.0);
}

} // namespace test_uvol_render
