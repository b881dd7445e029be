// SPDX-License-Identifier: BSD-3-Clause
// Every field of the samples on the isopoints: numbers interpolated, names of things
// copied.
#include "common/scalar_field.h"
#include "isosurface/iso_edges.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace test_iso_edges {

/** A packed cloud of one field of doubles, floats or integers, count numbers per point.
 */
template <typename T>
pcl::PCLPointCloud2
makeCloud(const std::string& name,
          std::uint8_t datatype,
          const std::vector<T>& values,
          std::uint32_t count)
{
  pcl::PCLPointCloud2 cloud;
  pcl::PCLPointField field;
  field.name = name;
  field.offset = 0;
  field.datatype = datatype;
  field.count = count;
  cloud.fields.push_back(field);
  cloud.point_step = static_cast<std::uint32_t>(sizeof(T)) * count;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(values.size()) / count;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(values.size() * sizeof(T));
  std::memcpy(cloud.data.data(), values.data(), cloud.data.size());
  return cloud;
}

template <typename T>
T
valueAt(const pcl::PCLPointCloud2& cloud,
        const std::string& name,
        std::size_t point,
        int k)
{
  const auto* const field = pcl_uvol::findField(cloud.fields, name);
  T value;
  std::memcpy(&value,
              &cloud.data[point * cloud.point_step + field->offset +
                          static_cast<std::size_t>(k) * sizeof(T)],
              sizeof(T));
  return value;
}

const pcl_uvol::IsoEdges edges{{0, 1, 0.25f}, {1, 0, 0.0f}, {0, 1, 0.75f}};

pcl::PCLPointCloud2
makeIsopoints()
{
  return makeCloud<float>("x", pcl::PCLPointField::FLOAT32, {1, 2, 3}, 1);
}

TEST(InterpolateFields, FloatingPointIsLinear)
{
  auto isopoints = makeIsopoints();
  pcl_uvol::interpolateFields(
      makeCloud<double>("vel", pcl::PCLPointField::FLOAT64, {1, 10, 2, 30}, 2),
      edges,
      isopoints);
  EXPECT_EQ(2u, isopoints.fields.size());
  EXPECT_DOUBLE_EQ(1.25, valueAt<double>(isopoints, "vel", 0, 0));
  EXPECT_DOUBLE_EQ(15.0, valueAt<double>(isopoints, "vel", 0, 1));
  EXPECT_DOUBLE_EQ(2.0, valueAt<double>(isopoints, "vel", 1, 0));
  EXPECT_EQ(3.0f, valueAt<float>(isopoints, "x", 2, 0));
}

TEST(InterpolateFields, IntegersAndPackedColoursComeFromTheNearerSample)
{
  auto isopoints = makeIsopoints();
  pcl_uvol::interpolateFields(
      makeCloud<std::int16_t>("label", pcl::PCLPointField::INT16, {7, -3}, 1),
      edges,
      isopoints);
  EXPECT_EQ(7, valueAt<std::int16_t>(isopoints, "label", 0, 0));
  EXPECT_EQ(-3, valueAt<std::int16_t>(isopoints, "label", 2, 0));
  pcl_uvol::interpolateFields(
      makeCloud<float>("rgb", pcl::PCLPointField::FLOAT32, {1e-39f, 2e-39f}, 1),
      edges,
      isopoints);
  EXPECT_EQ(1e-39f, valueAt<float>(isopoints, "rgb", 0, 0));
}

TEST(InterpolateFields, MissingValuesStayMissingUnlessTheFootIsOnTheOther)
{
  auto isopoints = makeIsopoints();
  const float missing = std::numeric_limits<float>::quiet_NaN();
  pcl_uvol::interpolateFields(
      makeCloud<float>("t", pcl::PCLPointField::FLOAT32, {missing, 4.0f}, 1),
      edges,
      isopoints);
  EXPECT_TRUE(std::isnan(valueAt<float>(isopoints, "t", 0, 0)));
  EXPECT_EQ(4.0f, valueAt<float>(isopoints, "t", 1, 0));
}

TEST(InterpolateFields, FieldsOfTheIsopointsWin)
{
  auto isopoints = makeIsopoints();
  pcl_uvol::interpolateFields(
      makeCloud<float>("x", pcl::PCLPointField::FLOAT32, {8, 9}, 1), edges, isopoints);
  EXPECT_EQ(1u, isopoints.fields.size());
  EXPECT_EQ(1.0f, valueAt<float>(isopoints, "x", 0, 0));
}

TEST(InterpolateFields, DisagreeingSizesThrow)
{
  auto isopoints = makeIsopoints();
  const auto samples =
      makeCloud<float>("t", pcl::PCLPointField::FLOAT32, {1.0f}, 1); // edges name two
  EXPECT_THROW(pcl_uvol::interpolateFields(samples, edges, isopoints),
               pcl_uvol::InvalidArgument);
  EXPECT_THROW(pcl_uvol::interpolateFields(samples, {}, isopoints),
               pcl_uvol::InvalidArgument);
}

TEST(InterpolateFields, FieldsThatGiveWayAreWarnedOf)
{
  const auto samples =
      makeCloud<float>("error", pcl::PCLPointField::FLOAT32, {8, 9}, 1);
  pcl_uvol::Report report;
  pcl_uvol::warnOfReplacedFields(
      samples.fields,
      makeCloud<float>("error", pcl::PCLPointField::FLOAT32, {1}, 1).fields,
      report);
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("replaced_field", report.warnings[0].code);
  EXPECT_EQ("error", uvol_test::wordOf(report.warnings[0], "field"));
  for (const char* const meant : {"x", "normal_x", "_"}) {
    const auto field = makeCloud<float>(meant, pcl::PCLPointField::FLOAT32, {1}, 1);
    pcl_uvol::warnOfReplacedFields(field.fields, field.fields, report);
    EXPECT_EQ(1u, report.warnings.size()) << meant;
  }
}

} // namespace test_iso_edges
