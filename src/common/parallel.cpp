// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <new>
#include <omp.h>
#include <system_error>
#include <thread>

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

/** Starts threads that live at the same time. Returns how many the system gives. */
unsigned
startAtOnce(unsigned count)
{
  std::vector<std::thread> threads;
  threads.reserve(count);
  std::mutex end;
  {
    const std::lock_guard<std::mutex> none_ends(end);
    try {
      while (threads.size() < count)
        threads.emplace_back([&end] { const std::lock_guard<std::mutex> ends(end); });
    }
    catch (const std::system_error&) { // there are no more
    }
    catch (const std::bad_alloc&) {
    }
  }
  for (std::thread& thread : threads)
    thread.join();
  return static_cast<unsigned>(threads.size());
}

/** The team that this thread opened last: OpenMP keeps its threads. */
thread_local unsigned last_team = 1;

/** OpenMP's runtime ends the program where it gets no memory for a team or a task: what
 * was had for a moment is there for it.
 * \throws std::bad_alloc where there is none */
void
checkMemory()
{
  constexpr std::size_t enough = 1 << 16;    // below what malloc maps apart
  ::operator delete(::operator new(enough)); // no compiler leaves this out
}

/** As many of a team as there are threads for: OpenMP's runtime ends the program where
 * it is given too few. Those that were had for a moment leave it their stacks. */
unsigned
limitTeam(unsigned team)
{
  const bool is_inner = omp_get_active_level() >= omp_get_max_active_levels();
  if (team <= 1 || is_inner) // nothing is started
    return team;
  checkMemory();
  if (team > last_team)
    team = last_team + startAtOnce(team - last_team);
  return last_team = team;
}

/** The team that the next fork opens; none within one. */
thread_local unsigned team_to_open = 1;

void
forkInTeam(const std::function<void()>& left, const std::function<void()>& right)
{
  checkMemory();
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
  if (requested == 0)
    return static_cast<unsigned>(omp_get_max_threads());
  if (requested <= least_bound) // the number of processors is a call of the system
    return requested;
  const auto processors = static_cast<unsigned>(omp_get_num_procs());
  return std::min(requested, std::max(least_bound, 4 * processors));
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
  const unsigned most_threads = blocks <= 1 ? 1 : resolveThreads(threads);
  if (most_threads <= 1) {
    for (std::ptrdiff_t b = 0; b < blocks; ++b)
      run_block(b);
    return;
  }
  // Blocks of one item are tasks, one per thread, say: there is nothing to divide.
  const std::ptrdiff_t done = block == 1 ? 0 : runAlone(blocks, run_block);
  const auto left = static_cast<std::size_t>(blocks - done);
  if (left == 0)
    return;
  const auto team = static_cast<unsigned>(std::min<std::size_t>(most_threads, left));
  const auto threads_given = static_cast<int>(limitTeam(team));
  FirstException first;
#pragma omp parallel for schedule(dynamic) num_threads(threads_given)
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
  const auto threads_given = static_cast<int>(limitTeam(team));
  team_to_open = 1;
  FirstException first;
#pragma omp parallel num_threads(threads_given)
#pragma omp single
  first.guard([&] { forkInTeam(left, right); });
  team_to_open = team;
  first.rethrow();
}

} // namespace pcl_uvol
