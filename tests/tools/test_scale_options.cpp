// SPDX-License-Identifier: BSD-3-Clause
// -scale and -rotate mean the same in every tool that has them.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_scale_options {

using uvol_test::runCommand;

/** Samples of layers that rise to the east, 400 m wide and 2 deep. */
class ScaleOptions : public ::testing::Test {
protected:
  ScaleOptions()
  {
    std::ostringstream table;
    uvol_test::Random random(5);
    table << "x,y,z,t,label\n";
    for (int i = 0; i < 1500; ++i) {
      const double x = 400.0 * random.uniform(), y = 400.0 * random.uniform(),
                   z = 2.0 * random.uniform();
      const double t = z - 0.002 * x;
      table << x << ',' << y << ',' << z << ',' << t << ',' << (t > 0.6) << '\n';
    }
    uvol_test::writeFile(in_, table.str());
  }

  /** The bytes of what a tool writes. */
  std::string
  outputOf(const std::string& tool, const std::string& options)
  {
    const std::string out = folder_ / "out.csv";
    const auto result = runCommand(tool + " " + in_ + " " + out + " " + options);
    EXPECT_EQ(0, result.exit_code) << tool << ' ' << options << ": " << result.err;
    return uvol_test::readFile(out);
  }

  /** The options of a job, with the file of places. */
  std::string
  withPlaces(std::string options)
  {
    if (const auto at = options.find("PLACES"); at != std::string::npos)
      options.replace(at, 6, folder_ / "places.csv");
    return options;
  }

  const uvol_test::TemporaryFolder folder_;
  const std::string in_ = folder_ / "in.csv";
};

/** Each tool with what it needs. */
const std::pair<const char*, const char*> jobs[] = {
    {"uvol_isosurface", "-field t -iso 0.6 "},
    {"uvol_isosurface", "-field t -iso 0.6 -normals edge -interpolation linear "},
    {"uvol_probe", "-field t -points PLACES -model fit -gradients "},
    {"uvol_levelset", "-field t -iso 0.6 -steps 5 "},
    {"uvol_cluster", "-cluster 1 -surface membership "},
    {"uvol_normals", ""}};

TEST_F(ScaleOptions, ADiagonalMatrixIsThreeFactors)
{
  uvol_test::writeFile(folder_ / "places.csv", "x,y,z\n200,200,1\n100,300,0.5\n");
  for (const auto& [tool, options] : jobs) {
    const std::string job = withPlaces(options);
    const std::string expected = outputOf(tool, job + "-scale 1,1,100");
    EXPECT_EQ(expected, outputOf(tool, job + "-scale 1,0,0,0,1,0,0,0,100"));
    EXPECT_EQ(expected, outputOf(tool, job + "-scale 1,1,100 -rotate 0,0,0"));
    EXPECT_NE(expected, outputOf(tool, job + "-scale 1,1,100 -rotate 0,20,10"));
    outputOf(tool, job + "-scale spacing -rotate 10,0,0");
    outputOf(tool, job + "-scale auto");
  }
}

TEST_F(ScaleOptions, MakeUpForAxesOfSeveralUnits)
{
  std::string table = uvol_test::readFile(in_);
  table.replace(0, std::string("x,y,z").size(), "lon,lat,depth");
  uvol_test::writeFile(in_, table);
  uvol_test::writeFile(folder_ / "places.csv", "lon,lat,depth\n200,200,1\n");
  for (const auto& [tool, options] : jobs) {
    const std::string job = std::string(tool) + " " + in_ + " " +
                            (folder_ / "out.csv") + " " + withPlaces(options);
    for (const auto& [scale, is_told] : {std::pair("", true),
                                         std::pair("-scale 111,80,0.001", false),
                                         std::pair("-scale auto", false)}) {
      const auto result = runCommand(job + scale + " -json");
      EXPECT_EQ(is_told, uvol_test::hasMessage(result, "mixed_units"))
          << job << scale << ": " << result.out;
    }
  }
}

TEST_F(ScaleOptions, RefuseWhatTheyCannotMean)
{
  for (const auto& [tool, options] : jobs)
    for (const auto& [bad, word] :
         {std::pair("-scale 1,1", "-scale"),
          std::pair("-scale 1,2,3,4", "-scale"),
          std::pair("-scale -1,1,1", "-scale"),
          std::pair("-scale 1,0,1", "-scale"),
          std::pair("-scale 1,1,1e-60", "-scale"),
          std::pair("-scale 1,0,0,0,1,0,0,0,0", "coplanar"),
          std::pair("-scale 1,0,0,0,1,0,0,0,2 -rotate 0,0,0", "-rotate"),
          std::pair("-scale automatic", "-scale"),
          std::pair("-rotate 0,91,0", "91"),
          std::pair("-rotate 0,10,20", "20"),
          std::pair("-rotate 0,10", "-rotate")}) {
      SCOPED_TRACE(tool);
      uvol_test::expectError(runCommand(std::string(tool) + " " + in_ + " " +
                                        (folder_ / "out.csv") + " -json " + options +
                                        bad),
                             "command_line",
                             word);
    }
}

TEST_F(ScaleOptions, AreReported)
{
  uvol_test::writeFile(folder_ / "places.csv", "x,y,z\n200,200,1\n");
  for (const auto& [tool, options] : jobs) {
    const std::string job = std::string(tool) + " " + in_ + " " +
                            (folder_ / "out.csv") + " " + withPlaces(options);
    for (const auto& [scale, told] :
         {std::pair("-scale 1,1,100", "scale: 1,1,100\n"),
          std::pair("-scale spacing", "scale: 1"),
          std::pair("-scale 1,1,4 -rotate 10,0,0", "rotation: 10,0,0\n")}) {
      const std::string report = runCommand(job + scale).out;
      EXPECT_NE(std::string::npos, report.find(told)) << job << scale << report;
    }
  }
  for (const char* const scale : {"1,1,100", "spacing", "auto"}) {
    const std::string report = runCommand("uvol_info " + in_ + " -scale " + scale).out;
    EXPECT_NE(std::string::npos, report.find("\nscale: 1,")) << report;
  }
  EXPECT_EQ(std::string::npos, runCommand("uvol_info " + in_).out.find("\nscale: "));
}

TEST_F(ScaleOptions, ReportHowTheScaleWasFound)
{
  const std::string job = "uvol_isosurface " + in_ + " " + (folder_ / "out.csv") +
                          " -field t -iso 0.6 -json ";
  const std::string found = runCommand(job + "-scale auto").out;
  EXPECT_NE(std::string::npos, found.find("\"scale_choice\"")) << found;
  EXPECT_NE(std::string::npos, found.find("\"error_ratio\"")) << found;
  EXPECT_EQ(std::string::npos, runCommand(job).out.find("scale_choice"));
  EXPECT_NE(std::string::npos,
            runCommand(job + "-rotate 10,20,0").out.find("\"rotation\""));
  // Kriging between lines measures as the field changes unless told otherwise.
  EXPECT_NE(std::string::npos,
            runCommand(job + "-fill-gaps").out.find("\"scale_choice\""));
  EXPECT_EQ(std::string::npos,
            runCommand(job + "-fill-gaps -scale 1,1,1").out.find("\"scale_choice\""));
}

TEST(ScaleOfRealData, IsThatOfTheOceanAndOneElsewhere)
{
  if (uvol_test::dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  struct Case {
    const char *file, *field;
    double isovalue, least, most; ///< of the factor of z
  };
  const Case cases[] = {
      {"sensors/seaglider_sg542.csv", "temperature_C", 6, 50, 300},
      {"sensors/seaglider_sg542.csv", "oxygen_umol_kg", 225, 50, 300},
      {"sensors/argo_4901079_gulfstream.csv", "temperature_C", 12, 1, 1},
      {"sensors/babbitt_drillholes.csv", "cu_pct", 0.6, 1, 1},
      {"particles/starsmasher_giant.csv", "rho", 0.01, 1, 1},
      {"cfd/bluntfin.vts", "Density", 0.9, 1, 1}};
  const uvol_test::TemporaryFolder folder;
  for (const Case& data : cases) {
    SCOPED_TRACE(data.file);
    std::ostringstream job;
    job << "uvol_isosurface " << uvol_test::dataFolder() << '/' << data.file << ' '
        << (folder / "out.ply") << " -field " << data.field << " -iso " << data.isovalue
        << " -scale auto -interpolation linear -normals edge -json";
    const auto report = nlohmann::json::parse(runCommand(job.str()).out);
    const auto scale = report.at("scale").get<std::vector<double>>();
    EXPECT_GE(scale[2], data.least);
    EXPECT_LE(scale[2], data.most);
    EXPECT_LE(std::max(scale[0], scale[1]), data.most == 1.0 ? 1.0 : 4.0);
  }
}

} // namespace test_scale_options
