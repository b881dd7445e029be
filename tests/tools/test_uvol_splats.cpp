// SPDX-License-Identifier: BSD-3-Clause
// uvol_splats from the outside: splats with the fields of their points, exit codes,
// sentences.
#include "common/scalar_field.h"
#include "render/point_colors.h"
#include "support/environment.h"
#include "support/surfaces.h"
#include "surface/splat_input.h"
#include "tool_test.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace test_uvol_splats {

using uvol_test::runCommand;

constexpr std::size_t points = 3000;

/** A unit sphere far from the origin, each point with its index and a colour. */
class SplatsTool : public uvol_test::ToolTest {
protected:
  SplatsTool()
      : ToolTest("uvol_splats", "out.ply")
  {
    in_ = folder_ / "in.ply";
  }

  void
  SetUp() override
  {
    pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
    for (std::size_t i = 0; i < points; ++i) {
      pcl::PointXYZRGBNormal point;
      point.getVector3fMap() = (*sphere_)[i].getVector3fMap();
      point.getNormalVector3fMap() = (*sphere_)[i].getNormalVector3fMap();
      point.curvature = static_cast<float>(i);
      point.r = static_cast<std::uint8_t>(i % 256);
      cloud.push_back(point);
    }
    pcl_uvol::Dataset dataset;
    pcl::toPCLPointCloud2(cloud, dataset.cloud);
    dataset.origin = {{far_, 0.0, 0.0}};
    pcl_uvol::saveDataset(in_, dataset);
  }

  /** Splats of a file, which holds good ones only. */
  static std::size_t
  splatsIn(const std::string& path)
  {
    const pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path);
    const auto view = pcl_uvol::viewOf(dataset.cloud);
    EXPECT_TRUE(pcl_uvol::hasSplats(view)) << path;
    pcl_uvol::Report report;
    const std::size_t count = pcl_uvol::readSplats(view, report).cloud.size();
    EXPECT_EQ(report.getCount("bad_splats"), 0u) << path;
    return count;
  }

  std::size_t
  countWith(const std::string& options) const
  {
    uvol_test::succeeded(run(options));
    return splatsIn(out_);
  }

  static constexpr double far_ = 5e6;
  uvol_test::SurfaceCloudPtr sphere_ = uvol_test::makeSphere(points, 1);
};

TEST_F(SplatsTool, CoversPointsAndCarriesTheirFieldsAlong)
{
  constexpr double delta = 0.01;
  const std::size_t count = countWith("-delta-abs 0.01");
  EXPECT_GT(count, points / 10);
  EXPECT_LT(count, points);
  const pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(out_);
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  ASSERT_EQ(view.count, count);
  EXPECT_TRUE(pcl_uvol::hasColors(view));
  const pcl_uvol::ScalarField mark(view.fields, "curvature"), red(view.fields, "red");
  EXPECT_EQ(pcl::PCLPointField::UINT8, red.getComponents().front().datatype);
  for (std::size_t i = 0; i < view.count; ++i) {
    const auto source = static_cast<std::size_t>(mark.read(view.point(i)));
    ASSERT_LT(source, points);
    EXPECT_EQ(red.read(view.point(i)), static_cast<double>(source % 256));
    const float* const expected = (*sphere_)[source].data;
    const double away =
        std::hypot(view.xyz(i)[0] + dataset.origin[0] - far_ - expected[0],
                   view.xyz(i)[1] + dataset.origin[1] - expected[1],
                   view.xyz(i)[2] + dataset.origin[2] - expected[2]);
    EXPECT_LT(away, delta + 1e-5); // the centre lies along the normal of its point
  }
}

TEST_F(SplatsTool, TakesDeltaAsALengthOrAsAPart)
{
  const auto length = static_cast<double>(countWith("-delta-abs 0.01"));
  const auto part = static_cast<double>(countWith("-delta 0.005"));
  EXPECT_NEAR(part, length, 0.03 * length); // the longest side is a little below 2
  EXPECT_LT(length, 0.98 * static_cast<double>(countWith("")));
}

TEST_F(SplatsTool, LargerLambdaIsFewerSplats)
{
  EXPECT_EQ(countWith("-lambda 0"), points);
  EXPECT_LT(countWith("-delta-abs 0.01 -lambda 1"),
            countWith("-delta-abs 0.01 -threads 1") / 2);
}

TEST_F(SplatsTool, WritesWhatCanBeReadAgain)
{
  const std::size_t expected = countWith("-delta-abs 0.01");
  for (const char* name : {"a.ply", "a.pcd", "a.csv", "a.vtp"})
    for (const char* option : {"", " -ascii"}) {
      uvol_test::runWell("uvol_splats " + in_ + " " + (folder_ / name) +
                         " -delta-abs 0.01" + option);
      EXPECT_EQ(splatsIn(folder_ / name), expected) << name << option;
    }
}

TEST_F(SplatsTool, SaysThatNormalsAreEstimated)
{
  std::string csv = "x,y,z\n";
  for (const auto& point : *sphere_)
    csv += std::to_string(point.x) + ',' + std::to_string(point.y) + ',' +
           std::to_string(point.z) + '\n';
  uvol_test::writeFile(folder_ / "in.csv", csv);
  const auto result =
      uvol_test::runWell("uvol_splats " + (folder_ / "in.csv") + " " + out_ + " -json");
  EXPECT_TRUE(uvol_test::hasMessage(result, "estimated_normals")) << result.out;
  EXPECT_FALSE(uvol_test::hasMessage(run("-json"), "estimated_normals"));
}

TEST_F(SplatsTool, ListsItsOptions)
{
  const auto result = uvol_test::succeeded(run("-h"));
  for (const char* option : {"-delta ", "-delta-abs ", "-lambda ", "-ascii "})
    EXPECT_NE(result.out.find(option), std::string::npos) << option;
  EXPECT_EQ(folder_.list().size(), 1u);
}

TEST_F(SplatsTool, RefusesAWrongCommandLine)
{
  for (const std::string value : {"0", "-1", "nan", "inf", "1e-3m", "''"})
    expectUsageErrors("", {"-delta " + value, "-delta-abs " + value});
  for (const std::string value : {"-0.1", "1.1", "nan", "x"})
    expectUsageErrors("", {"-lambda " + value});
  expectUsageErrors("", {"-delta 1.5", "-delta-abs 0.1 -delta 0.1", "-wat", "extra"});
  uvol_test::expectError(
      runCommand("uvol_splats -json " + in_), "command_line", "<out>");
}

TEST_F(SplatsTool, RefusesFilesThatItCannotCover)
{
  const std::string samples = in_;
  in_ = folder_ / "missing.ply";
  expectError("", "no_such_file", "missing.ply");
  in_ = samples;
  out_ = folder_ / "out.what";
  expectError("", "unwritten_ending", "out.what");
  out_ = folder_ / "out.ply";
  uvol_test::writeFile(in_,
                       "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                       "property float y\nproperty float z\nend_header\n");
  expectError("", "no_points");
  uvol_test::writeFile(in_,
                       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                       "property float y\nproperty float z\nproperty float nx\n"
                       "property float ny\nproperty float nz\nend_header\n"
                       "1 2 3 0 0 1\n1 2 3 0 0 1\n");
  expectError("", "splats_without_extent");
  EXPECT_EQ(countWith("-delta-abs 0.1"), 1u);
}

TEST_F(SplatsTool, GaussiansLieInThePlanesOfTheSplats)
{
  const auto result = uvol_test::succeeded(run("-gaussians -threads 1"));
  EXPECT_NE(std::string::npos, result.err.find("origin")) << result.err;
  const std::string bytes = uvol_test::readFile(out_);
  std::size_t at = 0; // viewers look for these in the header
  for (const char* name : {"x",
                           "y",
                           "z",
                           "nx",
                           "ny",
                           "nz",
                           "f_dc_0",
                           "f_dc_1",
                           "f_dc_2",
                           "opacity",
                           "scale_0",
                           "scale_1",
                           "scale_2",
                           "rot_0",
                           "rot_1",
                           "rot_2",
                           "rot_3"}) {
    const std::size_t found = bytes.find("property float " + std::string(name) + "\n");
    ASSERT_NE(std::string::npos, found) << name;
    EXPECT_GT(found, at) << name;
    at = found;
  }
  const pcl_uvol::Dataset gaussians = pcl_uvol::loadDataset(out_);
  const auto field = [&](const std::string& name) {
    return uvol_test::fieldOf(gaussians, name);
  };
  const auto x = field("x"), y = field("y"), z = field("z"), w = field("rot_0"),
             a = field("rot_1"), b = field("rot_2"), c = field("rot_3"),
             across = field("scale_2"), along = field("scale_0"), red = field("f_dc_0"),
             blue = field("f_dc_2"), opacity = field("opacity");
  ASSERT_GT(x.size(), 50u);
  for (std::size_t i = 0; i < x.size(); ++i) {
    // The third axis of the rotation is the normal: that of the sphere.
    const Eigen::Vector3d normal =
        Eigen::Quaterniond(w[i], a[i], b[i], c[i]) * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d place(x[i], y[i], z[i]);
    EXPECT_NEAR(1.0, normal.dot(place.normalized()), 0.01);
    EXPECT_NEAR(std::log(0.01 * std::sqrt(2.0)), across[i] - along[i], 1e-4);
    EXPECT_NEAR(std::log(99.0), opacity[i], 1e-4);
    EXPECT_GE(red[i], blue[i] - 1e-6); // green and blue are 0
    EXPECT_NEAR(-0.5 / 0.28209479, blue[i], 1e-4);
  }
  const std::string other = folder_ / "other.ply";
  uvol_test::runWell("uvol_splats " + in_ + " " + other + " -gaussians -threads 3");
  EXPECT_TRUE(bytes == uvol_test::readFile(other));
  ASSERT_EQ(0, run("-gaussians -color curvature").exit_code);
  EXPECT_TRUE(bytes != uvol_test::readFile(out_));
  const std::string shaded = uvol_test::readFile(out_);
  for (const char* look : {"-colormap gray", "-range 0,1", "-log"}) {
    ASSERT_EQ(0, run(std::string("-gaussians -color curvature ") + look).exit_code);
    EXPECT_TRUE(shaded != uvol_test::readFile(out_)) << look;
    EXPECT_EQ(2, run(look).exit_code) << look;
  }
  EXPECT_EQ(2, run("-color curvature").exit_code);
  EXPECT_EQ(2,
            runCommand("uvol_splats " + in_ + " " + folder_ / "out.pcd" + " -gaussians")
                .exit_code);
}

} // namespace test_uvol_splats
