// SPDX-License-Identifier: BSD-3-Clause
// Reports of several processes are one.
#include "distributed/merge_reports.h"
#include "support/thread_ranks.h"

#include <gtest/gtest.h>

namespace test_merge_reports {

using pcl_uvol::Report;

TEST(RankReport, AddsCountsAndKeepsTheLongestTimes)
{
  uvol_test::runRanks(3, [](pcl_uvol::Communicator& communicator) {
    Report report;
    report.count("samples", 10 + communicator.rank());
    if (communicator.rank() == 1)
      report.count("strays", 4);
    report.time("read", communicator.rank() == 2 ? 0.5 : 2.0 + communicator.rank());
    report.warnings = {"all of them"};
    if (communicator.rank() == 2)
      report.warnings.push_back("the last");
    const Report together =
        mergeReports(report, communicator, {"samples", "strays", "none"});
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

} // namespace test_merge_reports
