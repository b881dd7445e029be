// SPDX-License-Identifier: BSD-3-Clause
// Attributes of a cloud as rows of numbers (thesis 2.6).
#include "multivariate/attributes.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

namespace test_attributes {

using namespace uvol_test;
using pcl_uvol::AttributeTable;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Report;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

using Cloud = pcl::PointCloud<pcl::PointNormal>;

Cloud
makeCloud(std::size_t count)
{
  Random random(count);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    pcl::PointNormal point;
    point.x = static_cast<float>(1e-20 * random.uniform());
    point.y = static_cast<float>(1e18 * (1.0 + random.uniform()));
    point.z = static_cast<float>(random.uniform());
    point.normal_x = 3.0f;
    point.normal_y = static_cast<float>(i);
    point.normal_z = 0.0f;
    point.curvature = 0.5f;
    cloud.push_back(point);
  }
  return cloud;
}

AttributeTable
read(const Cloud& cloud,
     const std::vector<std::string>& names,
     bool is_standardized,
     Report& report,
     unsigned threads = 0)
{
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  return readAttributes(
      pcl_uvol::viewOf(cloud), all, names, is_standardized, threads, report);
}

AttributeTable
read(const Cloud& cloud, const std::vector<std::string>& names, bool is_standardized)
{
  Report report;
  return read(cloud, names, is_standardized, report);
}

TEST(Attributes, AreTheFieldsAsTheyAre)
{
  const Cloud cloud = makeCloud(10000);
  const auto table = read(cloud, {"normal_y", "x", "|normal_x,normal_y|"}, false);
  ASSERT_EQ(table.rows(), cloud.size());
  ASSERT_EQ(table.columns(), 3u);
  EXPECT_EQ(table.names[2], "|normal_x,normal_y|");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    EXPECT_EQ(table.points[i], i);
    EXPECT_EQ(table.row(i)[0], cloud[i].normal_y);
    EXPECT_EQ(table.row(i)[1], cloud[i].x);
    EXPECT_EQ(table.row(i)[2],
              static_cast<float>(std::sqrt(9.0 + static_cast<double>(i) * i)));
  }
}

TEST(Attributes, StandardizedHaveMeanZeroAndDeviationOne)
{
  const auto table = read(makeCloud(10000), {"x", "y", "z", "normal_y"}, true);
  for (std::size_t column = 0; column < table.columns(); ++column) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const double value = table.row(i)[column];
      sum += value;
      squares += value * value;
    }
    EXPECT_NEAR(sum / 1e4, 0.0, 1e-6) << column;
    EXPECT_NEAR(squares / 1e4, 1.0, 1e-6) << column;
  }
}

TEST(Attributes, KeepWhatDistinguishesDoubles)
{
  // Times in seconds after 1970 that differ by milliseconds.
  pcl::PCLPointCloud2 bytes;
  bytes.height = 1;
  bytes.width = 3;
  bytes.point_step = 24;
  for (const auto& [name, offset, type] :
       {std::tuple{"x", 0u, pcl::PCLPointField::FLOAT32},
        std::tuple{"y", 4u, pcl::PCLPointField::FLOAT32},
        std::tuple{"z", 8u, pcl::PCLPointField::FLOAT32},
        std::tuple{"time", 16u, pcl::PCLPointField::FLOAT64}}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = static_cast<std::uint8_t>(type);
    field.count = 1;
    bytes.fields.push_back(field);
  }
  bytes.data.assign(3 * 24, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double time = 1.7e9 + 0.001 * static_cast<double>(i);
    std::memcpy(&bytes.data[24 * i + 16], &time, sizeof time);
  }
  Report report;
  const auto table =
      readAttributes(pcl_uvol::viewOf(bytes), {0, 1, 2}, {"time"}, true, 0, report);
  EXPECT_NEAR(table.values[0], -std::sqrt(1.5), 1e-3);
  EXPECT_NEAR(table.values[1], 0.0, 1e-3);
  EXPECT_NEAR(table.values[2], std::sqrt(1.5), 1e-3);
  EXPECT_THROW(
      readAttributes(pcl_uvol::viewOf(bytes), {0, 1, 2}, {"time"}, false, 0, report),
      InvalidArgument)
      << "one number in float";
}

TEST(Attributes, LeaveOutPointsThatLackOne)
{
  Cloud cloud = makeCloud(100);
  cloud[7].z = nan;
  cloud[8].normal_y = infinity;
  cloud[9].normal_z = nan; // not asked for
  Report report;
  const auto table = read(cloud, {"z", "normal_y"}, true, report);
  EXPECT_EQ(table.rows(), 98u);
  EXPECT_EQ(report.getCount("missing_values"), 2u);
  EXPECT_EQ(table.points[7], 9u);
  EXPECT_TRUE(report.warnings.empty());
  for (const float value : table.values)
    EXPECT_TRUE(std::isfinite(value));
}

TEST(Attributes, LeaveOutThoseThatAreTheSameEverywhere)
{
  Cloud cloud = makeCloud(100);
  cloud[7].curvature = nan; // costs no point, since curvature is left out
  Report report;
  const auto table = read(cloud, {"curvature", "z", "normal_x"}, true, report);
  EXPECT_EQ(table.names, std::vector<std::string>{"z"});
  EXPECT_EQ(table.rows(), 100u);
  EXPECT_EQ(report.getCount("missing_values"), 0u);
  ASSERT_EQ(report.warnings.size(), 2u);
  EXPECT_EQ(std::vector<std::string>(2, "constant_attribute"),
            uvol_test::listCodes(report.warnings));
  EXPECT_EQ("curvature", uvol_test::wordOf(report.warnings[0], "attribute"));
  EXPECT_EQ("normal_x", uvol_test::wordOf(report.warnings[1], "attribute"));
}

TEST(Attributes, AreTheSameEverywhereIfTheyDifferAtLeftOutPointsOnly)
{
  Cloud cloud = makeCloud(100);
  cloud[7].curvature = 1.0f;
  cloud[7].z = nan;
  const auto table = read(cloud, {"curvature", "z"}, true);
  EXPECT_EQ(table.names, std::vector<std::string>{"z"});
  EXPECT_EQ(table.rows(), 99u);
}

TEST(Attributes, UseTheGivenPointsOnly)
{
  const Cloud cloud = makeCloud(100);
  Report report;
  const auto table = readAttributes(
      pcl_uvol::viewOf(cloud), {50, 3, 99}, {"normal_y"}, false, 0, report);
  EXPECT_EQ(table.points, (std::vector<std::uint32_t>{50, 3, 99}));
  EXPECT_EQ(table.values, (std::vector<float>{50, 3, 99}));
}

TEST(Attributes, AnyNumberOfThreadsIsTheSame)
{
  const Cloud cloud = makeCloud(20000);
  Report report;
  const auto one = read(cloud, {"x", "y", "z"}, true, report, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(one.values, read(cloud, {"x", "y", "z"}, true, report, threads).values);
}

TEST(Attributes, ThatCannotBeReadThrow)
{
  const Cloud cloud = makeCloud(10);
  EXPECT_THROW(read(cloud, {}, true), InvalidArgument);
  EXPECT_THROW(read(cloud, {"temperature"}, true), InvalidArgument);
  EXPECT_THROW(read(cloud, {"z", "x", "z"}, true), InvalidArgument);
  EXPECT_THROW(read(cloud, {"normal_x", "normal_z"}, true), InvalidArgument)
      << "all the same";
  EXPECT_THROW(read(Cloud(), {"x"}, true), InvalidArgument);
  Cloud missing = cloud;
  for (auto& point : missing)
    point.z = nan;
  EXPECT_THROW(read(missing, {"x", "z"}, true), InvalidArgument);
}

} // namespace test_attributes
