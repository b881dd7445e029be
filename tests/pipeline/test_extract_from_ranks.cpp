// SPDX-License-Identifier: BSD-3-Clause
// Several ranks find together what one process finds alone, byte for byte.
#include "pipeline/expect_sampling.h"
#include "pipeline/extract_from_ranks.h"
#include "support/clouds.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <tuple>

namespace test_extract_from_ranks {

using pcl_uvol::AngleCriterion;
using pcl_uvol::GlobalIsopoint;
using pcl_uvol::Interpolation;
using pcl_uvol::IsosurfaceParameters;
using pcl_uvol::LocalDimension;
using pcl_uvol::Report;
using pcl_uvol::Samples;
using uvol_test::runRanks;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Isopoints = std::vector<std::vector<GlobalIsopoint>>;

/** What one process finds. */
struct Alone {
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  pcl_uvol::IsoEdges edges;
  Report report;

  Alone(const Cloud::Ptr& cloud, const IsosurfaceParameters& settings)
  {
    pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
    extraction.setInputCloud(cloud);
    extraction.setIsoValues(settings.isovalues);
    extraction.setInterpolation(settings.interpolation);
    extraction.setAngleCriterion(settings.criterion);
    extraction.setOutside(settings.outside);
    extraction.setScale(settings.scale);
    extraction.extract(isopoints);
    edges = extraction.getEdges();
    report = extraction.getReport();
  }
};

/** What all ranks find, in the order of the edges. */
struct Together {
  Isopoints isopoints;
  pcl_uvol::SamplingSummary sampling; ///< as each rank says
  Report report;                      ///< of all ranks

  /** \param owner of point i among the ranks */
  Together(const Cloud& cloud,
           const IsosurfaceParameters& settings,
           std::size_t ranks,
           const std::function<std::size_t(std::size_t)>& owner)
      : isopoints(settings.isovalues.size())
  {
    const auto view = pcl_uvol::viewOf(cloud);
    std::mutex mutex;
    runRanks(ranks, [&](pcl_uvol::Communicator& communicator) {
      Report own;
      Samples samples;
      const Samples all = readSamples(view, {view.fields, "intensity"}, {}, 0, 1, own);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (owner(all.sources[i]) == communicator.rank())
          samples.append(all.span(i, 1));
      const auto found =
          extractFromRanks(std::move(samples), settings, {}, communicator, 1, own);
      const std::lock_guard lock(mutex);
      sampling = found.samples.sampling;
      report.merge(own);
      for (std::size_t i = 0; i < found.isopoints.size(); ++i)
        isopoints[i].insert(
            isopoints[i].end(), found.isopoints[i].begin(), found.isopoints[i].end());
    });
    for (auto& part : isopoints)
      std::sort(part.begin(), part.end(), [](const auto& a, const auto& b) {
        return std::tie(a.lower, a.higher) < std::tie(b.lower, b.higher);
      });
  }
};

void
expectEqual(const Alone& alone,
            const Together& together,
            const IsosurfaceParameters& settings)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < together.isopoints.size(); ++i)
    for (const GlobalIsopoint& isopoint : together.isopoints[i]) {
      ASSERT_LT(next, alone.isopoints.size());
      const pcl_uvol::PointIso point = toPointIso(isopoint, settings.isovalues[i]);
      // Every bit is to be the same, that of not-a-number as well.
      // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
      ASSERT_EQ(0,
                std::memcmp(&point, &alone.isopoints[next], sizeof(pcl_uvol::PointIso)))
          << next << ": " << point.x << " " << alone.isopoints[next].x;
      EXPECT_EQ(alone.edges[next].first, isopoint.first);
      EXPECT_EQ(alone.edges[next].second, isopoint.second);
      EXPECT_EQ(alone.edges[next].t, isopoint.t);
      ++next;
    }
  EXPECT_EQ(alone.isopoints.size(), next);
  for (const char* name : {"edges",
                           "coincident",
                           "isopoints",
                           "cubic_roots",
                           "linear_far",
                           "linear_step",
                           "bridged",
                           "rim",
                           "examined",
                           "examined_bridged",
                           "examined_rim",
                           "duplicates",
                           "conflicting_duplicates"})
    EXPECT_EQ(alone.report.getCount(name), together.report.getCount(name)) << name;
}

const auto in_turn = [](std::size_t ranks) {
  return [ranks](std::size_t point) { return point % ranks; };
};

/** Points dealt out in turn. */
void
expectRanksFind(const Alone& alone,
                const Cloud& cloud,
                const IsosurfaceParameters& settings,
                std::initializer_list<std::size_t> numbers)
{
  for (const std::size_t ranks : numbers) {
    SCOPED_TRACE(ranks);
    expectEqual(alone, Together(cloud, settings, ranks, in_turn(ranks)), settings);
  }
}

class RanksOnEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(RanksOnEveryShape, FindWhatOneFinds)
{
  const auto cloud = uvol_test::makeCloud(GetParam(), 4000, 7);
  IsosurfaceParameters settings;
  settings.isovalues = {0.41234, 0.2};
  for (const auto interpolation : {Interpolation::Fit, Interpolation::Linear}) {
    settings.interpolation = interpolation;
    const Alone alone(cloud, settings);
    expectRanksFind(alone, *cloud, settings, {1, 2, 3, 4, 8});
  }
}

INSTANTIATE_TEST_SUITE_P(Clouds,
                         RanksOnEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

TEST(RankExtraction, LendsAlongTheCutsOnly)
{
  std::uint64_t exchanged[2];
  std::size_t n = 30000;
  for (std::uint64_t& bytes : exchanged) {
    const auto radial = uvol_test::makeRadialCloud(n, 3);
    IsosurfaceParameters settings;
    settings.isovalues = {radial.radius};
    const Together together(*radial.cloud, settings, 8, in_turn(8));
    if (n == 30000)
      expectEqual(Alone(radial.cloud, settings), together, settings);
    bytes = together.report.getCount("bytes_exchanged");
    // All but an eighth of the samples change hands.
    EXPECT_NEAR(
        1.0, together.report.getCount("bytes_redistributed") / (21.0 * n), 0.05);
    n *= 8;
  }
  EXPECT_LT(exchanged[1], 4.5 * exchanged[0]);
}

TEST(RankExtraction, TakesSettingsAsOneProcessDoes)
{
  const auto cloud = uvol_test::makeCloud("clustered", 8000, 5);
  IsosurfaceParameters settings;
  settings.isovalues = {0.3};
  settings.criterion = AngleCriterion::All;
  settings.outside = pcl_uvol::Outside::Higher;
  settings.scale = {1.0f, 2.5f, 0.75f};
  expectEqual(
      Alone(cloud, settings), Together(*cloud, settings, 4, in_turn(4)), settings);
}

/** Where samples are far apart, the nearest ones of an isopoint lie several pieces
 * away.
 */
TEST(RankExtraction, AsksForWhatFitsReachBeyondNeighboringBricks)
{
  const Cloud::Ptr cloud(new Cloud);
  const auto dense = uvol_test::makeCloud("uniform", 20000, 9);
  // Thin out all but a corner, so that cells there are small.
  for (std::size_t i = 0; i < dense->size(); ++i) {
    const pcl::PointXYZI& point = (*dense)[i];
    if (i % 50 == 0 || point.x + point.y + point.z < 0.6f)
      cloud->push_back(point);
  }
  IsosurfaceParameters settings;
  settings.isovalues = {0.3, 0.5};
  const Alone alone(cloud, settings);
  EXPECT_GT(alone.isopoints.size(), 300u);
  expectRanksFind(alone, *cloud, settings, {3, 8, 16});
}

/** Values in steps, the isovalue on one of them: edges meet in samples of all pieces.
 */
TEST(RankExtraction, MergesIsopointsThatCoincideAcrossPieces)
{
  for (const std::string shape : {"lattice", "uniform"}) {
    const auto cloud = uvol_test::makeCloud(shape, 5000, 7);
    for (auto& point : *cloud)
      point.intensity = std::round(20.0f * point.intensity) / 20.0f;
    IsosurfaceParameters settings;
    settings.isovalues = {0.4};
    for (const auto interpolation : {Interpolation::Linear, Interpolation::Fit}) {
      settings.interpolation = interpolation;
      const Alone alone(cloud, settings);
      EXPECT_GT(alone.report.getCount("coincident"), 300u);
      expectRanksFind(alone, *cloud, settings, {2, 3, 8});
    }
  }
}

TEST(RankExtraction, DoesNotCareWhereSamplesAre)
{
  const auto cloud = uvol_test::makeCloud("uniform", 2000, 2);
  IsosurfaceParameters settings;
  settings.isovalues = {0.4};
  const Alone alone(cloud, settings);
  expectEqual(alone, Together(*cloud, settings, 4, [](auto) { return 2; }), settings);
  expectEqual(alone,
              Together(*cloud, settings, 4, [](auto i) { return i < 20 ? 0 : 3; }),
              settings);
}

TEST(RankExtraction, MergesDuplicatesAcrossRanks)
{
  const auto once = uvol_test::makeCloud("uniform", 1500, 4);
  const Cloud::Ptr cloud(new Cloud(*once));
  *cloud += *once;
  for (std::size_t i = 1500; i < 3000; i += 4) // two values
    (*cloud)[i].intensity -= 0.02f;
  for (std::size_t i = 0; i < 300; ++i) { // three
    cloud->push_back((*once)[i]);
    cloud->back().intensity += 0.01f;
  }
  IsosurfaceParameters settings;
  settings.isovalues = {0.4};
  const Alone alone(cloud, settings);
  EXPECT_EQ(1800u, alone.report.getCount("duplicates"));
  expectRanksFind(alone, *cloud, settings, {1, 4, 6});
}

TEST(RankExtraction, TakesMoreRanksThanSamples)
{
  const auto cloud = uvol_test::makeCloud("uniform", 5, 4);
  IsosurfaceParameters settings;
  settings.isovalues = {0.4};
  for (const std::size_t size : {1, 2, 5}) {
    cloud->resize(size);
    expectEqual(
        Alone(cloud, settings), Together(*cloud, settings, 8, in_turn(8)), settings);
  }
}

/** Two steps are taken to redistribute samples. */
TEST(RankExtraction, TakesManyRanks)
{
  const auto cloud = uvol_test::makeCloud("clustered", 12000, 6);
  IsosurfaceParameters settings;
  settings.isovalues = {0.3};
  const Alone alone(cloud, settings);
  EXPECT_GT(alone.isopoints.size(), 300u);
  expectRanksFind(alone, *cloud, settings, {64, 70});
}

/** Pieces end where neighbours would be, which changes little. */
TEST(RankExtraction, ReportsTheSampling)
{
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {7.0}; // none is found
  settings.scale = {1.0f, 1.0f, 3e6f};
  for (const float across : {1e-6f, 2e-5f}) {
    const Cloud::Ptr cloud(new Cloud);
    for (int row = 0; row < 16; ++row)
      for (int line = 0; line < 20; ++line)
        for (int i = 0; i < 100; ++i)
          cloud->push_back({across * static_cast<float>(line),
                            across * static_cast<float>(row),
                            static_cast<float>(i) / 3e12f,
                            0.0f});
    for (const std::size_t ranks : {1, 3})
      EXPECT_EQ(across > 1e-5f ? LocalDimension::Line : LocalDimension::Volume,
                uvol_test::expectSamplingOf(
                    *cloud,
                    settings,
                    Together(*cloud, settings, ranks, in_turn(ranks)).sampling));
  }
}

TEST(RankExtraction, RefusesNothingAtAll)
{
  IsosurfaceParameters settings;
  settings.isovalues = {0.4};
  EXPECT_THROW(Together(Cloud(), settings, 3, in_turn(3)), pcl_uvol::InvalidArgument);
}

} // namespace test_extract_from_ranks
