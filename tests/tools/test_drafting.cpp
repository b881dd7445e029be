// SPDX-License-Identifier: BSD-3-Clause
// Drafts of isosurfaces in the viewer: of how many samples, and what they are like.
#include "support/environment.h"
#include "viewer/draft_choice.h"
#include "viewer/drafting_pipeline.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>

namespace test_drafting {

using uvol_tools::DraftChoice;

TEST(DraftChoice, TakesAsManySamplesAsTimeAllows)
{
  DraftChoice choice(100.0);
  EXPECT_EQ(1u, choice.choose()); // nothing is known
  choice.addTime(1, 99.0);
  EXPECT_EQ(1u, choice.choose());
  choice.addTime(1, 799.0); // a quarter of it of an eighth, an eighth of it of 1 / 22.6
  EXPECT_EQ(32u, choice.choose());
  choice.addTime(1, 399.0);
  EXPECT_EQ(8u, choice.choose());
  choice.addTime(1, 1e9);
  EXPECT_EQ(DraftChoice::largest, choice.choose());
}

TEST(DraftChoice, IsChangedForLargeDifferencesOnly)
{
  DraftChoice choice(100.0);
  choice.addTime(1, 390.0);
  EXPECT_EQ(8u, choice.choose());
  choice.addTime(8, 1000.0); // with its tree
  EXPECT_EQ(8u, choice.choose());
  choice.addTime(8, 129.0);
  EXPECT_EQ(8u, choice.choose());
  choice.addTime(8, 51.0);
  EXPECT_EQ(8u, choice.choose());
  choice.addTime(8, 131.0);
  EXPECT_EQ(16u, choice.choose());
  choice.addTime(16, 1000.0); // as before
  choice.addTime(16, 49.0);
  EXPECT_EQ(8u, choice.choose());
  choice.addTime(8, 1000.0);
  choice.addTime(8, 24.0);
  EXPECT_EQ(1u, choice.choose()); // all take 96
}

/** Samples of the distance from the middle of a cube of side 2. */
std::shared_ptr<const pcl_uvol::Dataset>
makeBall()
{
  constexpr int samples = 40000;
  pcl::PointCloud<pcl::PointXYZI> points;
  uvol_test::Random random(3);
  for (int i = 0; i < samples; ++i) {
    pcl::PointXYZI point;
    for (float& coordinate : point.data)
      coordinate = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = point.getVector3fMap().norm();
    points.push_back(point);
  }
  const auto ball = std::make_shared<pcl_uvol::Dataset>();
  pcl::toPCLPointCloud2(points, ball->cloud);
  return ball;
}

TEST(DraftingPipeline, MakesTheSameSurfaceOfFewerSamples)
{
  const auto ball = makeBall();
  uvol_tools::DraftingPipeline pipeline(ball, "intensity", 0);
  const auto run = [&](unsigned thinning) {
    return pipeline.run({{0.7}, false, {}}, thinning, nullptr).surface.cloud;
  };
  const pcl::PCLPointCloud2 whole = run(1), draft = run(8);
  const double share = static_cast<double>(draft.width) / whole.width;
  EXPECT_NEAR(0.25, share, 0.03);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(draft);
  for (std::size_t i = 0; i < view.count; ++i)
    EXPECT_NEAR(0.7f, Eigen::Map<const Eigen::Vector3f>(view.xyz(i)).norm(), 0.02f);
  EXPECT_EQ(whole.data, run(1).data);
  EXPECT_EQ(draft.data, run(8).data);
  EXPECT_LT(run(16).width, draft.width);
  EXPECT_EQ(draft.data, run(8).data);
}

TEST(DraftingPipeline, MakesMeshesAndSeveralIsovaluesOfFewerSamples)
{
  uvol_tools::DraftingPipeline pipeline(makeBall(), "intensity", 0);
  const pcl_uvol::IsosurfaceResult two =
      pipeline.run({{0.7, 0.4}, false, {}}, 8, nullptr);
  ASSERT_EQ(2u, two.isopoints.size());
  EXPECT_NEAR(std::pow(0.7 / 0.4, 2.0),
              static_cast<double>(two.isopoints[1]) / two.isopoints[0],
              0.4);
  const pcl_uvol::IsosurfaceResult mesh = pipeline.run({{0.7}, true, {}}, 8, nullptr);
  EXPECT_GT(mesh.triangles.size(), 1000u);
  EXPECT_LT(mesh.triangles.size(),
            pipeline.run({{0.7}, true, {}}, 1, nullptr).triangles.size() / 3);
}

} // namespace test_drafting
