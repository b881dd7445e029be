// SPDX-License-Identifier: BSD-3-Clause
// Fields of known slopes as distances, and how noisy they are.
#include "band_setup.h"
#include "src/levelset/data_term.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace test_data_term {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::PlaneBand;

/** A share of a derivative: what the 16 bits of the stencils' weights leave. */
constexpr double rounding = 3e-4;

const PlaneBand&
wideBand()
{
  static const PlaneBand band({16.0, 7.0, 6.5}, 5.0, FitScheme::Quadratic);
  return band;
}

template <typename Field>
DataTerm
makeTerm(const PlaneBand& band, const Field& field)
{
  Report report;
  return makeDataTerm(band.band, *band.samples, band.bySample(field), 1, report);
}

/** Slopes of two kinds side by side: what counts is that of the surface below. */
TEST(DataTerm, IsADistanceAsFarAsTheBandGoes)
{
  const PlaneBand& b = wideBand();
  constexpr double border = 3.0, steep = 3.0;
  const DataTerm term = makeTerm(
      b, [](const Vector3d& x) { return x[2] * (x[0] > border ? steep : 1.0); });
  EXPECT_NEAR(1.0, term.slope, 0.05); // of most of the surface
  std::size_t far = 0;
  for (std::size_t i = 0; i < b.band.centers.size(); ++i) {
    const Vector3d x = b.center(i);
    // Slopes are mixed where stencils and their neighbours reach across the border.
    if (std::abs(x[0] - border) < 8.5)
      continue;
    far += x[0] > border && std::abs(x[2]) > 4.0 ? 1 : 0;
    ASSERT_NEAR(
        b.unit * x[2], term.target[i], rounding * b.unit * (1.0 + std::abs(x[2])))
        << x.transpose();
    EXPECT_NEAR(1.0, term.trust[i], 10.0 * rounding);
  }
  EXPECT_GT(far, 50u);
}

TEST(DataTerm, SlopesCountAsATenthOfTheirMedianAtLeast)
{
  const PlaneBand& b = wideBand();
  constexpr double border = 3.0, flat = 0.01;
  const DataTerm term = makeTerm(
      b, [](const Vector3d& x) { return x[2] * (x[0] > border ? flat : 1.0); });
  for (std::size_t i = 0; i < b.band.centers.size(); ++i) {
    const Vector3d x = b.center(i);
    if (x[0] - border > 8.5) {
      const double expected = flat / (0.1 * term.slope) * b.unit * x[2];
      EXPECT_NEAR(expected, term.target[i], 1e-3 * b.unit);
    }
  }
}

/** Half of the slope is the sample's own, which also tells how far it is trusted. */
TEST(DataTerm, TrustsPlacesThatAreAsSteepAsTheSurface)
{
  const PlaneBand b({7.0, 7.0, 8.5}, 0.0, FitScheme::Quadratic);
  constexpr double kink = 5.7, beyond = 0.4;
  const auto field = [](const Vector3d& x) {
    const double z = std::abs(x[2]);
    return std::copysign(z < kink ? z : kink + beyond * (z - kink), x[2]);
  };
  const DataTerm term = makeTerm(b, field);
  std::size_t partly = 0;
  for (std::size_t i = 0; i < b.band.centers.size(); ++i) {
    const Vector3d x = b.center(i);
    if (std::abs(x[2]) < 1.0 || std::abs(x[2]) > 6.5)
      continue;
    const double slope = 2.0 * b.unit * field(x) / term.target[i] - 1.0;
    partly += slope > 0.5 && slope < 0.9 ? 1 : 0;
    EXPECT_NEAR(std::min(1.0, slope * slope), term.trust[i], 0.02);
  }
  EXPECT_GT(partly, 50u);
}

TEST(DataTerm, KnowsTheNoise)
{
  const PlaneBand& b = wideBand();
  for (const double sigma : {0.0, 0.05, 0.2}) {
    std::mt19937_64 engine(8);
    std::normal_distribution<double> normal(0.0, sigma);
    const DataTerm term = makeTerm(b, [&](const Vector3d& x) {
      return 2.0 * (x[2] + (sigma > 0.0 ? normal(engine) : 0.0));
    });
    // The median of root mean squares of 17 degrees of freedom.
    const double median = std::sqrt(1.0 - 2.0 / (3.0 * 17.0));
    EXPECT_NEAR(median * sigma, term.noise / b.unit, 0.03 * sigma + 1e-5);
    EXPECT_NEAR(2.0, term.slope, 0.02 + 0.1 * sigma);
    if (sigma == 0.0) {
      EXPECT_NEAR(0.0, term.slope_error, rounding);
    }
  }
}

} // namespace test_data_term
