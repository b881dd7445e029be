// SPDX-License-Identifier: BSD-3-Clause
// What fits are worth: every bound is looked at from both sides.
#include "src/isosurface/fit_judgement.h"
#include "src/neighbors/empty_cone_kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace test_fit_judgement {

using namespace pcl_uvol;

/** An edge of half a radius across values that do not jump. */
Surroundings
makeSurroundings()
{
  Surroundings surroundings{};
  surroundings.edge_length = 1.0;
  surroundings.radius = 2.0;
  surroundings.values = {0.0, 10.0, {3.0, 6.0}};
  return surroundings;
}

/** A cubic in lane 0 whose zero level lies at the centre. */
FitResult
makeFit()
{
  FitResult result{};
  result.order[0] = fit_cubic;
  result.gradient[2][0] = 1.0;
  return result;
}

TEST(FitJudgement, ReportsTheOrderOfTheFit)
{
  FitResult fit = makeFit();
  EXPECT_EQ(RootOutcome::Cubic, judge(fit, 0, makeSurroundings()));
  fit.order[0] = fit_quadratic;
  EXPECT_EQ(RootOutcome::Quadratic, judge(fit, 0, makeSurroundings()));
  fit.order[0] = fit_failed;
  EXPECT_EQ(RootOutcome::Singular, judge(fit, 0, makeSurroundings()));
}

TEST(FitJudgement, ResidualsAreAStepWhereTheEdgeSpansMostOfTheValues)
{
  struct Case {
    double span, residual; // shares of the range
    bool is_step;
  };
  for (const Case& look : {Case{0.59, 0.149, false},
                           Case{0.59, 0.151, true},
                           Case{0.61, 0.059, false},
                           Case{0.61, 0.061, true}}) {
    Surroundings surroundings = makeSurroundings();
    surroundings.values.edge[1] = 3.0 + 10.0 * look.span;
    FitResult fit = makeFit();
    fit.residual[0] = look.residual * surroundings.values.range();
    EXPECT_EQ(look.is_step ? RootOutcome::Step : RootOutcome::Cubic,
              judge(fit, 0, surroundings))
        << look.span << ' ' << look.residual;
  }
  Surroundings labels = makeSurroundings();
  labels.has_steps = true;
  EXPECT_EQ(RootOutcome::Step, judge(makeFit(), 0, labels));
}

/** The room is half a radius, or the length of an edge that is longer. */
TEST(FitJudgement, RootsStayInTheSurroundingsOfTheirEdge)
{
  const auto outcomeOf =
      [](double edge_length, double shift, double error, double bias = 0.0) {
        Surroundings surroundings = makeSurroundings();
        surroundings.edge_length = edge_length;
        FitResult fit = makeFit();
        fit.offset[0][0] = 0.6 * shift / surroundings.radius;
        fit.offset[1][0] = 0.8 * shift / surroundings.radius;
        fit.error[0] = error / surroundings.radius;
        fit.bias[0] = bias / surroundings.radius;
        return judge(fit, 0, surroundings);
      };
  EXPECT_EQ(RootOutcome::Cubic, outcomeOf(0.1, 0.99, 0.0));
  EXPECT_EQ(RootOutcome::Far, outcomeOf(0.1, 1.01, 0.0));
  EXPECT_EQ(RootOutcome::Cubic, outcomeOf(1.5, 1.49, 0.0));
  EXPECT_EQ(RootOutcome::Far, outcomeOf(1.5, 1.51, 0.0));
  // 3.5 standard errors cover the deviations, and twice the bias.
  EXPECT_EQ(RootOutcome::Cubic, outcomeOf(0.1, 0.0, 0.285));
  EXPECT_EQ(RootOutcome::Far, outcomeOf(0.1, 0.0, 0.286));
  EXPECT_EQ(RootOutcome::Far, outcomeOf(0.1, 0.0, std::nan("")));
  EXPECT_EQ(RootOutcome::Cubic, outcomeOf(0.1, 0.0, 0.0, 0.499));
  EXPECT_EQ(RootOutcome::Far, outcomeOf(0.1, 0.0, 0.0, 0.501));
  EXPECT_EQ(RootOutcome::Far, outcomeOf(0.1, 0.0, 0.2, 0.36)) << "hypot(0.7, 0.72)";
}

TEST(FitJudgement, JumpsKeepFitsInAMetricBesideTheirEdge)
{
  const auto isFar = [](double span, double shift, double error) {
    Surroundings surroundings = makeSurroundings();
    surroundings.values.edge[1] = 3.0 + 10.0 * span;
    FitResult fit = makeFit();
    fit.offset[2][0] = shift / surroundings.radius;
    fit.error[0] = error;
    return isFarFromJump(fit, 0, surroundings, 3.0);
  };
  EXPECT_TRUE(isFar(0.61, 1.51, 0.0091));
  EXPECT_FALSE(isFar(0.59, 1.51, 0.01));
  EXPECT_FALSE(isFar(0.61, 1.49, 0.01));
  EXPECT_FALSE(isFar(0.61, 1.51, 0.0089));
}

TEST(FitJudgement, FewDifferentWholeNumbersAreLabels)
{
  std::vector<std::uint32_t> all(8);
  std::iota(all.begin(), all.end(), 0u);
  const auto are = [&](const std::vector<float>& values) {
    return areLabels(values, all.data(), all.size());
  };
  EXPECT_TRUE(are({0.5f, 1.5f, 0.5f, 1.5f, 0.5f, 1.5f, 1.5f, 0.5f}));
  EXPECT_FALSE(are({0.5f, 1.5f, 0.5f, 2.5f, 0.5f, 1.5f, 1.5f, 0.5f}));
  EXPECT_TRUE(are({0.0f, 1.0f, 2.0f, 3.0f, 3.0f, 2.0f, 1.0f, 0.0f}));
  EXPECT_FALSE(are({0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 2.0f, 1.0f, 0.0f}));
  EXPECT_FALSE(are({0.0f, 1.0f, 2.5f, 3.0f, 3.0f, 2.0f, 1.0f, 0.0f}));
}

/** Directions to all sides, or to the upper half only. */
IsoSupport
findSupport(bool is_open, double nearest, double edge_length)
{
  std::array<float, 4 * cone_lanes> x{}, y{}, z{};
  std::size_t count = 0;
  for (const int a : {-1, 0, 1})
    for (const int b : {-1, 0, 1})
      for (const int c : {-1, 0, 1})
        if ((a != 0 || b != 0 || c != 0) && (!is_open || c > 0)) {
          x[count] = static_cast<float>(a);
          y[count] = static_cast<float>(b);
          z[count++] = static_cast<float>(c);
        }
  Surroundings surroundings = makeSurroundings();
  surroundings.edge_length = edge_length;
  return judgeSupport(surroundings, nearest, {x.data(), y.data(), z.data(), x.size()});
}

TEST(FitJudgement, GapsShowByEmptyConesAndFarSamples)
{
  EXPECT_EQ(IsoSupport::Measured, findSupport(false, 0.99, 1.0));
  EXPECT_EQ(IsoSupport::Rim, findSupport(false, 1.01, 1.0));
  EXPECT_EQ(IsoSupport::Rim, findSupport(true, 0.5, 1.99));
  EXPECT_EQ(IsoSupport::Bridged, findSupport(true, 0.5, 2.01));
}

/** Samples of lane 0, two and one that only fills it up: the first lies above the
 * isovalue. */
std::vector<FitSample>
makeSamples(float nearest, float second, float second_value)
{
  std::vector<FitSample> samples(3);
  samples[0].x[0] = nearest;
  samples[0].value[0] = 0.0f;
  samples[1].x[0] = -0.6f * second;
  samples[1].y[0] = 0.8f * second;
  samples[1].value[0] = second_value;
  samples[2].x[0] = 2.0f;
  return samples;
}

TEST(FitJudgement, EdgesThatAreLongerThanAllSamplesAreFarGoPastThem)
{
  const auto goesPast = [](double edge_length, RootOutcome outcome) {
    Surroundings surroundings = makeSurroundings();
    surroundings.edge_length = edge_length;
    FitResult fit = makeFit();
    if (outcome == RootOutcome::Singular)
      fit.order[0] = fit_failed;
    return goesPastSamples(
        fit, 0, outcome, surroundings, makeSamples(0.3f, 0.6f, -1.0f));
  };
  EXPECT_TRUE(goesPast(2.01, RootOutcome::Singular));
  EXPECT_FALSE(goesPast(1.99, RootOutcome::Singular));
  EXPECT_FALSE(goesPast(2.01, RootOutcome::Quadratic));
  EXPECT_FALSE(goesPast(2.01, RootOutcome::Step));
}

/** A fit without a root tells more than one that does not serve, or that is none. */
TEST(FitJudgement, EdgesGoPastSamplesOnOneSideWhereNoFitServes)
{
  const auto goesPast = [](const std::vector<FitSample>& samples) {
    Surroundings surroundings = makeSurroundings();
    surroundings.edge_length = 2.01;
    FitResult none = makeFit();
    none.order[0] = fit_failed;
    none.value[0] = std::nan("");
    const bool is_past =
        goesPastSamples(none, 0, RootOutcome::Singular, surroundings, samples);
    EXPECT_EQ(is_past,
              goesPastSamples(makeFit(), 0, RootOutcome::Step, surroundings, samples));
    return is_past;
  };
  EXPECT_FALSE(goesPast(makeSamples(0.3f, 0.69f, -1.0f)));
  EXPECT_TRUE(goesPast(makeSamples(0.3f, 0.71f, -1.0f)));
  EXPECT_FALSE(goesPast(makeSamples(0.69f, 0.3f, -1.0f)));
  EXPECT_TRUE(goesPast(makeSamples(0.71f, 0.3f, -1.0f)));
  EXPECT_TRUE(goesPast(makeSamples(0.3f, 0.31f, 1.0f)));
}

/** A fit to f(m x) has the zero level, the gradient and the Hessian of f. */
TEST(FitJudgement, MetricsAreLeftAsCoordinatesAre)
{
  Eigen::Matrix3d metric, hessian;
  metric << 2.0, 0.5, 0.0, 0.5, 1.0, -0.25, 0.0, -0.25, 4.0;
  hessian << 0.8, 0.3, -0.4, 0.3, -0.6, 0.2, -0.4, 0.2, 1.0;
  const Eigen::Vector3d offset(0.1, -0.2, 0.3), gradient(1.0, 2.0, -0.5);
  FitResult fit = makeFit();
  constexpr int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int axis = 0; axis < 3; ++axis) {
    fit.offset[axis][0] = offset[axis];
    fit.gradient[axis][0] = gradient[axis];
  }
  for (std::size_t i = 0; i < 6; ++i)
    fit.hessian[i][0] = hessian(row[i], column[i]);
  fit.error[0] = 0.25;
  fit.bias[0] = 0.5;
  leaveMetric(metric, 0, fit);
  const Eigen::Vector3d back = metric.inverse() * offset,
                        slope = metric.transpose() * gradient;
  const Eigen::Matrix3d curvature = metric.transpose() * hessian * metric;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_DOUBLE_EQ(back[axis], fit.offset[axis][0]);
    EXPECT_DOUBLE_EQ(slope[axis], fit.gradient[axis][0]);
  }
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(curvature(row[i], column[i]), fit.hessian[i][0], 1e-14);
  EXPECT_DOUBLE_EQ(0.25 * gradient.norm() / slope.norm(), fit.error[0]);
  EXPECT_DOUBLE_EQ(0.5 * gradient.norm() / slope.norm(), fit.bias[0]);
}

TEST(FitJudgement, ErrorsInGapsAreThoseOfTheEdge)
{
  IsoEdge edge{};
  edge.t = 0.25f;
  PointIso point;
  point.edge_length = 8.0f;
  keepInGap(edge, point);
  EXPECT_EQ(static_cast<std::uint8_t>(IsoSupport::Bridged), point.support);
  EXPECT_FLOAT_EQ(6.0f, point.error);
}

} // namespace test_fit_judgement
