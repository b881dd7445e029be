// SPDX-License-Identifier: BSD-3-Clause
// The field between samples: what every model has to keep to.
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/interpolation_cases.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test_field_interpolation {

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

InterpolationParameters
parametersOf(InterpolationModel model)
{
  InterpolationParameters parameters;
  parameters.model = model;
  return parameters;
}

std::vector<InterpolationModel>
allModels()
{
  std::vector<InterpolationModel> models;
  for (const auto& word : listWords(InterpolationModel()))
    if (std::find(models.begin(), models.end(), word.value) == models.end())
      models.push_back(word.value);
  return models;
}

bool
areEqual(const InterpolatedFields& a, const InterpolatedFields& b)
{
  const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
    return x.size() == y.size() &&
           std::equal(x.begin(), x.end(), y.begin(), [](double p, double q) {
             return p == q || (std::isnan(p) && std::isnan(q));
           });
  };
  return same(a.values, b.values) && same(a.errors, b.errors) &&
         same(a.gradients, b.gradients) && a.support == b.support;
}

class EveryModel : public testing::TestWithParam<InterpolationModel> {
protected:
  InterpolationParameters parameters_ = parametersOf(GetParam());
};

INSTANTIATE_TEST_SUITE_P(FieldInterpolation,
                         EveryModel,
                         testing::ValuesIn(allModels()),
                         [](const auto& tested) {
                           return std::string(toWord(tested.param));
                         });

TEST_P(EveryModel, ConstantStaysWhatItIs)
{
  const auto samples =
      sampleFunctions(randomPlaces(500, 1), {[](const Vector3d&) { return 1.25; }});
  const auto result = interpolate(samples, parameters_, randomPlaces(200, 2));
  for (std::size_t i = 0; i < result.size; ++i) {
    if (result.support[i] == FieldSupport::Outside)
      continue;
    EXPECT_EQ(result.values[i], 1.25);
    for (const double along : result.getGradient(0, i))
      EXPECT_EQ(along, 0.0);
    EXPECT_FALSE(result.errors[i] > 0.0);
  }
}

TEST_P(EveryModel, FollowsAxesThatAreTurned)
{
  const Eigen::Array3d angles(30.0, 40.0, 15.0);
  const Eigen::Matrix3d rows = detail::StretchAxes(angles).getRows();
  const Places places = randomPlaces(1500, 3), queries = randomPlaces(300, 4, 0.1, 0.9);
  const auto samples = sampleFunctions(places, {franke});
  parameters_.scale = {1.0f, 2.0f, 1.5f};
  const auto expected = [&] { // of samples and queries that are turned by hand
    auto turned = samples;
    detail::StretchAxes(angles).turn(turned);
    Places seen = queries;
    for (auto& place : seen) {
      const Vector3d at = rows * Vector3d(place.data());
      place = {at[0], at[1], at[2]};
    }
    return interpolate(turned, parameters_, seen);
  }();
  parameters_.rotation = angles;
  const auto result = interpolate(samples, parameters_, queries);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < result.size; ++i) {
    if (std::isnan(expected.values[i]) || std::isnan(result.values[i]))
      continue;
    ++covered;
    EXPECT_NEAR(result.values[i], expected.values[i], 1e-6);
    const Vector3d found(result.getGradient(0, i).data()),
        seen(expected.getGradient(0, i).data());
    EXPECT_LT((found - rows.transpose() * seen).norm(), 1e-4 * (1.0 + seen.norm()));
  }
  EXPECT_GT(covered, 200u);
  parameters_.rotation = {0.0, 95.0, 0.0};
  EXPECT_THROW(interpolate(samples, parameters_, queries), InvalidArgument);
}

TEST_P(EveryModel, AnswersDependOnTheQueryAlone)
{
  const auto samples =
      sampleFunctions(randomPlaces(3000, 3),
                      {franke, [](const Vector3d& x) { return x.squaredNorm(); }});
  Places places = randomPlaces(1500, 4, -0.2, 1.2);
  const auto result = interpolate(samples, parameters_, places, 2, 1);
  EXPECT_TRUE(areEqual(result, interpolate(samples, parameters_, places, 2, 4)));
  // Backwards, and every other one only.
  Places others;
  for (std::size_t i = places.size(); i >= 2; i -= 2)
    others.push_back(places[i - 1]);
  const auto again = interpolate(samples, parameters_, others, 2, 3);
  for (std::size_t j = 0; j < others.size(); ++j) {
    const std::size_t i = places.size() - 1 - 2 * j;
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_TRUE(again.getValue(f, j) == result.getValue(f, i) ||
                  std::isnan(result.getValue(f, i)));
      EXPECT_EQ(std::isnan(again.getValue(f, j)), std::isnan(result.getValue(f, i)));
    }
    EXPECT_EQ(again.support[j], result.support[i]);
  }
  // The order of the samples does not matter either.
  auto shuffled = samples;
  for (std::size_t i = 0; i < samples.width; ++i)
    std::copy_n(&samples.data[i * samples.point_step],
                samples.point_step,
                &shuffled.data[(i * 1009 % samples.width) * samples.point_step]);
  EXPECT_TRUE(areEqual(result, interpolate(shuffled, parameters_, places, 2, 1)));
}

TEST_P(EveryModel, FieldsInOnePassAreThoseOneByOne)
{
  const Places at = randomPlaces(2000, 5);
  const Function second = [](const Vector3d& x) { return std::sin(3.0 * x.sum()); };
  const Places places = randomPlaces(300, 6);
  const auto both =
      interpolate(sampleFunctions(at, {franke, second}), parameters_, places, 2);
  const auto one = interpolate(sampleFunctions(at, {second}), parameters_, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool has_value = !std::isnan(one.getValue(0, i));
    EXPECT_EQ(has_value, !std::isnan(both.getValue(1, i)));
    if (has_value) {
      EXPECT_EQ(both.getValue(1, i), one.getValue(0, i));
    }
  }
}

/** In units of length and value that are powers of two the same bytes come out. */
TEST_P(EveryModel, UnitsDoNotMatter)
{
  const Places at = randomPlaces(1500, 7), places = randomPlaces(300, 8);
  const auto scaled = [](Places of, double factor) {
    for (auto& place : of)
      for (double& x : place)
        x *= factor;
    return of;
  };
  const auto result = interpolate(sampleFunctions(at, {franke}), parameters_, places);
  for (const double length : {0x1p-40, 0x1p40})
    for (const double unit : {0x1p-300, 0x1p300}) {
      const auto other =
          interpolate(sampleFunctions(scaled(at, length), {[&](const Vector3d& x) {
                                        return unit * franke(x / length);
                                      }}),
                      parameters_,
                      scaled(places, length));
      for (std::size_t i = 0; i < places.size(); ++i) {
        ASSERT_EQ(other.support[i], result.support[i]);
        if (std::isnan(result.getValue(0, i)))
          continue;
        EXPECT_NEAR(other.getValue(0, i) / unit, result.getValue(0, i), 1e-12);
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(other.getGradient(0, i)[axis] * length / unit,
                      result.getGradient(0, i)[axis],
                      1e-9);
      }
    }
}

TEST_P(EveryModel, OutsideThereIsNothingUnlessAskedFor)
{
  const auto samples = sampleFunctions(randomPlaces(2000, 9), {franke});
  const Places places{
      {2.0, 0.5, 0.5}, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {0.5, 0.5, 40}};
  Report report;
  const auto result = interpolate(samples, parameters_, places, 1, 0, &report);
  EXPECT_EQ(report.getCount("outside"), 3u);
  EXPECT_EQ(report.getCount("queries"), 4u);
  for (const std::size_t i : {0, 1, 3}) {
    EXPECT_EQ(result.support[i], FieldSupport::Outside);
    EXPECT_TRUE(std::isnan(result.getValue(0, i)));
    EXPECT_TRUE(std::isnan(result.getError(0, i)));
    EXPECT_TRUE(std::isnan(result.getGradient(0, i)[1]));
  }
  EXPECT_EQ(result.support[2], FieldSupport::Measured);
  EXPECT_NEAR(result.getValue(0, 2), franke({0.5, 0.5, 0.5}), 0.2);
  parameters_.extrapolate = true;
  const auto extrapolated = interpolate(samples, parameters_, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_TRUE(std::isfinite(extrapolated.getValue(0, i)));
    EXPECT_EQ(extrapolated.support[i], result.support[i]);
  }
}

TEST_P(EveryModel, QueriesWithoutAPlaceAreCounted)
{
  const auto samples = sampleFunctions(randomPlaces(500, 10), {franke});
  const Places places{{nan, 0.5, 0.5}, {0.5, infinity, 0.5}, {0.5, 0.5, 1e300}};
  parameters_.extrapolate = true;
  Report report;
  const auto result = interpolate(samples, parameters_, places, 1, 0, &report);
  EXPECT_EQ(report.getCount("invalid"), 3u);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(result.support[i], FieldSupport::Invalid);
    EXPECT_TRUE(std::isnan(result.getValue(0, i)));
  }
}

/** A file of isopoints and one of answers may lie in one folder: a number that both
 * have means the same. */
TEST(FieldSupportNumbers, MeanOneThingInAllFiles)
{
  const auto number = [](auto support) { return static_cast<int>(support); };
  EXPECT_EQ(number(FieldSupport::Measured), number(IsoSupport::Measured));
  EXPECT_EQ(number(FieldSupport::Bridged), number(IsoSupport::Bridged));
  EXPECT_EQ(number(FieldSupport::Rim), number(IsoSupport::Rim));
  for (const FieldSupport support :
       {FieldSupport::Reduced, FieldSupport::Invalid, FieldSupport::Outside})
    EXPECT_GT(number(support), number(IsoSupport::Predicted));
}

TEST_P(EveryModel, FieldsMayMissDifferentSamples)
{
  const Places at = randomPlaces(1500, 11), places = randomPlaces(100, 12, 0.3, 0.7);
  const Function holey = [](const Vector3d& x) {
    return std::fmod(1000.0 * x[0], 2.0) < 1.0 ? nan : x[1];
  };
  Places kept;
  for (const auto& place : at)
    if (!std::isnan(holey(vectorOf(place))))
      kept.push_back(place);
  const auto both =
      interpolate(sampleFunctions(at, {holey, franke}), parameters_, places, 2);
  const auto first = interpolate(sampleFunctions(kept, {holey}), parameters_, places);
  const auto second = interpolate(sampleFunctions(at, {franke}), parameters_, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(both.getValue(0, i), first.getValue(0, i));
    EXPECT_EQ(both.getValue(1, i), second.getValue(0, i));
  }
}

/** Whatever the layout, and however few samples: a number or NaN with a flag. */
TEST_P(EveryModel, SurvivesEveryLayout)
{
  for (const std::string& shape : cloudShapes())
    for (const std::size_t n : {1, 2, 3, 5, 9, 17, 40, 42, 300}) {
      const auto cloud = makeCloud(shape, n, 13);
      pcl::PCLPointCloud2 samples;
      pcl::toPCLPointCloud2(*cloud, samples);
      pcl::Indices indices(cloud->size());
      for (std::size_t i = 0; i < indices.size(); ++i)
        indices[i] = static_cast<int>(i);
      parameters_.extrapolate = true;
      Report report;
      const detail::FieldInterpolator interpolator(
          viewOf(samples), indices, parameters_, 0, report);
      Places places = randomPlaces(20, 14, -1.0, 2.0);
      for (const auto& point : *cloud)
        places.push_back({point.x, point.y, point.z});
      const auto result = interpolator.interpolate(places, 0, report);
      for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_TRUE(std::isfinite(result.getValue(0, i)))
            << shape << " " << n << " at " << vectorOf(places[i]).transpose();
    }
}

TEST_P(EveryModel, StageKeepsItsModelUntilSomethingChanges)
{
  const auto cloud = makeCloud("uniform", 2000, 15);
  const auto queries = makeCloud("uniform", 50, 16);
  FieldInterpolation<pcl::PointXYZI> interpolation;
  InterpolatedFields first, second;
  EXPECT_THROW(interpolation.interpolate(*queries, first), InvalidArgument);
  interpolation.setInputCloud(cloud);
  interpolation.setParameters(parameters_);
  interpolation.interpolate(*queries, first);
  ASSERT_EQ(first.names, std::vector<std::string>{"intensity"});
  const auto builds = [&] {
    const auto& times = interpolation.getReport().milliseconds;
    return std::any_of(times.begin(), times.end(), [](const auto& time) {
      return time.first == "tree";
    });
  };
  EXPECT_TRUE(builds());
  interpolation.interpolate(*queries, second);
  EXPECT_FALSE(builds());
  EXPECT_TRUE(areEqual(first, second));
  interpolation.setExtrapolate(true);
  interpolation.interpolate(*queries, second);
  EXPECT_TRUE(builds());
  const pcl::IndicesPtr half(new pcl::Indices);
  for (int i = 0; i < 1000; ++i)
    half->push_back(i);
  interpolation.setIndices(half);
  interpolation.interpolate(*queries, second);
  EXPECT_TRUE(builds());
  EXPECT_FALSE(areEqual(first, second));
}

TEST(FieldInterpolation, SamplesAtOnePlaceTakeTheirMedian)
{
  Places places = randomPlaces(300, 1);
  const Places once = places;
  places.insert(places.end(), once.begin(), once.end());
  std::vector<double> errors(300, 0.125);
  errors.resize(600, -0.125);
  std::size_t point = 0;
  const auto samples =
      sampleFunctions(places, {[&](const Vector3d&) { return 3.0 + errors[point++]; }});
  const auto result =
      interpolate(samples, parametersOf(InterpolationModel::Nearest), once);
  for (const double value : result.values)
    EXPECT_EQ(value, 3.0);
}

TEST(FieldInterpolation, RefusesWhatItCannotUse)
{
  const auto samples =
      sampleFunctions(randomPlaces(50, 17), {[](const Vector3d&) { return nan; }});
  const Places places{{0.5, 0.5, 0.5}};
  EXPECT_THROW(interpolate(samples, {}, places), InvalidArgument);
  EXPECT_THROW(interpolate(samples, {}, places, 2), InvalidArgument);
  const auto good = sampleFunctions(randomPlaces(50, 18), {franke});
  for (const float factor : {0.0f, -1.0f, std::numeric_limits<float>::infinity()}) {
    InterpolationParameters parameters;
    parameters.scale[1] = factor;
    EXPECT_THROW(interpolate(good, parameters, places), InvalidArgument);
  }
  InterpolationParameters parameters;
  parameters.shepard.k = 0;
  EXPECT_THROW(interpolate(good, parameters, places), InvalidArgument);
  parameters = {};
  parameters.shepard.power = 0.0;
  EXPECT_THROW(interpolate(good, parameters, places), InvalidArgument);
}

TEST(FieldInterpolation, ParametersGoThroughJson)
{
  InterpolationParameters parameters;
  parameters.fields = {"rho", "|vel|"};
  parameters.model = InterpolationModel::Shepard;
  parameters.extrapolate = true;
  parameters.shepard.k = 5;
  EXPECT_EQ(InterpolationParameters::fromJson(parameters.toJson()), parameters);
  EXPECT_NE(parameters, InterpolationParameters());
  EXPECT_THROW(InterpolationParameters::fromJson(R"({"model": "magic"})"),
               InvalidArgument);
}

TEST(FieldInterpolation, AnswersBecomeFieldsOfTheQueries)
{
  const auto samples = sampleFunctions(randomPlaces(1000, 19), {franke});
  pcl::PCLPointCloud2 points =
      sampleFunctions(randomPlaces(30, 20), {[](const Vector3d& x) { return x[0]; }});
  const auto result = interpolate(samples, {}, detail::readPlaces(viewOf(points)));
  // The points have another f0 of their own.
  EXPECT_EQ(
      appendFields(result, points),
      (std::vector<std::string>{"f0_2", "f0_2_error", "f0_2_gradient", "support"}));
  const ScalarField own(points.fields, "f0"), value(points.fields, "f0_2"),
      error(points.fields, "f0_2_error"), along(points.fields, "f0_2_gradient[2]"),
      support(points.fields, "support");
  ASSERT_EQ(points.data.size(), points.point_step * points.width);
  const CloudView view = viewOf(points);
  for (std::size_t i = 0; i < result.size; ++i) {
    const std::uint8_t* const point = view.point(i);
    EXPECT_EQ(own.read(point), static_cast<double>(view.xyz(i)[0]));
    EXPECT_EQ(value.read(point), result.getValue(0, i));
    EXPECT_EQ(error.read(point), result.getError(0, i));
    EXPECT_EQ(along.read(point), result.getGradient(0, i)[2]);
    EXPECT_EQ(support.read(point), static_cast<double>(result.support[i]));
  }
  points.width -= 1;
  EXPECT_THROW(appendFields(result, points), InvalidArgument);
}

} // namespace test_field_interpolation
