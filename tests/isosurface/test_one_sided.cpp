// SPDX-License-Identifier: BSD-3-Clause
// Isopoints that the samples around them contradict: between casts, whose surface is
// known, on a real glider, and none of dense samples.
#include "support/environment.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace test_one_sided {

using namespace pcl_uvol;

using Cloud = pcl::PointCloud<pcl::PointXYZI>;

/** Casts of 100 samples each, 5 m apart and down to 500 m, along a line: the water is
 * warm near its top and a little colder from metre to metre below 100 m. It has 8
 * degrees at a depth of 69 m.
 * \param apart metres between casts */
Cloud::Ptr
sampleCasts(float apart)
{
  uvol_test::Random random(11);
  auto cloud = std::make_shared<Cloud>();
  for (int cast = 0; cast < 12; ++cast)
    for (int i = 0; i < 100; ++i) {
      pcl::PointXYZI point;
      point.x = apart * static_cast<float>(cast);
      point.y = apart * 0.05f * static_cast<float>(random.uniform());
      point.z = -5.0f * static_cast<float>(i + 0.5 * random.uniform());
      point.intensity = 7.5f + 0.005f * point.z + 8.5f * std::exp(point.z / 30.0f);
      cloud->push_back(point);
    }
  return cloud;
}

struct Found {
  pcl::PointCloud<PointIso> isopoints;
  std::uint64_t contradicted;

  float
  findLowest() const
  {
    float lowest = 0.0f;
    for (const PointIso& point : isopoints)
      lowest = std::min(lowest, point.z);
    return lowest;
  }
};

Found
extract(const Cloud::Ptr& cloud,
        float isovalue,
        Interpolation interpolation,
        unsigned threads = 0)
{
  IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setScalarField("intensity");
  extraction.setIsoValue(isovalue);
  extraction.setInterpolation(interpolation);
  extraction.setNumberOfThreads(threads);
  Found found;
  extraction.extract(found.isopoints);
  EXPECT_EQ(found.isopoints.size(), extraction.getEdges().size());
  found.contradicted = extraction.getReport().getCount("contradicted");
  return found;
}

TEST(OneSided, IsopointsBetweenCastsAreContradictedFarFromTheSurface)
{
  for (const float apart : {500.0f, 2000.0f}) {
    SCOPED_TRACE(apart);
    const auto casts = sampleCasts(apart);
    const Found all = extract(casts, 8.0f, Interpolation::Fit),
                kept = extract(casts, 8.0f, Interpolation::Auto);
    EXPECT_EQ(0u, all.contradicted);
    EXPECT_LT(all.findLowest(), -100.0f);
    EXPECT_GE(kept.findLowest(), all.findLowest());
    EXPECT_GT(kept.contradicted, 0u);
    EXPECT_EQ(all.isopoints.size(), kept.isopoints.size() + kept.contradicted);
    // Crossings of the casts themselves stay.
    const auto count_short = [](const Found& found) {
      return std::count_if(found.isopoints.begin(),
                           found.isopoints.end(),
                           [](const auto& point) { return point.edge_length < 10.0f; });
    };
    EXPECT_GT(count_short(all), 0);
    EXPECT_EQ(count_short(all), count_short(kept));
  }
}

TEST(OneSided, NoIsopointOfDenseSamplesIsContradicted)
{
  uvol_test::Random random(5);
  const auto cloud = std::make_shared<Cloud>();
  for (int i = 0; i < 8000; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = point.getVector3fMap().norm();
    cloud->push_back(point);
  }
  const Found all = extract(cloud, 0.6f, Interpolation::Fit),
              kept = extract(cloud, 0.6f, Interpolation::Auto);
  EXPECT_GT(all.isopoints.size(), 500u);
  EXPECT_EQ(all.isopoints.size(), kept.isopoints.size());
  EXPECT_EQ(0u, kept.contradicted);
}

TEST(OneSided, DependsNotOnThreadsOrTheOrderOfSamples)
{
  const auto casts = sampleCasts(2000.0f), reversed = std::make_shared<Cloud>(*casts);
  std::reverse(reversed->begin(), reversed->end());
  const Found one = extract(casts, 8.0f, Interpolation::Auto, 1),
              three = extract(casts, 8.0f, Interpolation::Auto, 3),
              other = extract(reversed, 8.0f, Interpolation::Auto);
  ASSERT_EQ(one.isopoints.size(), three.isopoints.size());
  ASSERT_EQ(one.isopoints.size(), other.isopoints.size());
  for (std::size_t i = 0; i < one.isopoints.size(); ++i) {
    EXPECT_EQ(one.isopoints[i].getVector3fMap(), three.isopoints[i].getVector3fMap());
    EXPECT_EQ(one.isopoints[i].getVector3fMap(), other.isopoints[i].getVector3fMap());
  }
}

/** Fewer samples than the test needs contradict nothing. */
TEST(OneSided, FewSamplesContradictNothing)
{
  const auto cloud = std::make_shared<Cloud>();
  for (int i = 0; i < 7; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(i * i * i);
    point.y = static_cast<float>(i % 3);
    point.z = static_cast<float>(i % 2);
    point.intensity = i == 6 ? 1.0f : 0.0f;
    cloud->push_back(point);
  }
  const Found found = extract(cloud, 0.5f, Interpolation::Auto);
  EXPECT_GT(found.isopoints.size(), 0u);
  EXPECT_EQ(0u, found.contradicted);
}

} // namespace test_one_sided
