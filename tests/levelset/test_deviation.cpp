// SPDX-License-Identifier: BSD-3-Clause
// How far a smoothed surface lies from the true one, where both are known.
#include "levelset/band_setup.h"
#include "src/levelset/deviation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_deviation {

using namespace pcl_uvol;
using uvol_test::PlaneBand;
using Vector3d = Eigen::Vector3d;

const PlaneBand&
band()
{
  static const PlaneBand band({12.0, 12.0, 8.5}, 4.0, FitScheme::Quadratic);
  return band;
}

/** The data are the plane with noise, by the side of x; phi is the plane, moved. */
struct MovedPlane {
  DataTerm term;
  std::vector<float> phi;

  MovedPlane(double noise, double noise_beyond, double moved)
  {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal;
    term.target = band().byPlace([&](const Vector3d& x) {
      return x[2] + (x[0] < 0.0 ? noise : noise_beyond) * normal(engine);
    });
    phi = band().byPlace([&](const Vector3d& x) { return x[2] - moved; });
  }
};

/** The root mean square of deviations, in spacings, away from x = 0 and the rim. */
double
computeMean(const std::vector<float>& deviations, double side)
{
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const Vector3d x = band().center(i);
    if (side * x[0] < 4.0 || x.cwiseAbs().maxCoeff() > 9.0)
      continue;
    sum += std::pow(deviations[i] / band().unit, 2);
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

/** A fifth was left of residuals as large as the noise. */
TEST(Deviation, IsWhatIsLeftOfTheNoiseAroundIt)
{
  const MovedPlane setup(0.1, 0.4, 0.0);
  const auto deviations =
      findDeviations(band().band, setup.phi, setup.term, {0.2, 1.0}, 1);
  ASSERT_EQ(band().band.centers.size(), deviations.size());
  // Part of the shift that the mean of 27 residuals shows by chance is added.
  EXPECT_NEAR(0.02 * std::sqrt(2.0), computeMean(deviations, -1.0), 0.004);
  EXPECT_NEAR(0.08 * std::sqrt(2.0), computeMean(deviations, 1.0), 0.016);
  const auto half = findDeviations(band().band, setup.phi, setup.term, {0.5, 1.0}, 1);
  EXPECT_NEAR(0.05 * std::sqrt(2.0), computeMean(half, -1.0), 0.006);
  const auto more = findDeviations(band().band, setup.phi, setup.term, {0.2, 0.5}, 1);
  EXPECT_GT(computeMean(more, 1.0), 1.8 * computeMean(deviations, 1.0));
}

TEST(Deviation, KnowsWhereSmoothingHasMovedTheSurface)
{
  const MovedPlane setup(0.1, 0.1, 0.15);
  const auto deviations =
      findDeviations(band().band, setup.phi, setup.term, {0.1, 1.0}, 1);
  EXPECT_NEAR(0.15, computeMean(deviations, 1.0), 0.01);
  const MovedPlane exact(0.0, 0.0, 0.15);
  for (const float deviation :
       findDeviations(band().band, exact.phi, exact.term, {0.1, 1.0}, 1))
    EXPECT_NEAR(0.15, deviation / band().unit, 1e-4);
}

TEST(Deviation, IsLeftToFitsWhereNearlyNothingWasTakenAway)
{
  const MovedPlane setup(0.1, 0.1, 0.0);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const NoiseShares& shares :
       {NoiseShares{0.6, 0.19}, NoiseShares{}, NoiseShares{unknown, unknown}})
    for (const float deviation :
         findDeviations(band().band, setup.phi, setup.term, shares, 1))
      EXPECT_EQ(0.0f, deviation);
  EXPECT_GT(
      computeMean(findDeviations(band().band, setup.phi, setup.term, {0.6, 0.21}, 1),
                  1.0),
      0.1);
}

TEST(Deviation, AnyNumberOfThreadsGivesTheSame)
{
  const MovedPlane setup(0.1, 0.3, 0.1);
  const NoiseShares shares{0.2, 0.9};
  EXPECT_EQ(findDeviations(band().band, setup.phi, setup.term, shares, 1),
            findDeviations(band().band, setup.phi, setup.term, shares, 3));
}

} // namespace test_deviation
