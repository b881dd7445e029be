// SPDX-License-Identifier: BSD-3-Clause
// One target, named by FUZZ_TARGET when this is compiled, as libFuzzer calls it.
#include "targets.h"

#include <cstring>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  static const uvol_fuzz::Target& target = []() -> const uvol_fuzz::Target& {
    for (const auto& listed : uvol_fuzz::listTargets())
      if (std::strcmp(listed.name, FUZZ_TARGET) == 0)
        return listed;
    __builtin_trap();
  }();
  target.run(bytes, size);
  return 0;
}
