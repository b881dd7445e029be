// SPDX-License-Identifier: BSD-3-Clause
// The model that samples left out choose, and what is told of answers.
#include "common/random.h"
#include "interpolation/answer_summary.h"
#include "support/interpolation_cases.h"
#include "support/messages.h"
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace test_model_choice {

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

pcl::Indices
allOf(const pcl::PCLPointCloud2& cloud)
{
  pcl::Indices indices(cloud.width);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

ModelChoice
choose(const pcl::PCLPointCloud2& cloud,
       const InterpolationParameters& parameters = {},
       unsigned threads = 0)
{
  Report report;
  return chooseModel(viewOf(cloud), allOf(cloud), parameters, threads, report);
}

/** A number without any relation to the place. */
double
noise(const Vector3d& x)
{
  return x[0] * 1e6 - std::floor(x[0] * 1e6);
}

TEST(ModelChoice, SamplesAlongLinesAreLeftOutInBlocks)
{
  // Ten straight tracks of 300 samples: within a track local cubics are exact to many
  // digits, and beside it they are not to be trusted.
  Places places;
  for (int track = 0; track < 10; ++track)
    for (int i = 0; i < 300; ++i)
      places.push_back({i / 300.0,
                        0.1 * track + 1e-4 * std::sin(7.0 * i),
                        0.3 * std::sin(2.0 * track) + 1e-4 * std::cos(5.0 * i)});
  const auto tracks = sampleFunctions(places, {franke});
  Report report;
  const auto by_random = chooseModel(
      viewOf(tracks), allOf(tracks), {}, Folds::byRandom(places.size(), 10), 0, report);
  const auto by_blocks = chooseModel(viewOf(tracks),
                                     allOf(tracks),
                                     {},
                                     Folds::byBlocks(viewOf(tracks), 10, 0),
                                     0,
                                     report);
  // Random folds leave neighbours along the track.
  EXPECT_LT(by_random.scores.front().error, 0.25 * by_blocks.scores.front().error);
  const ModelChoice choice = choose(tracks);
  EXPECT_NE(choice.scores.front().model, InterpolationModel::Fit);
  ASSERT_EQ(choice.scores.size(), by_blocks.scores.size());
  for (std::size_t i = 0; i < choice.scores.size(); ++i) {
    EXPECT_EQ(choice.scores[i].model, by_blocks.scores[i].model);
    EXPECT_EQ(choice.scores[i].error, by_blocks.scores[i].error);
  }
}

TEST(ModelChoice, SmoothFieldsGetFitsAndNoiseGetsMeans)
{
  const auto smooth = sampleFunctions(randomPlaces(3000, 1), {franke});
  const ModelChoice choice = choose(smooth);
  ASSERT_EQ(choice.scores.size(), 5u);
  EXPECT_EQ(choice.scores.front().model, InterpolationModel::Fit);
  EXPECT_EQ(choice.scores.back().model, InterpolationModel::Nearest);
  EXPECT_GT(choice.tested, 700u); // of 900: those within the hull of the others
  EXPECT_LE(choice.tested, 900u);
  EXPECT_LT(3.0 * choice.scores[0].error, choice.scores[1].error);

  const ModelChoice of_noise = choose(sampleFunctions(randomPlaces(3000, 2), {noise}));
  EXPECT_EQ(of_noise.scores.front().model, InterpolationModel::Kriging);
  // The mean of all is off by the spread, another sample by sqrt(2) times that.
  EXPECT_NEAR(of_noise.scores.front().error, 1.0, 0.06);
  EXPECT_NEAR(of_noise.scores.back().error, std::sqrt(2.0), 0.12);
}

TEST(ModelChoice, DependsNeitherOnThreadsNorOnUnits)
{
  const auto cloud =
      sampleFunctions(randomPlaces(1500, 3),
                      {franke, [](const Vector3d& x) { return 1e9 * franke(x); }});
  InterpolationParameters one, other;
  one.fields = {"f0"};
  other.fields = {"f1"};
  const ModelChoice a = choose(cloud, one, 1), b = choose(cloud, other, 3);
  ASSERT_EQ(a.scores.size(), b.scores.size());
  EXPECT_EQ(a.tested, b.tested);
  for (std::size_t i = 0; i < a.scores.size(); ++i) {
    EXPECT_EQ(a.scores[i].model, b.scores[i].model);
    EXPECT_NEAR(a.scores[i].error, b.scores[i].error, 1e-6 * a.scores[i].error);
  }
  const ModelChoice again = choose(cloud, one, 3);
  for (std::size_t i = 0; i < a.scores.size(); ++i)
    EXPECT_EQ(a.scores[i].error, again.scores[i].error);
}

TEST(ModelChoice, ModelsThatCannotBeAreLeftOut)
{
  // In a plane nothing has natural neighbours in space.
  auto places = randomPlaces(800, 4);
  for (auto& place : places)
    place[2] = 0.5;
  const ModelChoice flat = choose(sampleFunctions(places, {franke}));
  EXPECT_GE(flat.scores.size(), 3u);
  for (const ModelScore& score : flat.scores)
    EXPECT_NE(score.model, InterpolationModel::Sibson);
  // Particles bring SPH in.
  const auto particles = sampleFunctions(randomPlaces(800, 5),
                                         {franke, [](const Vector3d&) { return 0.1; }});
  InterpolationParameters parameters;
  parameters.fields = {"f0"};
  parameters.sph.length_field = "f1";
  const ModelChoice with_sph = choose(particles, parameters);
  EXPECT_EQ(1,
            std::count_if(with_sph.scores.begin(),
                          with_sph.scores.end(),
                          [](const ModelScore& score) {
                            return score.model == InterpolationModel::Sph;
                          }));
  parameters.sph.length_field = "h";
  EXPECT_EQ(choose(particles, parameters).scores.size(), 5u);
  parameters.fields = {"rho"};
  EXPECT_THROW(choose(particles, parameters), InvalidArgument);
}

TEST(ModelChoice, AFewSamplesAreNoChoice)
{
  const auto cloud = sampleFunctions(randomPlaces(9, 6), {franke});
  Report report;
  const auto choice = chooseModel(viewOf(cloud), allOf(cloud), {}, 0, report);
  EXPECT_EQ(choice.scores.front().model, InterpolationModel::Fit);
  EXPECT_EQ(choice.tested, 0u);
  EXPECT_EQ(listCodes(report.warnings),
            std::vector<std::string>{"few_samples_for_choice"});
}

TEST(ModelChoice, TheAutomaticModelIsTheOneChosen)
{
  const auto cloud = sampleFunctions(randomPlaces(1000, 7), {noise});
  InterpolationParameters parameters;
  parameters.model = InterpolationModel::Auto;
  const Places places = randomPlaces(20, 8);
  const auto automatic = interpolate(cloud, parameters, places);
  parameters.model = choose(cloud).scores.front().model;
  EXPECT_EQ(automatic.values, interpolate(cloud, parameters, places).values);
}

/** Answers of one field with a support for each. */
InterpolatedFields
answersOf(const std::vector<double>& values, const std::vector<double>& errors)
{
  InterpolatedFields answers;
  answers.names = {"f0"};
  answers.size = values.size();
  answers.values = values;
  answers.errors = errors;
  answers.support.assign(values.size(), FieldSupport::Measured);
  return answers;
}

/** The warnings about answers to 10 queries.
 * \param kinds of support of the first ones */
std::vector<Message>
warningsOf(InterpolatedFields answers, const std::vector<FieldSupport>& kinds)
{
  std::copy(kinds.begin(), kinds.end(), answers.support.begin());
  // Values 0 and 1, spread 0.5.
  const auto cloud =
      sampleFunctions({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                      {[](const Vector3d& x) { return x[0] < 1.5 ? 0.0 : 1.0; }});
  detail::AnswerSummary summary(viewOf(cloud), {0, 1, 2, 3}, {"f0"});
  summary.add(answers);
  Report report;
  summary.warn(report);
  return report.warnings;
}

TEST(AnswerSummary, WarnsOnceWhereMostIsUncertain)
{
  const std::vector<double> fine(10, 0.5), small(10, 0.1), none(10, nan);
  EXPECT_TRUE(warningsOf(answersOf(fine, small), {}).empty());
  EXPECT_TRUE(warningsOf(answersOf(fine, small),
                         std::vector<FieldSupport>(5, FieldSupport::Rim))
                  .empty());
  EXPECT_TRUE(warningsOf(answersOf(fine, none), {}).empty());
  const auto expectOne = [](const std::vector<Message>& warnings,
                            const Message& expected) {
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], expected);
  };
  expectOne(warningsOf(answersOf(none, none),
                       std::vector<FieldSupport>(6, FieldSupport::Outside)),
            {"queries_outside", {{"outside", 6}, {"queries", 10}, {"has_values", 0}}});
  expectOne(warningsOf(answersOf(fine, small),
                       std::vector<FieldSupport>(6, FieldSupport::Outside)),
            {"queries_outside", {{"outside", 6}, {"queries", 10}, {"has_values", 1}}});
  expectOne(warningsOf(answersOf(none, none),
                       std::vector<FieldSupport>(6, FieldSupport::Invalid)),
            {"invalid_queries", {{"invalid", 6}, {"queries", 10}}});
  expectOne(warningsOf(answersOf(fine, small),
                       {FieldSupport::Rim,
                        FieldSupport::Rim,
                        FieldSupport::Bridged,
                        FieldSupport::Bridged,
                        FieldSupport::Reduced,
                        FieldSupport::Reduced}),
            {"weak_support", {{"weak", 6}, {"queries", 10}}});
  expectOne(warningsOf(answersOf(fine, std::vector<double>(10, 0.51)), {}),
            {"uncertain_values", {{"uncertain", 10}, {"values", 10}, {"field", "f0"}}});
  std::vector<double> wild = fine;
  wild[3] = 2.01;
  wild[4] = -1.01;
  wild[5] = 1.99;
  expectOne(warningsOf(answersOf(wild, small), {}),
            {"overshoots", {{"exceeding", 2}, {"values", 10}, {"field", "f0"}}});
}

TEST(AnswerSummary, ReportsTheRangeOfAllBlocks)
{
  const auto cloud = sampleFunctions({{0, 0, 0}, {1, 0, 0}}, {franke});
  detail::AnswerSummary summary(viewOf(cloud), {0, 1}, {"f0"});
  summary.add(answersOf({nan, 3.0}, {}));
  summary.add(answersOf({-2.0, nan, 1.0}, {}));
  const auto& field = summary.getFields().front();
  EXPECT_EQ(field.count, 3u);
  EXPECT_EQ(field.low, -2.0);
  EXPECT_EQ(field.high, 3.0);
  EXPECT_EQ(field.uncertain, 0u);
}

} // namespace test_model_choice
