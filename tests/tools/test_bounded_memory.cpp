// SPDX-License-Identifier: BSD-3-Clause
// What a bound of memory costs, by the whole tool.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cmath>
#include <string>
#include <sys/resource.h>

namespace test_bounded_memory {

/** A third of the samples in 1/300 of the space. */
void
saveCluster(const std::string& path, std::size_t count)
{
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  cloud.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double side = i % 3 == 0 ? 15.0 : 100.0;
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(50.0 + side * (random.uniform() - 0.5));
    point.intensity = std::sin(0.11f * point.x) +
                      std::cos(0.07f * point.y) * std::sin(0.09f * point.z);
    cloud.push_back(point);
  }
  pcl_uvol::Dataset dataset;
  pcl::toPCLPointCloud2(cloud, dataset.cloud);
  pcl_uvol::saveDataset(path, dataset);
}

/** Seconds of all processors that commands have taken so far. */
double
measureTime()
{
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/** Clusters are where a piece has to know most of others. */
TEST(BoundedMemory, HoldsBesideAClusterInThreeTimesTheTime_long)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers take memory and time of their own.";
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.pcd";
  saveCluster(in, 6000000);
  const auto run = [&](const std::string& out, const std::string& options) {
    return uvol_test::jsonOf(
        uvol_test::runCommand("uvol_isosurface " + in + ' ' + (folder / out) +
                              " -field intensity -iso 0.3 -json" + options));
  };
  const double begin = measureTime();
  run("memory.ply", "");
  const double middle = measureTime();
  const auto report = run("bound.ply", " -max-memory 330M");
  EXPECT_LE(measureTime() - middle, 3.0 * (middle - begin));
  EXPECT_LE(report.at("memory").at("peak"), 330e6);
  EXPECT_EQ(uvol_test::readFile(folder / "memory.ply"),
            uvol_test::readFile(folder / "bound.ply"));
}

} // namespace test_bounded_memory
