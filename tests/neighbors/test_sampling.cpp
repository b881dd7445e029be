// SPDX-License-Identifier: BSD-3-Clause
// Local dimension and spacings of samples whose layout is known.
#include "src/common/random.h"
#include "src/neighbors/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace test_sampling {

using namespace pcl_uvol;

SampleSet::ConstPtr
makeSamples(const std::vector<Position>& positions, const Position& scale)
{
  std::vector<std::uint32_t> use(positions.size());
  std::iota(use.begin(), use.end(), 0u);
  Report report;
  return SampleSet::build(
      positions.front().x, sizeof(Position) / sizeof(float), use, scale, 0, report);
}

/** A lattice of spacings dx, dy, dz, with a little disorder. */
std::vector<Position>
makeLattice(int nx, int ny, int nz, float dx, float dy, float dz)
{
  std::uint64_t draw = 0;
  const auto place = [&](int i, float spacing) {
    return spacing * (static_cast<float>(i) +
                      0.02f * static_cast<float>(uniformAt(3, draw++, 0)));
  };
  std::vector<Position> positions;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        positions.push_back({{place(x, dx), place(y, dy), place(z, dz)}});
  return positions;
}

SamplingSummary
summarize(const std::vector<Position>& positions,
          const Position& scale = {{1.0f, 1.0f, 1.0f}})
{
  return summarizeSampling(*makeSamples(positions, scale), 0);
}

TEST(Sampling, ClassifiesVolumesSheetsAndLines)
{
  const auto volume = summarize(makeLattice(12, 12, 12, 1.0f, 1.0f, 1.0f));
  EXPECT_EQ(LocalDimension::Volume, volume.most);
  EXPECT_NEAR(1.0, volume.along, 0.05);
  EXPECT_NEAR(1.0, volume.across, 0.05);
  const auto sheets = summarize(makeLattice(20, 20, 8, 1.0f, 1.0f, 12.0f));
  EXPECT_EQ(LocalDimension::Sheet, sheets.most);
  EXPECT_NEAR(1.0, sheets.along, 0.1);
  EXPECT_NEAR(12.0, sheets.across, 1.5);
  const auto lines = summarize(makeLattice(60, 8, 8, 1.0f, 12.0f, 12.0f));
  EXPECT_EQ(LocalDimension::Line, lines.most);
  EXPECT_NEAR(1.0, lines.along, 0.5);
  EXPECT_NEAR(12.0, lines.across, 1.5);
}

/** Cells up to 1:3 are as good as cubes; those of 1:6 lie in sheets or lines. */
TEST(Sampling, ContrastsAreThoseOfCells)
{
  EXPECT_EQ(LocalDimension::Volume,
            summarize(makeLattice(14, 14, 10, 1.0f, 1.0f, 3.0f)).most);
  EXPECT_EQ(LocalDimension::Volume,
            summarize(makeLattice(20, 10, 10, 1.0f, 3.0f, 3.0f)).most);
  EXPECT_EQ(LocalDimension::Sheet,
            summarize(makeLattice(20, 20, 8, 1.0f, 1.0f, 6.0f)).most);
  EXPECT_EQ(LocalDimension::Line,
            summarize(makeLattice(40, 8, 8, 1.0f, 6.0f, 6.0f)).most);
}

/** Of 3,000 samples every third one, wherever parts begin. */
TEST(Sampling, PartsLookAtWhatTheWholeLooksAt)
{
  const auto samples =
      makeSamples(makeLattice(10, 10, 10, 1.0f, 1.0f, 12.0f), {{1.0f, 1.0f, 1.0f}});
  const auto all = diagnoseSampling(*samples, 0);
  for (const std::size_t begin : {0, 1, 2, 1000, 1999, 2000}) {
    const auto some = lookAtSome(*samples, begin, 3000, 2);
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((begin + i) % 3 == 0) {
        ASSERT_LT(next, some.size());
        EXPECT_EQ(all[i].along, some[next].along);
        EXPECT_EQ(all[i].across, some[next++].across);
      }
    EXPECT_EQ(next, some.size()) << begin;
  }
}

TEST(Sampling, SpacingsAreThoseOfTheStretchedSpace)
{
  const auto positions = makeLattice(60, 8, 8, 1.0f, 12.0f, 12.0f);
  const auto stretched = summarize(positions, {{12.0f, 1.0f, 1.0f}});
  EXPECT_EQ(LocalDimension::Volume, stretched.most);
  EXPECT_NEAR(12.0, stretched.along, 1.0);
}

TEST(Sampling, KnowsOneLineAndOnePlane)
{
  std::vector<Position> line, plane;
  for (int i = 0; i < 100; ++i)
    line.push_back({{0.5f * static_cast<float>(i), 0.0f, 0.0f}});
  for (const Position& place : makeLattice(15, 15, 1, 1.0f, 1.0f, 0.0f))
    plane.push_back(place);
  const auto of_line = summarize(line), of_plane = summarize(plane);
  EXPECT_EQ(LocalDimension::Line, of_line.most);
  EXPECT_FLOAT_EQ(0.5f, of_line.along);
  EXPECT_TRUE(std::isinf(of_line.across));
  EXPECT_EQ(LocalDimension::Sheet, of_plane.most);
  EXPECT_TRUE(std::isinf(of_plane.across));
}

TEST(Sampling, KnowsWhatIsAlone)
{
  auto positions = makeLattice(8, 8, 8, 1.0f, 1.0f, 1.0f);
  positions.push_back({{40.0f, 0.0f, 0.0f}});
  const auto samples = makeSamples(positions, {{1.0f, 1.0f, 1.0f}});
  const auto found = diagnoseSampling(*samples, 0);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(samples->getInputIndex(i) == positions.size() - 1,
              found[i].dimension == LocalDimension::Isolated);
  EXPECT_EQ(LocalDimension::Isolated, summarize({{{1.0f, 2.0f, 3.0f}}}).most);
}

/** Lines between samples that are both have no lengths in float. */
TEST(Sampling, TakesSamplesBothVeryNearAndVeryFar)
{
  std::vector<Position> positions;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto draw = [&](unsigned axis) {
      const double number = uniformAt(11, i, axis);
      return number < 0.3 ? -0x1p63f
                          : std::trunc(static_cast<float>(8.0 * number) - 5.0f);
    };
    positions.push_back({{draw(0), draw(1), draw(2)}});
  }
  const auto samples = makeSamples(positions, {{1.0f, 1.0f, 1.0f}});
  for (const LocalSampling& found : diagnoseSampling(*samples, 0))
    EXPECT_GE(found.along, 0.0f);
}

TEST(Sampling, DoesNotDependOnThreadsOrUnits)
{
  auto positions = makeLattice(20, 20, 8, 1.0f, 1.0f, 12.0f);
  const auto samples = makeSamples(positions, {{1.0f, 1.0f, 1.0f}});
  const auto one = diagnoseSampling(*samples, 1), four = diagnoseSampling(*samples, 4);
  for (Position& position : positions)
    for (int axis = 0; axis < 3; ++axis)
      position[axis] *= 0x1p-30f;
  const auto small = diagnoseSampling(*makeSamples(positions, {{1.0f, 1.0f, 1.0f}}), 0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].along, four[i].along);
    EXPECT_EQ(one[i].across, four[i].across);
    EXPECT_EQ(0x1p-30f * one[i].along, small[i].along);
    EXPECT_EQ(one[i].dimension, small[i].dimension);
  }
}

} // namespace test_sampling
