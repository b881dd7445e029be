// SPDX-License-Identifier: BSD-3-Clause
// Folds, and what leaving them out tells of a model.
#include "common/scalar_field.h"
#include "support/interpolation_cases.h"
#include "support/messages.h"
#include <pcl_uvol/interpolation/cross_validation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace test_cross_validation {

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

pcl::Indices
allOf(const pcl::PCLPointCloud2& cloud)
{
  pcl::Indices indices(cloud.width);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

std::vector<std::size_t>
sizesOf(const Folds& folds, std::size_t count)
{
  std::vector<std::size_t> sizes(folds.size(), 0);
  for (std::size_t i = 0; i < count; ++i)
    ++sizes[folds[i]];
  return sizes;
}

TEST(Folds, RandomOnesAreEven)
{
  for (const std::size_t size : sizesOf(Folds::byRandom(1003, 10), 1003)) {
    EXPECT_GE(size, 100u);
    EXPECT_LE(size, 101u);
  }
  EXPECT_THROW(Folds::byRandom(10, 1), InvalidArgument);
  EXPECT_THROW(Folds::byRandom(10, 11), InvalidArgument);
}

TEST(Folds, BlocksAreCompact)
{
  const auto cloud = sampleFunctions(randomPlaces(4000, 1), {franke});
  const CloudView view = viewOf(cloud);
  const Folds folds = Folds::byBlocks(view, 4, 1), same = Folds::byBlocks(view, 4, 3);
  for (const std::size_t size : sizesOf(folds, 4000))
    EXPECT_NEAR(static_cast<double>(size), 1000.0, 130.0);
  // Most points have their nearest neighbour in their own fold; a quarter by chance.
  std::size_t together = 0;
  for (std::size_t i = 0; i < 4000; i += 10) {
    EXPECT_EQ(folds[i], same[i]);
    std::size_t nearest = 0;
    float sq_least = 10.0f;
    for (std::size_t j = 0; j < 4000; ++j) {
      float sq_dist = 0.0f;
      for (int axis = 0; axis < 3; ++axis)
        sq_dist += (view.xyz(i)[axis] - view.xyz(j)[axis]) *
                   (view.xyz(i)[axis] - view.xyz(j)[axis]);
      if (j != i && sq_dist < sq_least) {
        sq_least = sq_dist;
        nearest = j;
      }
    }
    together += folds[i] == folds[nearest];
  }
  EXPECT_GT(together, 300u);
}

TEST(Folds, PointsOfOneValueStayTogether)
{
  const auto cloud =
      sampleFunctions(randomPlaces(1000, 2),
                      {[](const Vector3d& x) { return std::floor(20.0 * x[0]); }});
  const CloudView view = viewOf(cloud);
  const Folds folds = Folds::byField(view, "f0", 5);
  const ScalarField field(view.fields, "f0");
  std::vector<std::size_t> fold_of(20, 9);
  for (std::size_t i = 0; i < 1000; ++i) {
    const auto value = static_cast<std::size_t>(field.read(view.point(i)));
    if (fold_of[value] == 9)
      fold_of[value] = folds[i];
    EXPECT_EQ(folds[i], fold_of[value]);
  }
  for (const std::size_t size : sizesOf(folds, 1000))
    EXPECT_NEAR(static_cast<double>(size), 200.0, 60.0);
  EXPECT_THROW(Folds::byField(view, "f0", 21), InvalidArgument);
  EXPECT_THROW(Folds::byField(view, "f7", 2), InvalidArgument);
}

/** Each well at a corner of a square is outside of the other three. */
TEST(CrossValidation, WarnsWhereNoHeldOutSampleHasAValue)
{
  Places places;
  for (int well = 0; well < 4; ++well)
    for (int i = 0; i < 40; ++i)
      places.push_back({static_cast<double>(well % 2),
                        static_cast<double>(well / 2),
                        0.02 * static_cast<double>(i)});
  const auto cloud = sampleFunctions(
      places, {franke, [](const Vector3d& x) { return x[0] + 2.0 * x[1]; }});
  const CloudView view = viewOf(cloud);
  InterpolationParameters parameters;
  parameters.fields = {"f0"};
  parameters.model = InterpolationModel::Kriging;
  const auto test = [&](const Folds& folds) {
    Report report;
    const auto scores =
        crossValidate(view, allOf(cloud), parameters, folds, 0, 0, report);
    EXPECT_EQ(160u, scores[0].tested);
    const bool is_told = std::any_of(
        report.warnings.begin(), report.warnings.end(), [](const Message& warning) {
          return warning.code == "nothing_covered" &&
                 numberOf(warning, "tested") == 160.0;
        });
    EXPECT_EQ(scores[0].covered == 0, is_told);
    EXPECT_EQ(scores[0].covered == 0, std::isnan(scores[0].rms));
    return scores[0].covered;
  };
  EXPECT_EQ(0u, test(Folds::byField(view, "f1", 4)));
  EXPECT_GT(test(Folds::byRandom(160, 4)), 80u);
  parameters.extrapolate = true;
  EXPECT_EQ(160u, test(Folds::byField(view, "f1", 4)));
}

TEST(CrossValidation, DistinguishesGoodModelsFromBadOnes)
{
  const auto cloud = sampleFunctions(
      randomPlaces(3000, 3), {franke, [](const Vector3d& x) { return 2.0 + x[0]; }});
  const CloudView view = viewOf(cloud);
  const Folds folds = Folds::byRandom(3000, 5);
  InterpolationParameters parameters;
  parameters.fields = {"f0", "f1"};
  Report report;
  const auto score = [&](InterpolationModel model) {
    parameters.model = model;
    return crossValidate(view, allOf(cloud), parameters, folds, 0, 0, report);
  };
  const auto fit = score(InterpolationModel::Fit),
             natural = score(InterpolationModel::Sibson),
             nearest = score(InterpolationModel::Nearest);
  ASSERT_EQ(fit.size(), 2u);
  EXPECT_EQ(fit[0].field, "f0");
  EXPECT_EQ(fit[0].tested, 3000u);
  EXPECT_GT(fit[0].covered, 2950u);
  EXPECT_LT(2.0 * fit[0].rms, natural[0].rms);
  EXPECT_LT(2.0 * natural[0].rms, nearest[0].rms);
  EXPECT_LT(fit[1].rms, 1e-9);
  EXPECT_LT(std::abs(fit[0].bias), fit[0].rms);
  EXPECT_GT(fit[0].share, 0.6);
  EXPECT_TRUE(std::isnan(nearest[0].share));
}

/** The errors of the nearest sample's value, pair by pair. */
TEST(CrossValidation, CountsErrorsRight)
{
  const auto cloud = sampleFunctions({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {6, 0, 0}},
                                     {[](const Vector3d& x) { return x[0] * x[0]; }});
  const CloudView view = viewOf(cloud);
  InterpolationParameters parameters;
  parameters.fields = {"f0"};
  parameters.model = InterpolationModel::Nearest;
  parameters.extrapolate = true;
  Report report;
  const auto scores = crossValidate(
      view, allOf(cloud), parameters, Folds::byRandom(4, 4), 0, 1, report);
  // 0 gets 1, 1 gets 0, 9 gets 1, 36 gets 9.
  EXPECT_NEAR(scores[0].bias, (1.0 - 1.0 - 8.0 - 27.0) / 4.0, 1e-12);
  EXPECT_NEAR(scores[0].rms, std::sqrt((1.0 + 1.0 + 64.0 + 729.0) / 4.0), 1e-12);
  EXPECT_EQ(scores[0].covered, 4u);
  const auto some = crossValidate(
      view, allOf(cloud), parameters, Folds::byRandom(4, 2), 1, 1, report);
  EXPECT_EQ(some[0].tested, 2u);
}

} // namespace test_cross_validation
