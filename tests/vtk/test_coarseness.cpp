// SPDX-License-Identifier: BSD-3-Clause
// What is chosen while a mouse drags, of frames that take as long as they are told to.
#include "src/vtk/coarseness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace test_coarseness {

using pcl_uvol::Coarseness;

/** The factors of frames after a still one.
 * \param time of a frame, by its factor */
std::vector<int>
drag(Coarseness& coarseness, int frames, const std::function<double(int)>& time)
{
  EXPECT_EQ(1, coarseness.choose(false));
  coarseness.addTime(time(1));
  std::vector<int> factors;
  for (int i = 0; i < frames; ++i) {
    factors.push_back(coarseness.choose(true));
    coarseness.addTime(time(factors.back()));
  }
  return factors;
}

TEST(Coarseness, FramesThatComeInTimeAreFine)
{
  Coarseness coarseness(25.0);
  EXPECT_EQ(1, coarseness.choose(true)); // nothing is known
  const auto in_time = [](int) { return 24.0; };
  EXPECT_EQ(std::vector<int>(5, 1), drag(coarseness, 5, in_time));
  coarseness.setGoal(INFINITY);
  EXPECT_EQ(std::vector<int>(5, 1), drag(coarseness, 5, [](int) { return 1e9; }));
}

TEST(Coarseness, TheFirstFrameIsAsCoarseAsTheOneBeforeRequires)
{
  for (const auto& [time, factor] :
       {std::pair(24.0, 1), {26.0, 2}, {49.0, 2}, {51.0, 3}, {99.0, 4}, {1e6, 4}}) {
    Coarseness coarseness(25.0);
    const auto falls = [time = time](int f) { return time / f; };
    EXPECT_EQ(factor, drag(coarseness, 1, falls)[0]) << time;
  }
}

TEST(Coarseness, LateFramesAreCoarserUntilTheyAreInTime)
{
  Coarseness coarseness(25.0);
  // Half of it are points, which coarser frames have as well.
  const auto time = [](int f) { return 20.0 + 20.0 / (f * f); };
  EXPECT_EQ((std::vector<int>{2, 2, 2, 2}), drag(coarseness, 4, time)); // 25 is in time
  const auto slower = [](int f) { return 22.0 + 20.0 / (f * f); };
  EXPECT_EQ((std::vector<int>{2, 2, 3, 3, 3}), drag(coarseness, 5, slower));
  const auto never = [](int) { return 30.0; };
  EXPECT_EQ((std::vector<int>{2, 2, 3, 3, 4}), drag(coarseness, 5, never));
}

TEST(Coarseness, AreFinerAgainWhereThereIsTime)
{
  Coarseness coarseness(25.0);
  int frame = 0;
  // Zoomed out after some frames; a single late one changes nothing.
  const auto time = [&](int f) {
    ++frame;
    return frame == 7 ? 26.0 : (frame < 5 ? 96.0 : 5.0) / f;
  };
  EXPECT_EQ((std::vector<int>{4, 4, 4, 4, 3, 2, 2, 1}), drag(coarseness, 8, time));
}

TEST(Coarseness, StillFramesAreFine)
{
  Coarseness coarseness(25.0);
  drag(coarseness, 5, [](int) { return 100.0; });
  EXPECT_EQ(1, coarseness.choose(false));
}

} // namespace test_coarseness
