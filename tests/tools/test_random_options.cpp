// SPDX-License-Identifier: BSD-3-Clause
// Random command lines of every tool but those that open windows or run ranks, and of
// what stands in front of them.
#include "support/random_lines.h"
#include "tools/sentences.h"

#include <gtest/gtest.h>

#include <list>

namespace test_random_options {

using uvol_test::countDefaultLines;
using uvol_test::pick;
using uvol_test::Random;
using uvol_test::RandomLines;
using uvol_test::RandomTool;

constexpr std::uint64_t long_lines = 800;

const std::vector<RandomTool> tools{
    {"isosurface", "ply pcd csv vtp obj xyz", "-iso 0;-iso 0,0.1"},
    {"levelset", "ply csv", "-iso 0"},
    {"probe", "ply csv vti", "-plane z=0 -size 16;-line 0,0,0,1,1,1 -n 20;-grid 5"},
    {"cluster", "ply csv", "-attributes f;-attributes x,f;-position"},
    {"project", "ply csv", "-attributes x,y,f;-attributes f,g"},
    {"voronoi", "vti ply", "-grid 8"},
    {"normals", "ply pcd", "-k 9"},
    {"splats", "ply csv", "-delta 0.01"},
    {"render", "png ply", "-size 16x16"},
    {"raytrace", "png", "-size 16x16"},
    {"generate", "ply pcd csv vtp", "-n 20", 0},
    {"convert", "ply pcd csv vtp vtkhdf npz", ""},
    {"info", "", ""},
    {"measure", "csv ply vtp", "-iso 0;-iso 0,0.1;-flat;-check"},
    {"compare", "ply csv", "", 2}};

class RandomOptions : public testing::TestWithParam<RandomTool> {};

TEST_P(RandomOptions, EndInASentenceOrAResult)
{
  RandomLines(GetParam()).run(0, countDefaultLines());
}

TEST_P(RandomOptions, EndInASentenceOrAResult_long)
{
  RandomLines(GetParam()).run(countDefaultLines(), long_lines);
}

INSTANTIATE_TEST_SUITE_P(Tools,
                         RandomOptions,
                         testing::ValuesIn(tools),
                         [](const auto& tool) { return tool.param.name; });

class RandomFrontEnd : public testing::Test {
protected:
  RandomFrontEnd()
  {
    for (RandomTool tool : tools) {
      tool.launcher = std::string("uvol ") + tool.name;
      lines_.emplace_back(tool);
    }
  }

  /** Lines of the tools in turn, and every fourth that names none. */
  void
  run(std::uint64_t first_seed, std::uint64_t count)
  {
    auto tool = lines_.begin();
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
      if (seed % 4 == 3) {
        runWithoutTool(seed);
        continue;
      }
      tool->run(seed, 1);
      if (++tool == lines_.end())
        tool = lines_.begin();
    }
  }

private:
  static void
  runWithoutTool(std::uint64_t seed)
  {
    Random random(seed);
    const std::vector<std::string> first{"",
                                         "help",
                                         "--version",
                                         "--list-formats",
                                         "isosurfac",
                                         "Info",
                                         "../uvol_info",
                                         "uvol_info",
                                         "-",
                                         ".",
                                         "a b",
                                         "\x1b[0m",
                                         "\xff",
                                         std::string(5000, 'a')};
    std::vector<std::string> others = first;
    others.insert(others.end(), {"info", "-json", "none.csv"});
    std::string line = "uvol '" + pick(first, random) + '\'';
    while (random.uniform() < 0.5)
      line += " '" + pick(others, random) + '\'';
    SCOPED_TRACE(line);
    const auto result = uvol_test::runCommand("timeout 20 " + line);
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2) << result.exit_code;
    EXPECT_EQ(result.exit_code == 0, !result.out.empty()) << result.out;
    uvol_test::expectSentences("uvol", result);
  }

  std::list<RandomLines> lines_;
};

TEST_F(RandomFrontEnd, EndsInASentenceOrAResult)
{
  run(0, countDefaultLines());
}

TEST_F(RandomFrontEnd, EndsInASentenceOrAResult_long)
{
  run(countDefaultLines(), long_lines);
}

} // namespace test_random_options
