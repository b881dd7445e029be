// SPDX-License-Identifier: BSD-3-Clause
// How large isosurfaces will be is told before they are extracted.
#include "isosurface/memory_need.h"
#include "support/smooth_fields.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

namespace test_estimated_surfaces {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;

std::vector<pcl_uvol::SurfaceSize>
estimate(const Cloud& cloud, const std::vector<double>& isovalues, unsigned threads = 0)
{
  pcl_uvol::IsosurfaceParameters parameters;
  parameters.isovalues = isovalues;
  return pcl_uvol::estimateSurfaces(pcl_uvol::viewOf(cloud), parameters, threads);
}

/** Within that part of what the extraction finds. */
void
expectSize(const Cloud::Ptr& cloud, double isovalue, double tolerance)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(isovalue);
  extraction.setInterpolation(pcl_uvol::Interpolation::Linear);
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  extraction.extract(isopoints);
  const auto crossing =
      static_cast<double>(extraction.getReport().getCount("crossing_samples"));
  const auto edges = static_cast<double>(extraction.getReport().getCount("edges"));
  const auto surfaces = estimate(*cloud, {isovalue});
  ASSERT_EQ(1u, surfaces.size());
  EXPECT_NEAR(crossing, surfaces[0].crossing, tolerance * crossing);
  EXPECT_NEAR(edges, surfaces[0].isopoints, tolerance * edges);
}

TEST(EstimatedSurfaces, AreAboutAsLargeAsTheyWillBe)
{
  constexpr std::size_t samples = 200000;
  for (const char* const name : {"radial", "gyroid", "torus"})
    for (const bool is_clustered : {false, true}) {
      SCOPED_TRACE(std::string(name) + (is_clustered ? " clustered" : ""));
      const auto field = uvol_test::makeSmoothField(name, samples);
      // Where density falls to a part in 27,000, a thinned cloud resolves less.
      expectSize(uvol_test::sampleSmoothField(field, samples, 1, is_clustered),
                 field.isovalue,
                 is_clustered ? 0.35 : 0.15);
    }
}

TEST(EstimatedSurfaces, OfFewSamplesAreExact)
{
  const auto field = uvol_test::makeSmoothField("torus", 5000);
  expectSize(
      uvol_test::sampleSmoothField(field, 5000, 1, false), field.isovalue, 1e-12);
}

TEST(EstimatedSurfaces, AreTheSameForAnyNumberOfThreads)
{
  const auto field = uvol_test::makeSmoothField("torus", 50000);
  const auto cloud = uvol_test::sampleSmoothField(field, 50000, 1, false);
  const auto one = estimate(*cloud, {field.isovalue}, 1);
  const auto three = estimate(*cloud, {field.isovalue}, 3);
  EXPECT_EQ(one[0].crossing, three[0].crossing);
  EXPECT_EQ(one[0].isopoints, three[0].isopoints);
}

TEST(EstimatedSurfaces, HaveNoSizeWhereTheFieldDoesNotTell)
{
  const auto field = uvol_test::makeSmoothField("torus", 1000);
  const auto cloud = uvol_test::sampleSmoothField(field, 1000, 1, false);
  for (const auto& surface : estimate(*cloud, {1e9, -1e9}))
    EXPECT_EQ(0.0, surface.crossing + surface.isopoints);
  for (auto& point : *cloud)
    point.intensity = std::nanf("");
  EXPECT_EQ(0.0, estimate(*cloud, {0.0})[0].crossing);
  EXPECT_EQ(2u, estimate({}, {0.0, 1.0}).size());
}

TEST(EstimatedSurfaces, NeedMoreMemoryTheLargerTheyAre)
{
  const pcl_uvol::SurfaceSize small{1000, 1000}, large{100000, 100000};
  const auto none = pcl_uvol::isosurfaceNeed(1e6, {});
  const auto one = pcl_uvol::isosurfaceNeed(1e6, {large});
  const auto two = pcl_uvol::isosurfaceNeed(1e6, {large, small});
  // As documented: 52 to 68 bytes per sample.
  EXPECT_GE(none.peak, 52e6);
  EXPECT_LE(none.peak, 68e6);
  EXPECT_EQ(0.0, none.kept);
  EXPECT_GT(one.peak, none.peak);
  EXPECT_GE(two.peak, one.peak);
  EXPECT_GT(two.kept, one.kept);
}

} // namespace test_estimated_surfaces
