// SPDX-License-Identifier: BSD-3-Clause
// Fields between samples from the outside: every kind of query, every output, and what
// is refused.
#include "support/png.h"
#include "tool_test.h"
#include "tools/json_warnings.h"
#include <pcl_uvol/io/dataset.h>

#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace test_uvol_probe {

using namespace uvol_test;
using Values = std::vector<double>;
using Json = nlohmann::json;

double
cubic(double x, double y, double z)
{
  return x * x * x - 2.0 * x * y * z + z * z + 1.0;
}

/** Samples in the unit cube with a cubic, which fits are exact for, a smooth field and
 * a constant. */
class ProbeTool : public ToolTest {
protected:
  ProbeTool()
      : ToolTest("uvol_probe", "out.csv")
  {
    writeSamples(in_, 3000, 1.0, 0.0);
  }

  static void
  writeSamples(const std::string& path, int count, double factor, double shift)
  {
    Random random(1);
    std::ostringstream text;
    text.precision(17);
    text << "x,y,z,cubic,wave,same,hole\n";
    for (int i = 0; i < count; ++i) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      text << factor * x + shift << ',' << factor * y << ',' << factor * z << ','
           << cubic(x, y, z) << ',' << std::sin(3.0 * x + y) << ",7.5," << i % 20
           << '\n';
    }
    writeFile(path, text.str());
  }

  Json
  reportOf(const std::string& options) const
  {
    const auto result = run(options + " -json");
    EXPECT_EQ(0, result.exit_code) << options << ": " << result.err;
    return Json::parse(result.out);
  }

  std::string
  bytesOf(const std::string& options) const
  {
    expectSuccess(options);
    return readFile(out_);
  }

  CommandResult
  runTo(const std::string& output, const std::string& options) const
  {
    return runCommand(tool_ + " " + in_ + " " + (folder_ / output) + " " + options);
  }
};

TEST_F(ProbeTool, PointsKeepTheirRowsAndColumns)
{
  writeFile(folder_ / "points.csv",
            "name,z,y,x,cubic\n"
            "7,0.5,0.25,0.5,100\n"
            "3,0.125,0.75,0.5,200\n"
            "5,nan,0.5,0.5,300\n"
            "5,0.5,3,0.5,400\n");
  const auto report = reportOf("-field cubic,wave -points " + (folder_ / "points.csv"));
  const auto result = pcl_uvol::loadDataset(out_);
  EXPECT_EQ(fieldOf(result, "name"), (Values{7, 3, 5, 5}));
  EXPECT_EQ(fieldOf(result, "cubic"), (Values{100, 200, 300, 400}));
  const Values values = fieldOf(result, "cubic_2"), waves = fieldOf(result, "wave"),
               support = fieldOf(result, "support");
  EXPECT_NEAR(values[0], cubic(0.5, 0.25, 0.5), 1e-7);
  EXPECT_NEAR(values[1], cubic(0.5, 0.75, 0.125), 1e-7);
  EXPECT_NEAR(waves[0], std::sin(1.75), 1e-4);
  EXPECT_TRUE(std::isnan(values[2]) && std::isnan(values[3]));
  EXPECT_EQ(support, (Values{1, 1, 6, 7}));
  EXPECT_EQ(fieldOf(result, "wave_error").size(), 4u);
  EXPECT_GT(report["sampling"]["volume"], 0.9);
  EXPECT_EQ(report["counts"]["invalid"], 1);
  EXPECT_EQ(report["counts"]["outside"], 1);
  EXPECT_EQ(report["appended_fields"],
            "cubic_2, cubic_2_error, wave, wave_error, support");
}

TEST_F(ProbeTool, MeshesKeepTheirFaces)
{
  writeFile(
      folder_ / "mesh.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
      "y\nproperty float z\nproperty uchar tag\nelement face 1\nproperty list "
      "uchar int vertex_indices\nend_header\n0.2 0.2 0.5 9\n0.8 0.2 0.5 8\n0.8 0.8 "
      "0.5 7\n0.2 0.8 0.5 6\n4 0 1 2 3\n");
  succeeded(
      runTo("out.ply", "-field cubic -points " + (folder_ / "mesh.ply") + " -ascii"));
  std::vector<pcl_uvol::Triangle> triangles;
  const auto mesh = pcl_uvol::loadMesh(folder_ / "out.ply", triangles);
  EXPECT_EQ(triangles, (std::vector<pcl_uvol::Triangle>{{{0, 1, 2}}, {{0, 2, 3}}}));
  EXPECT_EQ(fieldOf(mesh, "tag"), (Values{9, 8, 7, 6}));
  EXPECT_NEAR(fieldOf(mesh, "cubic")[2], cubic(0.8, 0.8, 0.5), 1e-6);
}

TEST_F(ProbeTool, LinesHaveDistances)
{
  const auto result =
      resultOf("-field cubic -line 0.2,0.5,0.5,0.8,0.5,0.5 -n 31 -png " +
               (folder_ / "line.png"));
  const Values distances = fieldOf(result, "distance"), x = fieldOf(result, "x"),
               values = fieldOf(result, "cubic");
  ASSERT_EQ(distances.size(), 31u);
  for (std::size_t i = 0; i < 31; ++i) {
    EXPECT_NEAR(distances[i], 0.02 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(x[i], 0.2 + distances[i], 1e-6);
    EXPECT_NEAR(values[i], cubic(0.2 + distances[i], 0.5, 0.5), 1e-6);
  }
  int channels = 0;
  EXPECT_EQ(readPng(folder_ / "line.png", channels).width, 720u);
}

TEST_F(ProbeTool, GridsAreTheFieldInEveryFormat)
{
  for (const std::string ending : {".vti", ".nrrd", ".mha"}) {
    SCOPED_TRACE(ending);
    succeeded(runTo("grid" + ending,
                    "-field cubic -grid 9x5x3 -box 0.2,0.2,0.3,0.8,0.8,0.7"));
    const auto volume = pcl_uvol::loadVolume(folder_ / ("grid" + ending));
    ASSERT_EQ(volume.dims, (std::array<std::size_t, 3>{9, 5, 3}));
    EXPECT_NEAR(volume.values[1 + 9 * (2 + 5 * 2)], cubic(0.275, 0.5, 0.7), 1e-6);
    EXPECT_NEAR(volume.upper()[1], 0.8, 1e-12);
  }
  EXPECT_NEAR(pcl_uvol::loadVolume(folder_ / "grid_support.mha").values[70], 1.0, 0.0);
  ASSERT_EQ(0,
            runTo("grid.vts",
                  "-field cubic -grid 9x5x3 -box 0.2,0.2,0.3,0.8,0.8,0.7 -gradients")
                .exit_code);
  const auto points = pcl_uvol::loadDataset(folder_ / "grid.vts");
  const Values x = fieldOf(points, "x"), y = fieldOf(points, "y"),
               z = fieldOf(points, "z"), values = fieldOf(points, "cubic"),
               along = fieldOf(points, "cubic_gradient[1]");
  ASSERT_EQ(values.size(), 135u);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], cubic(x[i], y[i], z[i]), 1e-6);
    EXPECT_NEAR(along[i], -2.0 * x[i] * z[i], 1e-5);
  }
}

TEST_F(ProbeTool, OutsideThereIsNoValueUnlessAskedFor)
{
  const std::string far = "-field cubic -line 0.5,0.5,0.5,0.5,0.5,3 -n 11";
  const auto outside = succeeded(run(far + " -json"));
  EXPECT_TRUE(uvol_test::hasMessage(outside, "queries_outside")) << outside.out;
  const Values values = fieldOf(pcl_uvol::loadDataset(out_), "cubic");
  EXPECT_FALSE(std::isnan(values[0]));
  EXPECT_TRUE(std::isnan(values[10]));
  EXPECT_FALSE(std::isnan(fieldOf(resultOf(far + " -extrapolate"), "cubic")[10]));
}

TEST_F(ProbeTool, ThreadsOrderAndUnitsDoNotMatter)
{
  const std::string slice = "-field wave -plane 0.5,0.5,0.5,1,1,2 -size 60";
  EXPECT_EQ(bytesOf(slice + " -threads 1"), bytesOf(slice + " -threads 3"));
  writeFile(folder_ / "a.csv", "x,y,z\n0.5,0.25,0.5\n0.7,0.2,0.1\n0.4,0.4,0.9\n");
  writeFile(folder_ / "b.csv", "x,y,z\n0.4,0.4,0.9\n0.5,0.25,0.5\n0.7,0.2,0.1\n");
  const Values a = fieldOf(resultOf("-field wave -points " + (folder_ / "a.csv")),
                           "wave"),
               b = fieldOf(resultOf("-field wave -points " + (folder_ / "b.csv")),
                           "wave");
  EXPECT_EQ(a, (Values{b[1], b[2], b[0]}));
  // In another unit, and beside an origin that float does not hold.
  const std::string line = "-field wave -n 9 -line ";
  const Values here = fieldOf(resultOf(line + "0.25,0.5,0.5,0.75,0.5,0.5"), "wave");
  writeSamples(in_, 3000, 1024.0, 0.0);
  EXPECT_EQ(here, fieldOf(resultOf(line + "256,512,512,768,512,512"), "wave"));
  writeSamples(in_, 3000, 1.0, 1e7);
  const Values there =
      fieldOf(resultOf(line + "10000000.25,0.5,0.5,10000000.75,0.5,0.5"), "wave");
  for (std::size_t i = 0; i < here.size(); ++i)
    EXPECT_NEAR(here[i], there[i], 1e-6);
}

TEST_F(ProbeTool, PlanesBecomePictures)
{
  succeeded(runTo("slice.vti",
                  "-field wave -plane z=0.5 -size 64 -contours 0,0.5 -samples "
                  "0.01 -unit m -png " +
                      (folder_ / "slice.png")));
  const auto volume = pcl_uvol::loadVolume(folder_ / "slice.vti");
  EXPECT_EQ(volume.dims[2], 1u);
  EXPECT_EQ(std::max(volume.dims[0], volume.dims[1]), 64u);
  EXPECT_EQ(volume.origin[2], 0.5);
  int channels = 0;
  const auto image = readPng(folder_ / "slice.png", channels);
  EXPECT_GT(image.width, 512u);
  EXPECT_GT(image.height, 512u);
}

TEST_F(ProbeTool, HeldOutSamplesShowHowGoodItIs)
{
  const auto fit =
      reportOf("-field cubic,wave -line 0.1,0.1,0.1,0.9,0.9,0.9 -validate 5"
               " -validate-by hole");
  EXPECT_LT(fit["validation"]["cubic"]["rms"], 1e-6);
  EXPECT_LT(fit["validation"]["wave"]["rms"], 1e-3);
  EXPECT_EQ(fit["validation"]["wave"]["tested"], 3000);
  // Without an output nothing is asked for.
  const auto alone = runWell(tool_ + " " + in_ +
                             " -field wave -validate 4 "
                             "-validate-by blocks -model nearest -json");
  EXPECT_LT(Json::parse(alone.out)["validation"]["wave"]["rms"], 1.0);
  const auto automatic =
      reportOf("-field wave -line 0.1,0.1,0.1,0.9,0.9,0.9 -model auto");
  EXPECT_EQ(automatic["model"], "fit");
  EXPECT_GT(automatic["compared_models"]["nearest"],
            automatic["compared_models"]["natural"]);
}

TEST_F(ProbeTool, ConstantsHaveNoVariogram)
{
  const auto result = succeeded(
      run("-field same -line 0.2,0.2,0.2,0.8,0.8,0.8 -n 5 -model kriging -json"));
  const auto warnings = Json::parse(result.out).at("warnings");
  ASSERT_EQ(1u, warnings.size()) << result.out;
  EXPECT_EQ("no_variogram", warnings[0].at("code"));
  const auto points = pcl_uvol::loadDataset(out_);
  EXPECT_EQ(fieldOf(points, "same"), Values(5, 7.5));
  EXPECT_EQ(fieldOf(points, "same_error"), Values(5, 0.0));
}

TEST_F(ProbeTool, VariogramsArePrintedWrittenAndDrawn)
{
  const std::string outputs = " -variogram-csv " + (folder_ / "v.csv") +
                              " -variogram-png " + (folder_ / "v.png");
  const std::string kriging = " -field wave,cubic -model kriging";
  const auto tell = [&](const std::string& options) {
    const auto result = runWell(tool_ + " " + in_ + kriging + options + " -json");
    return Json::parse(result.out)["variograms"];
  };
  const Json given = tell(outputs + " -variogram exponential,0.5,2,0.25");
  EXPECT_EQ(given["wave"],
            (Json{{"kind", "exponential"},
                  {"nugget", 0.5},
                  {"psill", 2.0},
                  {"range", given["wave"]["range"]},
                  {"pairs", given["wave"]["pairs"]}}));
  EXPECT_GT(given["wave"]["pairs"], 10000);
  EXPECT_NEAR(given["wave"]["range"], 0.25, 1e-12);
  EXPECT_EQ(given.size(), 2u);
  std::istringstream table(readFile(folder_ / "v.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "direction,distance,half_mean_square,pairs,model");
  std::map<std::string, int> rows;
  for (std::string cell; std::getline(table, line);) {
    std::istringstream cells(line);
    std::getline(cells, cell, ',');
    ++rows[cell];
    const bool is_of_all = cell == "all";
    std::vector<double> numbers;
    while (std::getline(cells, cell, ','))
      numbers.push_back(std::stod(cell));
    ASSERT_EQ(4u, numbers.size());
    EXPECT_GE(numbers[2], is_of_all ? 30.0 : 1.0); // fewer pairs make no class
    EXPECT_NEAR(numbers[3], 2.5 - 2.0 * std::exp(-numbers[0] / 0.25), 1e-7);
  }
  EXPECT_LE(rows["all"], 24);
  EXPECT_GE(rows["all"], 15);
  EXPECT_EQ(4u, rows.size());
  EXPECT_TRUE(rows.count("x") == 1 && rows.count("y") == 1 && rows.count("z") == 1);
  int channels = 0;
  EXPECT_EQ(720u, readPng(folder_ / "v.png", channels).width);
  // In another unit of length the range is that in this unit.
  const std::string any = " -variogram-csv " + (folder_ / "v.csv");
  const Json fitted = tell(any)["wave"];
  writeSamples(in_, 3000, 1024.0, 0.0);
  const Json larger = tell(any)["wave"];
  const double range = fitted["range"], sill = fitted["psill"];
  EXPECT_NEAR(larger["range"], 1024.0 * range, 1.024 * range);
  EXPECT_NEAR(larger["psill"], sill, 1e-3 * sill);
}

TEST_F(ProbeTool, FewSamplesGetASimplerModel)
{
  writeFile(in_, "x,y,z,v\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n");
  const auto result = resultOf("-line 0.1,0.1,0.1,0.3,0.3,0.3 -n 3 -extrapolate");
  for (const double value : fieldOf(result, "v")) {
    EXPECT_GE(value, 1.0);
    EXPECT_LE(value, 4.0);
  }
}

TEST_F(ProbeTool, AllFieldsAreThoseOfTheSamples)
{
  const auto report = reportOf("-field all -line 0.2,0.2,0.2,0.8,0.8,0.8 -n 3");
  EXPECT_EQ(report["ranges"].size(), 4u);
  EXPECT_EQ(report["ranges"]["same"]["min"], 7.5);
  EXPECT_EQ(2, run("-field all -line 0,0,0,0,0,0 -n").exit_code);
}

TEST_F(ProbeTool, FieldsMayBeExpressions)
{
  // At a sample the model is the sample's own value, of the expression as well.
  const std::string place = folder_ / "place.csv";
  writeFile(place, "x,y,z\n0.5,0.5,0.5\n");
  const std::string header =
      bytesOf("-points " + place + " -field '2*cubic+1,|grad(cubic)|,cubic'");
  std::istringstream lines(header);
  std::string names, values;
  std::getline(lines, names);
  std::getline(lines, values);
  EXPECT_EQ(0u, names.find("x,y,z,2*cubic+1,2*cubic+1_error,|grad(cubic)|"));
  std::vector<double> numbers;
  std::istringstream words(values);
  for (std::string word; std::getline(words, word, ',');)
    numbers.push_back(std::stod(word));
  ASSERT_EQ(10u, numbers.size());
  EXPECT_NEAR(2.0 * numbers[7] + 1.0, numbers[3], 1e-5);
  EXPECT_NEAR(cubic(0.5, 0.5, 0.5), numbers[7], 1e-5);
  expectError("-line 0,0,0,1,1,1 -n 5 -field '2*cubik'",
              "unknown_operand",
              R"("similar":"cubic")");
}

TEST_F(ProbeTool, ReportsValuesThatHaveNoLogarithm)
{
  const std::string plane =
      "-field wave -plane z=0.5 -size 20 -png " + (folder_ / "a.png");
  const auto logarithmic = succeeded(run(plane + " -json -log"));
  EXPECT_TRUE(uvol_test::hasMessage(logarithmic, "no_logarithms") ||
              uvol_test::hasMessage(logarithmic, "grey_places"))
      << logarithmic.out;
  const auto linear = succeeded(run(plane + " -json"));
  EXPECT_FALSE(uvol_test::hasMessage(linear, "no_logarithms") ||
               uvol_test::hasMessage(linear, "grey_places"));
}

TEST_F(ProbeTool, RefusesNonsense)
{
  const std::string line = "-field wave -line 0,0,0,1,1,1 ";
  const std::string kriging = line + "-model kriging ", field = "-field wave ",
                    png = "-png " + (folder_ / "a.png"),
                    variogram = "-variogram-csv " + (folder_ / "v.csv");
  expectError(field, "command_line", "-grid");
  expectUsageErrors(line,
                    {"-grid 8",
                     "-model cubic",
                     "-modle fit",
                     "-n 1",
                     "-size 9",
                     "-k 9",
                     "-power 2",
                     "-block 1,1,1",
                     "-contours 1",
                     "-log " + png,
                     "-validate-by random",
                     variogram});
  expectUsageErrors(kriging, {"-variogram cubic", "-variogram gaussian,1,2"});
  expectUsageErrors(field,
                    {png + " -grid 8",
                     "-plane w=3",
                     "-plane 1,2,3,0,0,0",
                     "-size 4x4x4 -plane z=3",
                     "-grid 8x8",
                     "-validate 1 -points " + in_});
  expectError("-field wave,, -grid 8", "command_line", "-field");
  expectError(field + "-points " + out_, "command_line", "out.csv");
  expectError(field + "-model kriging -points " + in_ + "2.csv -variogram-csv " + in_ +
                  "2.csv",
              "command_line",
              "2.csv");
  expectError(kriging + "-block 1,-1,1", "interpolation_number", "block");
  expectError(kriging + "-variogram gaussian,1,2,-3",
              "interpolation_number",
              "range of the variogram");
  expectError("-field same -line 0,0,0,1,1,1 -model kriging " + variogram,
              "no_variogram_of_constant");
  expectError(field + "-plane z=3", "plane_misses_data");
  expectError(field + "-grid 8 -box 0,0,0,-1,1,1", "unordered_box");
  expectError("-field rho -grid 8", "unknown_lone_field", R"("rho")");
  expectError("-grid 8", "several_scalar_fields");
  expectError(field + "-line 1,1,1,1,1,1", "line_without_ends");
  expectError(line + "-validate 21 -validate-by hole", "folds_not_allowed", "hole");
  expectError(field + "-points " + (folder_ / "none.csv"), "no_such_file", "none.csv");
  EXPECT_EQ(2, runCommand(tool_ + " " + in_ + " " + in_ + " " + line).exit_code);
  EXPECT_EQ(2, runCommand(tool_ + " " + in_ + " " + line).exit_code);
  EXPECT_EQ(1, runTo("out.xyz", line).exit_code);
  EXPECT_EQ(1, runTo("line.vti", line).exit_code);
}

} // namespace test_uvol_probe
