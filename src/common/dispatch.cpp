// SPDX-License-Identifier: BSD-3-Clause
#include "common/dispatch.h"

#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

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
  const std::string name = variable == nullptr ? "avx512" : variable;
  for (const auto& [word, level] : {std::pair{"baseline", SimdLevel::Baseline},
                                    std::pair{"avx2", SimdLevel::Avx2},
                                    std::pair{"avx512", SimdLevel::Avx512}})
    if (name == word)
      return std::min(level, levelOfMachine());
  throw InvalidArgument("unknown_simd_level", {{"level", shortenText(name)}});
}

} // namespace

SimdLevel
simdLevel()
{
  static const SimdLevel level = chooseLevel();
  return level;
}

} // namespace pcl_uvol
