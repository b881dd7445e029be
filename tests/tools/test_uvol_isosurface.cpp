// SPDX-License-Identifier: BSD-3-Clause
// The main job from the outside: files in and out, exit codes, sentences, nothing left
// behind.
#include "common/scalar_field.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include <pcl_uvol/io/dataset.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

namespace test_uvol_isosurface {

using uvol_test::CommandResult;
using uvol_test::runCommand;
using uvol_test::TemporaryFolder;

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

/** Failed as it should: that exit code, one sentence with that text, no file left. */
void
expectFailure(const CommandResult& result,
              int exit_code,
              const std::string& text,
              const TemporaryFolder& folder,
              std::size_t files)
{
  EXPECT_EQ(exit_code, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.err.find(text)) << result.err;
  // The place of what is wrong in an expression is shown.
  const bool is_marked = result.err.find("\n  ") != std::string::npos;
  EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), is_marked ? 3 : 2)
      << result.err;
  EXPECT_EQ(files, folder.list().size());
}

class Isosurface : public testing::Test {
protected:
  Isosurface()
  {
    uvol_test::writeFile(in_, radialCsv(4000));
  }

  CommandResult
  run(const std::string& arguments) const
  {
    return runCommand("uvol_isosurface " + arguments);
  }

  TemporaryFolder folder_;
  std::string in_ = folder_ / "in.csv";
  std::string out_ = folder_ / "out.ply";
};

TEST_F(Isosurface, WritesOrientedPointsWithEveryField)
{
  const auto result =
      run(in_ + " " + out_ + " -field density -iso 14,16 -interpolation linear -v");
  ASSERT_EQ(0, result.exit_code) << result.err;
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
  const std::string base = in_ + " " + out_ + " -field density -iso 15 ";
  const auto all = run(base);
  ASSERT_EQ(0, all.exit_code) << all.err;
  EXPECT_NE(std::string::npos, all.out.find("estimated error: median")) << all.out;
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
  std::ostringstream middle;
  middle.precision(17);
  middle << errors[count / 2];
  ASSERT_EQ(0, run(base + "-max-error " + middle.str()).exit_code);
  EXPECT_EQ(static_cast<std::size_t>(
                std::upper_bound(errors.begin(), errors.end(), errors[count / 2]) -
                errors.begin()),
            pointsIn(out_));
  ASSERT_EQ(0, run(base + "-drop-bridged").exit_code);
  EXPECT_EQ(count - bridged, pointsIn(out_));
  EXPECT_GT(bridged, 0u);

  for (const char* right : {"-interpolation linear -max-error 1",
                            "-max-error auto",
                            "-interpolation linear -max-error auto",
                            "-interpolation linear -drop-bridged",
                            "-normals edge",
                            "-validate 3 -validate-by blocks"})
    EXPECT_EQ(0, run(base + right).exit_code) << right;
  for (const char* wrong : {"-interpolation linear -normals fit",
                            "-validate 1",
                            "-validate-by blocks",
                            "-interpolation cubic",
                            "-max-error automatic",
                            "-max-error -1"})
    EXPECT_EQ(2, run(base + wrong).exit_code) << wrong;
}

TEST_F(Isosurface, SaysWhichFieldOfTheSamplesIsLeftOut)
{
  EXPECT_EQ(std::string::npos,
            run(in_ + " " + out_ + " -field density -iso 15").err.find("not copied"));
  std::string csv = radialCsv(2000);
  csv.replace(csv.find("experiment"), 10, "error");
  uvol_test::writeFile(in_, csv);
  const auto result = run(in_ + " " + out_ + " -field density -iso 15");
  EXPECT_EQ(0, result.exit_code);
  EXPECT_NE(std::string::npos,
            result.err.find("field 'error' of the samples is not copied"))
      << result.err;
}

TEST_F(Isosurface, LabelsGetNormalsFromTheirNeighbors)
{
  // A ball of ones: no polynomial fits it, and edges point anywhere.
  uvol_test::writeFile(in_, editedCsv([](double x, double y, double z) {
                         return std::hypot(x - 8.0, y - 8.0, z - 8.0) < 5.0 ? "1" : "0";
                       }));
  const auto result = run(in_ + " " + out_ + " -field label -iso 0.5");
  ASSERT_EQ(0, result.exit_code) << result.err;
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
  for (const char* ending : {"ply", "pcd", "csv", "vtp"}) {
    const std::string a = folder_ / ("a." + std::string(ending));
    const std::string b = folder_ / ("b." + std::string(ending));
    ASSERT_EQ(0, run(in_ + " " + a + " -field density -iso 15 -threads 1").exit_code);
    ASSERT_EQ(0, run(in_ + " " + b + " -field density -iso 15 -threads 2").exit_code);
    EXPECT_EQ(uvol_test::readFile(a), uvol_test::readFile(b)) << ending;
    ASSERT_EQ(0, run(in_ + " " + b + " -field density -iso 15").exit_code);
    EXPECT_EQ(uvol_test::readFile(a), uvol_test::readFile(b)) << ending;
  }
}

TEST_F(Isosurface, ShiftedCloudsGiveShiftedIsopoints)
{
  const double shift[3] = {500000.0, 5500000.0, 100.0};
  const std::string shifted = folder_ / "shifted.csv";
  uvol_test::writeFile(shifted, radialCsv(4000, shift[0], shift[1], shift[2]));
  for (const char* ending : {"ply", "pcd", "csv", "vtp"})
    for (const char* ascii : {"", " -ascii"}) {
      const std::string a = folder_ / ("a." + std::string(ending));
      const std::string b = folder_ / ("b." + std::string(ending));
      const auto extract = [&](const std::string& from, const std::string& to) {
        std::ostringstream command;
        command << from << ' ' << to << " -field density -iso 15" << ascii;
        return run(command.str()).exit_code;
      };
      ASSERT_EQ(0, extract(in_, a));
      ASSERT_EQ(0, extract(shifted, b));
      const auto expected = readCoordinates(a), found = readCoordinates(b);
      ASSERT_EQ(expected.size(), found.size()) << ending << ascii;
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(expected[i], found[i] - shift[i % 3], 16e-6) << ending << ascii;
    }
}

TEST_F(Isosurface, SelectsRowsFieldsAndScales)
{
  const std::string half = folder_ / "half.csv";
  ASSERT_EQ(0,
            run(in_ + " " + half + " -field density -iso 15 -where \"experiment=1\"")
                .exit_code);
  EXPECT_LT(pointsIn(half), 4000u);
  EXPECT_EQ(0, run(in_ + " " + out_ + " -field '|vel|' -iso 10").exit_code);
  EXPECT_EQ(0, run(in_ + " " + out_ + " -field 'vel[1]' -iso 10").exit_code);
  EXPECT_EQ(
      0,
      run(in_ + " " + out_ + " -field '|vel_0,vel_1|' -iso 10 -scale auto").exit_code);
  EXPECT_EQ(0,
            run(in_ + " " + out_ + " -field density -iso 15 -scale 1,1,9").exit_code);
  EXPECT_EQ(0, run(in_ + " " + out_ + " -field x -iso 5 -xyz 4,5,6").exit_code);
  const auto json = run(in_ + " " + out_ + " -field density -iso 15 -json");
  EXPECT_EQ(0, json.exit_code);
  EXPECT_EQ('{', json.out.front());
}

TEST_F(Isosurface, ReportsAreShortForPeopleAndNumbersForPrograms)
{
  const std::string all = in_ + " " + out_ + " -field density -iso 14,16";
  const auto first = nlohmann::json::parse(run(all + " -json").out);
  const double median = first["estimated_error"]["median"];
  EXPECT_GT(median, 0.0);
  const std::string options = all + " -max-error " + std::to_string(median);
  const auto told = run(options);
  ASSERT_EQ(0, told.exit_code) << told.err;
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
  const auto empty = nlohmann::json::parse(
      run(in_ + " " + out_ + " -field density -iso 1e9 -json").out + "");
  EXPECT_TRUE(empty["estimated_error"].is_null());
}

TEST_F(Isosurface, AnIsovalueOutsideTheRangeGivesAnEmptyFileAndAWarning)
{
  for (const char* ending : {"ply", "pcd", "csv", "vtp"}) {
    const std::string empty = folder_ / ("empty." + std::string(ending));
    const auto result = run(in_ + " " + empty + " -field density -iso -3 -json");
    EXPECT_EQ(0, result.exit_code);
    EXPECT_TRUE(uvol_test::hasMessage(result, "no_isopoints")) << result.out;
    EXPECT_EQ(0u, pointsIn(empty)) << ending;
  }
}

TEST_F(Isosurface, RefusesWrongCommandLines)
{
  const std::string job = in_ + " " + out_ + " -field density ";
  expectFailure(run(""), 2, "", folder_, 1);
  expectFailure(run(in_), 2, "", folder_, 1);
  expectFailure(run(job), 2, "-iso", folder_, 1);
  expectFailure(run(job + "-iso"), 2, "-iso", folder_, 1);
  expectFailure(run(job + "-iso abc"), 2, "abc", folder_, 1);
  expectFailure(run(job + "-iso 1.5m"), 2, "1.5m", folder_, 1);
  expectFailure(run(job + "-iso nan"), 2, "nan", folder_, 1);
  expectFailure(run(job + "-iso 1,,2"), 2, "-iso", folder_, 1);
  expectFailure(run(job + "-iso 15 -bogus"), 2, "-bogus", folder_, 1);
  expectFailure(run(job + "-iso 15 leftover"), 2, "leftover", folder_, 1);
  expectFailure(run(job + "-iso 15 -threads -1"), 2, "-threads", folder_, 1);
  expectFailure(run(job + "-iso 15 -scale 1,2"), 2, "-scale", folder_, 1);
  expectFailure(run(job + "-iso 15 -scale 1,2,x"), 2, "-scale", folder_, 1);
  expectFailure(run(job + "-iso 15 -criterion some"), 2, "some", folder_, 1);
  EXPECT_EQ(0, run("-h").exit_code);
  EXPECT_NE(std::string::npos, run("-h").out.find("-iso"));
  EXPECT_EQ(0, run("-version").exit_code);
}

TEST_F(Isosurface, RefusesBadFilesInOneSentence)
{
  const std::string job = " " + out_ + " -field density -iso 15";
  expectFailure(run((folder_ / "none.pcd") + job), 1, "none.pcd", folder_, 1);
  expectFailure(run((folder_ / "") + job), 1, "", folder_, 1);
  expectFailure(
      run(in_ + " " + out_ + " -field mass -iso 15"), 1, "density", folder_, 1);
  expectFailure(run(in_ + " " + out_ + " -iso 15"), 1, "density", folder_, 1);
  expectFailure(
      run(in_ + " " + (folder_ / "in.csv/out.ply") + " -field density -iso 15"),
      1,
      "in.csv",
      folder_,
      1);
  expectFailure(run(in_ + " " + (folder_ / "out.xyz9") + " -field density -iso 15"),
                1,
                "out.xyz9",
                folder_,
                1);
  expectFailure(run(in_ + job + " -where \"mass>1\""), 1, "mass", folder_, 1);
  expectFailure(run(in_ + job + " -where \"density>>1\""), 1, "density>>1", folder_, 1);
  expectFailure(run(in_ + job + " -where \"density>1e9\""), 1, "no points", folder_, 1);

  const std::pair<const char*, const char*> files[] = {
      {"empty.csv", ""},
      {"empty.pcd", ""},
      {"empty.ply", ""},
      {"empty.vtk", ""},
      {"empty.vtu", ""},
      {"header.csv", "x,y,z,density\n"},
      {"text.csv", "x,y,z,density\n0,0,zero,1\n1,1,1,2\n"},
      {"short.csv", "x,y,z,density\n0,0,0,1\n1,1,1\n"},
      {"nan.csv", "x,y,z,density\n0,0,0,\n1,1,1,nan\n"},
      {"nowhere.csv", "x,y,z,density\nnan,0,0,1\n1,nan,1,2\n"},
      {"absurd.pcd",
       "VERSION .7\nFIELDS x y z density\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
       "WIDTH 99999999999\nHEIGHT 1\nPOINTS 99999999999\nDATA binary\n"},
      {"more.pcd",
       "VERSION .7\nFIELDS x y z density\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
       "WIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n0 0 0 1\n1 1 1 2\n"},
      {"more.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nproperty float density\nend_header\n0 0 0 1\n1 1 1 2\n"},
      {"absurd.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty "
       "float "
       "x\nproperty float y\nproperty float z\nproperty float density\nend_header\n"},
      {"garbage.vtk", "not a vtk file\n"},
      {"garbage.vtu", "<VTKFile type=\"UnstructuredGrid\"><Unst"}};
  for (const auto& [name, content] : files) {
    SCOPED_TRACE(name);
    const std::string bad = folder_ / name;
    uvol_test::writeFile(bad, content);
    expectFailure(run(bad + job), 1, "", folder_, 2);
    EXPECT_EQ(0, runCommand("rm '" + bad + "'").exit_code);
  }
}

TEST_F(Isosurface, TruncatedFilesOfEachEncodingFail)
{
  for (const char* name : {"t.pcd", "t.ply"})
    for (const char* ascii : {"", " -ascii"}) {
      SCOPED_TRACE(std::string(name) + ascii);
      const std::string whole = folder_ / name;
      ASSERT_EQ(0,
                run(in_ + " " + whole + " -field density -iso 15" + ascii).exit_code);
      const std::string content = uvol_test::readFile(whole);
      for (const double part : {0.02, 0.3, 0.9}) {
        uvol_test::writeFile(
            whole,
            content.substr(
                0,
                static_cast<std::size_t>(part * static_cast<double>(content.size()))));
        expectFailure(
            run(whole + " " + out_ + " -field density -iso 15"), 1, name, folder_, 2);
      }
      EXPECT_EQ(0, runCommand("rm '" + whole + "'").exit_code);
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
    const std::string file = folder_ / name;
    uvol_test::writeFile(file, content);
    const auto result = run(file + " " + out_ + " -field density -iso 15");
    EXPECT_EQ(0, result.exit_code) << result.err;
    EXPECT_GE(pointsIn(out_), least);
    EXPECT_EQ(least == 0, pointsIn(out_) == 0);
    EXPECT_EQ(least == 0, result.err.find("No isopoints") != std::string::npos)
        << result.err;
  }
}

TEST_F(Isosurface, AFullDiskLeavesNothingBehind)
{
  for (const char* name : {"out.ply", "out.pcd", "out.csv", "out.vtp"}) {
    // 8 blocks of 512 or 1024 bytes: less than any of the results
    const auto result = runCommand("ulimit -f 8; uvol_isosurface " + in_ + " " +
                                   (folder_ / name) + " -field density -iso 15");
    expectFailure(result, 1, name, folder_, 1);
  }
}

} // namespace test_uvol_isosurface
