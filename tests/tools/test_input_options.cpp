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

  /** That exit code and that sentence. */
  void
  expectRefused(const std::string& tool,
                const std::string& options,
                int exit_code,
                const std::string& sentence) const
  {
    const auto result = run(tool, options);
    EXPECT_EQ(exit_code, result.exit_code) << tool << ' ' << options;
    EXPECT_NE(std::string::npos, result.err.find(sentence)) << result.err;
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

/** How often a sentence stands in the warnings. */
std::size_t
countWarnings(const CommandResult& result, const std::string& sentence)
{
  std::size_t count = 0;
  for (std::size_t at = result.err.find(sentence); at != std::string::npos;
       at = result.err.find(sentence, at + 1))
    ++count;
  return count;
}

const std::string conflicts = "several different values";

TEST_F(InputOptions, AreThoseOfEveryTool)
{
  for (const auto& [tool, options] : jobs) {
    const auto result = run(tool, options + chosen + "-json");
    ASSERT_EQ(0, result.exit_code) << tool << ": " << result.err;
    const auto counts = nlohmann::json::parse(result.out).at("counts");
    EXPECT_EQ(1458 - 324, counts.at("removed_by_where")) << tool;
    expectRefused(tool, std::string(options) + "-xyz ix,iy", 2, "three columns");
    if (std::string(tool) != "info" && std::string(tool) != "cluster")
      expectRefused(tool, options, 1, "(-xyz)");
  }
  EXPECT_EQ(
      0, run("project", "out.ply -attributes x,y,t -label label " + chosen).exit_code);
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
    const auto all = runTool(job + "-xyz ix,iy,iz");
    EXPECT_EQ(1u, countWarnings(all, conflicts)) << job << all.err;
    const auto one = runTool(job + "-xyz ix,iy,iz -where experiment=1");
    EXPECT_EQ(0u, countWarnings(one, conflicts)) << job << one.err;
  }
  write("in.csv", makeExperiments(0.0)); // the same twice is no contradiction
  EXPECT_EQ(0u,
            countWarnings(run("isosurface", "out.ply -field t -iso 9 -xyz ix,iy,iz"),
                          conflicts));
}

TEST_F(InputOptions, TakeNoNamesForValues)
{
  const std::string places = "-xyz ix,iy,iz ";
  for (const std::string options : {"out.ply -field site -iso 0.5 ",
                                    "out.ply -field '\"site\"' -iso 0.5 ",
                                    "out.ply -field site -iso 0.5 -max-memory 500M "})
    expectRefused("isosurface", options + places, 1, "'site' contains names");
  expectRefused(
      "levelset", "out.ply -field site -iso 0.5 " + places, 1, "'site' contains names");
  expectRefused(
      "probe", "out.csv -field site -grid 3x3x3 " + places, 1, "'site' contains names");
  expectRefused(
      "measure", "-field site -iso 0.5 " + places, 1, "'site' contains names");
  expectRefused(
      "cluster", "out.csv -attributes t,site " + places, 1, "'site' contains names");
}

TEST_F(InputOptions, DoNotPredictTheStepToTheValueOutside)
{
  expectRefused("isosurface",
                "out.ply -field t -iso 9 -fill-gaps -outside-value 0",
                2,
                "-fill-gaps cannot be combined with -outside-value");
}

} // namespace test_input_options
