// SPDX-License-Identifier: BSD-3-Clause
// Cells of the input decide where its data are: values inside of them, none outside.
#include "tool_test.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace test_probe_cells {

using namespace uvol_test;
using Json = nlohmann::json;

/** A grid bent around a cylinder, whose cells are thin at its wall, with the field
 * radius + z; as text of VTK. */
class ProbeCells : public FolderTest {
protected:
  static constexpr int along_x = 12, along_y = 16, along_z = 9;

  ProbeCells()
  {
    std::ostringstream text;
    text << "<VTKFile type=\"StructuredGrid\" version=\"0.1\"><StructuredGrid "
            "WholeExtent=\"0 "
         << along_x - 1 << " 0 " << along_y - 1 << " 0 " << along_z - 1
         << "\"><Piece Extent=\"0 " << along_x - 1 << " 0 " << along_y - 1 << " 0 "
         << along_z - 1 << "\"><Points><DataArray type=\"Float64\" "
         << "NumberOfComponents=\"3\" format=\"ascii\">\n";
    text.precision(17);
    std::ostringstream values;
    for (int z = 0; z < along_z; ++z)
      for (int y = 0; y < along_y; ++y)
        for (int x = 0; x < along_x; ++x) {
          const auto at = placeAt(x, y, z);
          text << at[0] << ' ' << at[1] << ' ' << at[2] << '\n';
          values << std::hypot(at[0], at[1]) + at[2] << '\n';
        }
    text << "</DataArray></Points><PointData><DataArray type=\"Float64\" Name=\"f\" "
            "format=\"ascii\">\n"
         << values.str()
         << "</DataArray></PointData></Piece></StructuredGrid></VTKFile>\n";
    write("in.vts", text.str());
  }

  /** \param x, y, z counted in nodes */
  static std::array<double, 3>
  placeAt(double x, double y, double z)
  {
    const double radius = 1.0 + 1.5 * std::pow(x / (along_x - 1), 5.0),
                 angle = 3.0 * y / (along_y - 1);
    return {radius * std::cos(angle), radius * std::sin(angle), 0.2 * z};
  }

  void
  writePlaces(const std::vector<std::array<double, 3>>& places) const
  {
    std::ostringstream text;
    text.precision(9);
    text << "x,y,z\n";
    for (const auto& place : places)
      text << place[0] << ',' << place[1] << ',' << place[2] << '\n';
    write("places.csv", text.str());
  }

  /** The report; the values and support of the answers. */
  Json
  probe(const std::string& options)
  {
    const auto result = succeeded(
        runTool("probe in.vts out.csv -field f -points places.csv -json " + options));
    const auto answers = pcl_uvol::loadDataset(folder_ / "out.csv");
    values_ = fieldOf(answers, "f");
    support_ = fieldOf(answers, "support");
    return Json::parse(result.out);
  }

  std::size_t
  countNaN() const
  {
    return static_cast<std::size_t>(
        std::count_if(values_.begin(), values_.end(), [](double value) {
          return std::isnan(value);
        }));
  }

  std::vector<double> values_, support_;
};

/** Corners of a cell with random weights each. */
TEST_F(ProbeCells, InsideOfCellsThereAreValues)
{
  Random random(2);
  std::vector<std::array<double, 3>> places(400);
  for (auto& place : places) {
    const double x = std::floor(random.uniform() * (along_x - 1)),
                 y = std::floor(random.uniform() * (along_y - 1)),
                 z = std::floor(random.uniform() * (along_z - 1)), u = random.uniform(),
                 v = random.uniform(), w = random.uniform();
    for (int corner = 0; corner < 8; ++corner) {
      const int i = corner & 1, j = corner / 2 & 1, k = corner / 4;
      const auto at = placeAt(x + i, y + j, z + k);
      const double weight = (i ? u : 1 - u) * (j ? v : 1 - v) * (k ? w : 1 - w);
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] += weight * at[axis];
    }
  }
  writePlaces(places);
  for (const char* const model : {"fit", "natural", "nearest"}) {
    SCOPED_TRACE(model);
    const Json report = probe(std::string("-model ") + model);
    EXPECT_EQ(report["counts"]["cells"], (along_x - 1) * (along_y - 1) * (along_z - 1));
    EXPECT_EQ(report["counts"]["outside"], 0);
    EXPECT_EQ(countNaN(), 0u);
    EXPECT_EQ(std::count(support_.begin(), support_.end(), 7.0), 0);
  }
  EXPECT_EQ(probe("-no-cell-mask")["counts"].count("cells"), 0u);
}

/** In the hollow of the cylinder, on the other side of it, and around. */
TEST_F(ProbeCells, OutsideOfAllThereAreNone)
{
  writePlaces({{0.0, 0.5, 0.8},
               {0.0, 0.9, 0.8},
               {0.3, -0.3, 0.8},
               {0.0, 2.6, 0.8},
               {0.0, 1.5, -0.05},
               {0.0, 1.5, 1.65}});
  Json report = probe("");
  EXPECT_EQ(countNaN(), 6u);
  EXPECT_EQ(support_, std::vector<double>(6, 7.0));
  EXPECT_EQ(report["counts"]["outside"], 6);
  report = probe("-extrapolate");
  EXPECT_EQ(countNaN(), 0u);
  EXPECT_EQ(support_, std::vector<double>(6, 7.0));
  // The samples take places near them for measured ones.
  report = probe("-no-cell-mask");
  EXPECT_LT(countNaN(), 6u);
  EXPECT_FALSE(report["counts"].contains("cells"));
  // Samples that are left out have no cells, and neither have images.
  report = probe("-where 'f>0'");
  EXPECT_FALSE(report["counts"].contains("cells"));
  report = probe("-periodic 9,9,9");
  EXPECT_FALSE(report["counts"].contains("cells"));
}

TEST_F(ProbeCells, PlanesHaveTheirHole)
{
  succeeded(runTool("probe in.vts plane.csv -field f -plane z=0.8 -size 60 -json"));
  const auto plane = pcl_uvol::loadDataset(folder_ / "plane.csv");
  const auto x = fieldOf(plane, "x"), y = fieldOf(plane, "y"), f = fieldOf(plane, "f");
  std::size_t inside = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double radius = std::hypot(x[i], y[i]), angle = std::atan2(y[i], x[i]);
    // Straight sides of cells leave the arcs by 0.005.
    if (radius > 1.0 && radius < 2.48 && angle > 0.01 && angle < 2.99) {
      ++inside;
      EXPECT_FALSE(std::isnan(f[i])) << x[i] << ' ' << y[i];
    }
    else if (radius < 0.99 || radius > 2.51 || angle < -0.01 || angle > 3.01) {
      EXPECT_TRUE(std::isnan(f[i])) << x[i] << ' ' << y[i];
    }
  }
  EXPECT_GT(inside, 500u);
}

TEST_F(ProbeCells, DamagedCellsLeaveItToTheSamples)
{
  // The reader of points is content with a grid of which a part of the cells is gone.
  write(
      "mesh.vtu",
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece "
      "NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray>"
      "</Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">0 1 2 9</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
      "format=\"ascii\">4</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
      "format=\"ascii\">10</DataArray></Cells><PointData><DataArray type=\"Float64\" "
      "Name=\"f\" format=\"ascii\">1 2 3 4</DataArray></PointData></Piece>"
      "</UnstructuredGrid></VTKFile>");
  writePlaces({{0.2, 0.2, 0.2}});
  const auto result =
      succeeded(runTool("probe mesh.vtu out.csv -field f -points places.csv "
                        "-model nearest -json"));
  EXPECT_TRUE(hasMessage(result, "cells_not_used")) << result.out << result.err;
  expectSentences("uvol_probe", result);
}

/** The share of places inside of cells that had no value was 36 %. */
TEST_F(ProbeCells, BluntFinHasNoGaps)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const std::string fin = dataFolder() + "/cfd/bluntfin.vts";
  const auto nodes = pcl_uvol::loadDataset(fin);
  const auto x = fieldOf(nodes, "x"), y = fieldOf(nodes, "y"), z = fieldOf(nodes, "z");
  ASSERT_EQ(x.size(), 40u * 32 * 32);
  Random random(7);
  std::vector<std::array<double, 3>> places(1000);
  for (auto& place : places) {
    const auto i = static_cast<std::size_t>(random.uniform() * 39.0),
               j = static_cast<std::size_t>(random.uniform() * 31.0),
               k = static_cast<std::size_t>(random.uniform() * 31.0);
    const double u = random.uniform(), v = random.uniform(), w = random.uniform();
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t a = corner & 1, b = corner / 2 & 1, c = corner / 4;
      const double weight = (a ? u : 1 - u) * (b ? v : 1 - v) * (c ? w : 1 - w);
      const std::size_t node = i + a + 40 * (j + b + 32 * (k + c));
      place[0] += weight * x[node];
      place[1] += weight * y[node];
      place[2] += weight * z[node];
    }
  }
  writePlaces(places);
  succeeded(runTool("probe " + fin + " out.csv -field Density -points places.csv"));
  const auto answers = pcl_uvol::loadDataset(folder_ / "out.csv");
  for (const double value : fieldOf(answers, "Density"))
    EXPECT_FALSE(std::isnan(value));
}

} // namespace test_probe_cells
