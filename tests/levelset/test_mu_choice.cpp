// SPDX-License-Identifier: BSD-3-Clause
// How much a noisy plane is smoothed, where its noise is known.
#include "levelset/band_setup.h"
#include "src/levelset/mu_choice.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace test_mu_choice {

using namespace pcl_uvol;
using Vector3d = Eigen::Vector3d;

const uvol_test::PlaneBand&
band()
{
  static const uvol_test::PlaneBand band({12.0, 12.0, 8.5}, 4.0, FitScheme::Quadratic);
  return band;
}

/** \param noise in spacings */
DataTerm
makeTerm(double noise)
{
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const double size = noise * band().spacing / band().unit;
  DataTerm term;
  term.target =
      band().byPlace([&](const Vector3d& x) { return x[2] + size * normal(engine); });
  term.trust.assign(band().band.centerPlaces(), 1.0f);
  term.noise = noise * band().spacing;
  return term;
}

TEST(MuChoice, NoiseThatNobodySeesIsLeft)
{
  Report report;
  const LevelSetParameters parameters;
  const auto choose = [&](double noise) {
    return chooseMu(band().band,
                    *band().samples,
                    makeTerm(noise),
                    parameters,
                    band().spacing,
                    1,
                    report);
  };
  EXPECT_TRUE(choose(0.0049).stages.empty());
  EXPECT_FALSE(choose(0.0051).stages.empty());
}

TEST(MuChoice, TooLargeNoiseEndsNoSearch)
{
  Report report;
  const LevelSetParameters parameters;
  const auto choose = [&](double told) {
    DataTerm term = makeTerm(0.5);
    term.noise *= told;
    return chooseMu(
        band().band, *band().samples, term, parameters, band().spacing, 1, report);
  };
  const MuChoice right = choose(1.0), larger = choose(1.4);
  ASSERT_FALSE(larger.stages.empty());
  EXPECT_LE(larger.stages.back().mu, right.stages.back().mu);
  EXPECT_NEAR(right.shares.of_surface, larger.shares.of_surface, 0.02);
}

TEST(MuChoice, LittleIsLeftOfTheNoiseOfAPlane)
{
  Report report;
  const LevelSetParameters parameters;
  const MuChoice choice = chooseMu(band().band,
                                   *band().samples,
                                   makeTerm(0.2),
                                   parameters,
                                   band().spacing,
                                   1,
                                   report);
  ASSERT_FALSE(choice.stages.empty());
  for (std::size_t i = 1; i < choice.stages.size(); ++i)
    EXPECT_LT(choice.stages[i].mu, choice.stages[i - 1].mu) << i;
  EXPECT_LT(choice.shares.of_surface, 0.5);
  EXPECT_LT(measureShares(band().band,
                          *band().samples,
                          makeTerm(0.2),
                          parameters,
                          band().spacing,
                          choice.stages.back().mu,
                          1,
                          report)
                .of_surface,
            measureShares(band().band,
                          *band().samples,
                          makeTerm(0.2),
                          parameters,
                          band().spacing,
                          1.0,
                          1,
                          report)
                .of_surface);
}

} // namespace test_mu_choice
