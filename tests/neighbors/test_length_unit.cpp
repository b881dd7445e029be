// SPDX-License-Identifier: BSD-3-Clause
// The unit of length of samples: a power of two that few points have no say in.
#include "neighbors/length_unit.h"
#include "neighbors/sample_set.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace test_length_unit {

using pcl_uvol::LengthUnit;
using pcl_uvol::MagnitudeCounts;
using pcl_uvol::Position;
using pcl_uvol::Report;
using pcl_uvol::SampleSet;

constexpr Position no_scale{{1.0f, 1.0f, 1.0f}};

float
factorOf(const std::vector<Position>& positions, const Position& scale = no_scale)
{
  MagnitudeCounts counts;
  for (const Position& position : positions)
    counts.add(position, scale);
  return counts.findUnit(scale).factor;
}

TEST(LengthUnit, BringsTheMedianMagnitudeNearOne)
{
  EXPECT_EQ(1.0f, factorOf({}));
  EXPECT_EQ(1.0f, factorOf({{{0.0f, -1.0f, 0.5f}}}));
  EXPECT_EQ(1.0f, factorOf({{{1.9999f, 0.0f, 0.0f}}}));
  EXPECT_EQ(0.5f, factorOf({{{0.0f, 0.0f, -2.0f}}}));
  EXPECT_EQ(0x1p100f, factorOf({{{0x1p-100f, 0.0f, 0.0f}}}));
  // Two of five may be anything, zeros and what is not finite as well.
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(0.25f,
            factorOf({{{1e30f, 0.0f, 0.0f}},
                      {{4.0f, 0.0f, 0.0f}},
                      {{1e-30f, 0.0f, 0.0f}},
                      {{5.0f, 0.0f, 0.0f}},
                      {{7.0f, 0.0f, 0.0f}},
                      {{0.0f, 0.0f, 0.0f}},
                      {{0.0f, 0.0f, 0.0f}},
                      {{1.0f, nan, 0.0f}}}));
  // Powers of two whose reciprocals are normal numbers.
  EXPECT_EQ(0x1p126f, factorOf({{{1e-45f, 0.0f, 0.0f}}}));
  EXPECT_EQ(0x1p-126f, factorOf({{{3.4e38f, 0.0f, 0.0f}}}));
}

TEST(LengthUnit, KnowsTheScale)
{
  const Position scale{{3.0f, 1.0f, 0.5f}};
  MagnitudeCounts counts;
  counts.add({{3.0f, 8.5f, 1.0f}}, scale); // 9, 8.5, 0.5
  const LengthUnit unit = counts.findUnit(scale);
  EXPECT_EQ(0.125f, unit.factor);
  EXPECT_EQ(0.375f, unit.scale[0]);
  EXPECT_EQ(0.125f, unit.scale[1]);
  EXPECT_EQ(0.0625f, unit.scale[2]);
  EXPECT_EQ(16.0, unit.toInput(2.0));
  // Products beyond float are numbers all the same.
  EXPECT_EQ(0x1p-126f, factorOf({{{1e30f, 0.0f, 0.0f}}}, {{1e30f, 1e30f, 1e30f}}));
  EXPECT_THROW(factorOf({{{1.0f, 0.0f, 0.0f}}}, {{1e30f, 1e-20f, 1.0f}}),
               pcl_uvol::InvalidArgument);
}

TEST(LengthUnit, IsThatOfAllPartsTogether)
{
  uvol_test::Random random(3);
  MagnitudeCounts all, parts[3];
  for (int i = 0; i < 1000; ++i) {
    const Position x{
        {static_cast<float>(std::exp(20.0 * random.uniform())), 1.0f, 2.0f}};
    all.add(x, no_scale);
    parts[i * i % 3].add(x, no_scale);
  }
  parts[2].add(parts[0]);
  parts[1].add(parts[2]);
  EXPECT_EQ(all.getCounts(), parts[1].getCounts());
}

TEST(LengthUnit, EndsAtTheFarthestSample)
{
  // One beyond the last place, one in it, one next to it, among samples near 1.
  const float end = LengthUnit::farthest;
  std::vector<Position> positions{{{std::nextafter(end, 2.0f * end), 0.0f, 0.0f}},
                                  {{0.0f, -end, 0.0f}},
                                  {{0.0f, 0.0f, std::nextafter(end, 0.0f)}}};
  for (int i = 0; i < 9; ++i)
    positions.push_back({{1.0f, 0.01f * static_cast<float>(i), 0.0f}});
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0u);
  MagnitudeCounts counts;
  for (const Position& position : positions)
    counts.add(position, no_scale);
  EXPECT_TRUE(counts.reachesBeyond(counts.findUnit(no_scale)));
  Report report;
  const auto samples = SampleSet::build(positions[0].x, 3, all, no_scale, 1, report);
  EXPECT_EQ(positions.size() - 1, samples->size());
  EXPECT_EQ(1u, report.getCount("far_points"));
  ASSERT_EQ(1u, report.warnings.size());
  const auto& warning = report.warnings[0];
  EXPECT_EQ("far_points", warning.code);
  EXPECT_EQ(1.0, uvol_test::numberOf(warning, "far_points"));
  EXPECT_EQ(0.0, uvol_test::numberOf(warning, "first"));
  EXPECT_EQ(double(positions[0].x[0]), uvol_test::numberOf(warning, "x"));
  for (const char* const axis : {"y", "z"})
    EXPECT_EQ(0.0, uvol_test::numberOf(warning, axis)) << axis;
}

TEST(LengthUnit, SamplesAreTheSameInAnyUnit)
{
  const auto build = [](int exponent) {
    uvol_test::Random random(7);
    std::vector<Position> positions(500);
    for (Position& position : positions)
      for (float& x : position.x)
        x = std::ldexp(static_cast<float>(random.uniform()) - 0.3f, exponent);
    std::vector<std::uint32_t> all(positions.size());
    std::iota(all.begin(), all.end(), 0u);
    Report report;
    return SampleSet::build(positions[0].x, 3, all, {{1.0f, 3.0f, 0.7f}}, 2, report);
  };
  const auto expected = build(0);
  for (const int exponent : {-100, -20, 1, 100, 120}) {
    const auto found = build(exponent);
    EXPECT_EQ(expected->getUnit().factor,
              std::ldexp(found->getUnit().factor, exponent));
    for (std::size_t i = 0; i < expected->size(); ++i) {
      ASSERT_EQ(expected->getInputIndex(i), found->getInputIndex(i));
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_EQ(expected->getPositions()[i][axis], found->getPositions()[i][axis]);
    }
  }
}

} // namespace test_length_unit
