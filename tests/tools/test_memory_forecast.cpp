// SPDX-License-Identifier: BSD-3-Clause
// Tools forecast their memory, and refuse what does not fit before they begin.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace test_memory_forecast {

using uvol_test::runCommand;

/** A run on "in.pcd" or "in.ply", with "out.ply", or "out.png" of what draws. */
struct ToolRun {
  const char *name, *tool, *input, *options;
};

const ToolRun runs[] = {
    {"Isosurface", "uvol_isosurface", "in.pcd", "-iso 0"},
    {"LinearIsosurface",
     "uvol_isosurface",
     "in.pcd",
     "-iso 0 -interpolation linear -threads 1"},
    {"Isosurfaces", "uvol_isosurface", "in.pcd", "-iso -0.2,-0.1,0,0.1"},
    {"SmoothIsosurface", "uvol_isosurface", "in.pcd", "-iso 0 -smooth"},
    {"Picture", "uvol_isosurface", "in.pcd", "-iso 0 -png out.png -size 1500"},
    {"Expression", "uvol_isosurface", "in.pcd", "-iso 0 -field torus*2"},
    {"Derivative",
     "uvol_isosurface",
     "in.pcd",
     "-iso 1 -field 'div(x,y,grad(torus)[2])'"},
    {"LevelSet", "uvol_levelset", "in.pcd", "-iso 0"},
    {"LinearLevelSet",
     "uvol_levelset",
     "in.pcd",
     "-iso 0 -scheme linear -mu 0.9 -threads 1"},
    {"Cluster", "uvol_cluster", "in.pcd", "-attributes torus,x -threads 1"},
    {"PositionCluster", "uvol_cluster", "in.pcd", "-attributes torus -position -k 30"},
    {"Probe", "uvol_probe", "in.pcd", "-grid 40"},
    {"ProbeByKriging", "uvol_probe", "in.pcd", "-grid 20 -model kriging -threads 1"},
    {"ProbeAtPoints", "uvol_probe", "in.pcd", "-points in.pcd -model nearest"},
    {"Normals", "uvol_normals", "in.ply", ""},
    {"ManyNeighborNormals", "uvol_normals", "in.ply", "-k 60 -threads 1"},
    {"Splats", "uvol_splats", "in.ply", ""},
    {"Rendering", "uvol_render", "in.ply", "-size 1500"},
    {"FewSplats", "uvol_splats", "in.ply", "-delta 0.002 -threads 1"}};

/** Megabytes of a tool that has not begun, which would hide what is wrong. */
constexpr double started = 9.0;

/** Forecast and peak in megabytes, of a run with -json. */
std::pair<double, double>
readMemory(const nlohmann::json& report)
{
  const auto& memory = report.at("memory");
  return {1e-6 * memory.at("forecast").get<double>(),
          1e-6 * memory.at("peak").get<double>()};
}

class MemoryForecast : public testing::TestWithParam<ToolRun> {
protected:
  void
  SetUp() override
  {
    if (uvol_test::isSanitized())
      GTEST_SKIP() << "Sanitizers take memory of their own.";
  }

  uvol_test::CommandResult
  run(const std::string& before = "", const std::string& after = "") const
  {
    const ToolRun& tool = GetParam();
    return runCommand(before + "cd " + (folder_ / "") + " && " + tool.tool + ' ' +
                      (folder_ / tool.input) + ' ' +
                      (folder_ / (draws() ? "out.png" : "out.ply")) + ' ' +
                      tool.options + after);
  }

  static bool
  draws()
  {
    return GetParam().tool == std::string("uvol_render");
  }

  /** Noise for those that smooth: without any there is no second evolver, and forecasts
   * cannot know that. */
  static bool
  isNoisy()
  {
    const ToolRun& run = GetParam();
    return std::string(run.options).find("-smooth") != std::string::npos ||
           run.tool == std::string("uvol_levelset");
  }

  /** Those that take seconds for 300,000 samples get fewer: the forecast is as many
   * times the peak, within 5 %. */
  static bool
  isSlow()
  {
    const ToolRun& run = GetParam();
    return std::string(run.options).find("grad(") != std::string::npos ||
           std::string(run.options).find("-points") != std::string::npos;
  }

  bool
  isVolume() const
  {
    return GetParam().input == std::string("in.pcd");
  }

  /** The file of that name, which the first test that needs it makes. */
  static std::string
  makeOnce(const std::string& name, const std::string& command)
  {
    static const uvol_test::TemporaryFolder made;
    if (const std::string path = made / name; !std::filesystem::exists(path)) {
      uvol_test::runWell("cd " + (made / "") + " && " + command);
    }
    return made / name;
  }

  uvol_test::TemporaryFolder folder_;
};

/** Spheres and tori are surfaces of usual size. */
TEST_P(MemoryForecast, IsEnoughAndNotTwiceThePeak)
{
  std::string in;
  if (!isVolume()) {
    // isopoints of spheres, with all their fields
    in = makeOnce("in.ply",
                  "uvol_generate samples.pcd -field sphere -n 1000000 && "
                  "uvol_isosurface samples.pcd in.ply -interpolation linear "
                  "-iso 0.1,0.2,0.3,0.4");
    ASSERT_GT(pcl_uvol::loadDataset(in).cloud.width, 100000u);
  }
  else if (isNoisy())
    in = makeOnce("noisy.pcd",
                  "uvol_generate noisy.pcd -field torus -n 50000 -noise 0.05");
  else if (isSlow())
    in = makeOnce("few.pcd", "uvol_generate few.pcd -field torus -n 120000");
  else
    in = makeOnce("in.pcd", "uvol_generate in.pcd -field torus -n 300000");
  std::filesystem::create_symlink(in, folder_ / GetParam().input);
  const auto [forecast, peak] = readMemory(uvol_test::jsonOf(run("", " -json")));
  ASSERT_GT(peak, started + 10.0);
  EXPECT_GT(forecast, 0.98 * peak); // chosen for reports of three digits
  // FewSplats has 1.73: a splat for each point is counted.
  EXPECT_LT(forecast - started, 1.8 * (peak - started));
}

/** A header that promises four thousand million points, and a file as long, of which
 * nothing is written. */
TEST_P(MemoryForecast, RefusesWhatDoesNotFit)
{
  const char* const fields = isVolume() ? "x y z torus" : "x y z normal_x";
  uvol_test::writeFile(folder_ / "in.pcd",
                       std::string("FIELDS ") + fields +
                           "\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 4000000000\n"
                           "HEIGHT 1\nDATA binary\n");
  uvol_test::writeFile(folder_ / "in.ply",
                       "ply\nformat binary_little_endian 1.0\n"
                       "element vertex 4000000000\nproperty float x\n"
                       "property float y\nproperty float z\nend_header\n");
  std::filesystem::resize_file(folder_ / GetParam().input, 64000001000u);
  const auto result = run("ulimit -v 7750000; ", " -json");
  uvol_test::expectError(result, "not_enough_memory", "Reading of 4000000000 points");
  const auto values = nlohmann::json::parse(result.out).at("error").at("values");
  const std::string needed = values.at("needed"), available = values.at("available");
  EXPECT_TRUE(std::regex_match(needed, std::regex("[0-9.]+ [GT]B"))) << needed;
  EXPECT_TRUE(std::regex_match(available, std::regex("[0-9.]+ GB"))) << available;
  EXPECT_LT(std::stod(available), 7.95); // 7750000 KiB are 7.94 GB
  const std::string tool = GetParam().tool, options = GetParam().options;
  const bool has_bound = tool == "uvol_isosurface" &&
                         options.find("-smooth") == std::string::npos &&
                         options.find("grad(") == std::string::npos;
  EXPECT_EQ(has_bound, result.err.find("Without -max-memory") != std::string::npos);
  EXPECT_EQ((std::vector<std::string>{"in.pcd", "in.ply"}), folder_.list());
}

/** The header tells nothing of how many points are left. */
TEST(MemoryOfSelectedRows, IsThatOfThoseLeft)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers take memory of their own.";
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.pcd";
  uvol_test::runWell("uvol_generate " + in + " -field torus -n 2000000");
  for (const std::string tool :
       {"uvol_isosurface -iso 0", "uvol_cluster -attributes torus"}) {
    const std::string all =
        "ulimit -d 110000; " + tool + " -threads 1 " + in + ' ' + (folder / "out.ply");
    uvol_test::expectError(runCommand(all + " -json"), "not_enough_memory");
    uvol_test::runWell(all + " -where 'x>0.8'");
  }
}

/** Kriged nodes in gaps are as many as the surface needs. */
TEST(MemoryOfGaps, IsEnoughAndNotThreeTimesThat)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers take memory of their own.";
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.csv";
  uvol_test::runWell("uvol_generate " + in + " -field sphere -samples casts -n 8000");
  const auto report = uvol_test::jsonOf(
      runCommand("uvol_isosurface " + in + ' ' + (folder / "out.ply") +
                 " -field sphere -iso 0 -fill-gaps -json"));
  ASSERT_GT(report.at("gaps").at("predicted"), 0);
  const auto [forecast, peak] = readMemory(report);
  EXPECT_GE(forecast, peak);
  EXPECT_LE(forecast, 3.0 * peak);
}

INSTANTIATE_TEST_SUITE_P(Tools,
                         MemoryForecast,
                         testing::ValuesIn(runs),
                         [](const auto& run) { return std::string(run.param.name); });

} // namespace test_memory_forecast
