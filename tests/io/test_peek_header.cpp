// SPDX-License-Identifier: BSD-3-Clause
// What headers promise is what reading brings.
#include "common/memory.h"
#include "io/memory_need.h"
#include "random_dataset.h"

#include <filesystem>
#include <map>

namespace test_peek_header {

using pcl_uvol::peekHeader;
using uvol_test::FieldSpec;
using uvol_test::Type;

class CloudHeader : public testing::Test {
protected:
  /** Save, and look whether the header tells what is loaded. */
  void
  expectPromise(const pcl_uvol::Dataset& dataset,
                const std::string& name,
                bool is_ascii = false)
  {
    pcl_uvol::SaveOptions options;
    options.ascii = is_ascii;
    pcl_uvol::saveDataset(folder_ / name, dataset, options);
    const auto cloud = pcl_uvol::loadDataset(folder_ / name).cloud;
    const auto promised = peekHeader(folder_ / name);
    ASSERT_TRUE(promised) << name;
    EXPECT_EQ(cloud.width, promised->points) << name;
    EXPECT_EQ(cloud.point_step, promised->point_step) << name;
    EXPECT_LE(static_cast<double>(cloud.data.size()), promised->reading_bytes) << name;
  }

  uvol_test::TemporaryFolder folder_;
};

TEST_F(CloudHeader, IsWhatIsLoaded)
{
  const std::vector<FieldSpec> odd = {
      {"flag", Type::UINT8}, {"mass", Type::FLOAT64}, {"vel", Type::FLOAT32, 3}};
  for (const auto& specs : {std::vector<FieldSpec>(), odd})
    for (auto dataset :
         {uvol_test::makeDataset(specs, 1000, 1), uvol_test::makeDataset(specs, 1, 2)})
      for (const bool is_wide : {false, true}) {
        dataset.double_coordinates = is_wide;
        for (const char* const name : {"a.pcd", "a.ply"}) {
          expectPromise(dataset, name);
          expectPromise(dataset, name, true);
        }
      }
}

/** Coordinates in double wait for their origin as records. */
TEST_F(CloudHeader, EstimatesThePeakOfReading)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers take memory of their own.";
  constexpr std::size_t count = 2500000; // clouds that the heap does not keep
  constexpr double room = 2e6;           // of streams, and of pages
  auto dataset = uvol_test::makeDataset({{"f", Type::FLOAT32}}, count, 1);
  const auto save = [&](const char* name, bool is_ascii) {
    pcl_uvol::SaveOptions options;
    options.ascii = is_ascii;
    pcl_uvol::saveDataset(folder_ / name, dataset, options);
  };
  save("packed.pcd", false);
  save("packed.ply", false);
  save("text.pcd", true);
  dataset.double_coordinates = true;
  save("wide.pcd", false);
  dataset = {};
  for (const auto& [name, per_point] :
       std::map<std::string, double>{{"packed.pcd", 16.0},
                                     {"packed.ply", 16.0},
                                     {"text.pcd", 16.0},
                                     {"wide.pcd", 28.0 + 16.0}}) {
    const auto promised = peekHeader(folder_ / name);
    ASSERT_TRUE(promised) << name;
    EXPECT_NEAR(per_point * count, promised->reading_bytes, room) << name;
    if (!uvol_test::resetPeakMemory())
      continue;
    const auto before = static_cast<double>(pcl_uvol::residentMemory());
    pcl_uvol::loadDataset(folder_ / name);
    const double taken = static_cast<double>(pcl_uvol::peakMemory()) - before;
    EXPECT_LE(taken, promised->reading_bytes) << name;
    EXPECT_GE(taken, promised->reading_bytes - 2.0 * room) << name;
  }
}

TEST_F(CloudHeader, IsNothingWhereTheDataMustBeRead)
{
  const auto dataset = uvol_test::makeDataset({}, 1000, 1);
  for (const char* const name : {"a.csv", "a.vtp"}) {
    pcl_uvol::saveDataset(folder_ / name, dataset);
    EXPECT_FALSE(peekHeader(folder_ / name)) << name;
  }
  uvol_test::writeFile(folder_ / "compressed.pcd",
                       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 0\n"
                       "DATA binary_compressed\n");
  EXPECT_NO_THROW(pcl_uvol::loadDataset(folder_ / "compressed.pcd"));
  EXPECT_TRUE(peekHeader(folder_ / "compressed.pcd"));
  for (const char* const name : {"a.pcd", "a.ply"})
    for (const bool is_ascii : {false, true}) {
      pcl_uvol::SaveOptions options;
      options.ascii = is_ascii;
      pcl_uvol::saveDataset(folder_ / name, dataset, options);
      const std::string whole = uvol_test::readFile(folder_ / name);
      uvol_test::writeFile(folder_ / name, whole.substr(0, 600));
      EXPECT_FALSE(peekHeader(folder_ / name)) << name << ' ' << is_ascii;
    }
}

TEST_F(CloudHeader, IsNothingForWhatCannotBeRead)
{
  uvol_test::writeFile(folder_ / "bad.pcd", "FIELDS x\nSIZE 3\nTYPE F\nDATA ascii\n");
  uvol_test::writeFile(folder_ / "bad.ply", "ply\nformat ascii 1.0\nend_header\n");
  uvol_test::writeFile(folder_ / "flat.pcd",
                       "FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n");
  for (const char* const name :
       {"bad.pcd", "bad.ply", "flat.pcd", "missing.pcd", "missing.ply", "a.unknown"})
    EXPECT_FALSE(peekHeader(folder_ / name)) << name;
}

TEST_F(CloudHeader, IsNothingForMoreThanPclCanNumber)
{
  uvol_test::writeFile(folder_ / "a.pcd",
                       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 5000000000\n"
                       "WIDTH 5000000000\nHEIGHT 1\nDATA binary\n");
  std::filesystem::resize_file(folder_ / "a.pcd", 60000001000u);
  EXPECT_FALSE(peekHeader(folder_ / "a.pcd"));
}

} // namespace test_peek_header
