// SPDX-License-Identifier: BSD-3-Clause
// Numbers of several ranks come into one order.
#include "common/random.h"
#include "distributed/sort_together.h"
#include "support/thread_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace test_sort_together {

using pcl_uvol::uniformAt;

/** The shares of ranks that hold so many numbers each, of so many different ones. */
std::vector<std::vector<double>>
share(const std::vector<std::size_t>& held, double different)
{
  std::vector<double> all;
  std::vector<std::vector<double>> shares(held.size());
  std::mutex mutex;
  uvol_test::runRanks(held.size(), [&](pcl_uvol::Communicator& communicator) {
    const std::size_t rank = communicator.rank();
    std::vector<double> own;
    for (std::size_t i = 0; i < held[rank]; ++i)
      own.push_back(std::floor(uniformAt(3, i, rank) * different));
    std::sort(own.begin(), own.end());
    shares[rank] = sortTogether(own, communicator, 1);
    const std::lock_guard lock(mutex);
    all.insert(all.end(), own.begin(), own.end());
  });
  std::sort(all.begin(), all.end());
  std::vector<double> joined;
  for (const auto& of_rank : shares)
    joined.insert(joined.end(), of_rank.begin(), of_rank.end());
  EXPECT_EQ(all, joined);
  return shares;
}

TEST(SortTogether, SharesAreAboutAsLarge)
{
  for (const auto& of_rank : share({1000, 1000, 1000, 1000}, 1e9)) {
    EXPECT_GT(of_rank.size(), 500u);
    EXPECT_LT(of_rank.size(), 2000u);
  }
}

TEST(SortTogether, EqualNumbersAreOnOneRank)
{
  const auto shares = share({300, 0, 500, 7}, 12.0);
  for (std::size_t i = 0; i < shares.size(); ++i)
    for (std::size_t j = i + 1; j < shares.size(); ++j)
      EXPECT_TRUE(shares[i].empty() || shares[j].empty() ||
                  shares[i].back() < shares[j].front());
}

TEST(SortTogether, TakesFewNumbersAndNone)
{
  share({1}, 1e9);
  share({0, 0, 0}, 1e9);
  share({0, 1, 0, 2, 0}, 1e9);
  share({50, 50}, 1.0);
}

} // namespace test_sort_together
