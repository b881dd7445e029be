// SPDX-License-Identifier: BSD-3-Clause
// The kernels that several searches use, compiled for every instruction set.
#pragma once

#include "common/dispatch.h"
#include "neighbors/metric_kernel.h"
#include "neighbors/nearest_kernel.h"
#include "neighbors/tree_kernel.h"

namespace pcl_uvol {

constexpr KernelTable<const NearestKernels*> nearest_kernel_table{
    &baseline::nearest_kernels, &avx2::nearest_kernels, &avx512::nearest_kernels};

constexpr KernelTable<const MetricKernels*> metric_kernel_table{
    &baseline::metric_kernels, &avx2::metric_kernels, &avx512::metric_kernels};

constexpr KernelTable<const TreeKernels*> tree_kernel_table{
    &baseline::tree_kernels, &avx2::tree_kernels, &avx512::tree_kernels};

} // namespace pcl_uvol
