// SPDX-License-Identifier: BSD-3-Clause
// Tables of attributes without coordinates: which columns are taken for what.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

namespace test_data_without_positions {

using namespace pcl_uvol;
using namespace uvol_test;

const std::string xyz = "x (float32), y (float32), z (float32)";

Dataset
load(const std::string& text, bool needs_coordinates, const std::string& name = "a.csv")
{
  const TemporaryFolder folder;
  writeFile(folder / name, text);
  LoadOptions options;
  options.needs_coordinates = needs_coordinates;
  return loadDataset(folder / name, options);
}

std::string
fieldsOf(const Dataset& dataset)
{
  return describeFields(dataset.cloud.fields);
}

/** These are attributes, and all points lie at the origin. */
void
expectNoPositions(const Dataset& dataset, const std::string& fields)
{
  EXPECT_FALSE(dataset.has_coordinates);
  EXPECT_EQ(xyz + fields, fieldsOf(dataset));
  EXPECT_EQ((std::array<double, 3>{{0.0, 0.0, 0.0}}), dataset.origin);
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(0.0, coordinateOf(dataset, axis, i));
}

TEST(DataWithoutPositions, AllColumnsAreAttributes)
{
  const Dataset dataset = load("a,b,c,d\n1,2,3.5,\n5,6,7,8\n", false);
  expectNoPositions(dataset, ", a (int32), b (int32), c (float32), d (float32)");
  ASSERT_EQ(2u, dataset.cloud.width);
  EXPECT_EQ(3.5, valueOf(dataset, "c", 0));
  EXPECT_TRUE(std::isnan(valueOf(dataset, "d", 0)));
  EXPECT_EQ(5.0, valueOf(dataset, "a", 1));
  EXPECT_TRUE(dataset.notes.empty()) << dataset.notes.front();
}

TEST(DataWithoutPositions, OneColumnIsEnough)
{
  expectNoPositions(load("a\n1\n2\n", false), ", a (int32)");
  expectNoPositions(load("a b\n1 2\n", false, "a.txt"), ", a (int32), b (int32)");
}

TEST(DataWithoutPositions, FilesWithoutRowsKeepTheirFields)
{
  const Dataset dataset = load("a,b,c,d\n", false);
  EXPECT_EQ(0u, dataset.cloud.width);
  EXPECT_FALSE(dataset.has_coordinates);
}

TEST(DataWithoutPositions, NamesOfRowsAreLabels)
{
  const Dataset dataset = load("name,a,b\nfirst,1,2\nsecond,3,4\n", false);
  expectNoPositions(dataset, ", name (int32), a (int32), b (int32)");
  EXPECT_EQ(2u, dataset.cloud.width);
  EXPECT_EQ(4.0, valueOf(dataset, "b", 1));
  EXPECT_EQ((LabelNames{{"name", {"first", "second"}}}), dataset.labels);
}

TEST(DataWithoutPositions, WordsThatStartAsAxesAreAttributes)
{
  expectNoPositions(load("xenon,yttrium,zinc,d\n1,2,3,4\n", false),
                    ", xenon (int32), yttrium (int32), zinc (int32), d (int32)");
  expectNoPositions(load("x_km,y_km,rho\n1,2,3\n", false),
                    ", x_km (int32), y_km (int32), rho (int32)");
}

TEST(DataWithoutPositions, AxesWithUnitsAreCoordinates)
{
  for (const char* header : {"x_km,y_km,z_minus_dbar,T", "X_km,Y_km,Z_km,T"}) {
    const Dataset dataset = load(header + std::string("\n1,2,3,4\n"), false);
    EXPECT_TRUE(dataset.has_coordinates) << header;
    EXPECT_EQ(xyz + ", T (int32)", fieldsOf(dataset)) << header;
    EXPECT_EQ(3.0, coordinateOf(dataset, 2, 0)) << header;
  }
}

TEST(DataWithoutPositions, NamedAxesAreCoordinatesWhereverTheyStand)
{
  const Dataset dataset = load("a,z,y,X,d\n1,2,3,4,5\n", false);
  EXPECT_TRUE(dataset.has_coordinates);
  EXPECT_EQ(xyz + ", a (int32), d (int32)", fieldsOf(dataset));
  EXPECT_EQ(4.0, coordinateOf(dataset, 0, 0));
  EXPECT_EQ(2.0, coordinateOf(dataset, 2, 0));
}

TEST(DataWithoutPositions, ChosenColumnsAreCoordinates)
{
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", "a,b,c,d\n1,2,3,4\n");
  LoadOptions options;
  options.needs_coordinates = false;
  options.xyz_columns = {{"3", "1", "0"}};
  const Dataset dataset = loadDataset(folder / "a.csv", options);
  EXPECT_TRUE(dataset.has_coordinates);
  EXPECT_EQ(xyz + ", c (int32)", fieldsOf(dataset));
  EXPECT_EQ(4.0, coordinateOf(dataset, 0, 0));
}

TEST(DataWithoutPositions, OtherFormatsHaveCoordinates)
{
  const TemporaryFolder folder;
  const Dataset points = makeDataset({{"a", Type::FLOAT32}}, 4, 1);
  LoadOptions options;
  options.needs_coordinates = false;
  for (const char* name : {"a.ply", "a.pcd", "a.vtp"}) {
    saveDataset(folder / name, points);
    const Dataset dataset = loadDataset(folder / name, options);
    EXPECT_TRUE(dataset.has_coordinates) << name;
    expectSameFields(dataset, points);
  }
}

TEST(DataWithoutPositions, ByDefaultTheFirstColumnsAreCoordinates)
{
  EXPECT_TRUE(LoadOptions().needs_coordinates);
  const Dataset dataset = load("a,b,c,d\n1.5,2.5,3.5,4\n", true);
  EXPECT_TRUE(dataset.has_coordinates);
  EXPECT_EQ(xyz + ", d (int32)", fieldsOf(dataset));
  EXPECT_EQ(2.5, coordinateOf(dataset, 1, 0));
  ASSERT_EQ(1u, dataset.notes.size());
  EXPECT_EQ(dataset.notes[0],
            Message("assumed_coordinates",
                    {{"skips_times", 0}, {"x", "a"}, {"y", "b"}, {"z", "c"}}));
  EXPECT_THROW(load("a,b\n1,2\n", true), IOError);
}

TEST(DataWithoutPositions, CanBeWrittenAndRead)
{
  const TemporaryFolder folder;
  const Dataset dataset = load("a,b,c,d\n1,2,3,4\n5,6,7,8\n", false);
  for (const char* name : {"a.ply", "a.pcd", "a.vtp", "a.csv"}) {
    saveDataset(folder / name, dataset);
    expectSameFields(loadDataset(folder / name), dataset);
  }
}

} // namespace test_data_without_positions
