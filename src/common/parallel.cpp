// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/parallel.h>

#include <algorithm>
#include <atomic>
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

} // namespace

unsigned
resolveThreads(unsigned requested)
{
  return requested == 0 ? static_cast<unsigned>(omp_get_max_threads()) : requested;
}

void
parallelBlocks(std::size_t count,
               std::size_t block,
               unsigned threads,
               const std::function<void(std::size_t, std::size_t)>& body)
{
  const auto blocks = static_cast<std::ptrdiff_t>((count + block - 1) / block);
  const auto team = static_cast<int>(
      std::min<std::size_t>(resolveThreads(threads), static_cast<std::size_t>(blocks)));
  if (team <= 1) {
    for (std::size_t begin = 0; begin < count; begin += block)
      body(begin, std::min(begin + block, count));
    return;
  }
  FirstException first;
#pragma omp parallel for schedule(dynamic) num_threads(team)
  for (std::ptrdiff_t b = 0; b < blocks; ++b)
    first.guard([&] {
      const std::size_t begin = static_cast<std::size_t>(b) * block;
      body(begin, std::min(begin + block, count));
    });
  first.rethrow();
}

void
TaskGroup::run(unsigned threads, const std::function<void()>& root)
{
  FirstException first;
#pragma omp parallel num_threads(static_cast <int>(resolveThreads(threads)))
#pragma omp single
  first.guard(root);
  first.rethrow();
}

void
TaskGroup::fork(const std::function<void()>& left, const std::function<void()>& right)
{
  FirstException first;
#pragma omp task shared(left, first)
  first.guard(left);
  first.guard(right);
#pragma omp taskwait
  first.rethrow();
}

} // namespace pcl_uvol
