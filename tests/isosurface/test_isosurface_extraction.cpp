// SPDX-License-Identifier: BSD-3-Clause
// Isopoints against brute force and analytic truth, and what becomes of awkward input.
#include "common/memory.h"
#include "neighbors/sample_set.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/messages.h"
#include "support/neighbor_oracle.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace test_isosurface_extraction {

using pcl_uvol::AngleCriterion;
using pcl_uvol::Interpolation;
using pcl_uvol::InvalidArgument;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Surface = pcl::PointCloud<pcl_uvol::PointIso>;
using Extraction = pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI>;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

bool
sameBytes(const Surface& a, const Surface& b)
{
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(&a.points[0],
                                   &b.points[0],
                                   a.size() * sizeof(pcl_uvol::PointIso)) == 0);
}

Surface
extract(const Cloud::Ptr& cloud,
        double isovalue,
        unsigned threads = 0,
        Interpolation interpolation = Interpolation::Fit)
{
  Extraction extraction;
  extraction.setInterpolation(interpolation);
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(isovalue);
  extraction.setNumberOfThreads(threads);
  Surface surface;
  extraction.extract(surface);
  return surface;
}

using EdgeSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/** Edges as pairs of input indices, lower first. */
EdgeSet
edgeSet(const pcl_uvol::IsoEdges& edges)
{
  EdgeSet set;
  for (const auto& edge : edges)
    set.emplace(std::min(edge.first, edge.second), std::max(edge.first, edge.second));
  return set;
}

class EdgesOnEveryShape : public testing::TestWithParam<std::string> {};

TEST_P(EdgesOnEveryShape, EqualThoseOverAllNeighborhoods)
{
  const auto cloud = uvol_test::makeCloud(GetParam(), 3000, 11);
  for (const auto criterion : {AngleCriterion::Kept, AngleCriterion::All}) {
    Extraction extraction;
    extraction.setInputCloud(cloud);
    extraction.setIsoValue(0.41234);
    extraction.setAngleCriterion(criterion);
    Surface surface;
    extraction.extract(surface);

    const auto& samples = *extraction.getSamples();
    const uvol_test::NeighborOracle oracle(samples.getPositions());
    std::vector<float> values;
    for (std::size_t i = 0; i < samples.size(); ++i)
      values.push_back((*cloud)[samples.getInputIndex(i)].intensity);
    EdgeSet expected;
    for (const auto& [a, b] : oracle.edges(values, 0.41234f, criterion)) {
      const auto i = samples.getInputIndex(a), j = samples.getInputIndex(b);
      expected.emplace(std::min(i, j), std::max(i, j));
    }
    const EdgeSet found = edgeSet(extraction.getEdges());
    EXPECT_EQ(expected.size(), extraction.getReport().getCount("edges"));
    // Isopoints that fall together keep one edge only.
    EXPECT_EQ(expected.size(),
              found.size() + extraction.getReport().getCount("coincident"));
    EXPECT_TRUE(
        std::includes(expected.begin(), expected.end(), found.begin(), found.end()));
    EXPECT_EQ(surface.size(), extraction.getEdges().size());
    EXPECT_GT(surface.size(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(IsosurfaceExtraction,
                         EdgesOnEveryShape,
                         testing::ValuesIn(uvol_test::cloudShapes()),
                         [](const auto& shape) {
                           return uvol_test::testNameOf(shape.param);
                         });

double
meanDeviation(const Surface& surface, const uvol_test::RadialCloud& radial)
{
  double sum = 0.0;
  for (const pcl_uvol::PointIso& point : surface)
    sum += std::abs(std::hypot(point.x - radial.center,
                               point.y - radial.center,
                               point.z - radial.center) -
                    radial.radius);
  return sum / static_cast<double>(surface.size());
}

/** Thesis Table 2.9: 0.00199 where an edge found from both ends counts twice. */
TEST(IsosurfaceExtraction, RadialTestWithFourMillionSamples)
{
  const auto radial = uvol_test::makeRadialCloud(4000000, 1);
  const Surface surface =
      extract(radial.cloud, radial.radius, 0, Interpolation::Linear);
  EXPECT_GT(surface.size(), 50000u);
  EXPECT_LE(meanDeviation(surface, radial), 0.0024);
}

TEST(IsosurfaceExtraction, DeviationFallsWithTheSquareOfTheSpacing)
{
  // The samples are scaled with their number, so deviations in units of the spacing
  // stay of the order spacing / radius.
  const auto coarse = uvol_test::makeRadialCloud(60000, 2);
  const auto fine = uvol_test::makeRadialCloud(480000, 2);
  const auto in_radii = [](const uvol_test::RadialCloud& radial) {
    return meanDeviation(extract(radial.cloud, radial.radius, 0, Interpolation::Linear),
                         radial) /
           radial.radius;
  };
  EXPECT_NEAR(2.0, std::log2(in_radii(coarse) / in_radii(fine)), 0.2);
}

TEST(IsosurfaceExtraction, LinearNormalsPointToLowerValuesByDefault)
{
  const auto radial = uvol_test::makeRadialCloud(20000, 3);
  for (const auto outside : {pcl_uvol::Outside::Lower, pcl_uvol::Outside::Higher}) {
    Extraction extraction;
    extraction.setInputCloud(radial.cloud);
    extraction.setIsoValue(radial.radius);
    extraction.setOutside(outside);
    extraction.setInterpolation(Interpolation::Linear);
    Surface surface;
    extraction.extract(surface);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const auto& edge = extraction.getEdges()[i];
      const auto& a = (*radial.cloud)[edge.first];
      const auto& b = (*radial.cloud)[edge.second];
      const auto along = (b.getVector3fMap() - a.getVector3fMap()).normalized().eval();
      const float uphill = surface[i].getNormalVector3fMap().dot(along) *
                           (b.intensity > a.intensity ? 1.0f : -1.0f);
      EXPECT_NEAR(outside == pcl_uvol::Outside::Lower ? -1.0f : 1.0f, uphill, 1e-5f);
      EXPECT_NEAR(surface[i].edge_length,
                  (b.getVector3fMap() - a.getVector3fMap()).norm(),
                  1e-5f);
    }
  }
}

TEST(IsosurfaceExtraction, LinearFieldsAreExact)
{
  const auto cloud = uvol_test::makeCloud("uniform", 5000, 4);
  for (auto& point : *cloud)
    point.intensity = point.x + 2.0f * point.y - point.z;
  for (const pcl_uvol::PointIso& point : extract(cloud, 0.7)) {
    EXPECT_NEAR(0.7, point.x + 2.0f * point.y - point.z, 2e-6);
    EXPECT_EQ(0.7f, point.isovalue);
  }
}

TEST(IsosurfaceExtraction, SameBytesForAnyNumberOfThreadsAndOrderOfInput)
{
  const auto radial = uvol_test::makeRadialCloud(100000, 5);
  const Surface one = extract(radial.cloud, radial.radius, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_TRUE(sameBytes(one, extract(radial.cloud, radial.radius, threads)));
  Cloud::Ptr shuffled(new Cloud(*radial.cloud));
  std::mt19937_64 generator(3);
  std::shuffle(shuffled->begin(), shuffled->end(), generator);
  EXPECT_TRUE(sameBytes(one, extract(shuffled, radial.radius, 2)));
}

TEST(IsosurfaceExtraction, SeveralIsovaluesFollowOneAnother)
{
  const auto radial = uvol_test::makeRadialCloud(20000, 6);
  Extraction extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValues({8.0, 6.0});
  Surface both;
  extraction.extract(both);
  Surface expected = extract(radial.cloud, 8.0);
  expected += extract(radial.cloud, 6.0);
  EXPECT_TRUE(sameBytes(expected, both));
}

TEST(IsosurfaceExtraction, KeepsWhatDoesNotDependOnTheIsovalue)
{
  auto radial = uvol_test::makeRadialCloud(20000, 6);
  const auto steps = [](const Extraction& extraction) {
    std::set<std::string> names;
    for (const auto& [step, milliseconds] : extraction.getReport().milliseconds)
      names.insert(step);
    return names;
  };
  Extraction extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValue(8.0);
  Surface surface;
  extraction.extract(surface);
  EXPECT_EQ(1u, steps(extraction).count("tree"));
  const auto samples = extraction.getReport().getCount("samples");

  extraction.setIsoValue(6.0);
  extraction.extract(surface);
  EXPECT_TRUE(sameBytes(extract(radial.cloud, 6.0), surface));
  for (const char* step : {"scalar", "tree", "ranges"})
    EXPECT_EQ(0u, steps(extraction).count(step)) << step;
  EXPECT_EQ(samples, extraction.getReport().getCount("samples"));

  // Another field of the same samples keeps the tree.
  extraction.setScalarField("x");
  extraction.extract(surface);
  EXPECT_EQ(0u, steps(extraction).count("tree"));
  EXPECT_EQ(1u, steps(extraction).count("ranges"));
  for (const pcl_uvol::PointIso& point : surface)
    ASSERT_NEAR(6.0, point.x, 1e-4);

  // A failed extraction leaves nothing behind that a later one would take for its own.
  extraction.setScalarField("nothing");
  EXPECT_THROW(extraction.extract(surface), InvalidArgument);
  extraction.setScalarField("intensity");
  pcl::IndicesPtr half(new pcl::Indices);
  for (int i = 0; i < 10000; ++i)
    half->push_back(i);
  extraction.setIndices(half);
  extraction.extract(surface);
  EXPECT_EQ(10000u, extraction.getReport().getCount("samples"));
  Cloud::Ptr first(new Cloud(*radial.cloud, *half));
  EXPECT_TRUE(sameBytes(extract(first, 6.0), surface));

  // A cloud that was handed over again is read again.
  for (auto& point : *first)
    point.intensity += 1.0f;
  extraction.setInputCloud(first);
  half->resize(5000);
  extraction.extract(surface);
  Cloud::Ptr quarter(new Cloud(*first, *half));
  EXPECT_TRUE(sameBytes(extract(quarter, 6.0), surface));
}

/** As in a simulation's loop: one cloud that is written into. */
TEST(IsosurfaceExtraction, NoticesWhatWasChangedInPlace)
{
  const auto radial = uvol_test::makeRadialCloud(20000, 6);
  Cloud& cloud = *radial.cloud;
  Extraction extraction;
  extraction.setInputCloud(radial.cloud);
  extraction.setIsoValue(radial.radius);
  Surface surface;
  const auto hasStep = [&](const char* step) {
    const auto& steps = extraction.getReport().milliseconds;
    return std::any_of(
        steps.begin(), steps.end(), [&](const auto& s) { return s.first == step; });
  };
  const auto expectAsNew = [&](bool builds_tree, const std::string& change) {
    extraction.extract(surface);
    EXPECT_TRUE(
        sameBytes(extract(pcl::make_shared<Cloud>(cloud), radial.radius), surface))
        << change;
    EXPECT_EQ(builds_tree, hasStep("tree")) << change;
    EXPECT_TRUE(hasStep("ranges")) << change;
    extraction.extract(surface);
    EXPECT_FALSE(hasStep("ranges")) << "after " << change;
  };
  extraction.extract(surface);

  for (auto& point : cloud)
    point.intensity += 0.25f;
  expectAsNew(false, "other values");
  cloud[7].intensity = 2.0f * cloud[7].intensity;
  expectAsNew(false, "one value");
  std::swap(cloud[1].intensity, cloud[20].intensity);
  expectAsNew(false, "two values swapped");
  cloud[7].intensity = std::numeric_limits<float>::quiet_NaN();
  expectAsNew(true, "a value that is none: one sample less");
  for (auto& point : cloud)
    point.y = -point.y;
  expectAsNew(true, "mirrored positions");
  cloud[3].z += 0.5f;
  expectAsNew(true, "one position");
  cloud.push_back(cloud.back());
  cloud.back().x += 0.25f;
  expectAsNew(true, "one point more");
  cloud.resize(10000);
  expectAsNew(true, "fewer points");
}

/** As in a robot's loop: a new cloud every time. */
TEST(IsosurfaceExtraction, RepeatedCallsPassHeadersOnAndDoNotGrow)
{
  const auto radial = uvol_test::makeRadialCloud(5000, 6);
  Extraction extraction;
  extraction.setIsoValue(radial.radius);
  Surface surface;
  std::uint64_t before = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    Cloud::Ptr cloud(new Cloud(*radial.cloud));
    cloud->header.seq = i;
    cloud->header.stamp = 1000 * i;
    cloud->header.frame_id = "base_link";
    extraction.setInputCloud(cloud);
    extraction.extract(surface);
    ASSERT_EQ(i, surface.header.seq);
    ASSERT_EQ(1000u * i, surface.header.stamp);
    ASSERT_EQ("base_link", surface.header.frame_id);
    if (i == 100)
      before = pcl_uvol::residentMemory();
  }
  // Sanitizers keep what was freed.
  if (!uvol_test::isSanitized()) {
    EXPECT_LE(pcl_uvol::residentMemory(), before + 1000000);
  }
}

TEST(IsosurfaceExtraction, ScaleFindsNeighborsInStretchedSpace)
{
  // Flattened by 1000 and stretched again: the same surface, flattened.
  const auto radial = uvol_test::makeRadialCloud(20000, 7);
  Cloud::Ptr flat(new Cloud(*radial.cloud));
  for (auto& point : *flat)
    point.z /= 1024.0f;
  const Surface expected = extract(radial.cloud, radial.radius);
  Extraction extraction;
  extraction.setInputCloud(flat);
  extraction.setIsoValue(radial.radius);
  extraction.setScale({1.0f, 1.0f, 1024.0f});
  Surface surface;
  extraction.extract(surface);
  ASSERT_EQ(expected.size(), surface.size());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    EXPECT_NEAR(expected[i].z, surface[i].z * 1024.0f, 1e-4f);
    // Lengths and directions are those of the flat space.
    const Eigen::Vector3f normal = (expected[i].getNormalVector3fMap().array() *
                                    Eigen::Array3f(1.0f, 1.0f, 1024.0f))
                                       .matrix()
                                       .normalized();
    EXPECT_NEAR(1.0f, normal.dot(surface[i].getNormalVector3fMap()), 1e-5f);
    EXPECT_LE(surface[i].error, expected[i].error);
    EXPECT_EQ(expected[i].support, surface[i].support);
  }
}

TEST(IsosurfaceExtraction, SamplesAtTheIsovalueGiveOneIsopoint)
{
  // A lattice of 0, 1, 2: the middle layer lies exactly at the isovalue.
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 27; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(i % 3);
    point.y = static_cast<float>(i / 3 % 3);
    point.z = static_cast<float>(i / 9);
    point.intensity = point.z;
    cloud->push_back(point);
  }
  Extraction extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(1.0);
  Surface surface;
  extraction.extract(surface);
  EXPECT_EQ(9u, surface.size());
  EXPECT_GT(extraction.getReport().getCount("coincident"), 0u);
  for (const pcl_uvol::PointIso& point : surface) {
    EXPECT_EQ(1.0f, point.z);
    EXPECT_LT(point.normal_z, -0.5f);
  }
}

/** \param values at the origin, whose median is 0.5, in their order; at x = 1 it is 1
 */
void
expectMedian(const std::vector<float>& values)
{
  Cloud::Ptr cloud(new Cloud(1, 1));
  (*cloud)[0].x = 1.0f;
  (*cloud)[0].intensity = 1.0f;
  for (const float value : values) {
    cloud->push_back({});
    cloud->back().intensity = value;
  }
  Extraction extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(0.75);
  Surface surface;
  extraction.extract(surface);
  ASSERT_EQ(1u, surface.size());
  EXPECT_EQ(0.5f, surface[0].x);
  EXPECT_EQ(values.size() - 1, extraction.getReport().getCount("duplicates"));
  EXPECT_EQ(1u, extraction.getReport().getCount("conflicting_duplicates"));
  std::vector<float> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto lower =
      std::find(values.begin(), values.end(), sorted[(values.size() - 1) / 2]);
  const auto source = static_cast<std::uint32_t>(1 + (lower - values.begin()));
  EXPECT_EQ((EdgeSet{{0, source}}), edgeSet(extraction.getEdges()));
}

TEST(IsosurfaceExtraction, DuplicatesTakeTheMedianInAnyOrder)
{
  for (std::vector<float> values : std::vector<std::vector<float>>{
           {0.25f, 0.75f},
           {0.0f, 0.5f, 9.0f},
           {-3e38f, 0.25f, 0.75f, 3e38f},
           {0.25f, 0.25f, 0.75f, 0.75f},
           {-1.0f, 0.5f, 0.5f, 0.5f}, // an even number that agree
           {-2.0f, -1.0f, 0.5f, 2.0f, 9.0f}})
    do
      expectMedian(values);
    while (std::next_permutation(values.begin(), values.end()));
}

TEST(IsosurfaceExtraction, UnusableSamplesAreDroppedAndCounted)
{
  const auto cloud = uvol_test::makeCloud("uniform", 500, 8);
  Cloud::Ptr dirty(new Cloud(*cloud));
  for (int i = 0; i < 3; ++i) {
    dirty->push_back((*cloud)[0]);
    (i == 0 ? dirty->back().x : dirty->back().intensity) =
        i == 2 ? std::numeric_limits<float>::infinity() : nan_value;
  }
  Extraction extraction;
  extraction.setInputCloud(dirty);
  extraction.setIsoValue(0.4);
  Surface surface;
  extraction.extract(surface);
  EXPECT_TRUE(sameBytes(extract(cloud, 0.4), surface));
  EXPECT_EQ(1u, extraction.getReport().getCount("non_finite"));
  EXPECT_EQ(2u, extraction.getReport().getCount("no_value"));
}

TEST(IsosurfaceExtraction, EmptyResultsAreWarned)
{
  for (const std::size_t n : {std::size_t(1), std::size_t(100)}) {
    const auto cloud = uvol_test::makeCloud("uniform", n, 9);
    for (const double isovalue : {-1.0, 5.0}) {
      Extraction extraction;
      extraction.setInputCloud(cloud);
      extraction.setIsoValue(isovalue);
      Surface surface(3, 1);
      extraction.extract(surface);
      EXPECT_TRUE(surface.empty());
      EXPECT_EQ(std::vector<std::string>{n == 1 ? "constant_field" : "no_isopoints"},
                uvol_test::listCodes(extraction.getReport().warnings));
    }
  }
}

TEST(IsosurfaceExtraction, BadInputThrowsAndLeavesTheOutputAlone)
{
  const auto expectThrow = [](const Cloud::Ptr& cloud, auto&& configure) {
    Extraction extraction;
    if (cloud)
      extraction.setInputCloud(cloud);
    extraction.setIsoValue(0.5);
    configure(extraction);
    Surface surface(3, 1);
    EXPECT_THROW(extraction.extract(surface), InvalidArgument);
    EXPECT_EQ(3u, surface.size());
  };
  const auto nothing = [](Extraction&) {};
  const auto good = uvol_test::makeCloud("uniform", 100, 10);
  expectThrow(nullptr, nothing);
  expectThrow(Cloud::Ptr(new Cloud), nothing);
  expectThrow(good, [](Extraction& e) { e.setScalarField("density"); });
  expectThrow(good, [](Extraction& e) { e.setIsoValues({}); });
  expectThrow(good, [](Extraction& e) { e.setIsoValue(nan_value); });
  expectThrow(good, [](Extraction& e) { e.setIsoValues({8.0, 6.0, 8.0}); });
  expectThrow(good, [](Extraction& e) { e.setScale({1.0f, 0.0f, 1.0f}); });
  expectThrow(good, [](Extraction& e) { e.setScale({1.0f, nan_value, 1.0f}); });
  Cloud::Ptr no_value(new Cloud(*good));
  for (auto& point : *no_value)
    point.intensity = nan_value;
  expectThrow(no_value, nothing);
  Cloud::Ptr nowhere(new Cloud(*good));
  for (auto& point : *nowhere)
    point.y = nan_value;
  expectThrow(nowhere, nothing);
}

} // namespace test_isosurface_extraction
