// SPDX-License-Identifier: BSD-3-Clause
// Fits of logarithms: when they are made, when they are taken, and what they reach.
#include "fitted_roots.h"
#include "src/isosurface/logarithmic_fits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace test_logarithmic_fits {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::FieldSamples;
using uvol_test::Roots;

FitResult made;                    // what fitAsMade() makes
std::vector<FitSample> fitted;     // what it was given
constexpr double of_values = 0.01; // error of the fit of the values

void
fitAsMade(const FitSample* samples,
          std::size_t count,
          const int* /*weighted*/,
          FitResult& result)
{
  fitted.assign(samples, samples + count);
  result = made;
}

/** One isopoint in lane 1, from a fit of its values. */
class LogarithmicFit : public ::testing::Test {
protected:
  LogarithmicFit()
  {
    fitted.clear();
    made = FitResult{};
    made.order[lane] = fit_quadratic;
    made.error[lane] = 0.5 * of_values;
    made.value[lane] = -0.25;
    made.value_error[lane] = 0.04;
    made.offset[2][lane] = 0.125;
    made.gradient[1][lane] = 3.0;
    made.hessian[5][lane] = 7.0;
    made.bias[lane] = 1e-4;
    made.slope_error[lane] = 0.02;
    made.residual[lane] = 0.3;
    made.pivot[lane] = 5.0;
    result_.order[lane] = fit_cubic;
    result_.error[lane] = of_values;
    result_.value[lane] = 11.0;
    result_.pivot[lane] = 0.1;
    surroundings_[lane].values = {0.5, 4.0, {1.0, 3.0}};
    weighted_[lane] = 40;
    samples_[0].value[lane] = -0.5f;
    samples_[1].value[lane] = 3.0f;
    samples_[1].value[2] = 3.0f;
  }

  bool
  isTaken(float isovalue = 1.0f)
  {
    LogarithmicFits(fitAsMade, isovalue)
        .improve(weighted_, surroundings_, samples_, result_);
    return result_.order[lane] == fit_quadratic;
  }

  static constexpr std::size_t lane = 1;
  FitResult result_{};
  Surroundings surroundings_[fit_lanes]{};
  std::vector<FitSample> samples_{2};
  int weighted_[fit_lanes] = {};
};

TEST_F(LogarithmicFit, ReplacesAllThatDescribesTheSurface)
{
  ASSERT_TRUE(isTaken(2.0f));
  EXPECT_EQ(0.125, result_.offset[2][lane]);
  EXPECT_EQ(3.0, result_.gradient[1][lane]);
  EXPECT_EQ(7.0, result_.hessian[5][lane]);
  EXPECT_EQ(0.5 * of_values, result_.error[lane]);
  EXPECT_EQ(1e-4, result_.bias[lane]);
  EXPECT_EQ(0.02, result_.slope_error[lane]);
  EXPECT_EQ(0.3, result_.residual[lane]);
  EXPECT_EQ(0.1, result_.pivot[lane]) << "samples have it whatever their values";
  EXPECT_EQ(-0.25, result_.value[lane]);
  EXPECT_EQ(0.04, result_.value_error[lane]);
  const ValueSpan& values = surroundings_[lane].values;
  EXPECT_DOUBLE_EQ(2.0 * std::log(0.5 / 2.0), values.lowest);
  EXPECT_DOUBLE_EQ(2.0 * std::log(4.0 / 2.0), values.highest);
  EXPECT_DOUBLE_EQ(2.0 * std::log(1.0 / 2.0), values.edge[0]);
  EXPECT_DOUBLE_EQ(2.0 * std::log(3.0 / 2.0), values.edge[1]);
  EXPECT_FLOAT_EQ(2.0f * std::log(1.5f / 2.0f), samples_[0].value[lane]);
  EXPECT_FLOAT_EQ(2.0f * std::log(5.0f / 2.0f), samples_[1].value[lane]);
  EXPECT_EQ(3.0f, samples_[1].value[2]) << "of another isopoint";
  EXPECT_EQ(samples_[0].value[lane], fitted[0].value[lane]);
}

TEST_F(LogarithmicFit, IsTakenWhereItsErrorIsClearlySmaller)
{
  made.error[lane] = 0.801 * of_values;
  made.bias[lane] = 0.0;
  EXPECT_FALSE(isTaken());
  EXPECT_EQ(11.0, result_.value[lane]);
  EXPECT_EQ(3.0f, samples_[1].value[lane]);
  EXPECT_EQ(4.0, surroundings_[lane].values.highest);
  made.error[lane] = 0.799 * of_values;
  EXPECT_TRUE(isTaken());
}

TEST_F(LogarithmicFit, IsNotTakenWhereItFails)
{
  made.order[lane] = fit_failed;
  EXPECT_FALSE(isTaken());
  result_.order[lane] = fit_failed;
  EXPECT_FALSE(isTaken());
  made.order[lane] = fit_quadratic;
  made.error[lane] = 1.0;
  EXPECT_TRUE(isTaken()) << "a fit of the values failed";
}

TEST_F(LogarithmicFit, IsNotTakenWhoseErrorIsNoNumber)
{
  made.error[lane] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isTaken());
}

/** The value at the centre tells its side, also where the root is another fit's. */
class SideByLogarithms : public LogarithmicFit {
protected:
  SideByLogarithms()
  {
    made.order[lane] = fit_failed;
    made.value_error[lane] = 0.1;    // 2.5 standard errors below
    result_.value_error[lane] = 5.5; // 2 above
    surroundings_[lane].support = IsoSupport::Measured;
  }

  double
  findValue()
  {
    EXPECT_FALSE(isTaken());
    return result_.value[lane];
  }
};

TEST_F(SideByLogarithms, IsTheirsWhereTheyHaveNoRoot)
{
  const FitResult before = result_;
  EXPECT_EQ(-0.25, findValue());
  EXPECT_EQ(0.1, result_.value_error[lane]);
  EXPECT_EQ(before.offset[2][lane], result_.offset[2][lane]);
  EXPECT_EQ(before.error[lane], result_.error[lane]);
  EXPECT_EQ(3.0f, samples_[1].value[lane]);
  EXPECT_EQ(4.0, surroundings_[lane].values.highest);
}

TEST_F(SideByLogarithms, IsTheirsBeyondTheSamples)
{
  made.order[lane] = fit_cubic;
  made.error[lane] = of_values;
  EXPECT_EQ(11.0, findValue()) << "errors of roots decide among samples";
  for (const IsoSupport support : {IsoSupport::Bridged, IsoSupport::Rim}) {
    result_.value[lane] = 11.0;
    result_.value_error[lane] = 5.5;
    surroundings_[lane].support = support;
    EXPECT_EQ(-0.25, findValue());
  }
}

TEST_F(SideByLogarithms, IsThatOfTheFitWithTheSmallerError)
{
  result_.value_error[lane] = 11.0 / 2.51;
  EXPECT_EQ(11.0, findValue());
  result_.value_error[lane] = 11.0 / 2.49;
  EXPECT_EQ(-0.25, findValue());
}

TEST_F(SideByLogarithms, IsNotTheirsByChance)
{
  result_.value_error[lane] = 100.0;
  made.value_error[lane] = 0.25 / 1.99;
  EXPECT_EQ(11.0, findValue());
  made.value_error[lane] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(11.0, findValue());
  made.value_error[lane] = 0.25 / 2.01;
  EXPECT_EQ(-0.25, findValue());
}

TEST_F(SideByLogarithms, IsTheirsWhereBothFallOrOneDoes)
{
  made.value_error[lane] = 1e-3;
  struct Case {
    double logarithm, value;
    bool is_taken;
  };
  for (const auto& [logarithm, value, is_taken] : {Case{0.25, 11.0, false},
                                                   Case{-0.25, 11.0, true},
                                                   Case{0.25, -11.0, true},
                                                   Case{-0.25, -11.0, true}}) {
    made.value[lane] = logarithm;
    result_.value[lane] = value;
    result_.value_error[lane] = 5.5;
    EXPECT_EQ(is_taken ? logarithm : value, findValue());
  }
}

TEST_F(SideByLogarithms, IsTheirsOfNegativeValues)
{
  surroundings_[lane].values = {-4.0, -0.5, {-3.0, -1.0}};
  made.value_error[lane] = 1e-3;
  made.value[lane] = 0.25; // nearer to 0 than the isovalue of -1
  EXPECT_FALSE(isTaken(-1.0f));
  EXPECT_EQ(0.25, result_.value[lane]);
}

TEST_F(LogarithmicFit, HasNoValueBeyondFloat)
{
  const FitResult of_values_before = result_;
  const Surroundings before = surroundings_[lane];
  for (const double logarithm : {-1e3, 88.0, 89.0, 1e3}) {
    made.value[lane] = logarithm;
    result_ = of_values_before;
    surroundings_[lane] = before;
    ASSERT_TRUE(isTaken());
    EXPECT_EQ(logarithm < 88.5 ? logarithm : std::numeric_limits<double>::infinity(),
              result_.value[lane]);
  }
}

TEST_F(LogarithmicFit, IsMadeOfValuesThatVaryByAFactor)
{
  struct Case {
    double lowest, highest;
    float isovalue;
    bool is_made;
  };
  const std::vector<Case> cases = {{1.0, 1.99, 1.5f, false},
                                   {1.0, 2.01, 1.5f, true},
                                   {-2.01, -1.0, -1.5f, true},
                                   {-1.99, -1.0, -1.5f, false},
                                   {1e-30, 3e-30, 2e-30f, true},
                                   {1e30, 3e30, 2e30f, true},
                                   {0.0, 3.0, 1.5f, false},
                                   {-1.0, 3.0, 1.5f, false},
                                   {-3.0, 1.0, -1.5f, false},
                                   {-3.0, 3.0, 0.0f, false}};
  for (const auto& [lowest, highest, isovalue, is_made] : cases) {
    fitted.clear();
    surroundings_[lane].values = {lowest, highest, {lowest, highest}};
    isTaken(isovalue);
    EXPECT_EQ(is_made, !fitted.empty()) << lowest << " to " << highest;
  }
}

TEST_F(LogarithmicFit, IsNotMadeWhereAnEndOfTheEdgeHasNoLogarithm)
{
  for (const double end : {0.0, -1.0})
    for (double& value : surroundings_[lane].values.edge) {
      const double before = std::exchange(value, end);
      isTaken();
      EXPECT_TRUE(fitted.empty()) << end;
      value = before;
    }
  EXPECT_TRUE(isTaken());
}

TEST_F(LogarithmicFit, IsNotMadeOfLabelsNorWithoutSamples)
{
  surroundings_[lane].has_steps = true;
  isTaken();
  EXPECT_TRUE(fitted.empty());
  surroundings_[lane].has_steps = false;
  weighted_[lane] = 0;
  isTaken();
  EXPECT_TRUE(fitted.empty());
}

std::vector<Position>
randomPlaces(std::size_t count, double half_side)
{
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> uniform(-half_side, half_side);
  std::vector<Position> places(count);
  for (Position& place : places)
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<float>(uniform(engine));
  return places;
}

/** A plume: no cubic follows its density, but its logarithm is a quadratic. The sphere
 * where it is 0.1 has a radius of 7 spacings, and values fall by half in one. */
TEST(LogarithmicFits, OfAPlumeAreASphereInAnyUnitAndOfEitherSign)
{
  const auto places = randomPlaces(5000, 1.25);
  const double radius = 1.0, spread = radius * radius / std::log(10.0);
  for (const double unit : {1.0, 1e-30, 1e30, -1.0}) {
    const Roots roots(FieldSamples(places,
                                   [&](const Vector3d& x) {
                                     return unit * std::exp(-x.squaredNorm() / spread);
                                   }),
                      static_cast<float>(0.1 * unit));
    ASSERT_GT(roots.points.size(), 500u);
    for (std::size_t i = 0; i < roots.points.size(); ++i) {
      const PointIso& point = roots.points[i];
      if (point.support != static_cast<std::uint8_t>(IsoSupport::Measured))
        continue;
      const Vector3d x = uvol_test::positionOf(point);
      ASSERT_LE(roots.fits[i].outcome, RootOutcome::Quadratic);
      EXPECT_NEAR(radius, x.norm(), 2e-6) << unit;
      EXPECT_LE(point.error, 1e-5);
      const Vector3d normal = point.getNormalVector3fMap().cast<double>();
      EXPECT_NEAR(1.0, std::abs(normal.dot(x.normalized())), 1e-6);
      EXPECT_NEAR(1.0 / radius, std::abs(point.mean_curvature), 1e-3);
    }
  }
}

/** Distances are no densities: half of the spacings from the centre on they vary by
 * factors as well, but cubics follow them better. */
TEST(LogarithmicFits, LeaveFieldsThatCubicsFollow)
{
  const auto places = randomPlaces(5000, 1.25);
  const auto distance = [](const Vector3d& x) { return x.squaredNorm() + 0.01; };
  const Roots roots(FieldSamples(places, distance), 0.09f);
  std::size_t measured = 0;
  for (const PointIso& point : roots.points)
    if (point.support == static_cast<std::uint8_t>(IsoSupport::Measured)) {
      ++measured;
      EXPECT_NEAR(std::sqrt(0.08), uvol_test::positionOf(point).norm(), 1e-6);
    }
  EXPECT_GT(measured, 30u);
}

} // namespace test_logarithmic_fits
