// SPDX-License-Identifier: BSD-3-Clause
// Refuse arrays that do not fit before memory is taken for them.
#pragma once

#include "common/memory.h"

#include <string>

namespace pcl_uvol::python {

/** \brief checkMemory() of arrays that are large: to ask what is available takes longer
 * than to make a small one.
 * \throws NotEnoughMemory */
inline void
checkLargeMemory(const std::string& what, double bytes)
{
  constexpr double large = 1e7;
  if (bytes > large)
    checkMemory(what, bytes);
}

} // namespace pcl_uvol::python
