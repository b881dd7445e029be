// SPDX-License-Identifier: BSD-3-Clause
// Files of other programs as they are found, in a folder beside that of the real data.
#include "io/held_fields.h"
#include "random_dataset.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_foreign_files {

class ForeignFiles : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (dataFolder().empty() || !std::filesystem::is_directory(pathOf("")))
      GTEST_SKIP() << "the folder of files of other programs is not there";
  }

  static std::string
  pathOf(const std::string& name)
  {
    return dataFolder() + "/../wild/" + name;
  }
};

TEST_F(ForeignFiles, SnapshotsWith64BitIdsAreWrittenAsPly)
{
  const Dataset snapshot =
      loadDataset(pathOf("made/c62_hdf5_unwrapped_positions.hdf5"));
  const auto* const ids = findField(snapshot.cloud.fields, "ParticleIDs");
  ASSERT_NE(nullptr, ids);
  ASSERT_EQ(8u, datatypeSize(ids->datatype));
  const TemporaryFolder folder;
  saveDataset(folder / "a.ply", snapshot);
  EXPECT_TRUE(describeLosses(folder / "a.ply", snapshot).empty());
  const Dataset loaded = loadDataset(folder / "a.ply");
  ASSERT_EQ(snapshot.cloud.width, loaded.cloud.width);
  for (std::size_t i = 0; i < loaded.cloud.width; ++i)
    ASSERT_EQ(valueOf(snapshot, "ParticleIDs", i), valueOf(loaded, "ParticleIDs", i));
}

TEST_F(ForeignFiles, Gadget4GivesTheHubbleParameterAmongItsParameters)
{
  const Dataset snapshot =
      loadDataset(pathOf("real/gadget4_lcdm_gas_snapshot_002.hdf5"));
  std::vector<Message> units;
  std::copy_if(snapshot.notes.begin(),
               snapshot.notes.end(),
               std::back_inserter(units),
               [](const Message& note) { return note.code == "comoving_units"; });
  ASSERT_EQ(1u, units.size());
  EXPECT_EQ(1.0, numberOf(units[0], "has_hubble"));
  EXPECT_NEAR(0.7, numberOf(units[0], "hubble"), 1e-6);
}

TEST_F(ForeignFiles, NamesWithUnitsBehindCommasAreCoordinates)
{
  const Dataset wells = loadDataset(pathOf("real/geostatsguy_res21_wells.csv"));
  EXPECT_EQ(7325.0, coordinateOf(wells, 0, 0));
  EXPECT_EQ(7175.0, coordinateOf(wells, 1, 0));
  EXPECT_NEAR(3052.8, coordinateOf(wells, 2, 0), 1e-3);
  EXPECT_NE(nullptr, findField(wells.cloud.fields, "Porosity, fraction"));
  LoadOptions options;
  options.xyz_columns = {{"0", "1", "2"}}; // the third one is called "0"
  const Dataset points = loadDataset(pathOf("real/gempy_moureze_points.csv"), options);
  EXPECT_EQ(272.0, coordinateOf(points, 0, 0));
  EXPECT_NEAR(-149.12, coordinateOf(points, 2, 0), 1e-4);
}

TEST_F(ForeignFiles, LargestFloatsAreNotPlaces)
{
  const Dataset samples = loadDataset(pathOf("made/c65_nc_fltmax_positions.nc"));
  ASSERT_EQ(1200u, samples.cloud.width);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < 1200; ++i) {
    const double x = coordinateOf(samples, 0, i), y = coordinateOf(samples, 1, i);
    missing += std::isnan(x) || std::isnan(y);
    if (!std::isnan(x) && !std::isnan(y)) {
      EXPECT_LT(std::abs(x), 1e4);
      EXPECT_LT(std::abs(y), 1e4);
    }
  }
  EXPECT_EQ(30u, missing);
}

/** As PDAL and others write point clouds. */
TEST(PcdFiles, OfOtherProgramsAreRead)
{
  const TemporaryFolder folder;
  const std::string head = "VERSION .7\nFIELDS X Y Z f\nSIZE 4 4 4 4\nTYPE f F f F\n"
                           "COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
  for (const char* const rows : {"1,2,3,4\n5,6,7,8\n", "1, 2, 3, 4\n5,6, 7,8\n"}) {
    writeFile(folder / "a.pcd", head + rows);
    const Dataset read = loadDataset(folder / "a.pcd");
    EXPECT_EQ("x (float32), y (float32), z (float32), f (float32)",
              describeFields(read.cloud.fields));
    EXPECT_EQ(5.0, valueAt(read, "x", 1));
    EXPECT_EQ(8.0, valueAt(read, "f", 1));
  }
  writeFile(folder / "a.pcd", head + "1,2,3\n5,6,7,8\n");
  EXPECT_THROW(loadDataset(folder / "a.pcd"), IOError);
}

} // namespace test_foreign_files
