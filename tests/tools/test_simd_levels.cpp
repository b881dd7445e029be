// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set that this machine has gives the same bytes.
#include "support/environment.h"
#include "tools/json_warnings.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace test_simd_levels {

/** Standard error and exit code are checked, the file is what counts. */
std::string
fileOf(const char* level, const std::string& command, const std::string& file)
{
  setenv("PCL_UVOL_SIMD", level, 1);
  const auto result = uvol_test::runCommand(command);
  unsetenv("PCL_UVOL_SIMD");
  EXPECT_EQ(0, result.exit_code) << result.err;
  return uvol_test::readFile(file);
}

TEST(SimdLevels, SameBytes)
{
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.pcd", out = folder / "out.ply",
                    picture = folder / "out.png";
  uvol_test::runWell("uvol_generate " + in + " -field gyroid -n 50000 -noise 0.01");
  const std::string extract =
      "uvol_isosurface " + in + " " + out + " -field gyroid -iso 0.2";
  const std::string baseline = fileOf("baseline", extract, out);
  EXPECT_GT(baseline.size(), 100000u);
  EXPECT_EQ(baseline, fileOf("avx2", extract, out));
  EXPECT_EQ(baseline, fileOf("avx512", extract, out));
  for (const char* scheme : {"quadratic", "linear"}) {
    const std::string evolve = "uvol_levelset " + in + " " + out +
                               " -field gyroid -iso 0.2 -steps 6 -scheme " + scheme;
    const std::string phi = fileOf("baseline", evolve, out);
    EXPECT_GT(phi.size(), 100000u);
    EXPECT_EQ(phi, fileOf("avx2", evolve, out)) << scheme;
    EXPECT_EQ(phi, fileOf("avx512", evolve, out)) << scheme;
  }
  ASSERT_EQ(baseline, fileOf("baseline", extract, out));
  // Dense and sparse, with every pass.
  for (const char* size : {"150", "900"}) {
    const std::string draw = "uvol_render " + out + " " + picture +
                             " -silhouettes -thickness 3 -features -size " + size;
    const std::string pixels = fileOf("baseline", draw, picture);
    EXPECT_GT(pixels.size(), 5000u);
    EXPECT_EQ(pixels, fileOf("avx2", draw, picture)) << size;
    EXPECT_EQ(pixels, fileOf("avx512", draw, picture)) << size;
  }
  const std::string trace = "uvol_raytrace " + out + " " + picture +
                            " -reflect 0.3 -occlusion-rays 8 -size 200";
  const std::string pixels = fileOf("baseline", trace, picture);
  EXPECT_GT(pixels.size(), 5000u);
  EXPECT_EQ(pixels, fileOf("avx2", trace, picture));
  EXPECT_EQ(pixels, fileOf("avx512", trace, picture));
}

} // namespace test_simd_levels
