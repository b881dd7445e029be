// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "support/clouds.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace test_report {

TEST(Report, CountsSamplesOfSeveralStagesOnce)
{
  const auto report_of = [](std::uint64_t samples) {
    pcl_uvol::Report stage;
    stage.countSamples("samples", samples);
    stage.countSamples("samples", 1); // two fields with samples of their own
    stage.count("isopoints", 7);
    return stage;
  };
  pcl_uvol::Report report;
  report.merge(report_of(4));
  report.merge(report_of(9));
  EXPECT_EQ(5u, report.getCount("samples"));
  EXPECT_EQ(14u, report.getCount("isopoints"));
}

TEST(Progress, RisesToOneAndIsReportedOneAtATime)
{
  pcl_uvol::Report report;
  std::vector<double> told;
  bool inside = false, overlapped = false;
  report.progress = [&](const std::string& step, double done) {
    overlapped |= inside;
    inside = true;
    EXPECT_EQ("work", step);
    told.push_back(done);
    inside = false;
  };
  {
    pcl_uvol::StepTimer step(report, "work", 100000);
    pcl_uvol::parallelBlocks(
        100000, 10, 3, [&](auto begin, auto end) { step.advance(end - begin); });
  }
  EXPECT_FALSE(overlapped);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(0.0, told.front());
  EXPECT_EQ(1.0, told.back());
  EXPECT_GT(told.size(), 20u);
  EXPECT_LT(told.size(), 300u);
}

TEST(Progress, ReachesTheUserOfAStageAndCanInterruptIt)
{
  const auto radial = uvol_test::makeRadialCloud(100000, 1);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValue(radial.radius);
  std::map<std::string, double> told;
  extraction.setProgressCallback(
      [&](const std::string& step, double done) { told[step] = done; });
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  extraction.extract(isopoints);
  EXPECT_EQ(1u, told.count("tree"));
  EXPECT_EQ(1u, told.count("neighborhoods"));
  for (const auto& [step, done] : told)
    EXPECT_EQ(1.0, done) << step;

  const std::size_t before = isopoints.size();
  extraction.setInputCloud(radial.cloud);
  extraction.setProgressCallback([](const std::string&, double done) {
    if (done > 0.3)
      throw std::runtime_error("enough");
  });
  EXPECT_THROW(extraction.extract(isopoints), std::runtime_error);
  EXPECT_EQ(before, isopoints.size());
  extraction.setProgressCallback({});
  extraction.extract(isopoints);
  EXPECT_EQ(before, isopoints.size());
}

} // namespace test_report
