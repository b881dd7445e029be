// SPDX-License-Identifier: BSD-3-Clause
// Charts of all tools in the size that they are printed with, and what has none.
#include "support/environment.h"
#include "support/png.h"
#include "tools/tool_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace test_printed_charts {

using uvol_test::readFile;

class PrintedCharts : public uvol_test::FolderTest {
protected:
  void
  SetUp() override
  {
    uvol_test::Random random(1);
    std::ostringstream table;
    table << "x,y,z,r\n";
    for (int i = 0; i < 600; ++i) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      table << x << ',' << y << ',' << z << ',' << std::sqrt(x * x + y * y + z * z)
            << '\n';
    }
    write("in.csv", table.str());
  }

  void
  expectSize(const std::string& arguments, unsigned width, unsigned height) const
  {
    const auto result = runTool(arguments);
    ASSERT_EQ(0, result.exit_code) << arguments << ": " << result.err;
    int channels = 0;
    const auto image = uvol_test::readPng(folder_ / "chart.png", channels);
    EXPECT_EQ(width, image.width) << arguments;
    EXPECT_EQ(height, image.height) << arguments;
    const std::string of_300_dpi("pHYs\0\0\x2e\x23\0\0\x2e\x23\1", 13);
    EXPECT_NE(std::string::npos, readFile(folder_ / "chart.png").find(of_300_dpi))
        << arguments;
  }
};

const std::string print = " -size 50.8x38.1mm", png_print = " -png-size 50.8x38.1mm";
const std::string on_line = "probe in.csv o.csv -field r -line 0.1,0.2,0.3,0.8,0.9,0.7";
const std::string in_plane = "probe in.csv o.csv -field r -plane z=0.5";

TEST_F(PrintedCharts, EveryToolWritesTheSizeThatIsAskedFor)
{
  const std::vector<std::string> commands{
      on_line + " -png chart.png" + png_print,
      in_plane + " -png chart.png" + png_print,
      on_line + " -model kriging -variogram-png chart.png" + png_print,
      "levelset in.csv o.ply -field r -iso 0.6 -steps 3 -plot chart.png" + print,
      "measure in.csv o.csv -field r -iso 0.5,0.6 -png chart.png" + print,
      "project in.csv o.ply -attributes x,y,r -png chart.png" + print,
      "voronoi in.csv o.vti -grid 8 -png chart.png" + print};
  for (const std::string& arguments : commands)
    expectSize(arguments, 600, 450);
  expectSize("voronoi in.csv o.vti -grid 8 -axis y -slices 2 -dpi 300 -png chart.png",
             2 * 296 + 4,
             296);
}

TEST_F(PrintedCharts, LettersHaveSevenPointsWhereTheyHaveRoom)
{
  for (const auto& [size, letters] :
       {std::pair("85x60mm", "29"), {"50.8x38.1mm", "28"}}) {
    for (const std::string& arguments :
         {on_line + " -png chart.svg -png-size " + size,
          in_plane + " -png chart.svg -png-size " + size,
          std::string(
              "levelset in.csv o.ply -field r -iso 0.6 -steps 3 -plot chart.svg "
              "-size ") +
              size,
          std::string("project in.csv o.ply -attributes x,y,r -png chart.svg -size ") +
              size}) {
      ASSERT_EQ(0, runTool(arguments).exit_code) << arguments;
      EXPECT_NE(std::string::npos,
                readFile(folder_ / "chart.svg")
                    .find(std::string("<text font-size=\"") + letters + "\""))
          << arguments;
    }
  }
}

TEST_F(PrintedCharts, WhatIsNotDrawnHasNoSize)
{
  for (const auto& [arguments, text] :
       {std::pair(on_line + png_print, "-png-size needs -png or -variogram-png."),
        {on_line + " -dpi 300", "-dpi needs -png or -variogram-png."},
        {"levelset in.csv o.ply -field r -iso 0.6" + print, "-size needs -plot."},
        {"measure in.csv o.csv -field r -iso 0.5,0.6 -dpi 300", "-dpi needs -png."},
        {"project in.csv o.ply -attributes x,y,r" + print, "-size needs -png."},
        {"voronoi in.csv o.vti -grid 8" + print, "-size needs -png."},
        {"voronoi in.csv o.vti -grid 8 -png a.png -size 5x5mm", "not 59 x 59."},
        {"voronoi in.csv o.vti -grid 8 -png a.png -size 9e9in",
         "not 1000000 x 1000000."},
        {"viewer in.csv -size 85x60mm",
         "-size is WxH in pixels, as in 1024x768, not"}}) {
    const auto result = runTool(arguments);
    EXPECT_EQ(2, result.exit_code) << arguments;
    EXPECT_NE(std::string::npos, result.err.find(text)) << arguments << result.err;
  }
  EXPECT_EQ(std::vector<std::string>{"in.csv"}, folder_.list());
}

} // namespace test_printed_charts
