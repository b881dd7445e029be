// SPDX-License-Identifier: BSD-3-Clause
#include "common/large_array.h"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pcl_uvol {

void
askForLargePages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes)
{
#if defined(MADV_HUGEPAGE)
  // The size of a large page on x86-64, and on ARM with pages of 4 KiB.
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  if (bytes < 2 * page)
    return;
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (begin + page - 1) / page * page,
                       end = (begin + bytes) / page * page;
  if (first < end) // a wish: where it is refused the array is as good as any other
    madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

} // namespace pcl_uvol
