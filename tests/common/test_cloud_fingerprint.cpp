// SPDX-License-Identifier: BSD-3-Clause
#include "src/common/cloud_fingerprint.h"

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <utility>

namespace test_cloud_fingerprint {

using pcl_uvol::CloudFingerprint;
using pcl_uvol::computeFingerprint;

CloudFingerprint
of(const pcl::PCLPointCloud2& cloud, const std::string& field, unsigned threads = 1)
{
  return computeFingerprint(
      pcl_uvol::viewOf(cloud), pcl_uvol::ScalarField(cloud.fields, field), threads);
}

/** Points of x, y, z and a field of so many numbers of one type, all bytes different.
 */
pcl::PCLPointCloud2
makeCloud(std::uint8_t datatype, std::uint32_t numbers, std::uint32_t points)
{
  pcl::PCLPointCloud2 cloud;
  const auto add = [&](const char* name, std::uint8_t type, std::uint32_t count) {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = type;
    field.count = count;
    field.offset = cloud.point_step;
    cloud.fields.push_back(field);
    cloud.point_step +=
        count * static_cast<std::uint32_t>(pcl_uvol::datatypeSize(type));
  };
  cloud.point_step = 0;
  for (const char* axis : {"x", "y", "z"})
    add(axis, pcl::PCLPointField::FLOAT32, 1);
  add("v", datatype, numbers);
  cloud.point_step = (cloud.point_step + 3) / 4 * 4;
  cloud.height = 1;
  cloud.width = points;
  cloud.row_step = points * cloud.point_step;
  for (std::uint32_t i = 0; i < cloud.row_step; ++i)
    cloud.data.push_back(static_cast<std::uint8_t>(7 * i + i / 251));
  return cloud;
}

TEST(CloudFingerprint, EveryBitOfWhatIsReadCounts)
{
  for (const std::uint8_t type : {pcl::PCLPointField::UINT8,
                                  pcl::PCLPointField::INT16,
                                  pcl::PCLPointField::FLOAT32,
                                  pcl::PCLPointField::FLOAT64})
    for (const std::string field : {"v[1]", "|v|"}) {
      auto cloud = makeCloud(type, 2, 5);
      const CloudFingerprint before = of(cloud, field);
      const std::size_t bytes = pcl_uvol::datatypeSize(type);
      for (std::size_t bit = 0; bit < 8 * cloud.data.size(); ++bit) {
        const std::size_t place = bit / 8 % cloud.point_step;
        const bool is_position = place < 12;
        const bool is_value =
            place >= (field == "|v|" ? 12 : 12 + bytes) && place < 12 + 2 * bytes;
        cloud.data[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        const CloudFingerprint after = of(cloud, field);
        EXPECT_EQ(is_position, before.positions != after.positions) << bit;
        EXPECT_EQ(is_value, before.values != after.values) << bit;
        cloud.data[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
      }
    }
}

TEST(CloudFingerprint, ThePlaceAndTheMeaningCount)
{
  auto cloud = makeCloud(pcl::PCLPointField::FLOAT32, 1, 3);
  std::set<std::uint64_t> values = {of(cloud, "v").values};
  const std::uint64_t positions = of(cloud, "v").positions;
  std::swap_ranges(&cloud.data[12], &cloud.data[16], &cloud.data[28]); // two values
  values.insert(of(cloud, "v").values);
  cloud.fields.back().datatype = pcl::PCLPointField::UINT32;
  values.insert(of(cloud, "v").values);
  values.insert(of(cloud, "|v|").values);
  EXPECT_EQ(4u, values.size());
  EXPECT_EQ(positions, of(cloud, "v").positions);
  // One point less, and two whole points swapped.
  std::swap_ranges(&cloud.data[0], &cloud.data[16], &cloud.data[16]);
  EXPECT_NE(positions, of(cloud, "v").positions);
  std::swap_ranges(&cloud.data[0], &cloud.data[16], &cloud.data[16]);
  EXPECT_EQ(positions, of(cloud, "v").positions);
  cloud.width = 2;
  EXPECT_NE(positions, of(cloud, "v").positions);
}

/** Changes that sums and products of plain numbers would let cancel out. */
TEST(CloudFingerprint, ChangesDoNotCancelOut)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i);
    cloud.push_back({x, 2.0f * x, 100.0f - x, x * x});
  }
  const auto now = [&] {
    const auto view = pcl_uvol::viewOf(cloud);
    return computeFingerprint(view, pcl_uvol::ScalarField(view.fields, "intensity"), 1);
  };
  const CloudFingerprint before = now();
  for (std::size_t i = 1; i + 1 < cloud.size(); i += 7) {
    const float kept[3] = {
        cloud[i - 1].intensity, cloud[i].intensity, cloud[i + 1].intensity};
    for (const float step : {1.0f, 256.0f}) {
      cloud[i - 1].intensity = kept[0] + step;
      cloud[i].intensity = kept[1] - 2.0f * step;
      cloud[i + 1].intensity = kept[2] + step;
      EXPECT_NE(before.values, now().values);
    }
    for (std::size_t j = 0; j < 3; ++j)
      cloud[i - 1 + j].intensity = kept[j];
  }
  EXPECT_EQ(before.values, now().values);
  for (auto& point : cloud)
    point.intensity = -point.intensity;
  EXPECT_NE(before.values, now().values);
  for (auto& point : cloud)
    std::swap(point.x, point.y);
  EXPECT_NE(before.positions, now().positions);
}

TEST(CloudFingerprint, IsTheSameOnAnyNumberOfThreads)
{
  const auto cloud = makeCloud(pcl::PCLPointField::FLOAT64, 3, 200000);
  const CloudFingerprint one = of(cloud, "|v|", 1), four = of(cloud, "|v|", 4);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.values, four.values);
}

} // namespace test_cloud_fingerprint
