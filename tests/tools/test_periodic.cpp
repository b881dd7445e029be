// SPDX-License-Identifier: BSD-3-Clause
// -periodic of the tools that look for neighbours.
#include "support/snapshots.h"
#include "tool_test.h"

#include <cmath>
#include <sstream>

using namespace uvol_test;

namespace test_periodic {

constexpr double side = 8.0;

double
gyroid(double x, double y, double z)
{
  const double k = 2.0 * std::acos(-1.0) / side;
  return std::sin(k * x) * std::cos(k * y) + std::sin(k * y) * std::cos(k * z) +
         std::sin(k * z) * std::cos(k * x);
}

class Periodic : public ToolTest {
protected:
  Periodic()
      : ToolTest(PCL_UVOL_TOOL_DIR "/uvol_isosurface", "out.csv")
  {
    writeSamples(0.0);
  }

  /** A field in a box that begins there along x. */
  void
  writeSamples(double begin) const
  {
    Random random(5);
    std::ostringstream text;
    text.precision(9);
    text << "x,y,z,f\n";
    constexpr int n = 14; // a lattice, jittered
    for (int i = 0; i < n * n * n; ++i) {
      double place[3];
      for (int axis = 0, rest = i; axis < 3; ++axis, rest /= n)
        place[axis] = (rest % n + 0.5 + 0.6 * (random.uniform() - 0.5)) * side / n;
      text << begin + place[0] << ',' << place[1] << ',' << place[2] << ','
           << gyroid(place[0], place[1], place[2]) << '\n';
    }
    writeFile(in_, text.str());
  }

  CommandResult
  runTool(const std::string& tool, const std::string& options) const
  {
    const auto result = runCommand(PCL_UVOL_TOOL_DIR "/" + tool + " " + in_ + " " +
                                   out_ + " " + options);
    EXPECT_EQ(0, result.exit_code) << options << ": " << result.err;
    return result;
  }
};

TEST_F(Periodic, ReportsNameTheBox)
{
  const auto result = succeeded(run("-iso 0 -periodic 8,8,8 -json"));
  EXPECT_EQ("", result.err);
  EXPECT_NE(std::string::npos, result.out.find("\"periodic_box\"")) << result.out;
}

TEST_F(Periodic, WeldedMeshesAreClosedAcrossTheFaces)
{
  expectError("-iso 0 -periodic-mesh weld", "command_line", "-mesh");
  const std::string ply = folder_ / "out.ply";
  const std::string tool = PCL_UVOL_TOOL_DIR "/uvol_isosurface " + in_ + " " + ply +
                           " -iso 0.3 -mesh -periodic-mesh weld";
  uvol_test::expectError(runCommand(tool + " -json"), "command_line", "-periodic-mesh");
  const auto welded = runWell(tool + " -periodic 8,8,8");
  EXPECT_EQ("", welded.err);
  const auto pieces = welded.out.find("pieces: ");
  ASSERT_NE(std::string::npos, pieces);
  const std::string line =
      welded.out.substr(pieces, welded.out.find('\n', pieces) - pieces);
  EXPECT_EQ(std::string::npos, line.find("boundary loop")) << line;
  const auto image_of = fieldOf(pcl_uvol::loadDataset(ply), "image_of");
  std::size_t images = 0;
  for (std::size_t i = 0; i < image_of.size(); ++i)
    images += image_of[i] != static_cast<double>(i);
  EXPECT_GT(images, 100u);
}

TEST_F(Periodic, DensitiesDoNotFallAtTheFaces)
{
  const double mean = std::pow(14.0 / side, 3);
  const auto lowest = [&](const std::string& options) {
    const auto surface = resultOf("-density -field f -iso 0 " + options);
    const auto densities = fieldOf(surface, "sph_density");
    return *std::min_element(densities.begin(), densities.end());
  };
  EXPECT_LT(lowest(""), 0.6 * mean);
  EXPECT_GT(lowest("-periodic 8,8,8"), 0.75 * mean);
  const auto slopes = fieldOf(resultOf("-field 'f+0*|grad(f)|' -iso 0 -periodic 8,8,8"),
                              "f+0*|grad(f)|");
  for (const double value : slopes)
    EXPECT_NEAR(0.0, value, 1e-5);
}

TEST_F(Periodic, CoordinatesBesideADerivativeAreThoseOfTheSamples)
{
  for (const double value : {0.5, 2.5, 7.0}) {
    const std::string iso = " -periodic 8,8,8 -iso " + std::to_string(value);
    const auto alone = fieldOf(resultOf("-field x+0" + iso), "x");
    EXPECT_GT(alone.size(), 100u);
    EXPECT_EQ(alone, fieldOf(resultOf("-field 'x+0*|grad(f)|'" + iso), "x")) << value;
  }
}

TEST_F(Periodic, LevelSetsOfDerivativesSeeAcrossTheFaces)
{
  for (const std::string scale : {"1,1,1", "auto"}) {
    runTool("uvol_levelset",
            "-field 'grad(f)[0]' -iso 0 -periodic 8,8,8 -mu 0.5 -steps 2 -scale " +
                scale);
    const auto found = pcl_uvol::loadDataset(out_);
    const auto x = fieldOf(found, "x"), y = fieldOf(found, "y"),
               z = fieldOf(found, "z"), slopes = fieldOf(found, "grad(f)[0]");
    const double k = 2.0 * std::acos(-1.0) / side;
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(k * (std::cos(k * x[i]) * std::cos(k * y[i]) -
                       std::sin(k * z[i]) * std::sin(k * x[i])),
                  slopes[i],
                  0.03)
          << scale;
  }
}

TEST_F(Periodic, FieldsAreAskedForAcrossTheFaces)
{
  writeFile(folder_ / "at.csv",
            "x,y,z\n-0.1,4,4\n7.9,4,4\n15.9,-4,12\n0.05,0.02,7.99\n");
  runTool("uvol_probe",
          "-field f -points " + folder_ / "at.csv" + " -periodic 8,8,8 -model fit");
  const auto found = pcl_uvol::loadDataset(out_);
  const auto x = fieldOf(found, "x"), y = fieldOf(found, "y"), z = fieldOf(found, "z"),
             f = fieldOf(found, "f"), support = fieldOf(found, "support");
  ASSERT_EQ(4u, f.size());
  for (std::size_t i = 0; i < f.size(); ++i) {
    EXPECT_NEAR(gyroid(x[i], y[i], z[i]), f[i], 0.02);
    EXPECT_EQ(1.0, support[i]);
  }
  EXPECT_NEAR(-0.1, x[0], 1e-6);
  EXPECT_NEAR(f[0], f[1], 1e-6);
  EXPECT_NEAR(f[0], f[2], 1e-6);
  runTool("uvol_probe", "-field f -grid 6 -periodic 8,8,8 -model fit");
  const auto grid = pcl_uvol::loadDataset(out_);
  const auto places = fieldOf(grid, "x");
  EXPECT_EQ(0.0, *std::min_element(places.begin(), places.end()));
  EXPECT_EQ(side, *std::max_element(places.begin(), places.end()));
  for (const double s : fieldOf(grid, "support"))
    EXPECT_EQ(1.0, s);
}

TEST_F(Periodic, LatticesBeyondTheFacesAreAskedForAsPoints)
{
  writeSamples(69.3); // the low corner of the box is no round number
  for (const std::string lattice :
       {"-grid 4 -box 61.2,-4.1,-2,79,12,12",
        "-grid 5x4x3 -box 0,-17,3,24,1,30",
        "-plane z=-1 -size 9 -box 60,-4,-4,79,12,12",
        "-plane 69,0,9,1,2,3 -size 9 -box 61,-9,-9,89,12,12"}) {
    const std::string options = " -field f -periodic 8,8,8 -gradients " + lattice;
    runTool("uvol_probe", options);
    const auto points = pcl_uvol::loadDataset(out_);
    const std::string parts = folder_ / "out.vts";
    runWell(PCL_UVOL_TOOL_DIR "/uvol_probe " + in_ + " " + parts + options);
    const auto written = pcl_uvol::loadDataset(parts);
    for (const char* const name : {"x", "y", "z", "f", "support"})
      EXPECT_EQ(fieldOf(points, name), fieldOf(written, name)) << lattice << name;
    for (const double support : fieldOf(written, "support"))
      EXPECT_EQ(1.0, support) << lattice;
  }
}

TEST_F(Periodic, LevelSetsKeepTheSamples)
{
  const auto before = pcl_uvol::loadDataset(in_);
  runTool("uvol_levelset", "-field f -iso 0 -periodic 8,8,8 -mu 0.5 -steps 20");
  const auto after = pcl_uvol::loadDataset(out_);
  for (const char* const axis : {"x", "y", "z"})
    EXPECT_EQ(fieldOf(before, axis), fieldOf(after, axis));
  const auto f = fieldOf(after, "f"), phi = fieldOf(after, "phi");
  std::size_t right = 0;
  for (std::size_t i = 0; i < f.size(); ++i)
    right += (f[i] > 0.0) == (phi[i] > 0.0);
  EXPECT_GT(right, f.size() * 98 / 100);
}

TEST_F(Periodic, HeadersNameTheBox)
{
  GadgetLayout layout;
  layout.here[0] = layout.total[0] = 200;
  layout.box = 101.0;
  writeFile(in_, makeGadget(layout));
  const std::string snapshot = folder_ / "snap";
  std::rename(in_.c_str(), snapshot.c_str());
  in_ = snapshot;
  const auto box =
      jsonOf(run("-field '|VEL|' -iso 200 -json -periodic header")).at("periodic_box");
  EXPECT_EQ(std::vector<double>(3, 101.0), box.at("sides"));
  EXPECT_EQ(std::vector<double>(3, 0.0), box.at("low"));
  EXPECT_TRUE(hasMessage(run("-field '|VEL|' -iso 200 -json"), "box_in_file"));
}

TEST_F(Periodic, WhatGoesWithWhat)
{
  for (const char* const wrong : {"-periodic 8,8",
                                  "-periodic 0,0,0",
                                  "-periodic -8,8,8",
                                  "-periodic nan,8,8",
                                  "-periodic boxes",
                                  "-periodic 8,8,8 -outside-value 0",
                                  "-periodic 8,8,8 -validate 3",
                                  "-periodic 8,8,8 -max-memory 1G"})
    EXPECT_EQ(2, run(std::string("-iso 0 ") + wrong).exit_code) << wrong;
  expectError("-iso 0 -periodic header", "no_box_in_file");
}

} // namespace test_periodic
