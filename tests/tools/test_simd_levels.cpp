// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set that this machine has gives the same bytes.
#include "support/environment.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

TEST(SimdLevels, SameBytes)
{
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.pcd", out = folder / "out.ply";
  ASSERT_EQ(0,
            uvol_test::runCommand("uvol_generate " + in +
                                  " -field gyroid -n 50000 -noise 0.01")
                .exit_code);
  const auto surface = [&](const char* level) {
    setenv("PCL_UVOL_SIMD", level, 1);
    const auto result = uvol_test::runCommand("uvol_isosurface " + in + " " + out +
                                              " -field gyroid -iso 0.2");
    unsetenv("PCL_UVOL_SIMD");
    EXPECT_EQ(0, result.exit_code) << result.err;
    return uvol_test::readFile(out);
  };
  const std::string baseline = surface("baseline");
  EXPECT_GT(baseline.size(), 100000u);
  EXPECT_EQ(baseline, surface("avx2"));
  EXPECT_EQ(baseline, surface("avx512"));
}

} // namespace
