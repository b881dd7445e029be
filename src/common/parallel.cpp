// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <omp.h>

namespace pcl_uvol {

namespace {

/** Keeps the first exception of a team; the others are dropped, and work that has not
 * begun is left. */
class FirstException {
public:
  template <typename Function>
  void
  guard(const Function& function) noexcept
  {
    if (thrown_)
      return;
    try {
      function();
    }
    catch (...) {
      thrown_ = true;
#pragma omp critical(pcl_uvol_first_exception)
      if (!exception_)
        exception_ = std::current_exception();
    }
  }

  void
  rethrow() const
  {
    if (exception_)
      std::rethrow_exception(exception_);
  }

private:
  std::atomic<bool> thrown_{false};
  std::exception_ptr exception_;
};

/** A team is opened for that much work at least. Opening one costs some 10 us where
 * cores are idle; where they are not, its threads wait for time slices of milliseconds.
 */
constexpr std::chrono::duration<double> least_work = std::chrono::microseconds(500);

/** Runs blocks one after the other until what is left is worth a team, as far as those
 * before tell. Returns the number of blocks that were run. */
template <typename RunBlock>
std::ptrdiff_t
runAlone(std::ptrdiff_t blocks, const RunBlock& run_block)
{
  const auto start = std::chrono::steady_clock::now();
  for (std::ptrdiff_t done = 0; done < blocks;) {
    run_block(done++);
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    if (spent * static_cast<double>(blocks - done) >=
        least_work * static_cast<double>(done))
      return done;
  }
  return blocks;
}

/** The team that the next fork opens; none within one. */
thread_local unsigned team_to_open = 1;

void
forkInTeam(const std::function<void()>& left, const std::function<void()>& right)
{
  FirstException first;
#pragma omp task shared(left, first)
  first.guard(left);
  first.guard(right);
#pragma omp taskwait
  first.rethrow();
}

} // namespace

unsigned
resolveThreads(unsigned requested)
{
  constexpr unsigned least_bound = 64;
  const auto processors = static_cast<unsigned>(omp_get_num_procs());
  return requested == 0 ? static_cast<unsigned>(omp_get_max_threads())
                        : std::min(requested, std::max(least_bound, 4 * processors));
}

void
parallelBlocks(std::size_t count,
               std::size_t block,
               unsigned threads,
               const std::function<void(std::size_t, std::size_t)>& body)
{
  const auto blocks = static_cast<std::ptrdiff_t>((count + block - 1) / block);
  const auto run_block = [&](std::ptrdiff_t b) {
    const std::size_t begin = static_cast<std::size_t>(b) * block;
    body(begin, std::min(begin + block, count));
  };
  if (resolveThreads(threads) <= 1) {
    for (std::ptrdiff_t b = 0; b < blocks; ++b)
      run_block(b);
    return;
  }
  // Blocks of one item are tasks, one per thread, say: there is nothing to divide.
  const std::ptrdiff_t done = block == 1 ? 0 : runAlone(blocks, run_block);
  const auto team = static_cast<int>(std::min<std::size_t>(
      resolveThreads(threads), static_cast<std::size_t>(blocks - done)));
  if (team == 0)
    return;
  FirstException first;
#pragma omp parallel for schedule(dynamic) num_threads(team)
  for (std::ptrdiff_t b = done; b < blocks; ++b)
    first.guard([&] { run_block(b); });
  first.rethrow();
}

void
TaskGroup::run(unsigned threads, const std::function<void()>& root)
{
  /** Puts back what was there, whatever is thrown. */
  struct Team {
    explicit Team(unsigned threads)
    {
      team_to_open = threads;
    }
    Team(const Team&) = delete;
    Team&
    operator=(const Team&) = delete;
    ~Team()
    {
      team_to_open = outer;
    }

    const unsigned outer = team_to_open;
  };
  const Team team(resolveThreads(threads));
  root();
}

void
TaskGroup::fork(const std::function<void()>& left, const std::function<void()>& right)
{
  if (team_to_open <= 1) {
    forkInTeam(left, right);
    return;
  }
  const unsigned team = team_to_open;
  team_to_open = 1;
  FirstException first;
#pragma omp parallel num_threads(static_cast <int>(team))
#pragma omp single
  first.guard([&] { forkInTeam(left, right); });
  team_to_open = team;
  first.rethrow();
}

} // namespace pcl_uvol
