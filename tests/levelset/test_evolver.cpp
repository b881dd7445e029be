// SPDX-License-Identifier: BSD-3-Clause
// Steps of level sets on functions whose motion is known in closed form.
#include "band_setup.h"
#include "src/levelset/evolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_evolver {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::PlaneBand;

constexpr double rounding = 1e-3; // of lengths of 1

const PlaneBand&
block()
{
  static const PlaneBand band({8.0, 8.0, 8.0}, 0.0, FitScheme::Quadratic);
  return band;
}

LevelSetParameters
makeParameters(Integration integration, CurvatureFlow flow = CurvatureFlow::Mean)
{
  LevelSetParameters parameters;
  parameters.integration = integration;
  parameters.flow = flow;
  parameters.reinitialization = Reinitialization::None;
  return parameters;
}

/** A function, and data that pull it to another one everywhere alike. */
struct Motion {
  LevelSetParameters parameters;
  DataTerm term;
  std::vector<float> phi;
  Evolver evolver;

  template <typename Phi, typename Target>
  Motion(const LevelSetParameters& of,
         double mu,
         const Phi& function,
         const Target& target)
      : parameters(of)
      , term(makeTerm(target))
      , phi(block().byPlace(function))
      , evolver(block().band, parameters, 1, block().spacing, mu, phi, term)
  {
  }

  template <typename Target>
  static DataTerm
  makeTerm(const Target& target)
  {
    DataTerm made{};
    made.target = block().byPlace(target);
    made.trust.assign(block().band.centerPlaces(), 1.0f);
    return made;
  }

  /** The value of a centre, in spacings of about 1. */
  double
  moved(std::size_t i) const
  {
    return (static_cast<double>(evolver.getPhi()[i]) - phi[i]) / block().unit;
  }
};

/** Where stencils are quadratics: not at the rim, where they do not smooth. */
bool
isInside(std::size_t i)
{
  return block().center(i).cwiseAbs().maxCoeff() < 5.5;
}

double
height(const Vector3d& x)
{
  return x[2];
}

TEST(Evolver, StepsAreAlmostAsLongAsTheStiffestSampleAllows)
{
  const PlaneBand& b = block();
  for (const double mu : {0.0, 0.3, 1.0})
    for (const double gap : {0.0, 0.5, 3.0}) {
      const Motion motion(
          makeParameters(Integration::Synchronous), mu, height, [&](const Vector3d& x) {
            return x[2] + gap * b.spacing / b.unit;
          });
      double rate = 0.0;
      for (const float stiffness : b.band.stencils.getStiffness())
        rate = std::max(rate,
                        mu * 1.5 * (1.0 + 6.0 * std::min(1.0, gap * gap)) +
                            (1.0 - mu) * stiffness * b.spacing * b.spacing);
      // Beyond 1 the explicit step is unstable.
      EXPECT_LT(motion.evolver.getStep() * rate, 0.95);
      EXPECT_GT(motion.evolver.getStep() * rate, 0.85);
    }
}

TEST(Evolver, DataPullAsFarAsTheirDistanceAndTheSlopeAndNoFaster)
{
  const double spacing = block().spacing / block().unit;
  struct Pull {
    double slope, gap, speed; ///< lengths in spacings
  };
  for (const Pull& pull : {Pull{1.0, 0.3, 0.3},
                           {1.0, -0.3, -0.3},
                           {1.0, 5.0, 1.0},
                           {1.25, 0.4, 0.5},
                           {2.0, 0.4, 0.6}}) {
    const auto start = [&](const Vector3d& x) { return pull.slope * x[2]; };
    Motion motion(makeParameters(Integration::Synchronous),
                  1.0,
                  start,
                  [&](const Vector3d& x) { return start(x) + pull.gap * spacing; });
    const LevelSetStep step = motion.evolver.advance();
    const double way = motion.evolver.getStep() * pull.speed * spacing;
    for (std::size_t i = 0; i < block().band.centers.size(); ++i)
      if (isInside(i)) {
        EXPECT_NEAR(way, motion.moved(i), rounding);
      }
    EXPECT_NEAR(std::abs(pull.speed) / pull.slope, step.change, 0.01);
    EXPECT_NEAR(pull.slope - 1.0, step.slope_error, 0.01);
    const double left = pull.gap - way / spacing;
    EXPECT_NEAR(0.5 * left * left, step.energy, 0.01);
  }
}

/** phi = |x|^2 / 2 R: its slope is |x| / R, the mean curvature of its levels 1 / |x|.
 */
TEST(Evolver, CurvatureMovesLevelsBySlopeTimesCurvature)
{
  constexpr double radius = 6.0;
  const auto bowl = [](const Vector3d& x) { return x.squaredNorm() / (2.0 * radius); };
  Motion motion(makeParameters(Integration::Synchronous), 0.0, bowl, bowl);
  motion.evolver.advance();
  const double spacing = block().spacing / block().unit;
  const double way = motion.evolver.getStep() * spacing * spacing / radius;
  EXPECT_GT(way, 20.0 * 5e-5);
  std::size_t inside = 0, exact = 0;
  for (std::size_t i = 0; i < block().band.centers.size(); ++i)
    if (isInside(i)) {
      ++inside;
      exact += std::abs(motion.moved(i) - way) < 0.02 * way ? 1 : 0;
    }
  EXPECT_GT(inside, 1000u);
  // Some stencils are isotropic: right on average only.
  EXPECT_GE(exact, inside * 95 / 100);
}

/** A wide cylinder is curved alike everywhere: nothing sticks out. */
TEST(Evolver, RelativeFlowLeavesWhatIsCurvedLikeItsSurroundings)
{
  constexpr double radius = 40.0;
  const auto cylinder = [](const Vector3d& x) {
    return std::hypot(x[0] + radius, x[2]) - radius;
  };
  const auto way = [&](CurvatureFlow flow) {
    Motion motion(
        makeParameters(Integration::Synchronous, flow), 0.0, cylinder, cylinder);
    motion.evolver.advance();
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < block().band.centers.size(); ++i)
      if (block().center(i).cwiseAbs().maxCoeff() < 3.0) {
        sum += motion.moved(i);
        ++count;
      }
    return sum / static_cast<double>(count) / motion.evolver.getStep();
  };
  const double spacing = block().spacing / block().unit;
  const double mean = 0.5 * spacing * spacing / radius;
  EXPECT_NEAR(mean, way(CurvatureFlow::Mean), 0.1 * mean);
  EXPECT_NEAR(0.0, way(CurvatureFlow::Relative), 0.1 * mean);
}

/** Where all move at one speed, steps of many lengths come to the same. */
TEST(Evolver, AsynchronousStepsArriveTogether)
{
  constexpr double mu = 0.05; // so that stiffness, which differs, makes the steps
  Motion motion(makeParameters(Integration::Asynchronous),
                mu,
                height,
                [](const Vector3d& x) { return x[2] + 30.0; });
  EXPECT_GT(10 * motion.evolver.getUpdates(), 11 * block().band.centers.size());
  motion.evolver.advance();
  const double way = mu * motion.evolver.getStep() * block().spacing / block().unit;
  std::size_t inside = 0, exact = 0;
  for (std::size_t i = 0; i < block().band.centers.size(); ++i)
    if (isInside(i)) {
      ++inside;
      exact += std::abs(motion.moved(i) - way) < 0.01 * way ? 1 : 0;
    }
  // Few are too stiff for any step of these, and move more slowly.
  EXPECT_GE(exact, inside * 95 / 100);
}

TEST(Evolver, IsBoundedUpToTheLargestValue)
{
  Motion motion(makeParameters(Integration::Synchronous), 1.0, height, height);
  const double largest = 8.0 * block().unit;
  EXPECT_TRUE(motion.evolver.isBounded(largest));
  EXPECT_FALSE(motion.evolver.isBounded(0.9 * largest));
  auto phi = motion.phi;
  phi[3] = std::nanf("");
  motion.evolver.setPhi(phi);
  EXPECT_FALSE(motion.evolver.isBounded(largest));
}

} // namespace test_evolver
