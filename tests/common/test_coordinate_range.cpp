// SPDX-License-Identifier: BSD-3-Clause
// The origin of coordinates in double, whatever a few of them are, and what is said of
// digits that float has no room for.
#include "common/coordinate_range.h"
#include "common/value_frame.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace test_coordinate_range {

using pcl_uvol::CoordinateRange;
using Point = CoordinateRange::Point;
using Points = std::vector<Point>;

/** A square kilometre, 100 m high, somewhere in UTM zone 33. */
Points
makeSite(std::size_t count, const Point& corner = {391000.0, 5819000.0, 30.0})
{
  uvol_test::Random random(11);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({corner[0] + 1000.0 * random.uniform(),
                      corner[1] + 1000.0 * random.uniform(),
                      corner[2] + 100.0 * random.uniform()});
  return points;
}

CoordinateRange
findRange(const Points& points)
{
  CoordinateRange range;
  for (const Point& point : points)
    range.add(point);
  return range;
}

std::optional<pcl_uvol::Message>
noteOf(const Points& points)
{
  const CoordinateRange range = findRange(points);
  return range.describeRounding(range.findOrigin());
}

TEST(CoordinateRange, RowsWithoutPositionMoveNoOrigin)
{
  Points points = makeSite(5000);
  const Point origin = findRange(points).findOrigin();
  EXPECT_NEAR(391500.0, origin[0], 500.0);
  EXPECT_NEAR(5819500.0, origin[1], 500.0);
  EXPECT_FALSE(noteOf(points));
  // One in ten, and one that is far off in another way.
  for (std::size_t i = 0; i < points.size(); i += 10)
    points[i] = {0.0, 0.0, 0.0};
  points[77] = {1e20, 391000.0, -9999.0};
  const Point robust = findRange(points).findOrigin();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(robust[axis], origin[axis], 500.0);
    const double step = std::exp2(std::floor(std::log2(500.0)));
    EXPECT_EQ(0.0, std::fmod(robust[axis], step));
  }
  const auto note = noteOf(points);
  ASSERT_TRUE(note);
  EXPECT_EQ("rounded_far_points", note->code);
}

TEST(CoordinateRange, OneRowWithoutPositionCostsNoDigits)
{
  Points points = makeSite(2000);
  points[5] = {0.0, 0.0, 0.0};
  std::vector<double> xyz;
  for (const Point& point : points)
    xyz.insert(xyz.end(), point.begin(), point.end());
  pcl_uvol::Dataset dataset;
  setCoordinates(dataset, xyz);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t axis = 0; axis < 3 && i != 5; ++axis) {
      float relative;
      std::memcpy(&relative,
                  &dataset.cloud.data[i * dataset.cloud.point_step + 4 * axis],
                  sizeof(relative));
      // Half a unit in the last place of 1000 m.
      ASSERT_NEAR(points[i][axis], dataset.origin[axis] + relative, 0x1p-15);
    }
}

TEST(CoordinateRange, AnyOrderAndDivisionGiveOneOrigin)
{
  Points points = makeSite(20000);
  points[9] = {0.0, 0.0, 0.0};
  const Point expected = findRange(points).findOrigin();
  const auto note = noteOf(points);
  CoordinateRange parts[3];
  std::reverse(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    parts[i * i % 3].add(points[i]);
  parts[1].add(parts[2]);
  parts[0].add(parts[1]);
  EXPECT_EQ(expected, parts[0].findOrigin());
  EXPECT_EQ(note, parts[0].describeRounding(expected));
}

TEST(CoordinateRange, ClustersFarApartAreReported)
{
  Points points = makeSite(20000, {0.0, 0.0, 0.0});
  const Points others = makeSite(20000, {1e10, 0.0, 0.0});
  points.insert(points.end(), others.begin(), others.end());
  // The nearest of 40,000 points is some 10 m away; floats of 1e10 are 1024 m apart.
  const auto note = noteOf(points);
  ASSERT_TRUE(note);
  EXPECT_EQ("rounded_coordinates", note->code);
  const double spacings = uvol_test::numberOf(*note, "spacings");
  EXPECT_NEAR(512.0, uvol_test::numberOf(*note, "rounding"), 16.0);
  EXPECT_GT(spacings, 30.0);
  EXPECT_LT(spacings, 80.0);
}

TEST(CoordinateRange, SpacingsOnALineAreThoseOfALine)
{
  uvol_test::Random random(3);
  Points line, volume;
  for (std::size_t i = 0; i < 100000; ++i) {
    line.push_back({1e5 * random.uniform(), 0.1, 0.1});
    volume.push_back(
        {1e5 * random.uniform(), 1e5 * random.uniform(), 1e5 * random.uniform()});
  }
  // Neighbours of random points on a line are half a mean spacing of 1 apart, or less.
  const auto note = noteOf(line);
  ASSERT_TRUE(note);
  EXPECT_NEAR(0.35, uvol_test::numberOf(*note, "spacing"), 0.15);
  EXPECT_FALSE(noteOf(volume));
}

TEST(CoordinateRange, WhatFloatCannotHoldIsRefusedUnlessItIsAnOutlier)
{
  Points points = makeSite(100, {0.0, 0.0, 0.0});
  points[3][0] = 1e300;
  EXPECT_NO_THROW(findRange(points).findOrigin());
  for (Point& point : points)
    point[1] *= 1e300;
  EXPECT_THROW(findRange(points).findOrigin(), pcl_uvol::InvalidArgument);
}

pcl_uvol::ValueFrame
frameOf(const std::vector<double>& values)
{
  pcl_uvol::ValueRange range;
  for (const double value : values)
    range.add(value);
  return range.findFrame();
}

TEST(ValueFrame, LeavesWhatFloatHolds)
{
  std::vector<double> values(1000);
  for (int i = 0; i < 1000; ++i)
    values[static_cast<std::size_t>(i)] = 0.001 * i - 0.3;
  EXPECT_EQ(pcl_uvol::ValueFrame(), frameOf(values));
  values[3] = 1e300;
  EXPECT_EQ(pcl_uvol::ValueFrame(), frameOf(values));
  EXPECT_EQ(pcl_uvol::ValueFrame(), frameOf({}));
  EXPECT_EQ(pcl_uvol::ValueFrame(), frameOf({0.0, 0.0}));
  EXPECT_EQ(pcl_uvol::ValueFrame(), frameOf({16777216.0, 16777217.0 - 1.0}));
}

TEST(ValueFrame, SubtractsWhatValuesHaveInCommon)
{
  std::vector<double> values(1000);
  for (int i = 0; i < 1000; ++i)
    values[static_cast<std::size_t>(i)] = 1e7 + 0.001 * i;
  const pcl_uvol::ValueFrame frame = frameOf(values);
  EXPECT_EQ(1.0, frame.factor);
  EXPECT_NEAR(1e7 + 0.5, frame.reference, 0.5);
  EXPECT_EQ(0.0, std::fmod(frame.reference, 0.5));
  EXPECT_EQ(1e7 + 0.25, frame.toInput(frame.apply(1e7 + 0.25)));
  values[3] = -9999.0;
  EXPECT_NEAR(1e7 + 0.5, frameOf(values).reference, 0.5);
}

TEST(ValueFrame, BringsLargeAndSmallValuesNearOne)
{
  for (const double scale : {1e50, 1e-50, 1e300, 1e-300}) {
    std::vector<double> values;
    for (int i = 1; i < 1000; ++i)
      values.push_back(scale * i);
    const pcl_uvol::ValueFrame frame = frameOf(values);
    EXPECT_EQ(0.0, frame.reference);
    EXPECT_LT(0.9, frame.apply(999.0 * scale)) << scale;
    EXPECT_GT(2.0, frame.apply(999.0 * scale)) << scale;
    EXPECT_EQ(std::ldexp(1.0, std::ilogb(frame.factor)), frame.factor);
  }
}

} // namespace test_coordinate_range
