// SPDX-License-Identifier: BSD-3-Clause
// Arrays of many megabytes: they lie on large pages, and memory that is about to be
// overwritten is not filled with zeros first. Of a run over millions of samples a third
// was first touches of small pages.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Ask for large pages (MADV_HUGEPAGE) for the part of an array that fills whole
 * ones. To be called before the array is first touched. Does nothing for arrays of less
 * than 4 MB and where the system has none. */
PCL_UVOL_EXPORTS void
askForLargePages(void* data, std::size_t bytes);

/** \brief An allocator whose large arrays lie on large pages, and whose elements are
 * left as they are where a vector would fill them with zeros. */
template <typename T>
class LargeAllocator : public std::allocator<T> {
public:
  template <typename U>
  struct rebind {
    using other = LargeAllocator<U>;
  };

  LargeAllocator() = default;
  template <typename U>
  LargeAllocator(const LargeAllocator<U>&) noexcept
  {
  }

  T*
  allocate(std::size_t count)
  {
    T* const array = std::allocator<T>::allocate(count);
    askForLargePages(array, count * sizeof(T));
    return array;
  }

  template <typename U>
  void
  construct(U* element) noexcept
  {
    ::new (static_cast<void*>(element)) U;
  }
  template <typename U, typename... Arguments>
  void
  construct(U* element, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(element)) U(std::forward<Arguments>(arguments)...);
  }
};

/** \brief A vector whose resize() does not set new elements to zero: members without an
 * initializer are undefined until they are written. */
template <typename T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

/** \brief Room in an empty vector, on large pages. */
template <typename Vector>
void
reserveLarge(Vector& vector, std::size_t count)
{
  vector.reserve(count);
  askForLargePages(vector.data(), count * sizeof(typename Vector::value_type));
}

/** \brief resize(), which takes new memory for an empty vector on large pages; others
 * grow as they do. */
template <typename Vector>
void
resizeLarge(Vector& vector, std::size_t count)
{
  if (vector.empty())
    reserveLarge(vector, count);
  vector.resize(count);
}

} // namespace pcl_uvol
