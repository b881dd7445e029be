// SPDX-License-Identifier: BSD-3-Clause
// -mesh of uvol_isosurface from the outside: files, options, what is told, refusals.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace test_uvol_isosurface_mesh {

using Json = nlohmann::json;
using pcl_uvol::Dataset;
using pcl_uvol::Triangle;
using uvol_test::CommandResult;
using uvol_test::fieldOf;
using uvol_test::readFile;
using uvol_test::runCommand;

class MeshTool : public uvol_test::ToolTest {
protected:
  MeshTool()
      : ToolTest("uvol_isosurface", "out.ply")
  {
  }

  /** Two balls whose centres are 1.2 apart, of radius 0.5 - f. */
  void
  SetUp() override
  {
    uvol_test::Random random(2);
    std::ostringstream csv;
    csv << "x,y,z,f,mark\n";
    for (int i = 0; i < 12000; ++i) {
      const double x = 2.4 * random.uniform() - 1.2, y = 1.2 * random.uniform() - 0.6,
                   z = 1.2 * random.uniform() - 0.6;
      const double away = std::hypot(std::abs(x) - 0.6, y, z);
      csv << x << ',' << y << ',' << z << ',' << 0.5 - away << ",7\n";
    }
    uvol_test::writeFile(in_, csv.str());
  }

  Json
  reportOf(const std::string& options) const
  {
    const CommandResult result =
        uvol_test::succeeded(run("-field f -iso 0.1 " + options + " -json"));
    return Json::parse(result.out);
  }
};

TEST_F(MeshTool, WritesMeshesWithAllFields)
{
  const Json report = reportOf("-mesh");
  EXPECT_EQ((std::vector<int>{0, 0}),
            report["pieces"]["genus"].get<std::vector<int>>());
  EXPECT_GE(report["smallest_angle"].get<double>(), 20.0);
  std::vector<Triangle> triangles;
  const Dataset mesh = pcl_uvol::loadMesh(out_, triangles);
  EXPECT_EQ(report["counts"]["triangles"].get<std::size_t>(), triangles.size());
  EXPECT_EQ(report["counts"]["vertices"].get<std::size_t>(), mesh.cloud.width);
  // Closed: as many edges as three halves of the triangles.
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert({triangle[i], triangle[(i + 1) % 3]});
  EXPECT_EQ(3 * triangles.size(), edges.size());
  for (const auto& [a, b] : edges)
    ASSERT_EQ(1u, edges.count({b, a}));
  EXPECT_EQ(7.0, fieldOf(mesh, "mark").front());
  const auto piece = fieldOf(mesh, "piece"), x = fieldOf(mesh, "x");
  for (std::size_t i = 0; i < piece.size(); ++i) // one on each side
    ASSERT_EQ(piece[i] == piece[0], (x[i] > 0.0) == (x[0] > 0.0));
  for (const char* const name : {"normal_x", "error", "support", "mean_curvature"})
    EXPECT_EQ(mesh.cloud.width, fieldOf(mesh, name).size());
}

TEST_F(MeshTool, EndingsImplyMeshes)
{
  for (const auto& [ending, start] :
       {std::pair{"obj", "# isosurface of f"}, {"off", "OFF\n"}, {"stl", "   "}}) {
    out_ = folder_ / (std::string("out.") + ending);
    expectSuccess("-field f -iso 0.1");
    EXPECT_EQ(0u, readFile(out_).find(start)) << ending;
  }
  out_ = folder_ / "out.vtp";
  expectSuccess("-field f -iso 0.1 -mesh");
  EXPECT_EQ(std::string::npos, readFile(out_).find("NumberOfPolys=\"0\""));
  expectSuccess("-field f -iso 0.1");
  EXPECT_NE(std::string::npos, readFile(out_).find("NumberOfPolys=\"0\""));
}

TEST_F(MeshTool, OptionsChangeTheTriangles)
{
  const auto trianglesOf = [&](const std::string& options) {
    return reportOf("-mesh " + options)["counts"]["triangles"].get<int>();
  };
  const int even = trianglesOf("");
  EXPECT_GT(trianglesOf("-remesh none"), 2 * even);
  EXPECT_LT(trianglesOf("-edge-length 0.15"), even / 2);
  EXPECT_EQ(0, trianglesOf("-drop-pieces 1000000"));
  EXPECT_EQ(0, reportOf("-mesh -check")["counts"]["intersections"].get<int>());
}

TEST_F(MeshTool, OpenMeshesEndAtTheBorder)
{
  // At -0.15 the balls, of radius 0.65, reach over the border of the samples.
  const auto run_at = [&](const std::string& options) {
    const CommandResult result =
        uvol_test::succeeded(run("-field f -iso -0.15 -mesh -json " + options));
    return Json::parse(result.out);
  };
  const Json closed = run_at(""), open = run_at("-open");
  EXPECT_GT(closed["counts"]["cap_vertices"].get<int>(), 10);
  EXPECT_EQ(0, closed["counts"]["rim_edges"].get<int>());
  EXPECT_EQ(0, open["counts"]["cap_vertices"].get<int>());
  EXPECT_GT(open["counts"]["rim_edges"].get<int>(), 10);
  // What caps add is told apart: area and the volume that they close.
  const Json measured = run_at("-measure"), without = run_at("-open -measure");
  EXPECT_NEAR(measured["surfaces"]["area"].get<double>() -
                  measured["surfaces"]["cap_area"].get<double>(),
              without["surfaces"]["area"].get<double>(),
              without["surfaces"]["area_error"].get<double>());
  EXPECT_GT(measured["surfaces"]["cap_area"].get<double>(), 0.1);
  EXPECT_EQ(measured["surfaces"]["volume"], measured["surfaces"]["capped_volume"]);
  EXPECT_NE(std::string::npos,
            run("-field f -iso -0.15 -mesh -measure").out.find("(caps "));
}

TEST_F(MeshTool, SaysWhereTrianglesAreBad)
{
  // Lines along z, a fiftieth as far apart along them as from one another.
  uvol_test::Random random(4);
  std::ostringstream csv;
  csv << "x,y,z,f\n";
  for (int line = 0; line < 40; ++line) {
    const double x = 20.0 * random.uniform(), y = 20.0 * random.uniform();
    for (int i = 0; i < 200; ++i)
      csv << x << ',' << y << ',' << 0.1 * i << ','
          << std::sin(0.3 * x) + std::cos(0.4 * y) + 0.1 * i - 10.0 << '\n';
  }
  uvol_test::writeFile(in_, csv.str());
  for (const auto& [remesh, is_even] : {std::pair("", 1), {"-remesh none", 0}}) {
    const Json report =
        uvol_test::jsonOf(run(std::string("-field f -iso 0 -json -mesh ") + remesh));
    EXPECT_EQ(is_even, uvol_test::warnedValues(report, "folds").at("is_even"))
        << report;
  }
}

TEST_F(MeshTool, StlReportsWhatItCannotStore)
{
  uvol_test::writeFile(in_,
                       "x,y,z,f\n5505024.25,0,0,1\n5505025.25,0,0,0\n5505024.25,1,0,0\n"
                       "5505024.25,0,1,0\n5505023.25,0,0,0\n5505024.25,-1,0,0\n"
                       "5505024.25,0,-1,0\n");
  out_ = folder_ / "out.stl";
  const CommandResult result = uvol_test::succeeded(run("-field f -iso 0.5 -json"));
  EXPECT_TRUE(uvol_test::hasMessage(result, "stl_without_origin")) << result.out;
}

TEST_F(MeshTool, SmoothFieldsHaveMeshesToo)
{
  const Json report = reportOf("-mesh -smooth -measure");
  EXPECT_EQ(2u, report["pieces"]["genus"].size());
  EXPECT_EQ(2u, report["pieces"]["area"].size());
  const std::string text = run("-field f -iso 0.1 -mesh -measure -json").out;
  EXPECT_EQ(text.find("\"pieces\": {"), text.rfind("\"pieces\": {"));
  const double volume = report["surfaces"]["volume"];
  EXPECT_NEAR(2.0 * 4.0 / 3.0 * M_PI * 0.064, volume, 0.01 * volume);
}

TEST_F(MeshTool, RefusesWhatDoesNotGoTogether)
{
  const std::string base = "-field f -iso 0.1 ";
  expectUsageErrors(
      base, {"-remesh none", "-edge-length 1", "-open", "-drop-pieces 3", "-check"});
  expectUsageErrors(base + "-mesh ",
                    {"-interpolation linear",
                     "-neighbors voronoi",
                     "-normals pca",
                     "-max-error 0.1",
                     "-drop-bridged",
                     "-max-memory 1G",
                     "-remesh none -edge-length 1",
                     "-edge-length -1"});
  expectUsageErrors(base + "-measure ", {"-max-memory 1G"});
  out_ = folder_ / "out.pcd";
  expectError(base + "-mesh", "unwritten_ending", ".pcd");
}

} // namespace test_uvol_isosurface_mesh
