// SPDX-License-Identifier: BSD-3-Clause
// uvol_generate from the outside: values, bytes, real volumes, wrong command lines.
#include "common/scalar_field.h"
#include "generation/analytic_fields.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace test_uvol_generate {

using uvol_test::runCommand;
using uvol_test::TemporaryFolder;

/** Numbers of some fields, point by point. */
std::vector<std::vector<double>>
findColumns(const std::string& path, const std::vector<std::string>& names)
{
  const pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path);
  std::vector<std::vector<double>> columns;
  for (const auto& name : names) {
    const pcl_uvol::ScalarField field(dataset.cloud.fields, name);
    columns.emplace_back();
    for (std::size_t i = 0; i < dataset.cloud.width; ++i)
      columns.back().push_back(
          field.read(&dataset.cloud.data[i * dataset.cloud.point_step]));
  }
  return columns;
}

TEST(UvolGenerate, ValuesAreThoseOfTheFieldAtTheWrittenPlace)
{
  const TemporaryFolder folder;
  for (const auto& field : pcl_uvol::analyticFields())
    for (const char* samples : {"uniform", "jittered", "lattice", "clustered"}) {
      SCOPED_TRACE(field.name + std::string(" ") + samples);
      const std::string file = folder / "out.pcd";
      const auto result =
          uvol_test::runWell("uvol_generate '" + file + "' -n 1000 -field " +
                             field.name + " -samples " + samples);
      EXPECT_EQ("", result.err);
      const auto columns = findColumns(file, {"x", "y", "z", field.name});
      ASSERT_EQ(1000u, columns[3].size());
      for (std::size_t i = 0; i < 1000; ++i)
        EXPECT_EQ(static_cast<float>(
                      field.value({columns[0][i], columns[1][i], columns[2][i]})),
                  static_cast<float>(columns[3][i]));
    }
}

TEST(UvolGenerate, LinesAreDenserAlongThanAcross)
{
  const TemporaryFolder folder;
  const auto& field = pcl_uvol::findAnalyticField("gyroid");
  for (const std::string samples : {"tracks", "casts", "holes"}) {
    SCOPED_TRACE(samples);
    const std::string file = folder / "out.csv";
    const auto result = uvol_test::runWell(
        "uvol_generate '" + file + "' -n 20000 -field gyroid -samples " + samples);
    EXPECT_EQ("", result.err);
    const std::string line = samples.substr(0, samples.size() - 1);
    const auto columns = findColumns(file, {"x", "y", "z", "gyroid", line});
    ASSERT_EQ(20000u, columns[3].size());
    double lines = 0.0, along = 0.0;
    for (std::size_t i = 0; i < 20000; ++i) {
      const std::array<double, 3> place{columns[0][i], columns[1][i], columns[2][i]};
      EXPECT_NEAR(field.value(place), columns[3][i], 1e-5);
      for (const double coordinate : place) {
        EXPECT_GE(coordinate, field.lower - 1e-5);
        EXPECT_LE(coordinate, field.upper + 1e-5);
      }
      lines = std::max(lines, columns[4][i] + 1.0);
      if (i > 0 && columns[4][i] == columns[4][i - 1])
        along += std::hypot(place[0] - columns[0][i - 1],
                            place[1] - columns[1][i - 1],
                            place[2] - columns[2][i - 1]);
    }
    along /= 20000.0 - lines;
    const double across = (field.upper - field.lower) / std::sqrt(lines);
    const double expected = samples == "holes" ? 25.0 : 10.0;
    EXPECT_NEAR(expected, across / along, 0.2 * expected);
    // The diagnosis sees lines.
    EXPECT_NE(std::string::npos,
              runCommand("uvol_info '" + file + "'").out.find("sampling: lines"));
  }
  EXPECT_NE(std::string::npos, uvol_test::readFile(folder / "out.csv").find("DH-01"));
}

TEST(UvolGenerate, HeldOutLinesArePredictedBetterThanByTheNearestSample)
{
  const TemporaryFolder folder;
  const std::string file = folder / "lines.csv";
  for (const std::string line : {"track", "cast"}) {
    uvol_test::runWell("uvol_generate '" + file + "' -n 8000 -field gyroid -samples " +
                       line + "s");
    const auto scores = uvol_test::jsonOf(runCommand(
        "uvol_isosurface '" + file + "' '" + (folder / "out.ply") +
        "' -field gyroid -iso 0 -json -validate 5 -validate-by " + line))["validation"];
    const auto score = [&](const char* name) { return scores[name].get<double>(); };
    // 0.79 and 0.81 on the right side, the nearest sample 0.72 and 0.76.
    EXPECT_GT(score("near"), 0.95 * 8000) << line;
    EXPECT_GT(score("side"), score("side_of_nearest") + 0.03) << line;
    EXPECT_GT(score("class"), score("class_of_nearest") + 0.03) << line;
    EXPECT_LT(score("side_base"), 0.55) << line;
  }
}

TEST(UvolGenerate, RadialSamplesHaveTheMeanSpacingOfTheThesis)
{
  const TemporaryFolder folder;
  const std::string file = folder / "out.pcd";
  ASSERT_EQ(0, runCommand("uvol_generate '" + file + "' -n 64000").exit_code);
  const auto x = findColumns(file, {"x"}).front();
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  EXPECT_NEAR(40.317, *high - *low, 0.02); // 160 (64000 / 4e6)^(1/3)
}

TEST(UvolGenerate, NoiseHasTheGivenStandardDeviation)
{
  const TemporaryFolder folder;
  const std::string file = folder / "out.pcd";
  uvol_test::runWell("uvol_generate '" + file +
                     "' -n 40000 -field sphere -noise 0.25 -seed 3");
  const auto columns = findColumns(file, {"x", "y", "z", "sphere"});
  double sum = 0.0, sum_sq = 0.0;
  for (std::size_t i = 0; i < 40000; ++i) {
    const double noise =
        columns[3][i] - 1.0 + std::hypot(columns[0][i], columns[1][i], columns[2][i]);
    sum += noise;
    sum_sq += noise * noise;
  }
  EXPECT_NEAR(0.0, sum / 40000, 0.00625); // five standard errors
  EXPECT_NEAR(0.25, std::sqrt(sum_sq / 40000), 0.0045);
}

TEST(UvolGenerate, BytesDependOnTheSeedButNotOnThreads)
{
  const TemporaryFolder folder;
  const std::string a = folder / "a.pcd", b = folder / "b.pcd";
  const std::string job = " -n 50000 -field gyroid -noise 0.1";
  ASSERT_EQ(0, runCommand("uvol_generate '" + a + "'" + job + " -threads 1").exit_code);
  ASSERT_EQ(0, runCommand("uvol_generate '" + b + "'" + job + " -threads 2").exit_code);
  EXPECT_TRUE(uvol_test::readFile(a) == uvol_test::readFile(b));
  ASSERT_EQ(0, runCommand("uvol_generate '" + b + "'" + job + " -seed 2").exit_code);
  EXPECT_FALSE(uvol_test::readFile(a) == uvol_test::readFile(b));
}

TEST(UvolGenerate, ResamplesEveryRealVolume)
{
  const std::string data = uvol_test::dataFolder();
  if (data.empty())
    GTEST_SKIP() << "no real data";
  const TemporaryFolder folder;
  const std::string file = folder / "out.pcd";
  std::size_t volumes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data + "/volumes")) {
    const std::string path = entry.path().string(),
                      ending = entry.path().extension().string();
    if (ending != ".nhdr" && ending != ".vtk")
      continue;
    SCOPED_TRACE(path);
    ++volumes;
    uvol_test::runWell("uvol_generate '" + path + "' '" + file + "' -n 200000");
    const auto volume = pcl_uvol::loadVolume(path);
    const auto columns = findColumns(file, {"x", "y", "z", volume.name});
    ASSERT_EQ(200000u, columns[3].size());
    for (std::size_t i = 0; i < columns[3].size(); i += 1000)
      EXPECT_EQ(static_cast<float>(
                    volume.sample({columns[0][i], columns[1][i], columns[2][i]})),
                static_cast<float>(columns[3][i]));
  }
  EXPECT_EQ(9u, volumes);
}

TEST(UvolGenerate, RefusesWrongCommandLines)
{
  const TemporaryFolder folder;
  const std::string out = "'" + (folder / "out.pcd") + "'";
  const std::pair<std::string, std::string> lines[] = {
      {"", "missing"},
      {out + " -n", "-n"},
      {out + " -n 0", "-n"},
      {out + " -n 1.5", "1.5"},
      {out + " -n -3", "-3"},
      {out + " -noise -1", "-noise"},
      {out + " -noise nan", "nan"},
      {out + " -noise 1.5m", "1.5m"},
      {out + " -samples some", "some"},
      {out + " -sample uniform", "did you mean -samples"},
      {out + " -seed 1 -seed 2", "twice"},
      {"a.nhdr " + out + " leftover", "leftover"},
      {"a.nhdr " + out + " -field star", "-field"}};
  for (const auto& [line, text] : lines) {
    const auto result = runCommand("uvol_generate " + line);
    EXPECT_EQ(2, result.exit_code) << line;
    EXPECT_NE(std::string::npos, result.err.find(text)) << result.err;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  }
  EXPECT_TRUE(folder.list().empty());
}

TEST(UvolGenerate, FailuresLeaveNoFile)
{
  const TemporaryFolder folder;
  const std::string out = "'" + (folder / "out.pcd") + "'";
  for (const std::string& command :
       {"uvol_generate " + out + " -field blob",
        "uvol_generate '" + (folder / "none.nhdr") + "' " + out,
        "uvol_generate '" + (folder / "none.ply") + "' " + out,
        "uvol_generate '" + (folder / "out.unknown") + "'",
        "ulimit -f 8; uvol_generate " + out + " -n 10000"}) {
    const auto result = runCommand(command);
    EXPECT_EQ(1, result.exit_code) << command;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  }
  EXPECT_TRUE(folder.list().empty());
}

TEST(UvolGenerate, AFullStandardOutputIsAFailure)
{
  const TemporaryFolder folder;
  const auto result =
      runCommand("uvol_generate '" + (folder / "out.pcd") + "' -n 10 >/dev/full");
  EXPECT_EQ(1, result.exit_code);
}

} // namespace test_uvol_generate
