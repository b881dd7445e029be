// SPDX-License-Identifier: BSD-3-Clause
// An isosurface through scratch files is the one that memory gives.
#include "io/point_stream.h"
#include "pipeline/expect_sampling.h"
#include "pipeline/extract_out_of_core.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace test_extract_out_of_core {

using pcl_uvol::Dataset;
using pcl_uvol::Interpolation;
using pcl_uvol::IsosurfaceParameters;
using pcl_uvol::OutOfCoreIsosurface;
using pcl_uvol::OutOfCoreSettings;
using pcl_uvol::PointStream;
using pcl_uvol::Report;

class OutOfCore : public testing::Test {
protected:
  void
  save(const pcl::PointCloud<pcl::PointXYZI>& cloud)
  {
    Dataset dataset;
    pcl::toPCLPointCloud2(cloud, dataset.cloud);
    pcl_uvol::setField(dataset, "number", std::vector<std::int32_t>(cloud.size()));
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto number = static_cast<std::int32_t>(i);
      const std::size_t offset = dataset.cloud.fields.back().offset;
      std::memcpy(&dataset.cloud.data[i * dataset.cloud.point_step + offset],
                  &number,
                  sizeof(number));
    }
    pcl_uvol::saveDataset(path_, dataset);
  }

  OutOfCoreIsosurface
  extract(const IsosurfaceParameters& settings, unsigned threads = 0)
  {
    PointStream points(path_);
    OutOfCoreSettings out_of_core;
    out_of_core.max_memory =
        pcl_uvol::leastOutOfCoreMemory(points.size(), settings.isovalues.size()) +
        more_memory_;
    out_of_core.scratch_folder = folder_ / "";
    out_of_core.threads = threads;
    report_ = Report();
    return extractOutOfCore(points, settings, out_of_core, report_);
  }

  void
  expectAsInMemory(const IsosurfaceParameters& settings)
  {
    const Dataset dataset = pcl_uvol::loadDataset(path_);
    pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
    extraction.setInputCloud(
        pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
    extraction.setIsoValues(settings.isovalues);
    extraction.setInterpolation(settings.interpolation);
    extraction.setScale(settings.scale);
    pcl::PointCloud<pcl_uvol::PointIso> isopoints;
    extraction.extract(isopoints);
    const OutOfCoreIsosurface found = extract(settings);
    ASSERT_EQ(isopoints.size(), found.isopoints.size());
    EXPECT_EQ(0,
              std::memcmp(isopoints.points.data(),
                          found.isopoints.points.data(),
                          isopoints.size() * sizeof(pcl_uvol::PointIso)));
    pcl::PCLPointCloud2 expected, carried;
    pcl::toPCLPointCloud2(isopoints, expected);
    pcl::toPCLPointCloud2(found.isopoints, carried);
    interpolateFields(dataset.cloud, extraction.getEdges(), expected);
    interpolateFields(found.samples, found.edges, carried);
    EXPECT_EQ(expected.data, carried.data);
    for (const auto& [name, count] : extraction.getReport().counts)
      EXPECT_EQ(count, report_.getCount(name)) << name;
    EXPECT_EQ(extraction.getReport().warnings, report_.warnings);
    EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder_.list());
  }

  uvol_test::TemporaryFolder folder_;
  std::string path_ = folder_ / "in.pcd";
  std::uint64_t more_memory_ = 0; // than the least bound
  Report report_;
};

class OutOfCoreOnEveryShape : public OutOfCore,
                              public testing::WithParamInterface<std::string> {};

TEST_P(OutOfCoreOnEveryShape, GivesTheBytesOfMemory)
{
  save(*uvol_test::makeCloud(GetParam(), 80000, 3));
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.41234, 0.1, 7.0};
  expectAsInMemory(settings);
  EXPECT_EQ(report_.getCount("samples") > 40000, report_.getCount("pieces") > 1);
}

INSTANTIATE_TEST_SUITE_P(Clouds,
                         OutOfCoreOnEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

/** Blocks are found three levels below pieces. */
TEST_F(OutOfCore, GivesTheBytesOfMemoryWithLargePieces)
{
  save(*uvol_test::makeCloud("clustered", 300000, 6));
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  more_memory_ = 8000000;
  expectAsInMemory(settings);
  EXPECT_EQ(2u, report_.getCount("pieces"));
}

/** Where metrics of the sparse samples reach into the cluster, balls around them would
 * hold most of the samples. The bound leaves room for the result, and for less than
 * half of the samples. */
TEST_F(OutOfCore, TakesOfAClusterBesideABlockOnlyWhatSearchesLookAt)
{
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (std::size_t i = 0; i < 450000; ++i) {
    const double side = i % 3 == 0 ? 15.0 : 100.0;
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(50.0 + side * (random.uniform() - 0.5));
    point.intensity = std::sin(0.11f * point.x) +
                      std::cos(0.07f * point.y) * std::sin(0.09f * point.z);
    cloud.push_back(point);
  }
  save(cloud);
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  more_memory_ = 7000000;
  expectAsInMemory(settings);
}

TEST_F(OutOfCore, TakesSettingsAndBadPointsAsMemoryDoes)
{
  auto cloud = uvol_test::makeCloud("uniform", 50000, 8);
  for (std::size_t i = 0; i < cloud->size(); i += 700) {
    (*cloud)[i].x = std::numeric_limits<float>::infinity();
    (*cloud)[i + 1].intensity = std::numeric_limits<float>::quiet_NaN();
    (*cloud)[i + 2] = (*cloud)[i + 3];
    (*cloud)[i + 2].intensity += 0.001f;
  }
  save(*cloud);
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  settings.interpolation = Interpolation::Linear;
  settings.scale = {2.0f, 1.0f, 0.25f};
  expectAsInMemory(settings);
  EXPECT_EQ(72u, report_.getCount("duplicates"));
  EXPECT_EQ(72u, report_.getCount("no_value"));
}

/** Pieces end where neighbours would be, which changes little. */
TEST_F(OutOfCore, ReportsTheSampling)
{
  const auto cloud = uvol_test::makeCloud("uniform", 200000, 8);
  save(*cloud);
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {7.0}; // none is found
  settings.scale = {1e9f, 1e9f, 1e9f};
  const auto found = extract(settings).read.sampling;
  EXPECT_LT(1u, report_.getCount("pieces"));
  EXPECT_EQ(pcl_uvol::LocalDimension::Volume,
            uvol_test::expectSamplingOf(*cloud, settings, found));
}

TEST_F(OutOfCore, DoesNotDependOnThreads)
{
  save(*uvol_test::makeCloud("clustered", 50000, 2));
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  const auto one = extract(settings, 1), three = extract(settings, 3);
  ASSERT_EQ(one.isopoints.size(), three.isopoints.size());
  EXPECT_EQ(0,
            std::memcmp(one.isopoints.points.data(),
                        three.isopoints.points.data(),
                        one.isopoints.size() * sizeof(pcl_uvol::PointIso)));
}

TEST_F(OutOfCore, RefusesWhatCannotWork)
{
  save(*uvol_test::makeCloud("uniform", 1000, 8));
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  const auto run = [&](const std::string& field, const OutOfCoreSettings& out_of_core) {
    return [&, field, out_of_core] {
      PointStream points(path_);
      Report report;
      settings.field = field;
      extractOutOfCore(points, settings, out_of_core, report);
    };
  };
  OutOfCoreSettings enough{std::uint64_t(1) << 30, folder_ / "", 0};
  const auto unknown =
      uvol_test::thrownBy<pcl_uvol::InvalidArgument>(run("density", enough));
  EXPECT_EQ("unknown_field", unknown.code);
  EXPECT_EQ("density", uvol_test::wordOf(unknown, "field"));
  EXPECT_EQ("memory_for_pieces",
            uvol_test::codeOf<pcl_uvol::InvalidArgument>(
                run("intensity", {1000000, folder_ / "", 0})));
  const auto refused =
      uvol_test::thrownBy(run("intensity", {enough.max_memory, "/nowhere", 0}));
  EXPECT_EQ("scratch_folder_refused", refused.code);
  EXPECT_EQ("/nowhere", uvol_test::wordOf(refused, "folder"));
  EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder_.list());
}

TEST_F(OutOfCore, HasScratchFilesThatNobodySees)
{
  save(*uvol_test::makeCloud("uniform", 50000, 8));
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  std::set<std::string> steps;
  Report report;
  report.progress = [&](const std::string& step, double) {
    steps.insert(step);
    EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder_.list());
    if (step == "smooth_roots")
      throw std::runtime_error("interrupted");
  };
  PointStream points(path_);
  const OutOfCoreSettings out_of_core{
      pcl_uvol::leastOutOfCoreMemory(50000, 1), folder_ / "", 0};
  EXPECT_THROW(extractOutOfCore(points, settings, out_of_core, report),
               std::runtime_error);
  EXPECT_EQ(1u, steps.count("scratch"));
  EXPECT_EQ(1u, steps.count("tree"));
  EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder_.list());
}

/** Room on disk of this process's files without a name. */
std::uint64_t
namelessBytes()
{
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    struct stat status;
    const int descriptor = std::stoi(entry.path().filename().string());
    if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_nlink == 0)
      bytes += static_cast<std::uint64_t>(status.st_blocks) * 512;
  }
  return bytes;
}

bool
canShortenFiles(const std::string& path)
{
  const int file = open(path.c_str(), O_RDWR | O_CREAT, 0600);
  const bool can =
      ftruncate(file, 1 << 16) == 0 &&
      fallocate(file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, 1 << 12) == 0;
  close(file);
  unlink(path.c_str());
  return can;
}

/** While they are parted, and while duplicates are merged, samples leave one file for
 * another one. */
TEST_F(OutOfCore, KeepsEachSampleOnDiskOnce)
{
  if (!canShortenFiles(folder_ / "hole"))
    GTEST_SKIP() << "this file system cannot shorten files at their beginning";
  const std::size_t size = 2000000;
  for (const bool duplicates : {false, true}) {
    auto cloud = uvol_test::makeCloud("lattice", size, 1);
    if (duplicates)
      (*cloud)[0] = (*cloud)[1];
    save(*cloud);
    IsosurfaceParameters settings;
    settings.field = "intensity";
    settings.isovalues = {7.0}; // no value comes near: isopoints are none of this test
    std::atomic<bool> ends{false};
    std::uint64_t most = 0;
    std::thread watch([&] {
      while (!ends) {
        most = std::max(most, namelessBytes());
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    });
    extract(settings);
    ends = true;
    watch.join();
    const double samples = 24.0 * static_cast<double>(report_.getCount("samples"));
    EXPECT_GT(static_cast<double>(most), 0.9 * samples);
    EXPECT_LT(static_cast<double>(most), 1.4 * samples);
  }
}

TEST_F(OutOfCore, SaysThatTheDiskIsFull)
{
  save(*uvol_test::makeCloud("uniform", 50000, 8));
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  // A limit on the size of files stands for the end of the disk.
  rlimit before;
  ASSERT_EQ(0, getrlimit(RLIMIT_FSIZE, &before));
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{500000, before.rlim_max};
  ASSERT_EQ(0, setrlimit(RLIMIT_FSIZE, &tight));
  const auto full = uvol_test::thrownBy([&] { extract(settings); });
  EXPECT_EQ("scratch_folder_full", full.code);
  EXPECT_EQ("500 kB", uvol_test::wordOf(full, "size"));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder_.list());
}

TEST_F(OutOfCore, RefusesMoreAtOnePlaceThanFits)
{
  pcl::PointCloud<pcl::PointXYZI> cloud(3000000, 1);
  for (std::size_t i = 0; i < cloud.size(); i += 8)
    cloud[i].x = cloud[i].y = cloud[i].z = cloud[i].intensity = static_cast<float>(i);
  save(cloud);
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  EXPECT_EQ("memory_for_piece",
            uvol_test::codeOf<pcl_uvol::InvalidArgument>([&] { extract(settings); }));
}

TEST_F(OutOfCore, HasNothingToSayOfNothing)
{
  pcl::PointCloud<pcl::PointXYZI> cloud(5, 1);
  for (auto& point : cloud)
    point.x = std::numeric_limits<float>::quiet_NaN();
  save(cloud);
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {0.3};
  EXPECT_THROW(extract(settings), pcl_uvol::InvalidArgument);
}

} // namespace test_extract_out_of_core
