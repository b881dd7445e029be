// SPDX-License-Identifier: BSD-3-Clause
// The only door to OpenMP: loops over fixed blocks and fork-join tasks. Exceptions
// leave through the caller, results do not depend on the number of threads, and no
// global OpenMP state is changed.
#pragma once

#include "common/large_array.h"
#include <pcl_uvol/common/export.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief The number of threads a stage uses: 0 stands for all that OpenMP offers; more
 * than 4 per processor, or 64 where that is more, count as that many. */
PCL_UVOL_EXPORTS unsigned
resolveThreads(unsigned requested);

/** \brief Call body(begin, end) for consecutive blocks of [0, count), in parallel where
 * that saves time: the caller's thread begins alone, and a team is opened when the
 * blocks that are left are worth it.
 * \param block indices per call, >= 1; fixed, so that per-block results do not depend
 * on the number of threads
 *
 * The first exception (by time) is rethrown when the blocks that were begun are done.
 */
PCL_UVOL_EXPORTS void
parallelBlocks(std::size_t count,
               std::size_t block,
               unsigned threads,
               const std::function<void(std::size_t, std::size_t)>& body);

/** \brief Run a recursive computation that forks through TaskGroup::fork. */
class PCL_UVOL_EXPORTS TaskGroup {
public:
  /** \brief Run root, for whose forks a team of that many threads is opened, and return
   * when it and everything it forked is done. */
  static void
  run(unsigned threads, const std::function<void()>& root);

  /** \brief Run left and right, possibly at the same time; returns when both are done.
   * Outside of run() they run one after the other. */
  static void
  fork(const std::function<void()>& left, const std::function<void()>& right);
};

/** \brief Variable output of a blocked loop: each block fills a vector of its own, and
 * the vectors are joined in the order of the blocks. */
template <typename T, typename Body>
std::vector<T>
parallelGather(std::size_t count, std::size_t block, unsigned threads, const Body& body)
{
  std::vector<std::vector<T>> parts((count + block - 1) / block);
  parallelBlocks(count, block, threads, [&](std::size_t begin, std::size_t end) {
    body(begin, end, parts[begin / block]);
  });
  std::size_t total = 0;
  for (const auto& part : parts)
    total += part.size();
  std::vector<T> joined;
  reserveLarge(joined, total);
  for (const auto& part : parts)
    joined.insert(joined.end(), part.begin(), part.end());
  return joined;
}

/** \brief Sort by a strict total order, so that the result is the same for any number
 * of threads. */
template <typename Iterator, typename Less>
void
parallelSort(Iterator first, Iterator last, unsigned threads, const Less& less)
{
  // Below this many elements sorting costs less than forking.
  constexpr std::ptrdiff_t block = 1 << 13;
  const std::function<void(Iterator, Iterator)> sort = [&](Iterator begin,
                                                           Iterator end) {
    if (end - begin <= block)
      return std::sort(begin, end, less);
    const Iterator middle = begin + (end - begin) / 2;
    TaskGroup::fork([&] { sort(begin, middle); }, [&] { sort(middle, end); });
    std::inplace_merge(begin, middle, end, less);
  };
  TaskGroup::run(threads, [&] { sort(first, last); });
}

} // namespace pcl_uvol
