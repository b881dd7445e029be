// SPDX-License-Identifier: BSD-3-Clause
// Fields added to a dataset: the others and the places stay as they are.
#include "io/random_dataset.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

namespace test_set_field {

using namespace pcl_uvol;
using namespace uvol_test;

constexpr std::size_t points = 21;

/** Fields of odd sizes, and padding at the end of a point. */
const std::vector<FieldSpec> specs{{"rgb", Type::UINT8, 3},
                                   {"vel", Type::FLOAT32, 3},
                                   {"time", Type::FLOAT64},
                                   {"mark", Type::INT16}};

Dataset
makePoints()
{
  Dataset dataset = makeDataset(specs, points, 5);
  dataset.origin = {{5e6, -64.0, 0.0}};
  dataset.double_coordinates = true;
  return dataset;
}

std::vector<float>
makeValues()
{
  std::vector<float> values;
  for (std::size_t i = 0; i < points; ++i)
    values.push_back(0.25f * static_cast<float>(i) - 1.0f);
  values[3] = std::numeric_limits<float>::quiet_NaN();
  return values;
}

std::vector<std::int32_t>
makeLabels()
{
  std::vector<std::int32_t> labels;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(points); ++i)
    labels.push_back(std::numeric_limits<std::int32_t>::max() - i * 100000000);
  return labels;
}

/** The same number at all points. */
void
expectSameField(const Dataset& actual, const Dataset& expected, const std::string& name)
{
  for (std::size_t i = 0; i < points; ++i)
    expectSame(valueOf(actual, name, i), valueOf(expected, name, i), name);
}

void
expectSameElsewhere(const Dataset& actual, const Dataset& expected)
{
  EXPECT_EQ(expected.origin, actual.origin);
  EXPECT_EQ(expected.double_coordinates, actual.double_coordinates);
  EXPECT_EQ(points, actual.cloud.width);
  EXPECT_EQ(1u, actual.cloud.height);
  EXPECT_EQ(points, viewOf(actual.cloud).count); // else it throws
  for (const char* name : {"x", "y", "z", "rgb[0]", "rgb[2]", "vel[1]", "time", "mark"})
    expectSameField(actual, expected, name);
}

TEST(SetField, AddsBehindTheOthers)
{
  const Dataset before = makePoints();
  Dataset dataset = before;
  setField(dataset, "membership", makeValues());
  setField(dataset, "label", makeLabels());
  expectSameElsewhere(dataset, before);
  EXPECT_EQ(describeFields(before.cloud.fields) +
                ", membership (float32), label (int32)",
            describeFields(dataset.cloud.fields));
  for (std::size_t i = 0; i < points; ++i) {
    expectSame(valueOf(dataset, "membership", i), makeValues()[i], "membership");
    EXPECT_EQ(makeLabels()[i], valueOf(dataset, "label", i));
  }
}

TEST(SetField, ReplacesTheOneOfThatName)
{
  const Dataset before = makePoints();
  Dataset dataset = before;
  setField(dataset, "label", makeValues());
  setField(dataset, "label", makeLabels());
  expectSameElsewhere(dataset, before);
  EXPECT_EQ(describeFields(before.cloud.fields) + ", label (int32)",
            describeFields(dataset.cloud.fields));
  EXPECT_EQ(makeLabels()[2], valueOf(dataset, "label", 2));
}

TEST(SetField, ReplacesFieldsOfSeveralNumbers)
{
  const Dataset before = makePoints();
  Dataset dataset = before;
  setField(dataset, "vel", makeValues());
  EXPECT_EQ(makeValues()[7], valueOf(dataset, "vel", 7));
  for (const char* name : {"x", "rgb[1]", "time", "mark"})
    expectSameField(dataset, before, name);
  EXPECT_EQ(before.cloud.fields.size(), dataset.cloud.fields.size());
}

TEST(SetField, CanBeWritten)
{
  constexpr double tolerance = 200.0 * 1e-7; // of setCoordinates, for that extent
  const TemporaryFolder folder;
  Dataset dataset = makePoints();
  setField(dataset, "label", makeLabels());
  saveDataset(folder / "a.pcd", dataset);
  const Dataset read = loadDataset(folder / "a.pcd");
  for (std::size_t i = 0; i < points; ++i) {
    EXPECT_EQ(makeLabels()[i], valueOf(read, "label", i));
    EXPECT_NEAR(coordinateOf(dataset, 0, i), coordinateOf(read, 0, i), tolerance);
  }
}

TEST(SetField, TakesNoPoints)
{
  Dataset dataset = makeDataset(specs, 0, 1);
  setField(dataset, "label", std::vector<std::int32_t>());
  EXPECT_NE(nullptr, findField(dataset.cloud.fields, "label"));
  EXPECT_EQ(0u, viewOf(dataset.cloud).count);
}

TEST(SetField, RefusesCoordinatesAndOtherNumbersOfValues)
{
  Dataset dataset = makePoints();
  for (const char* name : {"x", "y", "z"}) {
    EXPECT_NE(messageOf<InvalidArgument>([&] {
                setField(dataset, name, makeValues());
              }).find(name),
              std::string::npos);
    EXPECT_THROW(setField(dataset, name, makeLabels()), InvalidArgument);
  }
  for (const std::size_t count : {std::size_t{0}, points - 1, points + 1}) {
    const std::string message = messageOf<InvalidArgument>(
        [&] { setField(dataset, "mark", std::vector<float>(count)); });
    EXPECT_NE(message.find(std::to_string(count)), std::string::npos) << message;
    EXPECT_NE(message.find("21"), std::string::npos) << message;
  }
  expectSameFields(dataset, makePoints());
}

} // namespace test_set_field
