// SPDX-License-Identifier: BSD-3-Clause
// Reports of several processes are one.
#include "distributed/merge_reports.h"
#include "support/thread_ranks.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace test_merge_reports {

using pcl_uvol::Message;
using pcl_uvol::Report;

TEST(RankReport, AddsCountsAndKeepsTheLongestTimes)
{
  uvol_test::runRanks(3, [](pcl_uvol::Communicator& communicator) {
    Report report;
    report.count("samples", 10 + communicator.rank());
    if (communicator.rank() == 1)
      report.count("far_points", 4);
    report.time("read", communicator.rank() == 2 ? 0.5 : 2.0 + communicator.rank());
    report.warnings = {std::string("all of them")};
    if (communicator.rank() == 2)
      report.warnings.push_back(std::string("the last"));
    const Report together =
        mergeReports(report, communicator, {"samples", "far_points", "none"});
    const decltype(together.counts) counts{{"samples", 33},
                                           {"far_points", 4},
                                           {"largest_samples", 12},
                                           {"largest_far_points", 4},
                                           {"largest_none", 0}};
    EXPECT_EQ(counts, together.counts);
    const decltype(together.milliseconds) milliseconds{{"read", 3.0}};
    EXPECT_EQ(milliseconds, together.milliseconds);
    EXPECT_EQ(
        (std::vector<Message>{std::string("all of them"), std::string("the last")}),
        together.warnings);
  });
}

TEST(RankReport, WarningsComeBackAsTheyAre)
{
  const auto far_points = [](double x) {
    return Message("far_points",
                   {{"far_points", 1},
                    {"first", 4294967296.0},
                    {"x", x},
                    {"y", -0x1.fffffffffffffp+1023},
                    {"z", std::numeric_limits<double>::infinity()}});
  };
  const auto aboutFile = [&](const std::string& path) {
    Message message("inexact_fields_left_out",
                    {{"path", ""}, {"fields", 1.0 / 3.0}, {"names", "'\u00e9', '\n'"}});
    message.about = path;
    return message;
  };
  const std::vector<Message> expected{
      Message("single_point_box", {}), // without values
      aboutFile("my s.csv"),
      aboutFile("other.csv"), // differs in what it is about only
      far_points(1e20),
      far_points(2e20), // in a number
      Message("field_of_names", {{"field", "a"}}),
      Message("field_of_names", {{"field", "b"}}), // in a word
      Message("code_of_no_row", {{"field", "b"}}), // in the code
      Message("number_or_word", {{"value", 1}}),
      Message("number_or_word", {{"value", "1"}}),
  };
  uvol_test::runRanks(3, [&](pcl_uvol::Communicator& communicator) {
    // Each rank has those of the ones before it, and some of its own.
    Report report;
    const auto count = 4u + 3u * static_cast<unsigned>(communicator.rank());
    report.warnings.assign(expected.begin(), expected.begin() + count);
    const Report together = mergeReports(report, communicator, {});
    EXPECT_TRUE(expected == together.warnings);
    ASSERT_EQ(expected.size(), together.warnings.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(expected[i].code, together.warnings[i].code);
      EXPECT_EQ(expected[i].about, together.warnings[i].about);
      ASSERT_EQ(expected[i].values.size(), together.warnings[i].values.size());
      for (std::size_t k = 0; k < expected[i].values.size(); ++k) {
        EXPECT_EQ(expected[i].values[k].name, together.warnings[i].values[k].name);
        EXPECT_TRUE(expected[i].values[k].value == together.warnings[i].values[k].value)
            << expected[i].code << ' ' << expected[i].values[k].name;
      }
    }
  });
}

} // namespace test_merge_reports
