// SPDX-License-Identifier: BSD-3-Clause
// Which instruction set the vector kernels run with. A kernel is a plain function on
// plain arrays in a file of its own that is compiled once per level; all levels give
// the same bytes.
#pragma once

#include <pcl_uvol/common/export.h>

namespace pcl_uvol {

/** \brief Instruction sets that kernels are compiled for. */
enum class SimdLevel { Baseline, Avx2, Avx512 };

/** \brief The best level of this machine, or the lower one that the environment
 * variable PCL_UVOL_SIMD names: baseline, avx2 or avx512. Decided at the first call.
 * \throws InvalidArgument if the variable is anything else */
PCL_UVOL_EXPORTS SimdLevel
simdLevel();

/** \brief One function, compiled for every level. */
template <typename Function>
struct KernelTable {
  Function baseline, avx2, avx512;

  Function
  get() const
  {
    switch (simdLevel()) {
    case SimdLevel::Avx512:
      return avx512;
    case SimdLevel::Avx2:
      return avx2;
    default:
      return baseline;
    }
  }
};

} // namespace pcl_uvol
