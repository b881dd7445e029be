// SPDX-License-Identifier: BSD-3-Clause
// Every version of a vector kernel that this machine can run.
#pragma once

#include "common/dispatch.h"

#include <gtest/gtest.h>

namespace uvol_test {

/** \brief Call body(kernel) with the kernel of every instruction set up to that of this
 * machine; failures name it. */
template <typename Kernel, typename Body>
void
forLevels(const pcl_uvol::KernelTable<Kernel>& table, const Body& body)
{
  {
    SCOPED_TRACE("baseline");
    body(table.baseline);
  }
  if (pcl_uvol::simdLevel() >= pcl_uvol::SimdLevel::Avx2) {
    SCOPED_TRACE("avx2");
    body(table.avx2);
  }
  if (pcl_uvol::simdLevel() >= pcl_uvol::SimdLevel::Avx512) {
    SCOPED_TRACE("avx512");
    body(table.avx512);
  }
}

} // namespace uvol_test
