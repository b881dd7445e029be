// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <pthread.h>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace test_parallel {

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

/** A process with address space for few stacks; its exit code is 0 if all of its work
 * was done. */
[[noreturn]] void
workWithRoomFor(double stacks)
{
  pthread_attr_t attributes;
  std::size_t stack_size = 0;
  pthread_attr_init(&attributes);
  pthread_attr_getstacksize(&attributes, &stack_size);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max =
      pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) +
      static_cast<std::size_t>(stacks * static_cast<double>(stack_size));
  setrlimit(RLIMIT_AS, &limit);
  std::atomic<int> done{0};
  for (const unsigned threads : {2u, 7u, 3u, 7u}) {
    pcl_uvol::parallelBlocks(
        100, 1, threads, [&](std::size_t, std::size_t) { ++done; });
    pcl_uvol::TaskGroup::run(
        threads, [&] { pcl_uvol::TaskGroup::fork([&] { ++done; }, [&] { ++done; }); });
  }
  std::_Exit(done == 4 * 102 ? 0 : 1);
}

TEST(Parallel, WorkIsDoneByTheThreadsThatTheSystemGives)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "a sanitizer needs all address space";
  GTEST_FLAG_SET(death_test_style, "threadsafe"); // OpenMP does not survive a fork
  for (const double stacks : {0.5, 1.5, 2.5, 4.5, 10.0})
    EXPECT_EXIT(workWithRoomFor(stacks), testing::ExitedWithCode(0), "^$") << stacks;
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

} // namespace test_parallel
