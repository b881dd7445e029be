// SPDX-License-Identifier: BSD-3-Clause
// Kriging of whole clouds: exact at samples, calibrated on simulated fields, the same
// in stretched and turned coordinates.
#include "common/random.h"
#include "support/environment.h"
#include "support/interpolation_cases.h"
#include "support/messages.h"

#include <gtest/gtest.h>

#include <cmath>

namespace test_kriging {

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

InterpolationParameters
krigingBy(VariogramKind kind)
{
  InterpolationParameters parameters;
  parameters.model = InterpolationModel::Kriging;
  parameters.kriging.variogram = kind;
  return parameters;
}

/** A random field of variance 1 with the covariance exp(-h / range), by waves whose
 * vectors have its spectrum. */
class SimulatedField {
public:
  SimulatedField(double range, std::uint64_t seed)
  {
    constexpr std::uint64_t waves = 800;
    for (std::uint64_t i = 0; i < waves; ++i) {
      const double size = range * std::abs(normalAt(seed, i, 3));
      vectors_.push_back(
          Vector3d(normalAt(seed, i, 0), normalAt(seed, i, 1), normalAt(seed, i, 2)) /
          size);
      phases_.push_back(2.0 * 3.14159265358979 * uniformAt(seed, i, 100));
    }
  }

  double
  operator()(const Vector3d& x) const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < vectors_.size(); ++i)
      sum += std::cos(vectors_[i].dot(x) + phases_[i]);
    return sum * std::sqrt(2.0 / static_cast<double>(vectors_.size()));
  }

private:
  std::vector<Vector3d> vectors_;
  std::vector<double> phases_;
};

TEST(Kriging, ExactAtSamplesWithoutNugget)
{
  const Places at = randomPlaces(800, 1);
  for (const VariogramKind kind : {VariogramKind::Spherical,
                                   VariogramKind::Exponential,
                                   VariogramKind::Matern32}) {
    auto parameters = krigingBy(kind);
    parameters.kriging.nugget = 0.0;
    const auto result = interpolate(sampleFunctions(at, {franke}), parameters, at);
    for (std::size_t i = 0; i < at.size(); ++i) {
      EXPECT_NEAR(result.getValue(0, i), franke(vectorOf(at[i])), 1e-9);
      EXPECT_LT(result.getError(0, i), 1e-5);
    }
  }
}

/** Errors mean what they say: two thirds of the values lie within one, 95 % within two,
 * with the variogram that was fitted. */
TEST(Kriging, CalibratedOnSimulatedFields)
{
  for (const double noise : {0.0, 0.3}) {
    std::size_t within_one = 0, within_two = 0, count = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const SimulatedField field(0.3, seed);
      std::uint64_t draw = 0;
      const auto samples =
          sampleFunctions(randomPlaces(2000, 10 + seed), {[&](const Vector3d& x) {
                            return field(x) + noise * normalAt(seed, draw++, 7);
                          }});
      const Places places = randomPlaces(500, 20 + seed, 0.05, 0.95);
      const auto result =
          interpolate(samples, krigingBy(VariogramKind::Exponential), places);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double truth =
            field(vectorOf(places[i])) + noise * normalAt(seed, draw++, 7);
        const double off = std::abs(result.getValue(0, i) - truth);
        within_one += off <= result.getError(0, i);
        within_two += off <= 2.0 * result.getError(0, i);
        ++count;
      }
    }
    const double all = static_cast<double>(count);
    EXPECT_NEAR(static_cast<double>(within_one) / all, 0.683, 0.05) << noise;
    EXPECT_NEAR(static_cast<double>(within_two) / all, 0.954, 0.03) << noise;
  }
}

TEST(Kriging, ConstantFieldsAreSaidToBe)
{
  Report report;
  const auto result = interpolate(
      sampleFunctions(randomPlaces(200, 30), {[](const Vector3d&) { return -7.5; }}),
      krigingBy(VariogramKind::Spherical),
      {{0.5, 0.5, 0.5}},
      1,
      0,
      &report);
  EXPECT_EQ(result.getValue(0, 0), -7.5);
  EXPECT_EQ(result.getError(0, 0), 0.0);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].code, "no_variogram");
  EXPECT_EQ(wordOf(report.warnings[0], "field"), "f0");
}

/** Ranges along turned axes are the same as coordinates along them. */
TEST(Kriging, AnisotropyIsAMetric)
{
  constexpr double angle = 0.5235987755982988; // 30 degrees
  const Places stretched = randomPlaces(1000, 31);
  // x' = turned by 30 degrees about z, y four times as wide.
  const auto turn = [&](const std::array<double, 3>& x) {
    const double y = 4.0 * x[1];
    return std::array<double, 3>{static_cast<double>(static_cast<float>(
                                     std::cos(angle) * x[0] - std::sin(angle) * y)),
                                 static_cast<double>(static_cast<float>(
                                     std::sin(angle) * x[0] + std::cos(angle) * y)),
                                 x[2]};
  };
  const auto turnedBack = [&](const Vector3d& x) {
    return Vector3d(std::cos(angle) * x[0] + std::sin(angle) * x[1],
                    (-std::sin(angle) * x[0] + std::cos(angle) * x[1]) / 4.0,
                    x[2]);
  };
  Places turned, places, turned_places;
  for (const auto& place : stretched)
    turned.push_back(turn(place));
  places = randomPlaces(100, 32, 0.2, 0.8);
  for (const auto& place : places)
    turned_places.push_back(turn(place));
  auto parameters = krigingBy(VariogramKind::Exponential);
  parameters.kriging.nugget = 0.01;
  parameters.kriging.psill = 0.2;
  parameters.kriging.range = 0.5;
  const auto even =
      interpolate(sampleFunctions(stretched, {franke}), parameters, places);
  parameters.kriging.ratios = {1.0f, 4.0f, 1.0f};
  parameters.kriging.rotation = {30.0f, 0.0f, 0.0f};
  parameters.extrapolate = true;
  const auto uneven = interpolate(sampleFunctions(turned, {[&](const Vector3d& x) {
                                                    return franke(turnedBack(x));
                                                  }}),
                                  parameters,
                                  turned_places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(uneven.getValue(0, i), even.getValue(0, i), 1e-4);
    EXPECT_NEAR(uneven.getError(0, i), even.getError(0, i), 1e-4);
    const Vector3d g = vectorOf(uneven.getGradient(0, i));
    EXPECT_NEAR(std::cos(angle) * g[0] + std::sin(angle) * g[1],
                even.getGradient(0, i)[0],
                2e-2);
  }
}

TEST(Kriging, TrendsGoOnWhereSamplesEnd)
{
  const Function linear = [](const Vector3d& x) { return 10.0 * x[0] - x[2]; };
  const auto samples = sampleFunctions(randomPlaces(1000, 33), {linear});
  auto parameters = krigingBy(VariogramKind::Exponential);
  parameters.kriging.psill = 0.1;
  parameters.kriging.range = 0.2;
  parameters.kriging.nugget = 0.0;
  parameters.kriging.trend = 1;
  parameters.extrapolate = true;
  const Places places{{0.5, 0.5, 0.5}, {1.3, 0.5, 0.5}, {-0.4, 1.2, 0.1}};
  const auto result = interpolate(samples, parameters, places);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(result.getValue(0, i), linear(vectorOf(places[i])), 1e-6);
}

/** One dense clump beside the place, few samples on the other sides. */
TEST(Kriging, OctantsLookAround)
{
  Places at = randomPlaces(400, 34, 0.52, 0.6);
  for (const auto& place : randomPlaces(400, 35))
    at.push_back(place);
  auto parameters = krigingBy(VariogramKind::Exponential);
  parameters.kriging.nugget = 0.0;
  parameters.kriging.psill = 1.0;
  parameters.kriging.range = 1.0;
  parameters.kriging.k = 16;
  const SimulatedField field(1.0, 3);
  const auto samples = sampleFunctions(at, {field});
  const Places places = randomPlaces(60, 36, 0.44, 0.5);
  const auto nearest = interpolate(samples, parameters, places);
  parameters.kriging.octants = true;
  const auto around = interpolate(samples, parameters, places);
  double sq_nearest = 0.0, sq_around = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    sq_nearest += std::pow(nearest.getError(0, i), 2);
    sq_around += std::pow(around.getError(0, i), 2);
  }
  EXPECT_LT(sq_around, sq_nearest);
}

/** From the same samples a block is the mean of the places in it, in any metric. */
TEST(Kriging, BlocksAreMeansOfTheirPlaces)
{
  const auto samples = sampleFunctions(randomPlaces(30, 41), {franke});
  auto parameters = krigingBy(VariogramKind::Exponential);
  parameters.kriging.nugget = 0.01;
  parameters.kriging.psill = 1.0;
  parameters.kriging.range = 0.5;
  parameters.kriging.ratios[1] = 0.5f;
  parameters.scale = {1.0f, 2.0f, 3.0f};
  parameters.rotation = {30.0, 40.0, 10.0};
  const std::array<double, 3> middle{0.5, 0.45, 0.55}, sides{0.4, 0.2, 0.0};
  Places places;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      places.push_back({middle[0] + (i - 1.5) / 4.0 * sides[0],
                        middle[1] + (j - 1.5) / 4.0 * sides[1],
                        middle[2]});
  const auto of_places = interpolate(samples, parameters, places);
  double mean = 0.0, error = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    mean += of_places.getValue(0, i) / 16.0;
    error += of_places.getError(0, i) / 16.0;
  }
  parameters.kriging.block = {0.4f, 0.2f, 0.0f};
  const auto of_block = interpolate(samples, parameters, {middle});
  EXPECT_NEAR(mean, of_block.getValue(0, 0), 1e-6);
  EXPECT_LT(of_block.getError(0, 0), 0.9 * error);
  EXPECT_GT(of_block.getError(0, 0), 0.0);
}

TEST(Kriging, RefusesImpossibleVariograms)
{
  const auto samples = sampleFunctions(randomPlaces(50, 37), {franke});
  const auto refuses = [&](const auto& change) {
    auto parameters = krigingBy(VariogramKind::Spherical);
    change(parameters.kriging);
    EXPECT_THROW(interpolate(samples, parameters, {{0.5, 0.5, 0.5}}), InvalidArgument);
  };
  refuses([](auto& kriging) { kriging.nugget = -1.0; });
  refuses([](auto& kriging) { kriging.psill = -1.0; });
  refuses([](auto& kriging) { kriging.range = 0.0; });
  refuses([](auto& kriging) { kriging.k = 0; });
  refuses([](auto& kriging) { kriging.k = 1000; });
  refuses([](auto& kriging) { kriging.trend = 3; });
  refuses([](auto& kriging) { kriging.block[1] = -1.0f; });
  refuses([](auto& kriging) { kriging.ratios[2] = 0.0f; });
}

} // namespace test_kriging
