// SPDX-License-Identifier: BSD-3-Clause
#include "common/dispatch.h"
#include "support/environment.h"
#include "tools/sentences.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace test_dispatch {

/** The level is chosen once per process: one test for all there is to it. */
TEST(Dispatch, TheEnvironmentChoosesOnceAndOnlyByName)
{
  const pcl_uvol::KernelTable<int> table{1, 2, 3};
  setenv("PCL_UVOL_SIMD", "fast", 1);
  EXPECT_THROW(pcl_uvol::simdLevel(), pcl_uvol::InvalidArgument);
  setenv("PCL_UVOL_SIMD", "baseline", 1);
  EXPECT_EQ(pcl_uvol::SimdLevel::Baseline, pcl_uvol::simdLevel());
  EXPECT_EQ(1, table.get());
  setenv("PCL_UVOL_SIMD", "avx512", 1);
  EXPECT_EQ(1, table.get());
  unsetenv("PCL_UVOL_SIMD");
}

TEST(Dispatch, ToolsSayWhatIsWrong)
{
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.pcd";
  ASSERT_EQ(0, uvol_test::runCommand("uvol_generate " + in + " -n 1000").exit_code);
  setenv("PCL_UVOL_SIMD", "fast", 1);
  const auto result = uvol_test::runCommand("uvol_isosurface " + in + " " +
                                            (folder / "out.ply") + " -iso 3 -json");
  unsetenv("PCL_UVOL_SIMD");
  uvol_test::expectError(result, "unknown_simd_level", "fast");
  EXPECT_EQ(1u, folder.list().size());
}

} // namespace test_dispatch
