// SPDX-License-Identifier: BSD-3-Clause
// Snapshots, densities and a value outside, through the tools.
#include "tool_test.h"

#include <cmath>

using namespace uvol_test;

namespace test_particles {

class Particles : public ToolTest {
protected:
  Particles()
      : ToolTest(PCL_UVOL_TOOL_DIR "/uvol_isosurface", "out.ply")
  {
    in_ = dataFolder() + "/particles/planet_remnant.gadget1";
  }

  void
  SetUp() override
  {
    if (dataFolder().empty())
      GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  }
};

/** Nothing lies outside of the planet, and its surface is closed all the same. */
TEST_F(Particles, APlanetEndsWhereNothingIs)
{
  const auto surface = resultOf("-field RHO -iso 1.6 -where 'RHO>1' -outside-value 0");
  std::vector<int> octants(8);
  const auto x = fieldOf(surface, "x"), y = fieldOf(surface, "y"),
             z = fieldOf(surface, "z");
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double radius = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    EXPECT_GT(radius, 4e8);
    EXPECT_LT(radius, 8e8);
    ++octants[std::size_t(x[i] > 0) + 2 * std::size_t(y[i] > 0) +
              4 * std::size_t(z[i] > 0)];
  }
  for (const int count : octants)
    EXPECT_GT(count, 300);
  EXPECT_EQ(0u, resultOf("-field RHO -iso 1.6 -where 'RHO>1'").cloud.width);
}

TEST_F(Particles, DensitiesAreThoseOfTheFile)
{
  const auto own = resultOf("-density -iso 4.5"),
             file = resultOf("-field RHO -iso 4.5");
  EXPECT_NEAR(
      double(file.cloud.width), double(own.cloud.width), 0.01 * file.cloud.width);
  EXPECT_NE(nullptr, pcl_uvol::findField(own.cloud.fields, "sph_density"));
}

TEST_F(Particles, WhatGoesWithWhat)
{
  for (const auto& [options, code] :
       {std::pair<std::string, int>{"-field RHO -iso 4 -density-length 1", 2},
        {"-field RHO -iso 4 -density-length 0 -density", 2},
        {"-field RHO -iso 4 -density -max-memory 2G", 2},
        {"-field RHO -iso 4 -outside-value 0 -max-memory 2G", 2},
        {"-field RHO -iso 4 -outside-value nan", 2},
        {"-field RHO -iso 4 -particles dm", 1},
        {"-field '|VEL|' -iso 4 -outside-value 0", 1}})
    EXPECT_EQ(code, run(options).exit_code) << options;
  expectSuccess("-field RHO -iso 4.5 -particles gas");
  expectSuccess("-field RHO -iso 4.5 -particles 0 -max-memory 2G");
}

} // namespace test_particles
