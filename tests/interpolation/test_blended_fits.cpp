// SPDX-License-Identifier: BSD-3-Clause
// Local polynomials as a partition of unity: exact for what they are, smooth, of the
// order that they have, and sure of as much as they know.
#include "common/scalar_field.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/interpolation_cases.h"
#include "support/stretched_samples.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace test_blended_fits {

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

double
cubic(const Vector3d& p)
{
  const double x = p[0] - 0.3, y = p[1] + 0.2, z = p[2];
  return 2.0 + x - 3.0 * y + x * y + 2.0 * z * z - y * z + x * x * x - 2.0 * x * y * z +
         y * y * z + 0.5 * z * z * z;
}

TEST(BlendedFits, ExactForCubics)
{
  const auto samples = sampleFunctions(
      randomPlaces(3000, 1), {cubic, [](const Vector3d& x) { return 1e6 + cubic(x); }});
  const auto result = interpolate(samples, {}, randomPlaces(2000, 2), 2);
  const Places places = randomPlaces(2000, 2);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3d x = vectorOf(places[i]);
    if (result.support[i] == FieldSupport::Outside)
      continue;
    EXPECT_NEAR(result.getValue(0, i), cubic(x), 1e-9);
    EXPECT_NEAR(result.getValue(1, i) - 1e6, cubic(x), 2e-9);
    EXPECT_LT((vectorOf(result.getGradient(0, i)) - gradientOf(cubic, x)).norm(), 1e-7);
    EXPECT_LT(result.getError(0, i), 1e-8);
  }
}

/** The gradient is the derivative of the values, also where fits come and go. */
TEST(BlendedFits, ContinuouslyDifferentiable)
{
  const auto samples = sampleFunctions(randomPlaces(1000, 3), {franke});
  Places line;
  constexpr int steps = 4000;
  constexpr double step = 0.8 / steps;
  for (int i = 0; i <= steps; ++i)
    line.push_back({0.1 + i * step, 0.5, 0.45});
  const auto result = interpolate(samples, {}, line);
  double roughness = 0.0;
  for (int i = 1; i < steps; ++i) {
    const double slope =
        (result.getValue(0, i + 1) - result.getValue(0, i - 1)) / (2.0 * step);
    EXPECT_NEAR(slope, result.getGradient(0, i)[0], 2e-4);
    roughness = std::max(
        roughness,
        std::abs(result.getGradient(0, i)[0] - result.getGradient(0, i - 1)[0]));
  }
  EXPECT_LT(roughness, 0.05);
}

struct Deviation {
  double value, gradient; ///< root mean squares
  double share;           ///< of values no farther off than their error
};

Deviation
deviationOf(std::size_t n, const Function& function, double noise = 0.0)
{
  Random random(99);
  const Function noisy = [&](const Vector3d& x) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
      sum += random.uniform();
    return function(x) + noise * sum;
  };
  const auto samples = sampleFunctions(randomPlaces(n, 4), {noisy});
  const Places places = randomPlaces(3000, 5, 0.15, 0.85);
  const auto result = interpolate(samples, {}, places);
  Deviation deviation{};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3d x = vectorOf(places[i]);
    const double off = result.getValue(0, i) - function(x);
    deviation.value += off * off;
    deviation.gradient +=
        (vectorOf(result.getGradient(0, i)) - gradientOf(function, x)).squaredNorm();
    deviation.share += std::abs(off) <= result.getError(0, i);
  }
  const double count = static_cast<double>(places.size());
  return {std::sqrt(deviation.value / count),
          std::sqrt(deviation.gradient / count),
          deviation.share / count};
}

TEST(BlendedFits, OrderOfConvergence)
{
  const Function waves = [](const Vector3d& x) {
    return std::sin(4.0 * x[0]) * std::cos(3.0 * x[1]) + std::exp(x[2] * x[0]);
  };
  for (const Function& function : {Function(franke), waves}) {
    const Deviation coarse = deviationOf(8000, function);
    const Deviation fine = deviationOf(64000, function); // half the spacing
    EXPECT_GE(std::log2(coarse.value / fine.value), 3.5);
    EXPECT_GE(std::log2(coarse.gradient / fine.gradient), 2.5);
  }
}

TEST(BlendedFits, ErrorsAreCalibrated)
{
  EXPECT_GE(deviationOf(16000, franke).share, 0.68);
  const Deviation noisy = deviationOf(16000, franke, 0.1);
  EXPECT_GE(noisy.share, 0.6);
  EXPECT_LE(noisy.share, 0.9);
  EXPECT_LT(noisy.value, 0.07); // of noise of 0.1
}

/** Samples on a plane or a line, or few of them, still give back a linear function at
 * places among them; not so layers far apart, whose samples have no neighbours on
 * others. */
TEST(BlendedFits, LinearFunctionsOfEveryLayout)
{
  const Function linear = [](const Vector3d& x) {
    return 3.0 + x[0] - 2.0 * x[1] + 0.5 * x[2];
  };
  for (const std::string& shape : cloudShapes()) {
    if (shape == "slices" || shape == "one plane and noise")
      continue;
    for (const std::size_t n : {4, 12, 30, 400}) {
      const auto cloud = makeCloud(shape, n, 6);
      Places at, places;
      for (const auto& point : *cloud)
        at.push_back({point.x, point.y, point.z});
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        std::array<double, 3> middle;
        for (std::size_t axis = 0; axis < 3; ++axis)
          middle[axis] = 0.75 * at[i][axis] + 0.25 * at[i + 1][axis];
        places.push_back(middle);
      }
      InterpolationParameters parameters;
      parameters.extrapolate = true;
      const auto result =
          interpolate(sampleFunctions(at, {linear}), parameters, places);
      for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_NEAR(result.getValue(0, i), linear(vectorOf(places[i])), 1e-5)
            << shape << " " << n;
    }
  }
}

TEST(BlendedFits, ReducedFitsAreFlagged)
{
  Places at = randomPlaces(500, 7);
  for (auto& place : at)
    place[2] = 0.25;
  Report report;
  const auto result =
      interpolate(sampleFunctions(at, {franke}), {}, {{0.5, 0.5, 0.25}}, 1, 0, &report);
  EXPECT_GT(report.getCount("reduced_fits"), 0u);
  EXPECT_NEAR(result.getValue(0, 0), franke({0.5, 0.5, 0.25}), 5e-3);
  EXPECT_NE(result.support[0], FieldSupport::Measured);
}

/** Across a jump values overshoot by no more than half of it. */
TEST(BlendedFits, StepsRingALittle)
{
  const auto samples =
      sampleFunctions(randomPlaces(8000, 8),
                      {[](const Vector3d& x) { return x[0] < 0.5 ? 0.0 : 1.0; }});
  const Places places = randomPlaces(2000, 9, 0.1, 0.9);
  const auto result = interpolate(samples, {}, places);
  for (const double value : result.values) {
    EXPECT_GT(value, -0.5);
    EXPECT_LT(value, 1.5);
  }
}

/** Errors at random positions of the index space, in standard deviations. */
std::vector<double>
errorsBetweenNodes(const std::string& shape, double ratio, bool are_gradients_checked)
{
  constexpr int side = 20;
  const auto stretched = makeStretchedSamples(shape, ratio, side);
  const Function waves = [&](const Vector3d& x) {
    const Vector3d u = stretched.to_index(x);
    return std::sin(0.5 * u[0]) + std::cos(0.4 * u[1] - 0.3 * u[2]);
  };
  const auto lattice = stretched.sample(makeSmoothField("radial", 8000), side, 1);
  Places at, places;
  for (const auto& point : *lattice)
    at.push_back({point.x, point.y, point.z});
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    Vector3d u;
    for (double& x : u)
      x = (random.uniform() - 0.5) * (side - 5);
    const Vector3d x = stretched.to_space(u);
    places.push_back({x[0], x[1], x[2]});
  }
  const auto result = interpolate(sampleFunctions(at, {waves}), {}, places);
  std::vector<double> errors;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3d x = vectorOf(places[i]);
    EXPECT_FALSE(std::isnan(result.getValue(0, i))) << shape << " " << ratio;
    errors.push_back(std::abs(result.getValue(0, i) - waves(x)));
    if (are_gradients_checked) {
      const Vector3d slope = gradientOf(waves, x);
      EXPECT_LT((vectorOf(result.getGradient(0, i)) - slope).norm(),
                0.1 + 0.1 * slope.norm());
    }
  }
  return errors;
}

/** Values between the nodes of stretched cells are as good as those between the nodes
 * of cubes: fits use the metric of the samples around. Where that changes from node to
 * node, as at a wall, they are 6 to 8 times as far off, and still within 0.005. */
TEST(BlendedFits, FitsStretchedCellsInTheirMetric)
{
  const double of_cubes = quantile(errorsBetweenNodes("lattice", 1.0, true), 0.95);
  EXPECT_LT(of_cubes, 0.02);
  for (const double ratio : {3.0, 10.0, 30.0})
    EXPECT_LT(quantile(errorsBetweenNodes("lattice", ratio, false), 0.95),
              1.5 * of_cubes)
        << ratio;
  EXPECT_LT(quantile(errorsBetweenNodes("rotated", 10.0, false), 0.95), 3.0 * of_cubes);
  EXPECT_LT(quantile(errorsBetweenNodes("wall", 10.0, false), 0.95), 10.0 * of_cubes);
  EXPECT_LT(quantile(errorsBetweenNodes("curved", 10.0, false), 0.95), 10.0 * of_cubes);
}

/** A field that samples do not resolve, on vertical lines: no value leaves the range of
 * the samples. Errors are too small at half of the places (43 % are covered). */
TEST(BlendedFits, DoesNotSwingBetweenLines)
{
  Places at;
  Random random(11);
  for (int line = 0; line < 40; ++line) {
    const double x = random.uniform(), y = random.uniform();
    for (int i = 0; i < 60; ++i)
      at.push_back({static_cast<float>(x), static_cast<float>(y), i / 64.0});
  }
  const Function rough = [](const Vector3d& x) {
    return std::sin(91.0 * x[0] + 57.0 * x[1]) + 0.5 * std::sin(300.0 * x[2] * x[0]);
  };
  InterpolationParameters parameters;
  parameters.extrapolate = true;
  const Places places = randomPlaces(2000, 12, 0.05, 0.9);
  const auto result = interpolate(sampleFunctions(at, {rough}), parameters, places);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LT(std::abs(result.getValue(0, i)), 2.0);
    covered += std::abs(result.getValue(0, i) - rough(vectorOf(places[i]))) <=
               result.getError(0, i);
  }
  EXPECT_GE(covered, places.size() * 4 / 10);
}

/** Real cells around a fin, up to 1 : 1000: trilinear values in random cells. */
/** Dives of a glider through layers of water: between them fits swing far out of what
 * was measured, with errors of thousandths. */
TEST(BlendedFits, StaysInTheRangeOfNeighborsBetweenDives)
{
  Random random(9);
  Places at;
  for (int dive = 0; dive < 12; ++dive)
    for (int i = 0; i < 150; ++i) {
      const double depth = (dive % 2 == 0 ? i : 150 - i) / 150.0;
      at.push_back({15.0 * (dive + i / 150.0) + 0.02 * random.uniform(),
                    4.0 * std::sin(0.4 * dive + i / 300.0) + 0.02 * random.uniform(),
                    -depth});
    }
  const Function layers = [](const Vector3d& x) {
    return 5.0 + 10.0 / (1.0 + std::exp(-60.0 * (x[2] + 0.2)));
  };
  const auto samples = sampleFunctions(at, {layers});
  Places queries;
  for (int i = 0; i < 3000; ++i)
    queries.push_back(
        {170.0 * random.uniform(), 8.0 * random.uniform() - 4.0, -random.uniform()});
  InterpolationParameters parameters;
  parameters.extrapolate = true;
  const auto fields = interpolate(samples, parameters, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    EXPECT_GT(fields.getValue(0, i), 5.0 - 0.5) << i;
    EXPECT_LT(fields.getValue(0, i), 15.0 + 0.5) << i;
  }
}

TEST(BlendedFits, ValuesInCellsOfBluntFin)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "no real data";
  const auto fin = loadDataset(dataFolder() + "/cfd/bluntfin.vts");
  const CloudView cloud = viewOf(fin.cloud);
  constexpr std::size_t dims[] = {40, 32, 32};
  ASSERT_EQ(cloud.count, dims[0] * dims[1] * dims[2]);
  InterpolationParameters parameters;
  parameters.fields = {"Density"};
  pcl::Indices all(cloud.count);
  std::iota(all.begin(), all.end(), 0);
  Report report;
  const detail::FieldInterpolator nodes(cloud, all, parameters, 0, report);
  const ScalarField density(cloud.fields, "Density");
  Random random(1);
  Places places;
  std::vector<double> truth;
  for (int i = 0; i < 3000; ++i) {
    std::size_t cell[3];
    double part[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double along = random.uniform() * static_cast<double>(dims[axis] - 1);
      cell[axis] = static_cast<std::size_t>(along);
      part[axis] = along - static_cast<double>(cell[axis]);
    }
    std::array<double, 3> place{};
    double value = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      std::size_t at[3];
      double weight = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t side = corner >> axis & 1u;
        at[axis] = cell[axis] + side;
        weight *= side ? part[axis] : 1.0 - part[axis];
      }
      const std::size_t node = (at[2] * dims[1] + at[1]) * dims[0] + at[0];
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] += weight * static_cast<double>(cloud.xyz(node)[axis]);
      value += weight * density.read(cloud.point(node));
    }
    places.push_back(place);
    truth.push_back(value);
  }
  const auto result = nodes.interpolate(places, 0, report);
  double mean = 0.0, variance = 0.0, squares = 0.0;
  std::vector<double> errors;
  for (const double value : truth)
    mean += value / static_cast<double>(truth.size());
  for (const double value : truth)
    variance += (value - mean) * (value - mean) / static_cast<double>(truth.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::isnan(result.getValue(0, i))) {
      errors.push_back(std::abs(result.getValue(0, i) - truth[i]) /
                       std::sqrt(variance));
      squares += errors.back() * errors.back();
    }
  EXPECT_GT(errors.size(), 2000u);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(errors.size())), 0.06);
  EXPECT_LT(quantile(errors, 0.95), 0.1);
}

} // namespace test_blended_fits
