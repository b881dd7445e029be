// SPDX-License-Identifier: BSD-3-Clause
// Reports of several processes are one.
#include "support/thread_ranks.h"
#include <pcl_uvol/common/rank_report.h>

#include <gtest/gtest.h>

namespace {

using pcl_uvol::Report;

TEST(RankReport, AddsCountsAndKeepsTheLongestTimes)
{
  uvol_test::runRanks(3, [](pcl_uvol::RankGroup& ranks) {
    Report report;
    report.count("samples", 10 + ranks.rank());
    if (ranks.rank() == 1)
      report.count("strays", 4);
    report.time("read", ranks.rank() == 2 ? 0.5 : 2.0 + ranks.rank());
    report.warnings = {"all of them"};
    if (ranks.rank() == 2)
      report.warnings.push_back("the last");
    const Report together = mergeReports(report, ranks, {"samples", "strays", "none"});
    const decltype(together.counts) counts{{"samples", 33},
                                           {"strays", 4},
                                           {"largest_samples", 12},
                                           {"largest_strays", 4},
                                           {"largest_none", 0}};
    EXPECT_EQ(counts, together.counts);
    const decltype(together.milliseconds) milliseconds{{"read", 3.0}};
    EXPECT_EQ(milliseconds, together.milliseconds);
    EXPECT_EQ((std::vector<std::string>{"all of them", "the last"}), together.warnings);
  });
}

} // namespace
