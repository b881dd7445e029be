// SPDX-License-Identifier: BSD-3-Clause
// Command lines for many files: which files, their names, what pictures and tables of
// them share.
#include "support/png.h"
#include "support/snapshots.h"
#include "tool_test.h"

#include <cmath>
#include <filesystem>
#include <random>
#include <sstream>

using namespace uvol_test;

namespace test_series {

const std::string table = "x,y,z,rho\n1,2,3,0.5\n4,5,6,1.5\n7,8,9.25,2.5\n";

class Series : public FolderTest {
protected:
  Series()
  {
    for (const char* const number : {"0002", "0010", "0006"})
      write(std::string("in_") + number + ".csv", table);
  }

  CommandResult
  run(const std::string& arguments) const
  {
    return runTool("convert " + arguments);
  }
};

TEST_F(Series, EveryFileIsConvertedInOrder)
{
  write("in_0006x.csv", table);
  write("in_6.csv", table); // another width
  const auto result = succeeded(run("'in_{:04d}.csv' 'out {:02d}.vtp'"));
  EXPECT_NE(std::string::npos, result.err.find("3 of 3 files are done"));
  const std::string list = readFile(folder_ / "out.pvd");
  const std::size_t first = list.find("timestep=\"2\" file=\"out 02.vtp\""),
                    second = list.find("timestep=\"6\" file=\"out 06.vtp\""),
                    third = list.find("timestep=\"10\" file=\"out 10.vtp\"");
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(std::string::npos, third);
}

TEST_F(Series, SnapshotsAreChosen)
{
  EXPECT_EQ(0, run("'in_{:04d}.csv' 'out_{}.ply' -snapshots 2:10:4").exit_code);
  EXPECT_TRUE(exists("out_2.ply") && exists("out_6.ply") && exists("out_10.ply"));
  EXPECT_FALSE(exists("out.pvd"));
  EXPECT_EQ(0, run("'in_{:04d}.csv' 'o_{}.ply' -snapshots 6:9:4").exit_code);
  EXPECT_TRUE(exists("o_6.ply"));
  EXPECT_FALSE(exists("o_10.ply"));
  for (const char* const wrong :
       {"1", "5:1", "1:2:0", "1:2:3:4", "a:b", "1:", "0:99999999"})
    expectError(std::string("convert 'in_{:04d}.csv' 'w_{}.ply' -snapshots ") + wrong,
                "command_line",
                "first:last");
}

TEST_F(Series, FailuresEndItUnlessTheyArePassedOver)
{
  write("in_0004.csv", "nothing\n");
  const auto ended = run("'in_{:04d}.csv' 'a_{}.ply'");
  EXPECT_EQ(1, ended.exit_code);
  EXPECT_NE(std::string::npos, ended.err.find("in_0004.csv"));
  EXPECT_TRUE(exists("a_2.ply"));
  EXPECT_FALSE(exists("a_6.ply"));
  const auto passed = run("'in_{:04d}.csv' 'b_{}.ply' -keep-going");
  EXPECT_EQ(1, passed.exit_code);
  EXPECT_TRUE(exists("b_6.ply") && exists("b_10.ply"));
  EXPECT_NE(std::string::npos, passed.err.find("3 of 4 files are done"));
}

TEST_F(Series, OptionsNeedASeries)
{
  for (const char* const options : {"-keep-going", "-snapshots 1:2"})
    expectError(std::string("convert in_0002.csv b.ply ") + options,
                "command_line",
                "snap_{:04d}.h5");
  expectError("convert 'none_{}.csv' 'b_{}.ply'", "command_line", "none_0.csv");
}

/** The same name for every output would leave the last one only. */
TEST_F(Series, OutputsHaveDifferentNames)
{
  const auto result = run("'in_{:04d}.csv' b.ply -json");
  EXPECT_EQ(2, result.exit_code);
  EXPECT_TRUE(hasMessage(result, "command_line")) << result.out;
  EXPECT_FALSE(exists("b.ply"));
}

/** Snapshots of three particles of gas at times 0.5, 1.25 and 0.5. */
class TimedSeries : public Series {
protected:
  TimedSeries()
  {
    GadgetLayout layout;
    layout.here = layout.total = {3, 0, 0, 0, 0, 0};
    std::size_t number = 0;
    for (const double time : {0.5, 1.25, 0.5}) {
      layout.time = time;
      write("snap_00" + std::to_string(number++), makeGadget(layout));
    }
  }
};

TEST_F(TimedSeries, TimesOfHeadersStandInNamesAndLists)
{
  ASSERT_EQ(0, run("'snap_{:03d}' 't={t}.csv' -snapshots 0:1").exit_code);
  EXPECT_TRUE(exists("t=0.5.csv") && exists("t=1.25.csv"));
  ASSERT_EQ(0, run("'snap_{:03d}' 'all_{:d}.vtp'").exit_code);
  const std::string list = readFile(folder_ / "all.pvd");
  for (const char* const entry : {"timestep=\"0.5\" file=\"all_0.vtp\"",
                                  "timestep=\"1.25\" file=\"all_1.vtp\"",
                                  "timestep=\"0.5\" file=\"all_2.vtp\""})
    EXPECT_NE(std::string::npos, list.find(entry)) << list;
}

TEST_F(TimedSeries, FilesOfTheSameTimeAreNotWrittenOverOneAnother)
{
  const auto result = run("'snap_{:03d}' '{t}.csv' -json");
  EXPECT_EQ(2, result.exit_code);
  EXPECT_TRUE(hasMessage(result, "command_line")) << result.out;
  EXPECT_NE(std::string::npos, result.err.find("'0.5.csv'")) << result.err;
  EXPECT_NE(std::string::npos, result.err.find("2 of 3 files are done"));
}

TEST_F(TimedSeries, TimesNeedASeries)
{
  expectError("convert snap_000 '{t}.csv'", "command_line", "{t}");
}

TEST_F(TimedSeries, FilesWithoutATimeAreNamed)
{
  const auto result = run("'in_{:04d}.csv' '{t}.csv' -json");
  EXPECT_EQ(1, result.exit_code);
  EXPECT_TRUE(hasMessage(result, "no_time")) << result.out;
  EXPECT_NE(std::string::npos, result.out.find("in_0002.csv")) << result.out;
}

/** Balls that move and grow, with a field T of other values each time. */
class GrowingBalls : public Series {
protected:
  GrowingBalls()
  {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> any(-2.0, 2.0);
    for (int number = 0; number < count; ++number) {
      std::ostringstream text;
      text << "x,y,z,f,T\n";
      for (int i = 0; i < 6000; ++i) {
        const double x = any(engine), y = any(engine), z = any(engine);
        text << x << ',' << y << ',' << z << ','
             << radiusOf(number) - std::hypot(x + 0.9 - 0.6 * number, y, z) << ','
             << (number + 1) * (x + 3.0) << '\n';
      }
      write("s_" + std::to_string(number) + ".csv", text.str());
    }
  }

  static double
  radiusOf(int number)
  {
    return 0.5 + 0.15 * number;
  }

  /** The camera that a picture says it was drawn with. */
  std::string
  cameraOf(const std::string& picture) const
  {
    const std::string bytes = readFile(folder_ / picture);
    const std::size_t begin = bytes.find("-eye ");
    if (begin == std::string::npos)
      return "";
    std::size_t end = begin;
    while (end < bytes.size() && bytes[end] >= ' ' && bytes[end] <= '~')
      ++end;
    // A checksum follows, which may begin like a number.
    const std::size_t fov = bytes.find("-fov 30", begin);
    return fov < end ? bytes.substr(begin, fov + 7 - begin) : "";
  }

  void
  expectSamePixels(const std::string& a, const std::string& b) const
  {
    int channels = 0;
    const auto first = readPng(folder_ / a, channels),
               second = readPng(folder_ / b, channels);
    EXPECT_GT(first.pixels(), 0u);
    EXPECT_TRUE(first.color == second.color) << a << " " << b;
  }

  static constexpr int count = 3;
};

TEST_F(GrowingBalls, PicturesShareCameraAndColours)
{
  const std::string look = " -color T -size 120x90 -title 'file {}'";
  succeeded(runTool("isosurface 's_{}.csv' 'o_{}.ply' -field f -iso 0 -png 'p_{}.png'" +
                    look));
  ASSERT_EQ(0, runTool("render 'o_{}.ply' 'r_{}.png'" + look).exit_code);
  const std::string camera = cameraOf("p_0.png");
  ASSERT_NE("", camera);
  double low = 1e9, high = 0.0;
  for (int number = 0; number < count; ++number) {
    const auto surface =
        pcl_uvol::loadDataset(folder_ / ("o_" + std::to_string(number) + ".ply"));
    for (const double value : fieldOf(surface, "T")) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  std::ostringstream range;
  range.precision(17);
  range << "-range " << low << ',' << high << ' ' << camera;
  for (int number = 0; number < count; ++number) {
    const std::string name = std::to_string(number);
    EXPECT_EQ(camera, cameraOf("p_" + name + ".png"));
    expectSamePixels("p_" + name + ".png", "r_" + name + ".png");
    std::ostringstream command;
    command << "render o_" << name << ".ply one.png -color T -size 120x90 -title 'file "
            << name << "' " << range.str();
    ASSERT_EQ(0, runTool(command.str()).exit_code);
    expectSamePixels("p_" + name + ".png", "one.png");
  }
}

TEST_F(GrowingBalls, RaysShareCameraAndColours)
{
  const std::string look = " -color T -size 160x130";
  ASSERT_EQ(0, runTool("isosurface 's_{}.csv' 'o_{}.ply' -field f -iso 0").exit_code);
  succeeded(runTool("raytrace 'o_{}.ply' 't_{}.png'" + look));
  // What all files are seen by, as pixels show them.
  ASSERT_EQ(0, runTool("render 'o_{}.ply' 'r_{}.png'" + look).exit_code);
  const std::string camera = cameraOf("r_0.png");
  for (int number = 0; number < count; ++number)
    EXPECT_EQ(camera, cameraOf("t_" + std::to_string(number) + ".png"));
  int channels = 0;
  const auto first = readPng(folder_ / "t_0.png", channels),
             last = readPng(folder_ / "t_2.png", channels);
  EXPECT_TRUE(first.color != last.color);
  // The values beside the bar are the same, whatever a surface holds.
  for (std::size_t row = 0; row < first.height; ++row)
    for (std::size_t k = 4 * (row * first.width + 135); k < 4 * (row + 1) * first.width;
         ++k)
      ASSERT_EQ(first.color[k], last.color[k]) << row;
}

TEST_F(GrowingBalls, PicturesThatShareNothingDoNotWait)
{
  ASSERT_EQ(0, runTool("isosurface s_0.csv o_0.ply -field f -iso 0").exit_code);
  runWell("cd '" + (folder_ / "") +
          "' && TMPDIR=/nonexistent " PCL_UVOL_TOOL_DIR
          "/uvol_render 'o_{}.ply' 'p_{}.png' -color T -size 50 -range 0,9 "
          "-eye 9,0,0 -at 0,0,0");
  EXPECT_TRUE(exists("p_0.png"));
}

TEST_F(GrowingBalls, SurfacesThatAreNotThereLeaveNoPicture)
{
  write("s_1.csv", "x,y,z,f,T\n0,0,0,1,1\n1,0,0,2,1\n0,1,0,3,1\n0,0,1,4,1\n");
  succeeded(runTool(
      "isosurface 's_{}.csv' 'o_{}.ply' -field f -iso 0 -png 'p_{}.png' -size 50"));
  EXPECT_TRUE(exists("p_0.png") && exists("o_1.ply") && exists("p_2.png"));
  EXPECT_FALSE(exists("p_1.png"));
}

TEST_F(GrowingBalls, SlicesShareTheirColours)
{
  const std::string plane = " -field T -plane z=0 -size 16 -box -1,-1,-1,1,1,1";
  succeeded(runTool("probe 's_{}.csv' 'v_{}.vti' -png 'v_{}.png'" + plane));
  int channels = 0;
  const auto first = readPng(folder_ / "v_0.png", channels),
             last = readPng(folder_ / "v_2.png", channels);
  // The bars, which stand on the right, have the same colours and numbers.
  ASSERT_EQ(first.width, last.width);
  ASSERT_EQ(first.height, last.height);
  const std::size_t bar = 4 * std::size_t{first.width} * 5 / 6, row = 4u * first.width;
  bool is_same = true;
  for (std::size_t y = 0; y < first.height; ++y)
    is_same = is_same && std::equal(first.color.begin() + y * row + bar,
                                    first.color.begin() + (y + 1) * row,
                                    last.color.begin() + y * row + bar);
  EXPECT_TRUE(is_same);
}

TEST_F(GrowingBalls, MeasuresAreATableOverTime)
{
  succeeded(runTool("measure 's_{}.csv' m.csv -field f -iso 0 -png m.png"));
  const auto rows = pcl_uvol::loadDataset(folder_ / "m.csv");
  ASSERT_EQ(std::size_t(count), rows.cloud.width);
  for (int number = 0; number < count; ++number) {
    const auto at = static_cast<std::size_t>(number);
    const double radius = radiusOf(number);
    EXPECT_EQ(number, fieldOf(rows, "number")[at]);
    EXPECT_TRUE(std::isnan(fieldOf(rows, "time")[at]));
    EXPECT_NEAR(4.18879 * std::pow(radius, 3), fieldOf(rows, "volume")[at], 0.01);
    EXPECT_NEAR(0.6 * number - 0.9, fieldOf(rows, "x")[at], 0.01);
  }
  EXPECT_TRUE(exists("m.png"));
  // A file of its own for each.
  ASSERT_EQ(0, runTool("measure 's_{}.csv' 'm_{}.csv' -field f -iso 0").exit_code);
  EXPECT_TRUE(exists("m_0.csv") && exists("m_2.csv"));
  const auto refused =
      runTool("measure 's_{}.csv' -json -field f -iso 0,0.1 -png c.png");
  EXPECT_EQ(2, refused.exit_code);
  EXPECT_TRUE(hasMessage(refused, "command_line")) << refused.out;
}

/** The outputs of a file are its own, whatever becomes of those behind it. */
TEST_F(GrowingBalls, TablesOfFilesStayWhereTheLastOneFails)
{
  write("s_2.csv", "nothing\n");
  const auto result =
      runTool("measure 's_{}.csv' 'm_{}.csv' -field f -iso 0 -keep-going");
  EXPECT_EQ(1, result.exit_code);
  for (const char* const name : {"m_0.csv", "m_1.csv"}) {
    const auto rows = pcl_uvol::loadDataset(folder_ / name);
    EXPECT_EQ(1u, rows.cloud.width) << name;
    EXPECT_EQ(nullptr, pcl_uvol::findField(rows.cloud.fields, "number")) << name;
  }
}

TEST_F(GrowingBalls, FoldersThatTakeNoFilesAreOneSentence)
{
  ASSERT_EQ(0, runTool("isosurface s_0.csv o_0.ply -field f -iso 0").exit_code);
  const auto result = runCommand("cd '" + (folder_ / "") +
                                 "' && TMPDIR=/nonexistent " PCL_UVOL_TOOL_DIR
                                 "/uvol_render 'o_{}.ply' 'p_{}.png' -json");
  EXPECT_EQ(1, result.exit_code);
  EXPECT_TRUE(hasMessage(result, "scratch_folder_refused")) << result.out;
  EXPECT_FALSE(exists("p_0.png"));
}

} // namespace test_series
