// SPDX-License-Identifier: BSD-3-Clause
// What is said of a surface by what its isopoints rest on.
#include "pipeline/weak_support.h"

#include <gtest/gtest.h>

#include <string>

namespace test_weak_support {

using namespace pcl_uvol;

/** The code of what is told of 100 isopoints; "": nothing. */
std::string
tell(SupportCounts counts, LocalDimension most, bool have_border = true)
{
  counts.known = 100;
  SamplingSummary sampling;
  sampling.most = most;
  const auto told = describeWeakSupport(counts, sampling, {"guess", {}}, have_border);
  return told ? told->code : "";
}

TEST(GuessedIsopoints, AreToldWhereTheyAreMost)
{
  constexpr auto volume = LocalDimension::Volume, line = LocalDimension::Line;
  EXPECT_EQ("", tell({0, 20, 20, 10, 0}, volume));
  EXPECT_EQ("isopoints_at_border", tell({0, 30, 21, 0, 0}, volume));
  EXPECT_EQ("isopoints_at_border", tell({0, 51, 0, 0, 0}, line));
  EXPECT_EQ("isopoints_beside_samples", tell({0, 20, 20, 11, 0}, volume));
  EXPECT_EQ("guess", tell({0, 10, 10, 31, 0}, volume));
  EXPECT_EQ("guess", tell({0, 30, 21, 0, 0}, line));
}

/** In a box that repeats along all axes rims are beside voids. */
TEST(GuessedIsopoints, HaveNoBorderInAPeriodicBox)
{
  for (const LocalDimension most : {LocalDimension::Volume, LocalDimension::Line}) {
    EXPECT_EQ("", tell({0, 20, 20, 10, 0}, most, false));
    EXPECT_EQ("guess", tell({0, 60, 0, 0, 0}, most, false));
    EXPECT_EQ("guess", tell({0, 20, 20, 11, 0}, most, false));
  }
}

} // namespace test_weak_support
