// SPDX-License-Identifier: BSD-3-Clause
// What headers promise is what reading brings.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/memory_need.h>

#include <algorithm>

namespace {

using pcl_uvol::promisedCloud;
using uvol_test::FieldSpec;
using uvol_test::Type;

class PromisedCloud : public testing::Test {
protected:
  /** Save, and look whether the header tells what is loaded. \return bytes per point of
   * the peak */
  double
  expectPromise(const pcl_uvol::Dataset& dataset,
                const std::string& name,
                bool is_ascii = false)
  {
    pcl_uvol::SaveOptions options;
    options.ascii = is_ascii;
    pcl_uvol::saveDataset(folder_ / name, dataset, options);
    return expectPromise(name);
  }

  double
  expectPromise(const std::string& name)
  {
    const auto cloud = pcl_uvol::loadDataset(folder_ / name).cloud;
    const auto promised = promisedCloud(folder_ / name);
    EXPECT_TRUE(promised);
    if (!promised)
      return 0.0;
    EXPECT_EQ(cloud.width, promised->points) << name;
    EXPECT_EQ(cloud.point_step, promised->point_step) << name;
    EXPECT_EQ(static_cast<double>(cloud.data.size()), promised->reading.kept) << name;
    EXPECT_GE(promised->reading.peak, promised->reading.kept) << name;
    return promised->reading.peak / cloud.width;
  }

  uvol_test::TemporaryFolder folder_;
};

TEST_F(PromisedCloud, IsWhatIsLoaded)
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

/** The records themselves; beside them packed points, coordinates in double, text. */
TEST_F(PromisedCloud, ReadingTakesWhatLiesBesideTheCloud)
{
  auto dataset = uvol_test::makeDataset({{"f", Type::FLOAT32}}, 1000, 1);
  EXPECT_EQ(16.0, expectPromise(dataset, "packed.pcd"));
  EXPECT_NEAR(32.0, expectPromise(dataset, "packed.ply"), 1.0); // and the header
  EXPECT_GT(expectPromise(dataset, "text.pcd", true), 16.0 + 4 * 5);
  dataset.double_coordinates = true;
  EXPECT_EQ(28.0 + 24.0 + 16.0, expectPromise(dataset, "wide.pcd"));
}

/** LZF's plainest form: runs of 32 bytes as they are. */
std::string
compressed(const std::vector<std::uint8_t>& bytes)
{
  std::string packed;
  for (std::size_t i = 0; i < bytes.size(); i += 32) {
    const std::size_t run = std::min<std::size_t>(32, bytes.size() - i);
    packed += static_cast<char>(run - 1);
    packed.append(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                  bytes.begin() + static_cast<std::ptrdiff_t>(i + run));
  }
  return packed;
}

TEST_F(PromisedCloud, IsToldOfCompressedFiles)
{
  const std::string body = compressed(std::vector<std::uint8_t>(1000 * 16));
  const std::uint32_t sizes[] = {static_cast<std::uint32_t>(body.size()), 1000 * 16};
  std::string file = "FIELDS x y z f\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 1000\n"
                     "HEIGHT 1\nDATA binary_compressed\n";
  file.append(reinterpret_cast<const char*>(sizes), sizeof(sizes));
  uvol_test::writeFile(folder_ / "a.pcd", file + body);
  // records, unpacked fields, and the file
  EXPECT_NEAR(16.0 + 16.0 + 16.5, expectPromise("a.pcd"), 0.1);
}

TEST_F(PromisedCloud, IsNothingWhereOnlyReadingTells)
{
  const auto dataset = uvol_test::makeDataset({}, 1000, 1);
  for (const char* const name : {"a.csv", "a.vtp"}) {
    pcl_uvol::saveDataset(folder_ / name, dataset);
    EXPECT_FALSE(promisedCloud(folder_ / name)) << name;
  }
  for (const char* const name : {"a.pcd", "a.ply"})
    for (const bool is_ascii : {false, true}) {
      pcl_uvol::SaveOptions options;
      options.ascii = is_ascii;
      pcl_uvol::saveDataset(folder_ / name, dataset, options);
      const std::string whole = uvol_test::readFile(folder_ / name);
      uvol_test::writeFile(folder_ / name, whole.substr(0, 600));
      EXPECT_FALSE(promisedCloud(folder_ / name)) << name << ' ' << is_ascii;
    }
}

TEST_F(PromisedCloud, FailsAsReadingDoes)
{
  uvol_test::writeFile(folder_ / "bad.pcd", "FIELDS x\nSIZE 3\nTYPE F\nDATA ascii\n");
  uvol_test::writeFile(folder_ / "bad.ply", "ply\nformat ascii 1.0\nend_header\n");
  for (const char* const name : {"bad.pcd", "bad.ply", "missing.pcd", "missing.ply"}) {
    const auto message =
        uvol_test::messageOf<pcl_uvol::IOError>([&] { promisedCloud(folder_ / name); });
    EXPECT_NE("", message) << name;
    EXPECT_EQ(message, uvol_test::messageOf<pcl_uvol::IOError>([&] {
                pcl_uvol::loadDataset(folder_ / name);
              }));
  }
}

} // namespace
