// SPDX-License-Identifier: BSD-3-Clause
// Isopoints on fits against functions that fits follow exactly, and their error bars.
#include "fitted_roots.h"
#include "src/derivatives/fit_kernel.h"
#include "src/isosurface/smooth_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace test_smooth_roots {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::FieldSamples;
using uvol_test::positionOf;
using uvol_test::Roots;

/** Random places of a box; coordinates are whole steps from a corner. */
std::vector<Position>
randomPlaces(std::size_t count,
             const Vector3d& corner,
             double step,
             int steps,
             std::uint64_t seed = 1)
{
  std::mt19937_64 engine(seed);
  std::vector<Position> places(count);
  for (Position& place : places)
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<float>(
          corner[axis] +
          step * static_cast<double>(engine() % static_cast<std::uint64_t>(steps)));
  return places;
}

Vector3d
normalOf(const PointIso& point)
{
  return point.getNormalVector3fMap().cast<double>();
}

/** x^T A x has the value 1 on an ellipsoid whose axes lie askew; of 64ths floats hold
 * the values exactly. */
TEST(SmoothRoots, OfAnEllipsoidAreAnEllipsoidWhateverTheStretch)
{
  Eigen::Matrix3d half_hessian;
  half_hessian << 1.0, 0.25, 0.0, 0.25, 1.5, -0.25, 0.0, -0.25, 0.75;
  const Eigen::Matrix3d hessian = 2.0 * half_hessian;
  const auto places = randomPlaces(4000, Vector3d::Constant(-1.5), 1.0 / 64, 193);
  const auto value = [&](const Vector3d& x) { return x.dot(half_hessian * x); };
  for (const Position scale :
       {Position{{1.0f, 1.0f, 1.0f}}, Position{{1.0f, 1.5f, 0.75f}}})
    for (const Outside outside : {Outside::Lower, Outside::Higher}) {
      const Roots roots(FieldSamples(places, value, scale), 1.0f, outside);
      const double side = outside == Outside::Lower ? -1.0 : 1.0;
      ASSERT_GT(roots.points.size(), 500u);
      for (std::size_t i = 0; i < roots.points.size(); ++i) {
        const PointIso& point = roots.points[i];
        ASSERT_LE(roots.fits[i].outcome, RootOutcome::Quadratic);
        const Vector3d x = positionOf(point), gradient = hessian * x;
        const double slope = gradient.norm(),
                     deviation = std::abs(value(x) - 1.0) / slope;
        EXPECT_LE(deviation, 2e-7);
        EXPECT_NEAR(0.0, (side * gradient / slope - normalOf(point)).norm(), 2e-6);
        const Vector3d normal = gradient / slope;
        const double curvature =
            (hessian.trace() - normal.dot(hessian * normal)) / (2.0 * slope);
        EXPECT_NEAR(side * curvature, point.mean_curvature, 1e-5);
        // An estimate, but never less than what floats round.
        EXPECT_GE(point.error, deviation);
        EXPECT_LE(point.error, 1e-6);
      }
    }
}

/** At the coordinates of maps floats are half a metre apart: a plane that fits follow
 * exactly is known no better. */
TEST(SmoothRoots, ErrorsAtMapCoordinatesAreAtLeastTheStepOfFloats)
{
  const Vector3d corner(448000.0, 5402000.0, 96.0);
  const auto places = randomPlaces(3000, corner, 8.0, 201);
  const Vector3d gradient(0.25, -0.5, 0.125);
  const auto height = [&](const Vector3d& x) { return gradient.dot(x - corner); };
  const double isovalue = height(corner + Vector3d::Constant(801.0));
  const Roots roots(FieldSamples(places, height), static_cast<float>(isovalue));
  ASSERT_GT(roots.points.size(), 300u);
  for (std::size_t i = 0; i < roots.points.size(); ++i) {
    const PointIso& point = roots.points[i];
    ASSERT_LE(roots.fits[i].outcome, RootOutcome::Quadratic);
    const float step = std::nextafter(point.y, 1e9f) - point.y;
    ASSERT_EQ(0.5f, step);
    EXPECT_GE(point.error, step);
    EXPECT_LE(point.error, 4.0f * step);
    const double deviation = (height(positionOf(point)) - isovalue) / gradient.norm();
    EXPECT_LE(std::abs(deviation), point.error);
  }
}

/** The fourth power of the distance is the term that cubics miss and the bias stands
 * for: twice the deviation is told of all that is off by more than floats round. Values
 * of both signs have no logarithm. */
TEST(SmoothRoots, ErrorsCoverFieldsThatGrowAlikeInAllDirections)
{
  const auto places = randomPlaces(8000, Vector3d::Constant(-1.5), 1.0 / 1024, 3073);
  const auto fourth_power = [](const Vector3d& x) {
    return x.squaredNorm() * x.squaredNorm() - 1.0;
  };
  const Roots roots(FieldSamples(places, fourth_power), 0.0f);
  ASSERT_GT(roots.points.size(), 900u);
  std::size_t biased = 0;
  for (std::size_t i = 0; i < roots.points.size(); ++i) {
    const double deviation = std::abs(positionOf(roots.points[i]).norm() - 1.0);
    if (roots.fits[i].outcome != RootOutcome::Cubic || deviation < 2e-6)
      continue;
    ++biased;
    EXPECT_GE(roots.points[i].error, 1.8 * deviation);
  }
  EXPECT_GT(3 * biased, roots.points.size());
}

/** 3.5 standard errors of the fit to the forty nearest samples and twice its bias, the
 * next one being where weights end; more where the slope is hardly known. A fit that
 * does not serve tells how far from the edge the surface may be. */
class SmoothRootsOfNoise : public testing::TestWithParam<double> {};

TEST_P(SmoothRootsOfNoise, ErrorIsThatOfTheFitToTheNearestForty)
{
  const auto places = randomPlaces(3000, Vector3d::Constant(-1.5), 1.0 / 1024, 3073);
  std::mt19937_64 engine(2);
  const FieldSamples field(places, [&](const Vector3d& x) {
    return x.norm() - 1.0 +
           GetParam() * (static_cast<double>(engine() % 1024) / 1024.0 - 0.5);
  });
  const float isovalue = 0.0f;
  const Roots roots(field, isovalue);
  const std::vector<Position>& positions = field.samples().getPositions();
  const double unit = field.samples().getScale()[0];
  constexpr std::size_t fitted = 40;
  for (std::size_t i = 0; i < roots.points.size(); i += 10) {
    const Vector3d center = positionOf(roots.linear[i]) * unit;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t j = 0; j < positions.size(); ++j)
      order.emplace_back(
          (Vector3d(positions[j][0], positions[j][1], positions[j][2]) - center).norm(),
          j);
    std::sort(order.begin(), order.end());
    const double radius = order[fitted].first;
    std::vector<FitSample> samples(fitted);
    for (std::size_t j = 0; j < fitted; ++j) {
      const Position& x = positions[order[j].second];
      samples[j].x[0] = static_cast<float>((x[0] - center[0]) / radius);
      samples[j].y[0] = static_cast<float>((x[1] - center[1]) / radius);
      samples[j].z[0] = static_cast<float>((x[2] - center[2]) / radius);
      samples[j].value[0] = field.values()[order[j].second] - isovalue;
    }
    const int weighted[fit_lanes] = {static_cast<int>(fitted)};
    FitResult result;
    baseline::fitZeroLevel(samples.data(), fitted, weighted, result);
    if (roots.points[i].support == static_cast<std::uint8_t>(IsoSupport::Measured)) {
      EXPECT_NEAR(radius, roots.fits[i].radius, 1e-5 * radius);
    }
    const double least_part =
        std::max(0.25, 1.0 - 2.6 * std::max(0.0, result.slope_error[0] - 0.05));
    const double of_fit =
        std::hypot(3.5 * result.error[0], 2.0 * result.bias[0]) / least_part;
    const bool serves = roots.fits[i].outcome <= RootOutcome::Quadratic;
    double error = radius / unit * of_fit;
    if (!serves) {
      const double shift =
          std::hypot(result.offset[0][0], result.offset[1][0], result.offset[2][0]);
      // An edge across most of the values is a step.
      float low = field.values()[order[0].second], high = low;
      for (std::size_t j = 0; j <= fitted; ++j) {
        low = std::min(low, field.values()[order[j].second]);
        high = std::max(high, field.values()[order[j].second]);
      }
      const double span = std::abs(field.values()[roots.edges[i].first] -
                                   field.values()[roots.edges[i].second]);
      const double reach = span > 0.6 * (high - low) ? 0.0
                           : result.order[0] == fit_failed
                               ? 1.2
                               : std::min(1.2, shift + of_fit);
      const float t = roots.edges[i].t;
      error = std::max<double>(std::max(t, 1.0f - t) * roots.points[i].edge_length,
                               radius / unit * reach);
    }
    EXPECT_NEAR(error, roots.points[i].error, 2e-3 * error) << serves;
  }
}

INSTANTIATE_TEST_SUITE_P(SmoothRoots,
                         SmoothRootsOfNoise,
                         testing::Values(0.01, 0.1, 0.6),
                         [](const auto& test) {
                           return "noise_" +
                                  std::to_string(std::lround(100.0 * test.param));
                         });

/** Where no fit serves, the linear point stays, and its error is the way to the farther
 * end of the edge. */
TEST(SmoothRoots, LabelsAndLinesOfSamplesKeepTheLinearPoint)
{
  auto line = randomPlaces(1500, Vector3d::Constant(-1.5), 1.0 / 1024, 3073);
  for (Position& place : line)
    place[1] = place[2] = 0.25f * place[0];
  const auto solid = randomPlaces(1500, Vector3d::Constant(-1.5), 1.0 / 64, 193);
  const auto label = [](const Vector3d& x) { return x[0] + x[1] > 0.1 ? 1.0 : 0.0; };
  const auto wave = [](const Vector3d& x) { return std::sin(100.0 * x[0]); };
  for (const auto& [places, value, outcome] :
       {std::tuple<std::vector<Position>, FieldSamples::Function, RootOutcome>(
            line, wave, RootOutcome::Singular),
        {solid, label, RootOutcome::Step}}) {
    const Roots roots(FieldSamples(places, value), 0.5f);
    ASSERT_GT(roots.points.size(), 30u);
    std::size_t expected = 0;
    for (std::size_t i = 0; i < roots.points.size(); ++i) {
      const PointIso& point = roots.points[i];
      expected += roots.fits[i].outcome == outcome ? 1 : 0;
      if (roots.fits[i].outcome <= RootOutcome::Quadratic)
        continue;
      EXPECT_EQ(positionOf(roots.linear[i]), positionOf(point));
      EXPECT_EQ(normalOf(roots.linear[i]), normalOf(point));
      const float t = roots.edges[i].t;
      EXPECT_EQ(std::max(t, 1.0f - t) * point.edge_length, point.error);
      EXPECT_TRUE(std::isnan(point.mean_curvature));
    }
    // A border of labels may look like a slope where samples happen to lie so.
    EXPECT_GE(expected, roots.points.size() * 9 / 10);
  }
}

/** Two halves a wide gap apart: edges reach across it; beside it points know that they
 * lie on a rim. */
TEST(SmoothRoots, ReportWhatTheyRestOn)
{
  auto places = randomPlaces(6000, Vector3d::Constant(-2.0), 1.0 / 64, 257);
  for (Position& place : places)
    place[0] += place[0] >= 0.0f ? 1.0f : -1.0f;
  const FieldSamples across(places, [](const Vector3d& x) { return x[0]; });
  for (const PointIso& point : Roots(across, 0.0f).points)
    EXPECT_EQ(IsoSupport::Bridged, static_cast<IsoSupport>(point.support));
  const FieldSamples along(places,
                           [](const Vector3d& x) { return x[1] + 0.01 * x[2]; });
  std::size_t middle = 0, measured = 0, rim = 0, open = 0;
  for (const PointIso& point : Roots(along, 0.0f).points) {
    // In spacings of about 0.22 from the four faces of the halves.
    const double inside = std::min(
        {std::abs(point.x) - 1.0, 3.0 - std::abs(point.x), 2.0 - std::abs(point.z)});
    const bool is_measured =
        point.support == static_cast<std::uint8_t>(IsoSupport::Measured);
    if (inside > 0.6) {
      ++middle;
      measured += is_measured ? 1 : 0;
    }
    if (inside < 0.05) {
      ++rim;
      open += is_measured ? 0 : 1;
    }
  }
  EXPECT_GT(middle, 100u);
  EXPECT_GE(measured, middle * 98 / 100);
  EXPECT_GT(rim, 10u);
  EXPECT_GE(open, rim * 9 / 10);
}

/** What an isopoint becomes depends on no other one, whichever searches it shares. */
TEST(SmoothRoots, AreTheSameAloneAndAmongOthers)
{
  const auto random = randomPlaces(3000, Vector3d::Constant(-1.5), 1.0 / 1024, 3073);
  const auto changed = [&](const std::function<void(Position&, std::size_t)>& change) {
    auto places = random;
    for (std::size_t i = 0; i < places.size(); ++i)
      change(places[i], i);
    return places;
  };
  const auto sheets = changed([](Position& x, std::size_t i) {
    x[2] = static_cast<float>(i % 6) * 0.5f - 1.25f;
  });
  const auto halves =
      changed([](Position& x, std::size_t) { x[0] += x[0] > 0.0f ? 5.0f : -5.0f; });
  const auto shells = changed([](Position& x, std::size_t i) {
    const float length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int axis = 0; axis < 3; ++axis)
      x[axis] *= (i % 2 == 0 ? 1.0f : 0.5f) / std::max(length, 0.01f);
  });
  const auto slabs = changed([](Position& x, std::size_t) { x[2] *= 12.0f; });
  for (const auto& places : {random, sheets, halves, shells, slabs}) {
    const FieldSamples field(places, [](const Vector3d& x) {
      return x.norm() + 0.05 * x[0] - (std::abs(x[0]) > 2.0 ? 5.0 : 0.75);
    });
    const Roots together(field, 0.01f);
    ASSERT_GT(together.points.size(), 20u);
    const IsopointInput input = field.input(Outside::Lower, Interpolation::Fit);
    Report report;
    StepTimer step(report, "roots");
    for (std::size_t i = 0; i < together.points.size(); i += 3) {
      std::vector<PointIso> alone{together.linear[i]};
      const auto fits = fitRoots(input, 0.01f, {together.edges[i]}, alone, step);
      EXPECT_EQ(together.fits[i].outcome, fits[0].outcome);
      EXPECT_EQ(positionOf(together.points[i]), positionOf(alone[0]));
      EXPECT_EQ(normalOf(together.points[i]), normalOf(alone[0]));
      EXPECT_EQ(together.points[i].error, alone[0].error);
      EXPECT_EQ(together.points[i].support, alone[0].support);
    }
  }
}

/** Where the nearest samples lie in a thin shell about it, an isopoint stays on its
 * edge.
 */
TEST(SmoothRoots, StayOnEdgesAcrossWideGaps)
{
  auto places = randomPlaces(3000, Vector3d::Constant(-1.5), 1.0 / 1024, 3073);
  for (Position& place : places)
    place[0] += place[0] > 0.0f ? 20.0f : -20.0f;
  const Roots roots(FieldSamples(places, [](const Vector3d& x) { return x[0]; }), 0.0f);
  ASSERT_GT(roots.points.size(), 50u);
  for (std::size_t i = 0; i < roots.points.size(); ++i) {
    EXPECT_EQ(RootOutcome::Far, roots.fits[i].outcome);
    EXPECT_EQ(positionOf(roots.linear[i]), positionOf(roots.points[i]));
    EXPECT_EQ(IsoSupport::Bridged, static_cast<IsoSupport>(roots.points[i].support));
    const float t = roots.edges[i].t;
    EXPECT_EQ(std::max(t, 1.0f - t) * roots.points[i].edge_length,
              roots.points[i].error);
  }
}

} // namespace test_smooth_roots
