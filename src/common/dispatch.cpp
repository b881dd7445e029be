// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/dispatch.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace pcl_uvol {

namespace {

SimdLevel
levelOfMachine()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    return SimdLevel::Avx512;
  if (__builtin_cpu_supports("avx2"))
    return SimdLevel::Avx2;
#endif
  return SimdLevel::Baseline;
}

SimdLevel
chooseLevel()
{
  const char* const variable = std::getenv("PCL_UVOL_SIMD");
  const std::string name = variable == nullptr ? "" : variable;
  const SimdLevel allowed = name == "baseline" ? SimdLevel::Baseline
                            : name == "avx2"   ? SimdLevel::Avx2
                                               : SimdLevel::Avx512;
  return std::min(allowed, levelOfMachine());
}

} // namespace

SimdLevel
simdLevel()
{
  static const SimdLevel level = chooseLevel();
  return level;
}

} // namespace pcl_uvol
