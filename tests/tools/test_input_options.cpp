// SPDX-License-Identifier: BSD-3-Clause
// -xyz and -where mean the same in every tool that reads samples, and what samples can
// not be is told.
#include "tools/tool_test.h"

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

namespace test_input_options {

using uvol_test::CommandResult;

/** A lattice whose columns of whole numbers have names that tell no axis, with the same
 * values in both experiments unless they conflict. */
std::string
makeExperiments(double conflict)
{
  std::ostringstream table;
  table << "experiment,ix,iy,iz,t,label,site\n";
  for (int experiment = 1; experiment <= 2; ++experiment)
    for (int place = 0; place < 729; ++place) {
      const std::array<int, 3> at = {place % 9, place / 9 % 9, place / 81};
      double sq_dist = 0.0;
      for (const int coordinate : at)
        sq_dist += (coordinate - 4.1) * (coordinate - 4.1);
      table << experiment << ',' << at[0] << ',' << at[1] << ',' << at[2] << ','
            << sq_dist + conflict * experiment << ',' << (sq_dist < 9.0) << ','
            << (at[2] < 4 ? "low" : "high") << '\n';
    }
  return table.str();
}

class InputOptions : public uvol_test::FolderTest {
protected:
  InputOptions()
  {
    write("in.csv", makeExperiments(0.5));
  }

  CommandResult
  run(const std::string& tool, const std::string& options) const
  {
    return runTool(tool + " in.csv " + options);
  }
};

/** Each tool that reads samples, with what it needs. */
const std::pair<const char*, const char*> jobs[] = {
    {"isosurface", "out.csv -field t -iso 9 "},
    {"levelset", "out.csv -field t -iso 9 -steps 3 "},
    {"normals", "out.csv "},
    {"cluster", "out.ply -cluster 1 -surface distance "},
    {"probe", "out.csv -field t -grid 3x3x3 "},
    {"measure", "-field t -iso 9 "},
    {"voronoi", "out.vti -grid 8 "},
    {"convert", "out.csv "},
    {"info", ""}};

const std::string chosen = "-xyz ix,iy,iz -where \"experiment=1 && site='low'\" ";

/** How often samples contradict each other in the warnings of a run. */
std::size_t
countConflicts(const CommandResult& result)
{
  const auto warnings = nlohmann::json::parse(result.out).at("warnings");
  return static_cast<std::size_t>(
      std::count_if(warnings.begin(), warnings.end(), [](const auto& warning) {
        return warning.at("code") == "conflicting_samples" &&
               warning.value("times", 1) == 1;
      }));
}

TEST_F(InputOptions, AreThoseOfEveryTool)
{
  for (const auto& [tool, options] : jobs) {
    const auto result = run(tool, options + chosen + "-json");
    ASSERT_EQ(0, result.exit_code) << tool << ": " << result.err;
    const auto counts = nlohmann::json::parse(result.out).at("counts");
    EXPECT_EQ(1458 - 324, counts.at("removed_by_where")) << tool;
    const std::string job = std::string(tool) + " in.csv " + options;
    expectError(job + "-xyz ix,iy", "command_line", "-xyz");
    if (std::string(tool) != "info" && std::string(tool) != "cluster")
      expectError(job, "ambiguous_integers", "experiment");
  }
  uvol_test::succeeded(
      run("project", "out.ply -attributes x,y,t -label label " + chosen));
}

TEST_F(InputOptions, ChooseTheSamplesThatLevelSetsAndNormalsKeep)
{
  for (const std::string job :
       {"levelset in.csv out.csv -field t -iso 9 ", "normals in.csv out.csv "}) {
    ASSERT_EQ(0, runTool(job + chosen).exit_code) << job;
    const auto kept = pcl_uvol::loadDataset(folder_ / "out.csv");
    EXPECT_EQ(324u, kept.cloud.width) << job;
    for (const double z : uvol_test::fieldOf(kept, "z"))
      EXPECT_LT(z, 4.0) << job;
  }
}

TEST_F(InputOptions, ReportSamplesThatContradictEachOther)
{
  for (const std::string job : {"isosurface in.csv out.ply -field t -iso 9 ",
                                "isosurface in.csv out.ply -field t -iso 8,9 -smooth ",
                                "isosurface in.csv out.ply -field t -iso 9 -mesh ",
                                "levelset in.csv out.ply -field t -iso 9 -steps 3 ",
                                "measure in.csv -field t -iso 9 ",
                                "probe in.csv out.csv -field t,label -grid 3x3x3 "}) {
    const std::string all = job + "-json -xyz ix,iy,iz ";
    EXPECT_EQ(1u, countConflicts(runTool(all))) << job;
    EXPECT_EQ(0u, countConflicts(runTool(all + "-where experiment=1"))) << job;
  }
  write("in.csv", makeExperiments(0.0)); // the same twice is no contradiction
  EXPECT_EQ(0u,
            countConflicts(runTool("isosurface in.csv out.ply -field t -iso 9 -json "
                                   "-xyz ix,iy,iz")));
}

TEST_F(InputOptions, TakeNoNamesForValues)
{
  for (const std::string job : {"isosurface in.csv out.ply -iso 0.5 -field site",
                                "isosurface in.csv out.ply -iso 0.5 -field '\"site\"'",
                                "isosurface in.csv out.ply -iso 0.5 -max-memory 500M "
                                "-field site",
                                "levelset in.csv out.ply -iso 0.5 -field site",
                                "probe in.csv out.csv -grid 3x3x3 -field site",
                                "measure in.csv -iso 0.5 -field site",
                                "cluster in.csv out.csv -attributes t,site"})
    expectError(job + " -xyz ix,iy,iz", "field_of_names", "site");
}

TEST_F(InputOptions, DoNotPredictTheStepToTheValueOutside)
{
  expectError("isosurface in.csv out.ply -field t -iso 9 -fill-gaps -outside-value 0",
              "command_line",
              "-outside-value");
}

} // namespace test_input_options
