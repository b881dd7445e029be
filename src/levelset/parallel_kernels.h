// SPDX-License-Identifier: BSD-3-Clause
// The kernels of a level set, compiled for every instruction set, and how much a thread
// takes at once.
#pragma once

#include "common/dispatch.h"
#include "levelset/evolution_kernel.h"

#include <cstddef>

namespace pcl_uvol {

constexpr KernelTable<const EvolutionKernels*> evolution_kernel_table{
    &baseline::evolution_kernels, &avx2::evolution_kernels, &avx512::evolution_kernels};

constexpr std::size_t block_groups = 64, block_fits = 64;

} // namespace pcl_uvol
