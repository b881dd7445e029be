// SPDX-License-Identifier: BSD-3-Clause
// The hold-out test of the pipeline: what it says of surfaces whose truth is known.
#include "pipeline/hold_out.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <memory>
#include <numeric>

namespace test_validation {

using namespace pcl_uvol;

/** A sphere of radius 0.6 in a cube of samples; with noise, values that mean nothing.
 */
std::shared_ptr<Dataset>
makeSphere(std::size_t n, bool is_noise = false, float factor = 1.0f)
{
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  std::vector<float> track;
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    const auto noise = static_cast<float>(random.uniform() - 0.5);
    point.intensity = is_noise ? noise : 0.6f - point.getVector3fMap().norm();
    point.getVector3fMap() *= factor;
    cloud.push_back(point);
    const std::size_t number = i / 100;
    track.push_back(static_cast<float>(number));
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  setField(*samples, "track", track);
  return samples;
}

IsosurfacePipelineParameters
makeParameters(std::size_t folds)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {0.0};
  parameters.validation.folds = folds;
  return parameters;
}

void
expectEqual(const ValidationScore& a, const ValidationScore& b)
{
  EXPECT_EQ(a.tested, b.tested);
  EXPECT_EQ(a.covered, b.covered);
  EXPECT_EQ(a.beyond_error, b.beyond_error);
  for (const auto& [x, y] : {std::pair(a.side.predicted, b.side.predicted),
                             {a.side.base, b.side.base},
                             {a.side.nearest, b.side.nearest},
                             {a.side_of_field, b.side_of_field},
                             {a.field.predicted, b.field.predicted},
                             {a.field.base, b.field.base},
                             {a.field.nearest, b.field.nearest},
                             {a.side_everywhere, b.side_everywhere},
                             {a.side_beyond_error, b.side_beyond_error}})
    EXPECT_EQ(x, y);
}

TEST(Validation, FindsAWellSampledSurfaceRight)
{
  const auto samples = makeSphere(8000);
  for (const ValidateBy by :
       {ValidateBy::Random, ValidateBy::Blocks, ValidateBy::Field}) {
    auto parameters = makeParameters(5);
    parameters.validation.by = by;
    parameters.validation.field = "track";
    const auto result = uvol_test::runPipeline(samples, parameters);
    ASSERT_EQ(1u, result.validation.size());
    const ValidationScore& score = result.validation[0];
    EXPECT_EQ(8000u, score.tested);
    // A shell of twice 2 spacings of 0.09 about the sphere holds a fifth of the cube.
    EXPECT_GT(score.covered, 1200u);
    EXPECT_LT(score.covered, 4000u);
    EXPECT_GT(score.side.predicted, 0.98);
    EXPECT_GT(score.side.predicted, score.side.nearest);
    EXPECT_GT(score.field.predicted, 0.98);
    EXPECT_GT(score.side_beyond_error, 0.99);
    EXPECT_GT(score.beyond_error, score.covered / 2);
    // The sphere is 11 % of the cube.
    EXPECT_NEAR(1.0 - 4.0 / 3.0 * M_PI * 0.216 / 8.0, score.field.base, 0.01);
  }
}

/** The score is that of the definition, which each sample can tell for itself. */
TEST(Validation, CountsWhatItIsGiven)
{
  std::vector<HeldOutSample> samples;
  const auto add = [&](bool above, bool nearest, bool field, bool side, bool covered) {
    samples.push_back({0, above, nearest, field, side, covered, 1.0f, 0.5f});
  };
  add(true, true, false, true, true);
  add(true, false, true, true, true);
  add(true, true, true, false, true);
  add(false, false, false, false, false);
  samples.back().error = 2.0f;
  samples[0].error = 2.0f;
  const ValidationScore score = scoreHeldOut(samples);
  EXPECT_EQ(4u, score.tested);
  EXPECT_EQ(3u, score.covered);
  EXPECT_DOUBLE_EQ(2.0 / 3.0, score.side.predicted);
  EXPECT_DOUBLE_EQ(1.0, score.side.base);
  EXPECT_DOUBLE_EQ(2.0 / 3.0, score.side.nearest);
  // The surface and the nearest sample differ by +1, -1 and 0.
  EXPECT_DOUBLE_EQ(std::sqrt(2.0 / 3.0) / std::sqrt(3.0), score.side_error);
  EXPECT_DOUBLE_EQ(2.0 / 3.0, score.side_of_field);
  EXPECT_DOUBLE_EQ(0.75, score.side_everywhere);
  EXPECT_DOUBLE_EQ(0.75, score.field.predicted);
  EXPECT_DOUBLE_EQ(0.75, score.field.base);
  EXPECT_DOUBLE_EQ(0.75, score.field.nearest);
  EXPECT_EQ(2u, score.beyond_error);
  EXPECT_DOUBLE_EQ(0.5, score.side_beyond_error);
  EXPECT_TRUE(std::isnan(scoreHeldOut({}).side.predicted));
}

TEST(Validation, SaysWhoIsBetterThanTheSurface)
{
  // 100 samples: the surface tells 70 rightly, the nearest sample so many of the other
  // 30 and none, or some, of the 70 wrongly; 30 are below.
  IsosurfacePipelineParameters parameters;
  std::optional<SamplingSummary> sampling;
  const auto warn = [&](int gained, int lost, int below) {
    std::vector<HeldOutSample> samples;
    for (int i = 0; i < 100; ++i) {
      const bool is_above = i >= below, side = i < 70;
      const bool nearest = side ? i >= lost : i < 70 + gained;
      samples.push_back(
          {0, is_above, nearest == is_above, true, side == is_above, true, 0.5f, 1.0f});
    }
    Report report;
    warnOfScores({scoreHeldOut(samples)}, parameters, sampling, report);
    return report.warnings;
  };
  EXPECT_TRUE(warn(0, 0, 50).empty());
  EXPECT_TRUE(warn(5, 5, 50).empty());
  // 6 of 10 that differ speak for the nearest sample: 0.02 with an error of 0.0316.
  EXPECT_TRUE(warn(6, 4, 50).empty());
  // 7 of 10 do: 0.04 with one of 0.0314.
  ASSERT_EQ(1u, warn(7, 3, 50).size());
  const Message better = warn(7, 3, 50)[0];
  EXPECT_EQ("worse_than_nearest_on_lines", better.code);
  EXPECT_EQ(1.0, uvol_test::numberOf(better, "scale"));
  EXPECT_EQ(1.0, uvol_test::numberOf(better, "gaps"));
  const std::string options = better.text(ParameterNames::Options);
  EXPECT_LT(options.size(), 300u);
  for (const char* const option : {"-scale", "-fill-gaps"})
    EXPECT_NE(std::string::npos, options.find(option)) << options;
  EXPECT_EQ(70.0, uvol_test::numberOf(better, "surface"));
  EXPECT_EQ(74.0, uvol_test::numberOf(better, "nearest"));
  EXPECT_EQ(100.0, uvol_test::numberOf(better, "samples"));
  parameters.fill_gaps = true; // what was given is not advised
  parameters.automatic_scale = false;
  EXPECT_EQ(1.0, uvol_test::numberOf(warn(7, 3, 50)[0], "scale"));
  EXPECT_EQ(0.0, uvol_test::numberOf(warn(7, 3, 50)[0], "gaps"));
  sampling = SamplingSummary{{0.0, 0.0, 0.0, 1.0}, LocalDimension::Volume, 1.0f, 1.0f};
  ASSERT_EQ(1u, warn(7, 3, 50).size());
  EXPECT_EQ("worse_than_nearest_sample", warn(7, 3, 50)[0].code);
  EXPECT_EQ(4u, warn(7, 3, 50)[0].values.size()); // nothing is advised
  ASSERT_EQ(1u, warn(0, 0, 25).size());
  EXPECT_EQ("worse_than_baseline", warn(0, 0, 25)[0].code);
  EXPECT_EQ(75.0, uvol_test::numberOf(warn(0, 0, 25)[0], "baseline"));
  EXPECT_EQ(
      (std::vector<std::string>{"worse_than_baseline", "worse_than_nearest_sample"}),
      uvol_test::listCodes(warn(7, 3, 25)));
  Report none;
  warnOfScores({scoreHeldOut({})}, parameters, sampling, none);
  EXPECT_TRUE(none.warnings.empty());
}

TEST(Validation, SaysWhereErrorsAreTooSmall)
{
  // The surface tells all within its error rightly, and a part of those beyond it.
  const auto warn = [](int beyond, int wrong) {
    std::vector<HeldOutSample> samples;
    for (int i = 0; i < 200; ++i) {
      const bool is_above = i % 2 == 0, is_right = i >= wrong;
      samples.push_back({0,
                         is_above,
                         is_above == is_right,
                         true,
                         is_above == is_right,
                         true,
                         i < beyond ? 1.5f : 0.5f,
                         1.0f});
    }
    Report report;
    warnOfScores({scoreHeldOut(samples)}, {}, {}, report);
    return report.warnings;
  };
  EXPECT_TRUE(warn(29, 29).empty());
  EXPECT_TRUE(warn(30, 6).empty());
  ASSERT_EQ(1u, warn(30, 7).size());
  EXPECT_EQ("small_errors", warn(30, 7)[0].code);
  EXPECT_EQ(23.0, uvol_test::numberOf(warn(30, 7)[0], "percent"));
}

TEST(Validation, SaysThatNoiseHasNoSurface)
{
  const auto result = uvol_test::runPipeline(makeSphere(3000, true), makeParameters(5));
  const ValidationScore& score = result.validation.at(0);
  EXPECT_NEAR(0.5, score.side.predicted, 0.05);
  EXPECT_NEAR(0.5, score.field.predicted, 0.05);
}

TEST(Validation, KnowsThePartOfSamplesNearTheSurface)
{
  // Samples on a lattice of spacing 1 that is left out by planes: the 6 nearest that
  // remain lie at 1, 1 and four times at the root of 2.
  const double spacing = (2.0 + 4.0 * std::sqrt(2.0)) / 6.0;
  pcl::PointCloud<pcl::PointXYZI> cloud;
  std::vector<float> layer;
  for (int z = 0; z < 30; ++z)
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x) {
        pcl::PointXYZI point;
        point.x = static_cast<float>(x);
        point.y = static_cast<float>(y);
        point.z = static_cast<float>(z);
        point.intensity = 14.6f - point.z;
        cloud.push_back(point);
        layer.push_back(point.z);
      }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  setField(*samples, "layer", layer);
  auto parameters = makeParameters(30);
  parameters.validation.by = ValidateBy::Field;
  parameters.validation.field = "layer";
  parameters.isosurface.interpolation = Interpolation::Linear;
  Report report;
  const auto told = holdOut(
      {samples, nullptr, parameters},
      makeFolds(viewOf(samples->cloud), parameters.validation, 0),
      [&](const IsosurfacePipelineParameters& of_part,
          const pcl::IndicesPtr& use,
          const ProgressCallback&) {
        IsosurfacePipeline pipeline;
        pipeline.setInput(samples);
        pipeline.setParameters(of_part);
        pipeline.setIndices(use);
        return pipeline.run();
      },
      0,
      report);
  for (const HeldOutSample& sample : told.at(0)) {
    const auto& place = cloud[sample.point];
    if (std::min(place.x, place.y) < 3.0f || std::max(place.x, place.y) > 8.0f)
      continue;
    EXPECT_EQ(std::abs(place.z - 14.6f) <= 2.0 * spacing, sample.is_covered) << place.z;
    EXPECT_EQ(place.z < 14.6f, sample.is_above);
    EXPECT_EQ(sample.is_above, sample.is_side_above) << place.z;
  }
}

TEST(Validation, DoesNotDependOnThreadsOrUnits)
{
  auto parameters = makeParameters(4);
  const auto one =
      uvol_test::runPipeline(makeSphere(3000), parameters, 1).validation.at(0);
  expectEqual(one,
              uvol_test::runPipeline(makeSphere(3000), parameters, 4).validation.at(0));
  expectEqual(one,
              uvol_test::runPipeline(makeSphere(3000, false, 0x1p20f), parameters)
                  .validation.at(0));
}

TEST(Validation, LeavesTheSurfaceAsItIs)
{
  const auto samples = makeSphere(3000);
  EXPECT_EQ(uvol_test::runPipeline(samples, makeParameters(0)).surface.cloud.data,
            uvol_test::runPipeline(samples, makeParameters(3)).surface.cloud.data);
  EXPECT_TRUE(uvol_test::runPipeline(samples, makeParameters(0)).validation.empty());
}

TEST(Validation, HasOneScorePerIsovalue)
{
  auto parameters = makeParameters(3);
  parameters.isosurface.isovalues = {0.1, 5.0};
  const auto scores = uvol_test::runPipeline(makeSphere(3000), parameters).validation;
  ASSERT_EQ(2u, scores.size());
  EXPECT_GT(scores[0].covered, 0u);
  EXPECT_EQ(0u, scores[1].covered); // out of the range of values
  EXPECT_EQ(1.0, scores[1].field.base);
  EXPECT_TRUE(std::isnan(scores[1].side.predicted));
}

TEST(Validation, RefusesWhatItCannotDo)
{
  const auto samples = makeSphere(500);
  EXPECT_THROW(uvol_test::runPipeline(samples, makeParameters(1)), InvalidArgument);
  EXPECT_THROW(uvol_test::runPipeline(samples, makeParameters(501)), InvalidArgument);
  auto parameters = makeParameters(3);
  parameters.validation.by = ValidateBy::Field;
  parameters.validation.field = "nothing";
  EXPECT_THROW(uvol_test::runPipeline(samples, parameters), InvalidArgument);
  parameters.validation.field = "track";
  parameters.validation.folds = 6; // there are 5
  EXPECT_THROW(uvol_test::runPipeline(samples, parameters), InvalidArgument);
}

TEST(Validation, ItsParametersAreWrittenAndRead)
{
  auto parameters = makeParameters(7);
  parameters.validation.by = ValidateBy::Field;
  parameters.validation.field = "dive";
  EXPECT_EQ(parameters, IsosurfacePipelineParameters::fromJson(parameters.toJson()));
  auto other = parameters;
  other.validation.by = ValidateBy::Blocks;
  EXPECT_NE(parameters, other);
}

} // namespace test_validation
