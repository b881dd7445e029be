// SPDX-License-Identifier: BSD-3-Clause
// What is said of a surface by what its isopoints rest on.
#include "pipeline/weak_support.h"

#include <gtest/gtest.h>

#include <string>

namespace test_weak_support {

using namespace pcl_uvol;

/** The code of what is told of 100 isopoints; "": nothing. */
std::string
codeOf(SupportCounts counts, LocalDimension most, bool have_border = true)
{
  counts.examined = 100;
  SamplingSummary sampling;
  sampling.most = most;
  const auto warning =
      describeWeakSupport(counts, sampling, {"unconstrained", {}}, have_border);
  return warning ? warning->code : "";
}

TEST(WeakSupport, IsReportedWhereItPrevails)
{
  constexpr auto volume = LocalDimension::Volume, line = LocalDimension::Line;
  EXPECT_EQ("", codeOf({0, 20, 20, 10, 0}, volume));
  EXPECT_EQ("isopoints_at_border", codeOf({0, 30, 21, 0, 0}, volume));
  EXPECT_EQ("isopoints_at_border", codeOf({0, 51, 0, 0, 0}, line));
  EXPECT_EQ("isopoints_beside_samples", codeOf({0, 20, 20, 11, 0}, volume));
  EXPECT_EQ("unconstrained", codeOf({0, 10, 10, 31, 0}, volume));
  EXPECT_EQ("unconstrained", codeOf({0, 30, 21, 0, 0}, line));
}

/** In a box that repeats along all axes rims are beside voids. */
TEST(WeakSupport, HaveNoBorderInAPeriodicBox)
{
  for (const LocalDimension most : {LocalDimension::Volume, LocalDimension::Line}) {
    EXPECT_EQ("", codeOf({0, 20, 20, 10, 0}, most, false));
    EXPECT_EQ("unconstrained", codeOf({0, 60, 0, 0, 0}, most, false));
    EXPECT_EQ("unconstrained", codeOf({0, 20, 20, 11, 0}, most, false));
  }
}

} // namespace test_weak_support
