// SPDX-License-Identifier: BSD-3-Clause
// Balls in metrics: how far they reach, and which hold others.
#include "src/neighbors/ball.h"

#include <gtest/gtest.h>

#include <limits>

namespace test_ball {

using pcl_uvol::Ball;

/** Ten times as long in x as in the other directions. */
Ball
makeLong(float x, float radius)
{
  Ball ball{{{x, 0.0f, 0.0f}}, radius};
  ball.metric[0][0] = 0.1;
  ball.extent[0] = 10.0;
  return ball;
}

TEST(Balls, ReachAsFarAsTheirLongestAxis)
{
  EXPECT_EQ(2.0, (Ball{{}, 2.0f}.getReach()));
  EXPECT_NEAR(20.0, makeLong(5.0f, 2.0f).getReach(), 1e-12);
}

TEST(Balls, KnowWhichOthersTheyHold)
{
  const Ball ball{{{1.0f, 0.0f, 0.0f}}, 2.0f};
  EXPECT_TRUE(ball.contains(ball));
  EXPECT_TRUE(ball.contains({{{2.0f, 0.0f, 0.0f}}, 1.0f}));
  EXPECT_FALSE(ball.contains({{{2.25f, 0.0f, 0.0f}}, 1.0f}));
  EXPECT_TRUE(ball.contains(makeLong(1.0f, 0.19f)));
  EXPECT_FALSE(ball.contains(makeLong(1.0f, 0.21f)));
  const Ball stretched = makeLong(1.0f, 2.0f);
  EXPECT_TRUE(stretched.contains(stretched));
  EXPECT_TRUE(stretched.contains(makeLong(10.0f, 1.0f)));
  EXPECT_FALSE(stretched.contains(makeLong(12.0f, 1.0f)));
  EXPECT_FALSE(stretched.contains(ball)); // which it does, but at a cost
}

TEST(Balls, HoldAllIfTheyHaveNoEnd)
{
  const float infinity = std::numeric_limits<float>::infinity();
  const Ball all{{}, infinity};
  EXPECT_TRUE(all.contains(all));
  EXPECT_TRUE(all.contains({{{7.0f, 0.0f, 0.0f}}, 3.0f}));
  EXPECT_FALSE((Ball{{}, 3.0f}.contains(all)));
}

TEST(Balls, AreConcentricIfOnlyTheirSizesDiffer)
{
  const Ball ball{{{1.0f, 0.0f, 0.0f}}, 2.0f};
  EXPECT_TRUE(ball.isConcentric({{{1.0f, 0.0f, 0.0f}}, 3.0f}));
  EXPECT_FALSE(ball.isConcentric({{{1.5f, 0.0f, 0.0f}}, 2.0f}));
  EXPECT_FALSE(ball.isConcentric(makeLong(1.0f, 2.0f)));
}

} // namespace test_ball
