// SPDX-License-Identifier: BSD-3-Clause
// The main job from the outside: files in and out, exit codes, sentences, nothing left
// behind.
#include "common/scalar_field.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>
#include <utility>

namespace test_uvol_isosurface {

using uvol_test::runCommand;

/** A CSV of a radial field of uniform points, shifted, with a vector and a label. */
std::string
radialCsv(std::size_t n, double dx = 0.0, double dy = 0.0, double dz = 0.0)
{
  uvol_test::Random random(1);
  std::ostringstream csv;
  csv.precision(17);
  csv << "x,y,z,density,vel_0,vel_1,vel_2,experiment\n";
  for (std::size_t i = 0; i < n; ++i) {
    // 20 bits: sums with the shift are exact in double
    const auto coordinate = [&] {
      return std::floor(random.uniform() * 0x1p20) / 0x1p16;
    };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    csv << x + dx << ',' << y + dy << ',' << z + dz << ','
        << 20.0 - std::hypot(x - 8.0, y - 8.0, z - 8.0) << ',' << x << ',' << y << ','
        << z << ',' << i % 2 << '\n';
  }
  return csv.str();
}

/** 20,000 of these points with a label of their own; without one they are left out. */
std::string
editedCsv(const std::function<std::string(double x, double y, double z)>& label)
{
  std::istringstream table(radialCsv(20000));
  std::string line;
  std::getline(table, line);
  std::ostringstream edited;
  edited << line << ",label\n";
  while (std::getline(table, line)) {
    std::istringstream row(line);
    double x, y, z;
    char comma;
    row >> x >> comma >> y >> comma >> z;
    if (const std::string text = label(x, y, z); !text.empty())
      edited << line << ',' << text << '\n';
  }
  return edited.str();
}

/** Coordinates with the origin added, in the order of the file. */
std::vector<double>
readCoordinates(const std::string& path)
{
  const pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path);
  std::vector<double> xyz;
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float relative;
      std::memcpy(&relative,
                  &dataset.cloud.data[i * dataset.cloud.point_step + axis * 4],
                  sizeof(relative));
      xyz.push_back(relative + dataset.origin[axis]);
    }
  return xyz;
}

std::size_t
pointsIn(const std::string& path)
{
  return pcl_uvol::loadDataset(path).cloud.width;
}

class Isosurface : public uvol_test::ToolTest {
protected:
  Isosurface()
      : ToolTest("uvol_isosurface", "out.ply")
  {
    uvol_test::writeFile(in_, radialCsv(4000));
  }

  /** With the isovalue 15 of the field density. */
  void
  extract(const std::string& input,
          const std::string& output,
          const std::string& options = "") const
  {
    const auto result = runCommand("uvol_isosurface " + input + " " + output +
                                   " -field density -iso 15" + options);
    ASSERT_EQ(0, result.exit_code) << output << options << result.err;
  }

  const std::string job_ = "-field density -iso 15 ";
};

TEST_F(Isosurface, WritesOrientedPointsWithEveryField)
{
  const auto result =
      uvol_test::succeeded(run("-field density -iso 14,16 -interpolation linear -v"));
  for (const char* word :
       {"read", "tree", "neighborhoods", "write", "total", "isopoints"})
    EXPECT_NE(std::string::npos, result.out.find(word)) << word;
  const pcl_uvol::Dataset surface = pcl_uvol::loadDataset(out_);
  EXPECT_GT(surface.cloud.width, 500u);
  const auto field = [&](const char* name) {
    return pcl_uvol::ScalarField(surface.cloud.fields, name);
  };
  EXPECT_EQ(pcl::PCLPointField::INT32,
            field("experiment").getComponents().front().datatype);
  const auto density = field("density"), isovalue = field("isovalue");
  const auto speed = field("|vel|");
  const pcl_uvol::ScalarField axes[] = {field("x"), field("y"), field("z")};
  const pcl_uvol::ScalarField normals[] = {
      field("normal_x"), field("normal_y"), field("normal_z")};
  for (std::size_t i = 0; i < surface.cloud.width; ++i) {
    const auto* const point = &surface.cloud.data[i * surface.cloud.point_step];
    EXPECT_NEAR(isovalue.read(point), density.read(point), 1e-4);
    double radius_sq = 0.0, outward = 0.0, length_sq = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double d = axes[k].read(point) + surface.origin[std::size_t(k)] - 8.0;
      radius_sq += d * d;
      outward += d * normals[k].read(point);
      length_sq += std::pow(axes[k].read(point) + surface.origin[std::size_t(k)], 2);
    }
    const double radius = 20.0 - isovalue.read(point);
    EXPECT_NEAR(radius, std::sqrt(radius_sq), 0.5);
    EXPECT_GT(outward / std::sqrt(radius_sq), 0.8); // lower values lie outside
    EXPECT_NEAR(std::sqrt(length_sq), speed.read(point), 1e-3); // vel = position
  }
}

TEST_F(Isosurface, FiltersByErrorAndSupport)
{
  // a hole in the sampling where the surface passes
  uvol_test::writeFile(in_, editedCsv([](double x, double y, double z) {
                         return std::hypot(x - 13.0, y - 8.0, z - 8.0) < 2.5 ? "" : "0";
                       }));
  const auto all = uvol_test::succeeded(run(job_ + "-json"));
  const double median = nlohmann::json::parse(all.out)["estimated_error"]["median"];
  const std::size_t count = pointsIn(out_);
  const pcl_uvol::Dataset surface = pcl_uvol::loadDataset(out_);
  const pcl_uvol::ScalarField error(surface.cloud.fields, "error");
  const pcl_uvol::ScalarField support(surface.cloud.fields, "support");
  std::vector<double> errors;
  std::size_t bridged = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto* const point = &surface.cloud.data[i * surface.cloud.point_step];
    errors.push_back(error.read(point));
    bridged += support.read(point) == 2.0;
    EXPECT_GE(support.read(point), 1.0);
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_NEAR(median, errors[count / 2], 0.1 * median);
  std::ostringstream middle;
  middle.precision(17);
  middle << errors[count / 2];
  ASSERT_EQ(0, run(job_ + "-max-error " + middle.str()).exit_code);
  EXPECT_EQ(static_cast<std::size_t>(
                std::upper_bound(errors.begin(), errors.end(), errors[count / 2]) -
                errors.begin()),
            pointsIn(out_));
  ASSERT_EQ(0, run(job_ + "-drop-bridged").exit_code);
  EXPECT_EQ(count - bridged, pointsIn(out_));
  EXPECT_GT(bridged, 0u);

  for (const char* right : {"-interpolation linear -max-error 1",
                            "-max-error auto",
                            "-interpolation linear -max-error auto",
                            "-interpolation linear -drop-bridged",
                            "-normals edge",
                            "-validate 3 -validate-by blocks"})
    EXPECT_EQ(0, run(job_ + right).exit_code) << right;
  for (const char* wrong : {"-interpolation linear -normals fit",
                            "-validate 1",
                            "-validate-by blocks",
                            "-interpolation cubic",
                            "-max-error automatic",
                            "-max-error -1"})
    EXPECT_EQ(2, run(job_ + wrong).exit_code) << wrong;
}

TEST_F(Isosurface, SaysWhichFieldOfTheSamplesIsLeftOut)
{
  EXPECT_FALSE(uvol_test::hasMessage(run(job_ + "-json"), "replaced_field"));
  std::string csv = radialCsv(2000);
  csv.replace(csv.find("experiment"), 10, "error");
  uvol_test::writeFile(in_, csv);
  const auto result = uvol_test::succeeded(run(job_ + "-json"));
  EXPECT_EQ("error",
            uvol_test::warnedValues(nlohmann::json::parse(result.out), "replaced_field")
                .at("field"));
}

TEST_F(Isosurface, LabelsGetNormalsFromTheirNeighbors)
{
  // A ball of ones: no polynomial fits it, and edges point anywhere.
  uvol_test::writeFile(in_, editedCsv([](double x, double y, double z) {
                         return std::hypot(x - 8.0, y - 8.0, z - 8.0) < 5.0 ? "1" : "0";
                       }));
  uvol_test::succeeded(run("-field label -iso 0.5"));
  const pcl_uvol::Dataset surface = pcl_uvol::loadDataset(out_);
  double mean_cosine = 0.0;
  for (std::size_t i = 0; i < surface.cloud.width; ++i) {
    const auto* const point = &surface.cloud.data[i * surface.cloud.point_step];
    Eigen::Vector3d x, normal;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      x[axis] = pcl_uvol::ScalarField(surface.cloud.fields, name).read(point) +
                surface.origin[static_cast<std::size_t>(axis)] - 8.0;
      normal[axis] =
          pcl_uvol::ScalarField(surface.cloud.fields, "normal_" + name).read(point);
    }
    mean_cosine += x.normalized().dot(normal) / surface.cloud.width;
  }
  EXPECT_GT(mean_cosine, 0.97);
}

TEST_F(Isosurface, SameBytesForAnyNumberOfThreadsAndEveryRun)
{
  for (const std::string ending : {"ply", "pcd", "csv", "vtp"}) {
    const std::string a = folder_ / ("a." + ending), b = folder_ / ("b." + ending);
    extract(in_, a, " -threads 1");
    for (const char* const threads : {" -threads 2", ""}) {
      extract(in_, b, threads);
      EXPECT_EQ(uvol_test::readFile(a), uvol_test::readFile(b)) << ending;
    }
  }
}

TEST_F(Isosurface, ShiftedCloudsGiveShiftedIsopoints)
{
  const double shift[3] = {500000.0, 5500000.0, 100.0};
  const std::string shifted = folder_ / "shifted.csv";
  uvol_test::writeFile(shifted, radialCsv(4000, shift[0], shift[1], shift[2]));
  for (const std::string ending : {"ply", "pcd", "csv", "vtp"})
    for (const char* ascii : {"", " -ascii"}) {
      const std::string a = folder_ / ("a." + ending), b = folder_ / ("b." + ending);
      extract(in_, a, ascii);
      extract(shifted, b, ascii);
      const auto expected = readCoordinates(a), found = readCoordinates(b);
      ASSERT_EQ(expected.size(), found.size()) << ending << ascii;
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(expected[i], found[i] - shift[i % 3], 16e-6) << ending << ascii;
    }
}

TEST_F(Isosurface, SelectsRowsFieldsAndScales)
{
  const std::string half = folder_ / "half.csv";
  extract(in_, half, " -where \"experiment=1\"");
  EXPECT_LT(pointsIn(half), 4000u);
  for (const char* const options : {"-field '|vel|' -iso 10",
                                    "-field 'vel[1]' -iso 10",
                                    "-field '|vel_0,vel_1|' -iso 10 -scale auto",
                                    "-field density -iso 15 -scale 1,1,9",
                                    "-field x -iso 5 -xyz 4,5,6"})
    expectSuccess(options);
  const auto json = uvol_test::succeeded(run(job_ + "-json"));
  EXPECT_EQ('{', json.out.front());
}

TEST_F(Isosurface, ReportsAreShortForPeopleAndNumbersForPrograms)
{
  const std::string all = "-field density -iso 14,16";
  const auto first = nlohmann::json::parse(run(all + " -json").out);
  const double median = first["estimated_error"]["median"];
  EXPECT_GT(median, 0.0);
  const std::string options = all + " -max-error " + std::to_string(median);
  const auto told = uvol_test::succeeded(run(options));
  EXPECT_LT(std::count(told.out.begin(), told.out.end(), '\n'), 12) << told.out;
  EXPECT_EQ(std::string::npos, told.out.find(" ms")) << told.out;
  EXPECT_EQ(std::string::npos, told.out.find(" 0,")) << told.out; // nothing to tell
  const auto report = nlohmann::json::parse(run(options + " -json").out);
  EXPECT_EQ(report["isovalues"], (std::vector<double>{14.0, 16.0}));
  EXPECT_LE(report["estimated_error"]["largest"], median);
  EXPECT_GT(report["memory"]["peak"], 1e6);
  EXPECT_GT(report["counts"]["removed_by_error"], 0);
  // What is counted is what is written.
  const pcl_uvol::Dataset surface = pcl_uvol::loadDataset(out_);
  EXPECT_EQ(report["counts"]["isopoints"], surface.cloud.width);
  const std::vector<std::size_t> each = report["isopoints_per_isovalue"];
  ASSERT_EQ(each.size(), 2u);
  EXPECT_EQ(each[0] + each[1], surface.cloud.width);
  EXPECT_GT(each[0], 0u);
  EXPECT_GT(each[1], 0u);
  for (const auto& count : report["counts"].items())
    EXPECT_FALSE(report["milliseconds"].contains(count.key())) << count.key();
  const auto empty = nlohmann::json::parse(run("-field density -iso 1e9 -json").out);
  EXPECT_TRUE(empty["estimated_error"].is_null());
}

TEST_F(Isosurface, AnIsovalueOutsideTheRangeGivesAnEmptyFileAndAWarning)
{
  for (const char* name : {"out.ply", "out.pcd", "out.csv", "out.vtp"}) {
    out_ = folder_ / name;
    const auto result = uvol_test::succeeded(run("-field density -iso -3 -json"));
    EXPECT_TRUE(uvol_test::hasMessage(result, "no_isopoints")) << result.out;
    EXPECT_EQ(0u, pointsIn(out_)) << name;
  }
}

TEST_F(Isosurface, RefusesWrongCommandLines)
{
  for (const auto& [options, value] : {std::pair("", "-iso"),
                                       std::pair("-iso", "-iso"),
                                       std::pair("-iso abc", "abc"),
                                       std::pair("-iso 1.5m", "1.5m"),
                                       std::pair("-iso nan", "nan"),
                                       std::pair("-iso 1,,2", "-iso"),
                                       std::pair("-iso 15 -bogus", "-bogus"),
                                       std::pair("-iso 15 leftover", "leftover"),
                                       std::pair("-iso 15 -threads -1", "-threads"),
                                       std::pair("-iso 15 -scale 1,2", "-scale"),
                                       std::pair("-iso 15 -scale 1,2,x", "-scale"),
                                       std::pair("-iso 15 -criterion some", "some")})
    expectError(std::string("-field density ") + options, "command_line", value);
  uvol_test::expectError(runCommand("uvol_isosurface -json"), "command_line", "<in>");
  uvol_test::expectError(
      runCommand("uvol_isosurface -json " + in_), "command_line", "<out>");
  EXPECT_EQ(0, run("-h").exit_code);
  EXPECT_NE(std::string::npos, run("-h").out.find("-iso"));
  EXPECT_EQ(0, run("-version").exit_code);
}

TEST_F(Isosurface, RefusesBadFilesInOneSentence)
{
  expectError("-field mass -iso 15", "unknown_lone_field", "density");
  expectError("-iso 15", "several_scalar_fields", "density");
  expectError(job_ + "-where 'mass>1'", "unknown_operand", "mass");
  expectError(job_ + "-where 'density>>1'", "operand_missing", "density>>1");
  expectError(job_ + "-where 'density>1e9'", "no_points_where", "density>1e9");
  for (const auto& [name, code] : {std::pair("in.csv/out.ply", "not_a_folder"),
                                   std::pair("out.xyz9", "unwritten_ending")}) {
    out_ = folder_ / name;
    expectError(job_, code, name);
  }
  out_ = folder_ / "out.ply";
  for (const auto& [name, code] :
       {std::pair("none.pcd", "no_such_file"), std::pair("", "is_directory")}) {
    in_ = folder_ / name;
    expectError(job_, code, name);
  }

  const std::tuple<const char*, const char*, const char*> files[] = {
      {"empty.csv", "empty_file", ""},
      {"empty.pcd", "empty_file", ""},
      {"empty.ply", "empty_file", ""},
      {"empty.vtk", "empty_file", ""},
      {"empty.vtu", "empty_file", ""},
      {"header.csv", "no_points", "x,y,z,density\n"},
      {"text.csv", "text_in_column", "x,y,z,density\n0,0,zero,1\n1,1,1,2\n"},
      {"short.csv", "wrong_count", "x,y,z,density\n0,0,0,1\n1,1,1\n"},
      {"nan.csv", "no_finite_value", "x,y,z,density\n0,0,0,\n1,1,1,nan\n"},
      {"nowhere.csv", "no_usable_sample", "x,y,z,density\nnan,0,0,1\n1,nan,1,2\n"},
      {"absurd.pcd",
       "truncated_data",
       "VERSION .7\nFIELDS x y z density\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
       "WIDTH 99999999999\nHEIGHT 1\nPOINTS 99999999999\nDATA binary\n"},
      {"more.pcd",
       "truncated_data",
       "VERSION .7\nFIELDS x y z density\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
       "WIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n0 0 0 1\n1 1 1 2\n"},
      {"more.ply",
       "truncated_part",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nproperty float density\nend_header\n0 0 0 1\n1 1 1 2\n"},
      {"absurd.ply",
       "truncated_part",
       "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty "
       "float "
       "x\nproperty float y\nproperty float z\nproperty float density\nend_header\n"},
      {"garbage.vtk", "wrong_start", "not a vtk file\n"},
      {"garbage.vtu", "missing_part", "<VTKFile type=\"UnstructuredGrid\"><Unst"}};
  for (const auto& [name, code, content] : files) {
    in_ = folder_ / name;
    uvol_test::writeFile(in_, content);
    uvol_test::expectError(run(job_ + "-json"), code);
    EXPECT_EQ(2u, folder_.list().size());
    std::filesystem::remove(in_);
  }
}

TEST_F(Isosurface, TruncatedFilesOfEachEncodingFail)
{
  const std::string samples = in_;
  for (const auto& [name, ascii, early, late] :
       {std::tuple("t.pcd", "", "truncated_data", "truncated_data"),
        std::tuple("t.pcd", " -ascii", "truncated_data", "wrong_count"),
        std::tuple("t.ply", "", "truncated_part", "truncated_part"),
        std::tuple("t.ply", " -ascii", "truncated_part", "numbers_unlike_header")}) {
    in_ = folder_ / name;
    extract(samples, in_, ascii);
    const std::string content = uvol_test::readFile(in_);
    for (const auto& [part, code] :
         {std::pair(0.02, early), std::pair(0.3, late), std::pair(0.9, late)}) {
      const double length = part * static_cast<double>(content.size());
      uvol_test::writeFile(in_, content.substr(0, static_cast<std::size_t>(length)));
      expectError(job_, code, name);
    }
    std::filesystem::remove(in_);
  }
}

TEST_F(Isosurface, DegenerateCloudsGiveWhatTheyHold)
{
  const std::tuple<const char*, const char*, std::size_t> files[] = {
      {"one.csv", "x,y,z,density\n1,2,3,4\n", 0},
      {"two.csv", "x,y,z,density\n0,0,0,10\n1,0,0,20\n", 1},
      {"equal.csv", "x,y,z,density\n1,1,1,10\n1,1,1,20\n1,1,1,20\n", 0},
      {"collinear.csv", "x,y,z,density\n0,0,0,10\n1,1,1,20\n2,2,2,10\n", 2},
      {"constant.csv", "x,y,z,density\n0,0,0,10\n1,0,0,10\n0,1,0,10\n0,0,1,10\n", 0},
      {"coplanar.csv", "x,y,z,density\n0,0,5,10\n1,0,5,20\n0,1,5,10\n1,1,5,20\n", 2}};
  for (const auto& [name, content, least] : files) {
    SCOPED_TRACE(name);
    in_ = folder_ / name;
    uvol_test::writeFile(in_, content);
    const auto result = uvol_test::succeeded(run(job_ + "-json"));
    EXPECT_GE(pointsIn(out_), least);
    EXPECT_EQ(least == 0, pointsIn(out_) == 0);
    EXPECT_EQ(least == 0,
              uvol_test::hasMessage(result, "no_isopoints") ||
                  uvol_test::hasMessage(result, "constant_field"))
        << result.out;
  }
}

TEST_F(Isosurface, AFullDiskLeavesNothingBehind)
{
  // 8 blocks of 512 or 1024 bytes: less than any of the results
  for (const auto& [name, code] : {std::pair("out.ply", "system_error"),
                                   std::pair("out.pcd", "system_error"),
                                   std::pair("out.csv", "system_error"),
                                   std::pair("out.vtp", "full_disk")}) {
    const auto result = runCommand("ulimit -f 8; uvol_isosurface " + in_ + " " +
                                   (folder_ / name) + " -json " + job_);
    uvol_test::expectError(result, code, name);
    EXPECT_EQ(std::vector<std::string>{"in.csv"}, folder_.list());
  }
}

} // namespace test_uvol_isosurface
