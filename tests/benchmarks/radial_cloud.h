// SPDX-License-Identifier: BSD-3-Clause
// The radial test of thesis Table 2.9, made once for all benchmarks of one size.
#pragma once

#include "support/clouds.h"

#include <cstddef>

inline const uvol_test::RadialCloud&
radialCloud(std::size_t n)
{
  static uvol_test::RadialCloud radial;
  if (!radial.cloud || radial.cloud->size() != n)
    radial = uvol_test::makeRadialCloud(n, 1);
  return radial;
}
