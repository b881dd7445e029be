// SPDX-License-Identifier: BSD-3-Clause
// Expressions and derivatives as fields of the tools.
#include "common/scalar_field.h"
#include "support/environment.h"
#include "support/flows.h"
#include "tools/tool_test.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_derived_fields {

/** Taylor and Green's vortices in a CSV file, with a name of two words. */
class DerivedFields : public testing::Test {
protected:
  DerivedFields()
  {
    Dataset dataset = sampleFlow(makeFlows()[0], 4000, 3);
    const CloudView cloud = viewOf(dataset.cloud);
    std::vector<double> density;
    for (std::size_t i = 0; i < cloud.count; ++i)
      density.push_back(std::exp(static_cast<double>(cloud.xyz(i)[0])));
    setField(dataset, "the density", density);
    saveDataset(in_, dataset);
  }

  void
  expectSuccess(const std::string& command) const
  {
    const auto result = runCommand(command);
    EXPECT_EQ(0, result.exit_code) << command << ": " << result.err;
  }

  std::vector<double>
  valuesOf(const std::string& path, const std::string& name) const
  {
    return fieldOf(loadDataset(path), name);
  }

  TemporaryFolder folder_;
  const std::string in_ = folder_ / "in.csv", out_ = folder_ / "out.ply",
                    png_ = folder_ / "out.png";
};

TEST_F(DerivedFields, IsosurfaceOfAVortexCriterion)
{
  expectSuccess("uvol_isosurface " + in_ + " " + out_ +
                " -field 'Q(v)' -iso 0.4 -png " + png_ +
                " -size 64 -color '|curl(v)|' -where 'x > -1.5'");
  const auto q = valuesOf(out_, "Q(v)");
  ASSERT_GT(q.size(), 50u);
  EXPECT_LT(std::abs(*std::max_element(q.begin(), q.end()) - 0.4), 0.1);
  const auto curl = valuesOf(out_, "|curl(v)|");
  EXPECT_GT(*std::min_element(curl.begin(), curl.end()), 0.5);
  EXPECT_TRUE(std::find(folder_.list().begin(), folder_.list().end(), "out.png") !=
              folder_.list().end());
  // What was carried can be drawn, and be part of another expression.
  expectSuccess("uvol_render " + out_ + " " + png_ +
                " -size 64 -color 'ln(|curl(v)|)'");
  expectSuccess("uvol_raytrace " + out_ + " " + png_ + " -size 32 -color '1+\"Q(v)\"'");
  expectError(
      runCommand("uvol_render " + out_ + " " + png_ + " -json -color 'Q(vx,vy,vz)'"),
      "no_derivatives",
      "Q(vx,vy,vz)");
}

TEST_F(DerivedFields, TheSameAsAColumnOfTheFile)
{
  const std::string name = "log10(\"the density\")";
  Dataset dataset = loadDataset(in_);
  std::vector<double> values = valuesOf(in_, "the density");
  for (double& value : values)
    value = std::log10(value);
  setField(dataset, "d", values);
  saveDataset(folder_ / "d.csv", dataset);
  expectSuccess("uvol_isosurface " + (folder_ / "d.csv") + " " + out_ +
                " -field d -iso 0.2");
  const std::string other = folder_ / "other.csv"; // names keep their blanks there
  expectSuccess("uvol_isosurface " + in_ + " " + other + " -field '" + name +
                "' -iso 0.2");
  EXPECT_EQ(valuesOf(out_, "x"), valuesOf(other, "x"));
  EXPECT_EQ(valuesOf(out_, "d"), valuesOf(other, "log10(the density)"));
}

TEST_F(DerivedFields, FromDiskTheSameBytes)
{
  const std::string job = " -field 'vx*vy + vz' -iso 0.1 ", other = folder_ / "b.ply";
  expectSuccess("uvol_isosurface " + in_ + " " + out_ + job);
  expectSuccess("uvol_isosurface " + in_ + " " + other + job + "-max-memory 200M");
  EXPECT_EQ(readFile(out_), readFile(other));
  expectError(runCommand("uvol_isosurface " + in_ + " " + other +
                         " -json -field 'Q(v)' -iso 1 -max-memory 200M"),
              "command_line",
              "derivatives");
  // Points that are undefined are told once, although they are read twice.
  const auto result = runWell("uvol_isosurface " + in_ + " " + other +
                              " -field 'sqrt(vx)' -iso 0.1 -max-memory 200M -json");
  const auto report = nlohmann::json::parse(result.out);
  const auto told = uvol_test::warnedValues(report, "undefined_field");
  ASSERT_TRUE(told.is_object()) << result.out;
  EXPECT_EQ("sqrt(vx)", told.at("field"));
  EXPECT_EQ(4000, told.at("points"));
}

TEST_F(DerivedFields, OtherTools)
{
  expectSuccess("uvol_info " + in_ + " -field 'lambda2(v)' -where 'Q(v)>0 && vx<vy'");
  expectSuccess("uvol_levelset " + in_ + " " + out_ + " -field 'vx-vy' -iso 0");
  EXPECT_EQ(valuesOf(out_, "vx-vy").size(), 4000u);
  expectSuccess("uvol_cluster " + in_ + " " + out_ +
                " -attributes 'atan2(vy,vx),|vx,vy|,\"the density\"' -k 5");
  EXPECT_EQ(valuesOf(out_, "atan2(vy,vx)").size(), 4000u);
  expectSuccess("uvol_project " + in_ + " " + out_ +
                " -attributes 'min(vx,vy),|grad(vx)|,vz,\"the density\"/2'");
  EXPECT_FALSE(valuesOf(out_, "|grad(vx)|").empty());
}

TEST_F(DerivedFields, WrongOnesAreMarked)
{
  const auto result = runCommand("uvol_isosurface " + in_ + " " + out_ +
                                 " -field 'sqrt(vx + wy)' -iso 1 -json");
  expectError(result, "unknown_operand", R"("  sqrt(vx + wy)\n            ^")");
  EXPECT_NE(std::string::npos, result.err.find("\n  sqrt(vx + wy)\n            ^\n"))
      << result.err;
  EXPECT_EQ(std::vector<std::string>{"in.csv"}, folder_.list());
  expectError(runCommand("uvol_info " + in_ + " -json -where 'vx ~ 3'"),
              "operator_missing",
              "^");
}

TEST(DerivedFieldsOfRealData, VorticesOfARotatingDisk)
{
  const std::string data = dataFolder();
  if (data.empty())
    GTEST_SKIP() << "no folder of real data";
  const TemporaryFolder folder;
  const std::string out = folder / "out.ply";
  runWell("uvol_isosurface " + data + "/cfd/disk_out_ref.vtu " + out +
          " -field 'Q(V)' -iso 0.5");
  const Dataset surface = loadDataset(out);
  EXPECT_GT(surface.cloud.width, 2000u);
  EXPECT_NE(findField(surface.cloud.fields, "Q(V)"), nullptr);
  // Layers of samples near the disk once made it a million.
  const auto info = runCommand("uvol_info " + data +
                               "/cfd/disk_out_ref.vtu -json -where '|Q(V)|>2000'");
  EXPECT_EQ(8499, nlohmann::json::parse(info.out).at("counts").at("removed_by_where"));
}

} // namespace test_derived_fields
