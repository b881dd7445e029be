// SPDX-License-Identifier: BSD-3-Clause
// uvol_project from the outside: data of many dimensions become points, axes and
// pictures.
#include "common/random.h"
#include "support/environment.h"
#include "support/png.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace test_uvol_project {

using pcl_uvol::Dataset;
using uvol_test::CommandResult;
using uvol_test::fieldOf;
using uvol_test::readFile;
using uvol_test::runCommand;

constexpr std::size_t points = 300, columns = 5;

int
truthOf(std::size_t i)
{
  return i % 6 < 3 ? 0 : i % 6 < 5 ? 1 : 2;
}

/** Attribute of a point: three clusters, in units that differ by orders. */
double
escapeAttribute(std::size_t i, std::size_t column)
{
  constexpr double centers[3][columns] = {
      {0, 0, 0, 0, 1}, {9, 0, 0, 5, 2}, {0, 9, 5, 0, 3}};
  constexpr double units[columns] = {1.0, 1e-3, 1e4, 1.0, 1.0};
  return units[column] *
         (centers[truthOf(i)][column] + 0.5 * pcl_uvol::normalAt(3, i, column));
}

std::string
makeTable(const std::string& header = "a,b,c,d,e,truth")
{
  std::ostringstream csv;
  csv << header << '\n';
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t column = 0; column < columns; ++column)
      csv << escapeAttribute(i, column) << ',';
    csv << truthOf(i) << '\n';
  }
  return csv.str();
}

double
varianceOf(const std::vector<double>& values)
{
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return squares / count - sum * sum / count / count;
}

/** The axis of an attribute as a row of the table tells it. */
struct Axis {
  double mean, unit, direction[3];
};

/** Cells of a row, which may be quoted. */
std::vector<std::string>
cellsOf(const std::string& line)
{
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line)
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

std::map<std::string, Axis>
readAxes(const std::string& path)
{
  std::map<std::string, Axis> axes;
  std::istringstream table(readFile(path));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ("attribute,mean,unit,x,y,z", line);
  while (std::getline(table, line)) {
    const auto cells = cellsOf(line);
    EXPECT_EQ(6u, cells.size()) << line;
    if (cells.size() == 6)
      axes[cells[0]] = {
          std::stod(cells[1]),
          std::stod(cells[2]),
          {std::stod(cells[3]), std::stod(cells[4]), std::stod(cells[5])}};
  }
  return axes;
}

/** The columns x, y, z are orthogonal and of length 1. */
void
expectOrthonormal(const std::map<std::string, Axis>& axes)
{
  constexpr double tolerance = 1e-9;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double product = 0.0;
      for (const auto& [name, axis] : axes)
        product += axis.direction[a] * axis.direction[b];
      EXPECT_NEAR(a == b ? 1.0 : 0.0, product, tolerance) << a << b;
    }
}

/** Coordinates are attributes, less their means, in their units, along their axes. */
void
expectProjected(const Dataset& dataset, const std::map<std::string, Axis>& axes)
{
  constexpr double tolerance = 1e-4; // attributes have six digits
  std::map<std::string, std::vector<double>> values;
  for (const auto& [name, axis] : axes)
    values[name] = fieldOf(dataset, name);
  for (int k = 0; k < 3; ++k) {
    const auto coordinates = fieldOf(dataset, std::string(1, "xyz"[k]));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      double expected = 0.0;
      for (const auto& [name, axis] : axes)
        expected += (values[name][i] - axis.mean) / axis.unit * axis.direction[k];
      ASSERT_NEAR(expected, coordinates[i], tolerance) << "xyz"[k] << i;
    }
  }
}

class ProjectTool : public uvol_test::ToolTest {
protected:
  ProjectTool()
      : ToolTest("uvol_project", "out.ply")
  {
  }

  void
  SetUp() override
  {
    uvol_test::writeFile(in_, makeTable());
  }

  const std::string attributes_ = "-attributes a,b,c,d,e ";
  std::string axes_ = folder_ / "axes.csv", picture_ = folder_ / "out.png";
};

TEST_F(ProjectTool, DataWithoutPositionsBecomeACloud)
{
  const Dataset in = pcl_uvol::loadDataset(in_);
  for (const char* name : {"out.ply", "out.pcd", "out.csv", "out.vtp"})
    for (const char* option : {"", "-ascii"}) {
      out_ = folder_ / name;
      const Dataset out = resultOf(attributes_ + option);
      ASSERT_EQ(points, out.cloud.width);
      EXPECT_GT(varianceOf(fieldOf(out, "x")), 0.01) << name;
      const auto labels = fieldOf(out, "label"), d = fieldOf(out, "d");
      for (std::size_t i = 0; i < points; ++i) {
        EXPECT_EQ(truthOf(i), labels[i]) << i;
        EXPECT_NEAR(escapeAttribute(i, 3), d[i], 1e-4);
      }
    }
}

TEST_F(ProjectTool, AxesReproduceTheProjection)
{
  for (const char* options :
       {"", "-method pca", "-raw", "-raw -method pca", "-label truth"}) {
    const Dataset out = resultOf(attributes_ + options + " -axes " + axes_);
    const auto axes = readAxes(axes_);
    ASSERT_EQ(columns, axes.size()) << options;
    expectOrthonormal(axes);
    if (std::string(options).find("-raw") == std::string::npos)
      expectProjected(out, axes);
    else
      for (const auto& [name, axis] : axes)
        EXPECT_EQ(1.0, axis.unit) << name;
  }
}

TEST_F(ProjectTool, RawAxesReproduceTheProjectionInTheirUnits)
{
  // Without the column whose six digits are coarse in the units of the others.
  const Dataset out = resultOf("-attributes a,b,d,e -raw -axes " + axes_);
  expectProjected(out, readAxes(axes_));
}

TEST_F(ProjectTool, PrincipalComponentsFallInVariance)
{
  const Dataset out = resultOf(attributes_ + "-method pca");
  const double x = varianceOf(fieldOf(out, "x")), y = varianceOf(fieldOf(out, "y")),
               z = varianceOf(fieldOf(out, "z"));
  EXPECT_GE(x, y);
  EXPECT_GE(y, z);
  EXPECT_GT(z, 0.0);
  EXPECT_LE(x + y + z, static_cast<double>(columns) + 1e-3);
}

TEST_F(ProjectTool, StarCoordinatesKeepClustersApart)
{
  const auto ratio = [&](const char* method) {
    const auto result =
        uvol_test::succeeded(run(attributes_ + "-label truth -json -method " + method));
    const std::string key = "\"smallest_Fisher_ratio\": ";
    const std::size_t at = result.out.find(key);
    EXPECT_NE(std::string::npos, at) << result.out;
    return at == std::string::npos ? 0.0
                                   : std::stod(result.out.substr(at + key.size()));
  };
  const double star = ratio("star"), principal = ratio("pca");
  EXPECT_GT(star, 1.0);
  EXPECT_GE(star, principal * (1.0 - 1e-6));
}

TEST_F(ProjectTool, LabelsAreThoseOfTheField)
{
  // One that clusters have nothing to do with.
  std::string table = makeTable("a,b,c,d,e,label");
  uvol_test::writeFile(in_, table);
  const auto labels = fieldOf(resultOf(attributes_), "label");
  for (std::size_t i = 0; i < points; ++i)
    EXPECT_EQ(truthOf(i), labels[i]);
  uvol_test::writeFile(in_, makeTable("label,b,c,d,e,other"));
  const auto others = fieldOf(resultOf("-attributes b,c,d,e -label other"), "label");
  for (std::size_t i = 0; i < points; ++i)
    EXPECT_EQ(truthOf(i), others[i]);
}

TEST_F(ProjectTool, PointsWithoutEveryAttributeAreLeftOut)
{
  std::string table = makeTable();
  table += ",1,2,3,4,0\n1,nan,2,3,4,0\n";
  uvol_test::writeFile(in_, table);
  const auto result = run(attributes_ + "-json");
  EXPECT_NE(std::string::npos, result.out.find("\"missing_values\": 2"));
  EXPECT_EQ(points, pcl_uvol::loadDataset(out_).cloud.width);
}

TEST_F(ProjectTool, DrawsAPicture)
{
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const char* view : {"", "-view front", "-view iso"}) {
    uvol_test::succeeded(run(attributes_ + "-png " + picture_ + " " + view));
    int channels = 0;
    const auto image = uvol_test::readPng(picture_, channels);
    EXPECT_EQ(640u, image.width);
    EXPECT_EQ(512u, image.height);
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      drawn += image.color[4 * i] < 250;
    EXPECT_GT(drawn, 300u) << view;
    EXPECT_LT(drawn, image.pixels() / 2) << view;
    EXPECT_EQ(0, std::count(pictures.begin(), pictures.end(), image.color)) << view;
    pictures.push_back(image.color);
  }
}

TEST_F(ProjectTool, FewAttributesMakeFlatClouds)
{
  for (const char* method : {"star", "pca"}) {
    const std::string option = std::string(" -label truth -method ") + method;
    const Dataset plane = resultOf("-attributes a,b" + option + " -axes " + axes_);
    expectProjected(plane, readAxes(axes_));
    EXPECT_EQ(std::vector<double>(points, 0.0), fieldOf(plane, "z")) << method;
    EXPECT_GT(varianceOf(fieldOf(plane, "y")), 0.0) << method;
    const Dataset line = resultOf("-attributes d" + option + " -axes " + axes_);
    expectProjected(line, readAxes(axes_));
    EXPECT_EQ(std::vector<double>(points, 0.0), fieldOf(line, "y")) << method;
    EXPECT_GT(varianceOf(fieldOf(line, "x")), 0.0) << method;
  }
}

TEST_F(ProjectTool, LengthsOfVectorsAreAttributes)
{
  const Dataset out = resultOf("-attributes '|a,d|,b,c,e' -axes " + axes_);
  const auto axes = readAxes(axes_);
  ASSERT_EQ(4u, axes.size());
  EXPECT_EQ(1u, axes.count("|a,d|"));
  expectOrthonormal(axes);
  expectProjected(out, axes);
}

TEST_F(ProjectTool, PositionsAreAttributesIfThereAreAny)
{
  expectError("-position", "no_coordinates_for");
  uvol_test::writeFile(in_, makeTable("x,y,z,d,e,truth"));
  resultOf("-position -attributes d,e -axes " + axes_);
  const auto axes = readAxes(axes_);
  EXPECT_EQ(5u, axes.size());
  EXPECT_EQ(1u, axes.count("x"));
}

TEST_F(ProjectTool, ConstantAttributesAreLeftOutWithAWarning)
{
  std::string table = "a,b,c,d,e,same\n";
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t column = 0; column < columns; ++column)
      table += std::to_string(escapeAttribute(i, column)) + ',';
    table += "7\n";
  }
  uvol_test::writeFile(in_, table);
  const auto result =
      uvol_test::succeeded(run("-attributes a,c,d,e,same -json -axes " + axes_));
  EXPECT_TRUE(uvol_test::hasMessage(result, "constant_attribute")) << result.out;
  EXPECT_EQ(0u, readAxes(axes_).count("same"));
}

TEST_F(ProjectTool, SameBytesForAnyNumberOfThreads)
{
  for (const char* options : {"", "-method pca", "-raw"}) {
    std::string expected;
    for (const char* threads : {"1", "2", "3"}) {
      uvol_test::succeeded(run(attributes_ + options + " -axes " + axes_ + " -png " +
                               picture_ + " -threads " + threads));
      const std::string bytes = readFile(out_) + readFile(axes_) + readFile(picture_);
      if (expected.empty())
        expected = bytes;
      EXPECT_TRUE(expected == bytes) << options << ' ' << threads;
    }
  }
}

TEST_F(ProjectTool, RefusesAttributesThatAreNone)
{
  expectError("", "command_line", "-attributes");
  for (const char* names : {"a,,b", ",a,b", "a,b,", ","})
    expectError(std::string("-attributes ") + names, "command_line", "-attributes");
  expectError("-attributes ''", "command_line", "-attributes");
  expectError("-attributes a,b,nope", "unknown_lone_field", R"("nope")");
  expectError("-attributes a,b,a", "same_attributes");
  expectError("-attributes '|a,b'", "bar_not_closed", "|a,b");
  expectError("-attributes '|a,nope|,b,c'", "unknown_operand", "\"nope\"");
}

TEST_F(ProjectTool, RefusesLabelsThatAreNone)
{
  expectError(attributes_ + "-label nope", "unknown_field", "\"nope\"");
  expectError(attributes_ + "-label a", "labels_not_integers");
}

TEST_F(ProjectTool, RefusesWrongCommandLines)
{
  expectError(attributes_ + "-method umap", "command_line", "umap");
  expectError(attributes_ + "-view above", "command_line", "above");
  expectError(attributes_ + "-wat", "command_line", "-wat");
  expectError(attributes_ + "more", "command_line", "more");
  expectError(
      attributes_ + "-axes " + (folder_ / "axes.txt"), "unwritten_ending", ".csv");
  expectError(
      attributes_ + "-axes " + (folder_ / "no/axes.csv"), "no_folder", "axes.csv");
  expectError(
      attributes_ + "-png " + (folder_ / "out.jpg"), "unwritten_ending", ".png");
}

TEST_F(ProjectTool, RefusesOtherFiles)
{
  out_ = folder_ / "out.what";
  expectError(attributes_, "unwritten_ending", "out.what");
  out_ = folder_ / "out.ply";
  uvol_test::writeFile(in_, "a,b,c,d,e\n");
  expectError(attributes_, "no_points");
  uvol_test::writeFile(in_, "a,b,c,d,e\n1,2,3,4,\n,1,2,3,4\n");
  expectError(attributes_, "no_complete_point");
  in_ = folder_ / "missing.csv";
  expectError(attributes_, "no_such_file", "missing.csv");
}

} // namespace test_uvol_project
