// SPDX-License-Identifier: BSD-3-Clause
// Whole numbers as bytes, the lowest one first.
#pragma once

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

} // namespace io
} // namespace pcl_uvol
