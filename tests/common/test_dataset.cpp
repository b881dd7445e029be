// SPDX-License-Identifier: BSD-3-Clause
// The origin of large coordinates, and records of bytes that become datasets.
#include "common/records.h"
#include "io/random_dataset.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_dataset {

TEST(Coordinates, OriginOnlyWhereFloatNeedsIt)
{
  Dataset near;
  setCoordinates(near, {-50.1, 10.7, 0.3, 49.3, 110.2, 99.9});
  EXPECT_EQ(near.origin, (std::array<double, 3>{}));
  Dataset lattice; // far away, but float holds it exactly
  setCoordinates(lattice, {500000.0, 0.0, 1.0, 500001.0, 1.0, 2.0});
  EXPECT_EQ(lattice.origin, (std::array<double, 3>{}));
  Dataset flat; // noise of a plane is no extent
  setCoordinates(flat, {0.0, 0.0, 0.1, 1.0, 1.0, 0.1 + 1e-9});
  EXPECT_EQ(flat.origin, (std::array<double, 3>{}));
  Dataset place; // a single point keeps its digits as well
  setCoordinates(place, {500000.123456789, 5500000.1, 0.1});
  EXPECT_NEAR(coordinateOf(place, 0, 0), 500000.123456789, 1e-7);
  Dataset empty;
  setCoordinates(empty, {});
  EXPECT_EQ(empty.cloud.width, 0u);
  EXPECT_EQ(describeFields(empty.cloud.fields),
            "x (float32), y (float32), z (float32)");
}

TEST(Coordinates, NonFiniteOnesStay)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Dataset dataset;
  setCoordinates(dataset, {nan, 5500000.25, 1.0, 1.0, 5500000.125, HUGE_VAL});
  EXPECT_TRUE(std::isnan(coordinateOf(dataset, 0, 0)));
  EXPECT_EQ(coordinateOf(dataset, 2, 1), HUGE_VAL);
  EXPECT_EQ(coordinateOf(dataset, 1, 0), 5500000.25);
}

TEST(Coordinates, BadArguments)
{
  Dataset dataset = makeDataset({}, 3, 1);
  EXPECT_THROW(setCoordinates(dataset, {1.0, 2.0, 3.0}), InvalidArgument);
  EXPECT_THROW(setCoordinates(dataset, {1.0, 2.0}), InvalidArgument);
  Dataset huge;
  EXPECT_THROW(setCoordinates(huge, {1e300, 0.0, 0.0}), InvalidArgument);
}

TEST(Records, BecomeClouds)
{
  Fields fields;
  appendField(fields, "a", Type::INT16);
  appendField(fields, "_", Type::UINT8, 3);
  for (const char* const axis : {"z", "y", "x"})
    appendField(fields, axis, Type::INT32);
  appendField(fields, "a", Type::FLOAT64);
  auto records = makeRecords(fields, 2);
  EXPECT_EQ(records.point_step, 25u);
  put(&records.data[25 + 5], std::int32_t{7}); // z of the second one
  const Dataset dataset = pcl_uvol::makeDataset(std::move(records));
  EXPECT_EQ(describeFields(dataset.cloud.fields),
            "x (float32), y (float32), z (float32), a (int16), a_2 (float64)");
  EXPECT_EQ(viewOf(dataset.cloud).xyz(1)[2], 7.0f);
  EXPECT_EQ(
      dataset.notes,
      (std::vector<Message>{{"repeated_field", {{"field", "a"}, {"name", "a_2"}}}}));
}

TEST(Records, BadOnes)
{
  Fields fields;
  appendField(fields, "x", Type::FLOAT32);
  EXPECT_EQ(Message("no_coordinate_field", {{"axis", "y"}, {"fields", "x (float32)"}}),
            uvol_test::thrownBy<InvalidArgument>(
                [&] { pcl_uvol::makeDataset(makeRecords(fields, 1)); }));
  EXPECT_THROW(makeRecords(fields, std::uint64_t{1} << 40), InvalidArgument);
  auto incomplete = makeRecords(fields, 3);
  EXPECT_NO_THROW(checkComplete(incomplete));
  incomplete.data.pop_back();
  EXPECT_THROW(checkComplete(incomplete), InvalidArgument);
}

} // namespace test_dataset
