// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace {

TEST(Parallel, SortEqualsTheSerialOne)
{
  uvol_test::Random random(1);
  for (const std::size_t size : {std::size_t(0), std::size_t(1), std::size_t(100000)}) {
    std::vector<double> values(size);
    for (double& value : values)
      value = random.uniform();
    auto expected = values;
    std::sort(expected.begin(), expected.end());
    for (const unsigned threads : {1u, 2u, 7u}) {
      auto sorted = values;
      pcl_uvol::parallelSort(
          sorted.begin(), sorted.end(), threads, std::less<double>());
      EXPECT_EQ(expected, sorted);
    }
  }
}

TEST(Parallel, ExceptionsReachTheCaller)
{
  EXPECT_THROW(pcl_uvol::parallelBlocks(100,
                                        1,
                                        3,
                                        [](std::size_t begin, std::size_t) {
                                          if (begin == 57)
                                            throw std::runtime_error("57");
                                        }),
               std::runtime_error);
  const auto fail = [] { throw std::runtime_error("leaf"); };
  EXPECT_THROW(
      pcl_uvol::TaskGroup::run(3, [&] { pcl_uvol::TaskGroup::fork([] {}, fail); }),
      std::runtime_error);
}

TEST(Parallel, NoBlockBeginsAfterAnException)
{
  std::atomic<int> begun{0};
  EXPECT_THROW(pcl_uvol::parallelBlocks(1000,
                                        1,
                                        3,
                                        [&](std::size_t, std::size_t) {
                                          if (++begun >= 10)
                                            throw std::runtime_error("10");
                                        }),
               std::runtime_error);
  EXPECT_LT(begun, 50);
}

TEST(Parallel, AnyNumberOfThreadsCanBeAskedFor)
{
  for (const unsigned threads : {100000u, static_cast<unsigned>(-1)}) {
    EXPECT_GE(4096u, pcl_uvol::resolveThreads(threads));
    std::atomic<std::size_t> done{0};
    pcl_uvol::parallelBlocks(
        100000, 1, threads, [&](std::size_t begin, std::size_t end) {
          done += end - begin;
        });
    EXPECT_EQ(100000u, done);
  }
  EXPECT_EQ(7u, pcl_uvol::resolveThreads(7));
}

/** Blocks that take no time stay with the caller's thread; those that do are shared,
 * and every one is run once. */
TEST(Parallel, TeamsAreOpenedForWorkOnly)
{
  const auto caller = std::this_thread::get_id();
  std::atomic<int> elsewhere{0}, sum{0};
  const auto run = [&](std::chrono::milliseconds time) {
    elsewhere = sum = 0;
    pcl_uvol::parallelBlocks(40, 1, 2, [&](std::size_t begin, std::size_t) {
      std::this_thread::sleep_for(time);
      elsewhere += std::this_thread::get_id() != caller ? 1 : 0;
      sum += static_cast<int>(begin);
    });
    EXPECT_EQ(780, sum);
  };
  run(std::chrono::milliseconds(2));
  EXPECT_GT(elsewhere, 0);
  elsewhere = 0;
  pcl_uvol::TaskGroup::run(
      2, [&] { elsewhere += std::this_thread::get_id() != caller ? 1 : 0; });
  EXPECT_EQ(0, elsewhere);
}

} // namespace
