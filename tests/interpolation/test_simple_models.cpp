// SPDX-License-Identifier: BSD-3-Clause
// The nearest sample and inverse distances, against all samples tried.
#include "support/interpolation_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_simple_models {

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

/** Samples by their distance from a place. */
std::vector<Vector3d>
sortByDistance(const Places& places, const Vector3d& x)
{
  std::vector<Vector3d> sorted;
  for (const auto& place : places)
    sorted.push_back(vectorOf(place));
  std::sort(sorted.begin(), sorted.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - x).norm() < (b - x).norm();
  });
  return sorted;
}

TEST(SimpleModels, TheNearestSampleHasItsValue)
{
  const Places samples = randomPlaces(300, 1), queries = randomPlaces(100, 2);
  InterpolationParameters parameters;
  parameters.model = InterpolationModel::Nearest;
  parameters.extrapolate = true;
  const auto found =
      interpolate(sampleFunctions(samples, {franke}), parameters, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Vector3d x = vectorOf(queries[i]);
    EXPECT_EQ(franke(sortByDistance(samples, x)[0]), found.getValue(0, i));
    EXPECT_EQ(Vector3d::Zero(), vectorOf(found.getGradient(0, i)));
  }
}

TEST(SimpleModels, InverseDistancesAreAsShepardHasThem)
{
  const Places samples = randomPlaces(300, 3), queries = randomPlaces(60, 4);
  for (const double power : {1.0, 2.0, 3.5}) {
    InterpolationParameters parameters;
    parameters.model = InterpolationModel::Shepard;
    parameters.extrapolate = true;
    parameters.shepard.power = power;
    parameters.shepard.k = 9;
    const auto found =
        interpolate(sampleFunctions(samples, {franke}), parameters, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Vector3d x = vectorOf(queries[i]);
      const std::vector<Vector3d> near = sortByDistance(samples, x);
      const auto shepard = [&](const Vector3d& place) {
        double sum = 0.0, weights = 0.0;
        for (std::size_t j = 0; j < parameters.shepard.k; ++j) {
          const double weight = std::pow((near[j] - place).norm(), -power);
          sum += weight * franke(near[j]);
          weights += weight;
        }
        return sum / weights;
      };
      EXPECT_NEAR(shepard(x), found.getValue(0, i), 1e-12) << power;
      const Vector3d gradient = gradientOf(shepard, x);
      EXPECT_LT((gradient - vectorOf(found.getGradient(0, i))).norm(),
                1e-5 * (1.0 + gradient.norm()))
          << power;
    }
  }
}

} // namespace test_simple_models
