// SPDX-License-Identifier: BSD-3-Clause
// uvol_measure from the outside: figures of known bodies, tables, curves, refusals; and
// -measure of uvol_isosurface.
#include "support/environment.h"
#include "support/png.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

namespace test_uvol_measure {

using Json = nlohmann::json;
using uvol_test::CommandResult;
using uvol_test::fieldOf;
using uvol_test::readFile;
using uvol_test::runCommand;

class MeasureTool : public uvol_test::ToolTest {
protected:
  MeasureTool()
      : ToolTest("uvol_measure", "out.csv")
  {
  }

  /** Balls about the origin: rho = 1 - r, and a mass of 0.5. */
  void
  SetUp() override
  {
    uvol_test::Random random(2);
    std::ostringstream csv;
    csv << "x,y,z,rho,mass\n";
    for (int i = 0; i < 20000; ++i) {
      double sq_radius = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double x = 2.0 * random.uniform() - 1.0;
        csv << x << ',';
        sq_radius += x * x;
      }
      csv << 1.0 - std::sqrt(sq_radius) << ",0.5\n";
    }
    uvol_test::writeFile(in_, csv.str());
  }

  /** The report of a run without a table. */
  Json
  reportOf(const std::string& arguments) const
  {
    const CommandResult result =
        uvol_test::runWell("uvol_measure " + arguments + " -json");
    return Json::parse(result.out);
  }

  const std::string mesh_ = folder_ / "mesh.ply", picture_ = folder_ / "out.png";
};

TEST_F(MeasureTool, MeasuresIsosurfacesOfSamples)
{
  const Json surfaces = reportOf(in_ + " -field rho -iso 0.1:0.2:0.5")["surfaces"];
  ASSERT_EQ(3u, surfaces["isovalue"].size());
  for (std::size_t i = 0; i < 3; ++i) {
    const double radius = 0.9 - 0.2 * static_cast<double>(i);
    EXPECT_NEAR(1.0 - radius, surfaces["isovalue"][i].get<double>(), 1e-15);
    for (const auto& [name, truth] :
         {std::pair{"area", 4.0 * M_PI * radius * radius},
          {"volume", 4.0 / 3.0 * M_PI * std::pow(radius, 3)},
          {"rho_volume_integral",
           4.0 * M_PI * (std::pow(radius, 3) / 3.0 - std::pow(radius, 4) / 4.0)}}) {
      const double value = surfaces[name][i],
                   error = surfaces[std::string(name) + "_error"][i];
      EXPECT_LE(std::abs(value - truth), error) << name;
      EXPECT_LT(error, 0.02 * truth) << name;
    }
    EXPECT_EQ(0, surfaces["genus"][i]);
    EXPECT_EQ(0.5 * surfaces["samples"][i].get<double>(),
              surfaces["mass_sample_sum"][i].get<double>());
  }
}

TEST_F(MeasureTool, WritesATableOfSurfacesAndPieces)
{
  const pcl_uvol::Dataset table = resultOf("-field rho -iso 0.3,0.5 -pieces");
  EXPECT_EQ(4u, table.cloud.width);
  const std::vector<double> isovalues = fieldOf(table, "isovalue");
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(i % 2 == 0 ? 0.3 : 0.5, isovalues[i], 1e-7);
  EXPECT_EQ((std::vector<double>{-1, -1, 0, 1}), fieldOf(table, "piece"));
  for (const char* const axis : {"x", "y", "z"})
    for (const double place : fieldOf(table, axis))
      EXPECT_NEAR(0.0, place, 1e-3);
  const auto volumes = fieldOf(table, "volume");
  EXPECT_EQ(volumes[0], volumes[2]);
  EXPECT_NEAR(4.0 / 3.0 * M_PI * 0.343, volumes[0], 1e-3);
  for (const double half_axis : fieldOf(table, "half_axis_3"))
    EXPECT_TRUE(std::abs(half_axis - 0.7) < 1e-3 || std::abs(half_axis - 0.5) < 1e-3);
}

/** A made or real file with an awkward property; empty where these are not there. */
std::string
findForeignFile(const std::string& name)
{
  const std::string path = uvol_test::dataFolder() + "/../wild/" + name;
  return std::ifstream(path).good() ? path : "";
}

TEST_F(MeasureTool, NamesDebrisAndLeavesItOut)
{
  const std::string debris = findForeignFile("made/c29_debris.csv");
  if (debris.empty())
    GTEST_SKIP() << "the folder of awkward files is not there";
  const Json all = reportOf(debris + " -field rho -iso 0.8");
  EXPECT_GE(all["surfaces"]["volume"].get<double>(), 0.0);
  const Json warned = uvol_test::warnedValues(all, "uncertain_pieces");
  ASSERT_TRUE(warned.is_object()) << all;
  EXPECT_EQ(2, warned["uncertain"]) << all;
  EXPECT_EQ(3, warned["pieces"]) << all;
  const Json body =
      reportOf(debris + " -field rho -iso 0.8 -drop-uncertain")["surfaces"];
  EXPECT_NEAR(0.503, body["area"].get<double>(), 0.001);
  EXPECT_NEAR(0.0335, body["volume"].get<double>(), 0.0001);
}

TEST_F(MeasureTool, PrintsNoNumberThatIsNotFiniteOrWrapped)
{
  std::ostringstream csv; // a disc in a plane
  csv << "x,y,z,f\n";
  uvol_test::Random random(4);
  for (int i = 0; i < 1200; ++i) {
    const double x = random.uniform(), y = random.uniform();
    csv << x << ',' << y << ",53," << std::hypot(x - 0.5, y - 0.5) << '\n';
  }
  uvol_test::writeFile(in_, csv.str());
  std::vector<std::string> inputs = {in_ + " -field f"};
  for (const char* const name : {"made/c22_coplanar.csv -field f",
                                 "made/c26_axes_differ.csv -field f -scale auto"})
    if (!findForeignFile(std::string(name).substr(0, std::string(name).find(' ')))
             .empty())
      inputs.push_back(uvol_test::dataFolder() + "/../wild/" + name);
  for (const std::string& input : inputs)
    for (const char* const form : {"", " -json"}) {
      const CommandResult result = uvol_test::runWell(
          "uvol_measure " + input + " -iso 0.3 -outside higher" + form);
      for (const char* const wrong : {" nan", "-nan", " inf", "1844674407"})
        EXPECT_EQ(std::string::npos, result.out.find(wrong)) << result.out;
    }
  const Json flat = reportOf(in_ + " -field f -iso 0.3 -outside higher");
  EXPECT_EQ(0.0, flat["surfaces"]["volume"].get<double>());
  EXPECT_EQ(0.0, flat["surfaces"]["samples"].get<double>());
  EXPECT_TRUE(uvol_test::hasWarning(flat, "flat_surfaces")) << flat;
}

TEST_F(MeasureTool, SumsSamplesBeyondTheIsovalue)
{
  const Json open = reportOf(in_ + " -field rho -iso 0.5")["surfaces"];
  const double beyond = open["samples_beyond"];
  EXPECT_EQ(0.5 * beyond, open["mass_beyond_sum"].get<double>());
  EXPECT_NEAR(beyond, open["samples"].get<double>(), 0.02 * beyond);
  uvol_test::runWell("uvol_isosurface " + in_ + " " + mesh_ +
                     " -field rho -iso 0.5 -mesh");
  const Json known = reportOf(mesh_ + " -samples " + in_ + " -field rho")["surfaces"];
  EXPECT_EQ(beyond, known["samples_beyond"].get<double>());
  const Json unknown = reportOf(mesh_ + " -samples " + in_)["surfaces"];
  EXPECT_FALSE(unknown.contains("samples_beyond"));
}

TEST_F(MeasureTool, MeasuresThroughAPeriodicBox)
{
  // A ball about the corner of a box from -1 to 1: rho is higher near the corner.
  uvol_test::Random random(6);
  std::ostringstream csv;
  csv << "x,y,z,rho,mass\n";
  for (int i = 0; i < 8000; ++i) {
    double sq_radius = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = 2.0 * random.uniform() - 1.0;
      csv << x << ',';
      sq_radius += std::pow(1.0 - std::abs(x), 2);
    }
    csv << 1.0 - std::sqrt(sq_radius) << ",0.5\n";
  }
  uvol_test::writeFile(in_, csv.str());
  const Json ball = reportOf(in_ + " -field rho -iso 0.4 -periodic 2,2,2");
  const double volume = 4.0 / 3.0 * M_PI * 0.216;
  const Json& surfaces = ball["surfaces"];
  EXPECT_NEAR(volume, surfaces["volume"].get<double>(), 0.005 * volume);
  EXPECT_EQ(0, surfaces["rims"]);
  EXPECT_FALSE(ball["pieces"]["piece"].is_array()) << "more than one piece";
  EXPECT_NEAR(surfaces["mass_beyond_sum"].get<double>(),
              surfaces["mass_sample_sum"].get<double>(),
              0.03 * surfaces["mass_beyond_sum"].get<double>());
  const auto warningsOf = [&](const std::string& sides) {
    return runCommand("uvol_measure " + in_ + " -field rho -iso 0.4 -json -periodic " +
                      sides);
  };
  EXPECT_FALSE(uvol_test::hasMessage(warningsOf("2,2,2"), "samples_beyond_box"));
  EXPECT_TRUE(uvol_test::hasMessage(warningsOf("1,2,2"), "samples_beyond_box"));
  EXPECT_EQ(2, runCommand("uvol_measure " + in_ + " -iso 0.4 -periodic 2,2").exit_code);
  EXPECT_EQ(1,
            runCommand("uvol_measure " + in_ + " -field rho -iso 0.4 -periodic header")
                .exit_code);
}

TEST_F(MeasureTool, SumsMassesOfASnapshotThroughItsBox)
{
  const std::string snapshot =
      findForeignFile("real/gadget4_lcdm_gas_snapshot_002.hdf5");
  if (snapshot.empty())
    GTEST_SKIP() << "the folder of awkward files is not there";
  const Json all =
      reportOf(snapshot + " -field Density -iso 1e-9 -periodic header")["surfaces"];
  EXPECT_NEAR(98495.0, all["Masses_beyond_sum"].get<double>(), 1.0);
  EXPECT_NEAR(98495.0, all["Masses_sample_sum"].get<double>(), 500.0);
}

TEST_F(MeasureTool, EstimatesVolumesOfBlocks)
{
  const std::string blocks = " -field rho -iso 0.1,0.3,0.5 -block 0.1,0.1,0.1";
  expectSuccess(blocks + " -png " + picture_ + " -plot rho_volume_mean");
  const auto volumes = fieldOf(pcl_uvol::loadDataset(out_), "volume");
  ASSERT_EQ(3u, volumes.size());
  const Json report = reportOf(in_ + blocks);
  EXPECT_EQ(8000.0, report["blocks"]["all"]);
  EXPECT_GT(report["blocks"]["estimated"], 7500.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double radius = 0.9 - 0.2 * static_cast<double>(i);
    const double truth = 4.0 / 3.0 * M_PI * std::pow(radius, 3);
    EXPECT_NEAR(truth, volumes[i], 0.02 * truth);
    EXPECT_NEAR(1.0 - 0.75 * radius, report["beyond"]["rho_volume_mean"][i], 0.01);
    EXPECT_GT(report["beyond"]["volume_error"][i], 0.0);
  }
}

TEST_F(MeasureTool, DrawsCurves)
{
  expectSuccess("-field rho -iso 0.05:0.8:5log -png " + picture_ +
                " -plot mass_sample_sum");
  int channels = 0;
  const auto image = uvol_test::readPng(picture_, channels);
  EXPECT_EQ(720u, image.width);
  EXPECT_EQ(440u, image.height);
}

TEST_F(MeasureTool, MeasuresMeshesAsTheSamplesTheyCameFrom)
{
  const Json told = uvol_test::jsonOf(
                 runCommand("uvol_isosurface " + in_ + " " + mesh_ +
                            " -field rho -iso 0.3 -mesh -measure -json"))["surfaces"],
             measured = reportOf(mesh_ + " -samples " + in_)["surfaces"];
  for (const char* const name :
       {"area", "volume", "samples", "rho_volume_integral", "mass_sample_sum"})
    EXPECT_EQ(told[name], measured[name]) << name;
  // Shares of the area, whose sums are integrals.
  std::vector<pcl_uvol::Triangle> triangles;
  const auto areas = fieldOf(pcl_uvol::loadMesh(mesh_, triangles), "area");
  const double area = told["area"];
  EXPECT_NEAR(area, std::accumulate(areas.begin(), areas.end(), 0.0), 1e-9);
  // Flat triangles lie within the ball.
  EXPECT_LT(reportOf(mesh_ + " -flat")["surfaces"]["volume"].get<double>(),
            0.999 * measured["volume"].get<double>());
}

TEST_F(MeasureTool, MeasuresIsopointsWithoutAMesh)
{
  const std::string points = folder_ / "points.csv";
  const Json told = uvol_test::jsonOf(
      runCommand("uvol_isosurface " + in_ + " " + points +
                 " -field rho -iso 0.3,0.5 -measure -json"))["surfaces"];
  const pcl_uvol::Dataset surface = pcl_uvol::loadDataset(points);
  const auto areas = fieldOf(surface, "area"), pieces = fieldOf(surface, "piece");
  double sums[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < areas.size(); ++i)
    sums[static_cast<std::size_t>(pieces.at(i))] += areas[i];
  for (std::size_t i = 0; i < 2; ++i) {
    const double radius = i == 0 ? 0.7 : 0.5;
    const double area = told["area"][i], volume = told["volume"][i];
    EXPECT_NEAR(area, sums[i], 1e-9);
    EXPECT_NEAR(
        4.0 * M_PI * radius * radius, area, told["area_error"][i].get<double>());
    EXPECT_NEAR(4.0 / 3.0 * M_PI * std::pow(radius, 3),
                volume,
                told["volume_error"][i].get<double>());
    EXPECT_LT(told["volume_error"][i].get<double>(), 0.01 * volume);
    EXPECT_TRUE(told["genus"][i].is_null());
  }
  const Json measured = reportOf(points)["surfaces"];
  EXPECT_EQ(told["area"], measured["area"]);
  // Pieces that wait on the disk are not measured.
  EXPECT_EQ(2,
            runCommand("uvol_isosurface " + in_ + " " + points +
                       " -field rho -iso 0.3 -measure -max-memory 1G")
                .exit_code);
}

TEST_F(MeasureTool, MeasuresMeshesOfAllFormats)
{
  double flat = 0.0;
  for (const char* const name : {"m.ply", "m.vtp", "m.obj", "m.off", "m.stl"}) {
    const std::string mesh = folder_ / name;
    uvol_test::runWell("uvol_isosurface " + in_ + " " + mesh +
                       " -field rho -iso 0.3 -mesh");
    const Json surfaces = reportOf(mesh + " -flat")["surfaces"];
    if (flat == 0.0)
      flat = surfaces["volume"];
    EXPECT_NEAR(flat, surfaces["volume"].get<double>(), 1e-6) << name;
    EXPECT_EQ(0, surfaces["genus"]) << name;
    EXPECT_EQ(0, surfaces["rims"]) << name;
  }
}

TEST_F(MeasureTool, PrintsAReportForPeople)
{
  const CommandResult result = uvol_test::succeeded(run("-field rho -iso 0.5"));
  for (const char* const part : {"surface at 0.5: area 3.14",
                                 "volume 0.523",
                                 "1 piece, genus 0",
                                 "samples inside",
                                 "mass inside at 0.5",
                                 "half axes at 0.5: 0.5"})
    EXPECT_NE(std::string::npos, result.out.find(part)) << part << result.out;
}

TEST_F(MeasureTool, SameBytesForAnyNumberOfThreads)
{
  std::string first;
  for (const char* const threads : {"1", "2", "5"}) {
    expectSuccess(std::string("-field rho -iso 0.2,0.4 -threads ") + threads);
    if (first.empty())
      first = readFile(out_);
    EXPECT_EQ(first, readFile(out_)) << threads;
  }
}

TEST_F(MeasureTool, OpenMeshesHaveNoVolume)
{
  uvol_test::writeFile(mesh_,
                       "ply\nformat ascii 1.0\nelement vertex 3\n"
                       "property float x\nproperty float y\nproperty float z\n"
                       "element face 1\nproperty list uchar int vertex_indices\n"
                       "end_header\n0 0 0\n2 0 0\n0 3 0\n3 0 1 2\n");
  const CommandResult result = uvol_test::runWell("uvol_measure " + mesh_);
  EXPECT_NE(std::string::npos, result.out.find("area 3 "));
  EXPECT_NE(std::string::npos, result.out.find("open at 1 boundary loop"));
  const Json report = reportOf(mesh_);
  EXPECT_TRUE(uvol_test::hasWarning(report, "open_pieces")) << report;
  EXPECT_TRUE(report["surfaces"]["volume"].is_null());
}

TEST_F(MeasureTool, RefusesWrongCommandLines)
{
  expectError("", "command_line", "-iso");
  expectError("-field rho -iso 0.1:0.5", "command_line", "0.1:0.5");
  expectError("-field rho -iso 0.1:0:1", "command_line", "0.1:0:1");
  expectError("-field rho -iso 0.1:0.5:x", "command_line", "'x'");
  expectError("-field rho -iso 0:0.5:5log", "command_line", "log");
  expectError("-field rho -iso 0.5 -png " + picture_, "command_line", "-iso");
  expectError("-field rho -iso 0.5 -plot area", "command_line", "-png");
  expectError("-field rho -iso 0.5 -samples " + in_, "command_line", "-samples");
  expectError(
      "-field rho -iso 0.2,0.5 -png " + picture_ + " -plot no", "command_line", "no");
  expectError("-field rho -iso 7", "no_surface_to_measure");
  expectError("-field nothing -iso 7", "unknown_lone_field", "\"nothing\"");
  expectError("-block 1,1,1", "command_line", "-iso");
  expectError("-field rho -iso 0.5 -block 0,1,1", "block_sides_not_positive");
  expectError("-field rho -iso 0.5 -block 1,1,1 -pieces", "command_line", "-pieces");
  expectError("-field rho -iso 0.5 -block 1e-4,1e-4,1e-4", "too_many_blocks");
  out_ = folder_ / "out.jpg";
  expectError("-field rho -iso 0.5", "unwritten_ending", ".jpg");
}

TEST_F(MeasureTool, RefusesWhatIsNoSurface)
{
  const auto refuses = [&](const std::string& input, const std::string& word) {
    const CommandResult result = runCommand("uvol_measure " + input);
    EXPECT_NE(0, result.exit_code);
    EXPECT_NE(std::string::npos, result.err.find(word)) << result.err;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  };
  refuses(folder_ / "missing.ply", "missing.ply");
  const std::string points = folder_ / "points.ply";
  uvol_test::runWell("uvol_isosurface " + in_ + " " + points + " -field rho -iso 0.3");
  refuses(points + " -iso 0.3 -measure", "-measure");
  for (const char* const option : {"-flat", "-check", "-samples x.ply"})
    refuses(points + " " + option, "needs triangles");
  refuses(in_, "neither triangles nor normals");
}

} // namespace test_uvol_measure
