// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes, the lowest or the highest one first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace pcl_uvol {
namespace io {

template <typename T>
void
appendLittle(std::string& bytes, T value)
{
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
}

/** \brief Turn the bytes of numbers around. */
inline void
swapBytes(std::uint8_t* bytes, std::size_t size, std::uint64_t count)
{
  for (std::uint64_t i = 0; i < count && size > 1; ++i, bytes += size)
    std::reverse(bytes, bytes + size);
}

} // namespace io
} // namespace pcl_uvol
