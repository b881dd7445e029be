// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: the width of the registers that a file is compiled for. Wider
// vectors would be taken apart through memory.
#pragma once

#include <cstddef>

namespace pcl_uvol::PCL_UVOL_SIMD {

#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX2__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif

} // namespace pcl_uvol::PCL_UVOL_SIMD
