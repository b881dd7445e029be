// SPDX-License-Identifier: BSD-3-Clause
#include "common/number_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace test_number_range {

using namespace pcl_uvol;

using Texts = std::vector<std::string>;

TEST(DescribeNumbers, GivesSixDigitsWhereTheyDistinguishNumbers)
{
  EXPECT_EQ(describeNumbers({1.0 / 3.0}), (Texts{"0.333333"}));
  EXPECT_EQ(describeNumbers({0.1, 0.25, 1e6}), (Texts{"0.1", "0.25", "1e+06"}));
  EXPECT_EQ(describeNumbers({}), Texts());
}

TEST(DescribeNumbers, ShowsWhatPartsNumbersThatLieFarFromZero)
{
  EXPECT_EQ(describeNumbers({1e7 + 0.03125, 1e7 + 0.875}),
            (Texts{"10000000.031", "10000000.875"}));
  EXPECT_EQ(describeNumbers({3e50, 1e7, 1e7 + 1.0}),
            (Texts{"3e+50", "10000000", "10000001"}));
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(describeNumbers({1.0, next}), (Texts{"1", "1.0000000000000002"}));
}

TEST(DescribeNumbers, TakesEqualNumbersAndThoseThatAreNone)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(describeNumbers({0.0, 0.0}), (Texts{"0", "0"}));
  EXPECT_EQ(describeNumbers({1.5, infinity, std::nan("")}),
            (Texts{"1.5", "unknown", "unknown"}));
}

} // namespace test_number_range
