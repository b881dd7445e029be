// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "generation/analytic_fields.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/stage.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace test_analytic_fields {

TEST(AnalyticFields, IsovaluesLieInTheRangeOfTheirField)
{
  for (const auto& field : pcl_uvol::analyticFields())
    for (const double isovalue : field.isovalues) {
      std::size_t above = 0;
      constexpr std::size_t n = 20000;
      for (std::size_t i = 0; i < n; ++i)
        above +=
            field.value(pcl_uvol::scatterAt(
                pcl_uvol::Scatter::Clustered, 1, i, n, field.lower, field.upper)) >=
            isovalue;
      EXPECT_GT(above, 10u) << field.name << ' ' << isovalue;
      EXPECT_LT(above, n - 10) << field.name << ' ' << isovalue;
    }
  EXPECT_THROW(pcl_uvol::findAnalyticField("cube"), pcl_uvol::InvalidArgument);
}

TEST(AnalyticFields, GridsHaveOneSamplePerCell)
{
  using pcl_uvol::Scatter;
  EXPECT_EQ(729u, pcl_uvol::scatterCount(Scatter::Jittered, 999));
  EXPECT_EQ(1000u, pcl_uvol::scatterCount(Scatter::Lattice, 1000));
  EXPECT_EQ(999u, pcl_uvol::scatterCount(Scatter::Uniform, 999));
  for (const auto scatter : {Scatter::Jittered, Scatter::Lattice}) {
    std::vector<int> filled(1000, 0);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const auto p = pcl_uvol::scatterAt(scatter, 1, i, 1000, 0.0, 10.0);
      ++filled[static_cast<std::size_t>(p[0]) + 10 * static_cast<std::size_t>(p[1]) +
               100 * static_cast<std::size_t>(p[2])];
    }
    EXPECT_EQ(std::vector<int>(1000, 1), filled);
  }
}

TEST(Parallel, ExceptionsLeaveThroughTheCaller)
{
  EXPECT_THROW(pcl_uvol::parallelBlocks(100,
                                        1,
                                        2,
                                        [](std::size_t i, std::size_t) {
                                          if (i == 50)
                                            throw std::runtime_error("50");
                                        }),
               std::runtime_error);
  EXPECT_THROW(pcl_uvol::TaskGroup::run(2,
                                        [] {
                                          pcl_uvol::TaskGroup::fork(
                                              [] { throw std::runtime_error("left"); },
                                              [] {});
                                        }),
               std::runtime_error);
}

TEST(Parallel, BlocksCoverEverythingOnceInOrder)
{
  for (const unsigned threads : {0u, 1u, 3u}) {
    const auto indices = pcl_uvol::parallelGather<std::size_t>(
        1003,
        10,
        threads,
        [](std::size_t begin, std::size_t end, std::vector<std::size_t>& out) {
          for (std::size_t i = begin; i < end; ++i)
            out.push_back(i);
        });
    ASSERT_EQ(1003u, indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      EXPECT_EQ(i, indices[i]);
  }
}

TEST(Report, AddsUpAndKeepsTheOrder)
{
  pcl_uvol::Report a, b;
  a.count("x", 1);
  b.count("y", 2);
  b.count("x", 3);
  b.warnings.push_back(std::string("w"));
  {
    const pcl_uvol::StepTimer timer(b, "step");
  }
  a.merge(b);
  EXPECT_EQ(4u, a.getCount("x"));
  EXPECT_EQ(2u, a.getCount("y"));
  EXPECT_EQ(0u, a.getCount("z"));
  EXPECT_EQ("x", a.counts.front().first);
  EXPECT_EQ("step", a.milliseconds.front().first);
  EXPECT_EQ(b.warnings, a.warnings);
}

} // namespace test_analytic_fields
