// SPDX-License-Identifier: BSD-3-Clause
// Samples whose values stand alone are told of, and nothing else is taken for one.
#include "common/scalar_field.h"
#include "pipeline/membership_surface.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"
#include "support/messages.h"
#include "support/noisy_shapes.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace test_spikes {

using namespace pcl_uvol;
using Eigen::Vector3d;
using Function = std::function<double(const Vector3d&)>;

/** Random samples of the cube from -1 to 1.
 * \param one_in so many samples have the value of a spike; 0: none */
std::shared_ptr<Dataset>
sample(const Function& function,
       std::size_t count,
       std::size_t one_in = 0,
       float spike = 0.0f)
{
  uvol_test::Random random(11);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d x;
    for (int axis = 0; axis < 3; ++axis)
      x[axis] = 2.0 * random.uniform() - 1.0;
    pcl::PointXYZI point;
    point.getVector3fMap() = x.cast<float>();
    const bool is_spike =
        one_in > 0 && random.uniform() * static_cast<double>(one_in) < 1.0;
    point.intensity = is_spike ? spike : static_cast<float>(function(x));
    cloud.push_back(point);
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

double
sphere(const Vector3d& x)
{
  return 0.6 - x.norm();
}

/** What the report says of spikes. */
std::optional<Message>
findWarning(const IsosurfaceResult& result)
{
  return uvol_test::findWarning(result, "spikes");
}

IsosurfacePipelineParameters
at(double isovalue)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {isovalue};
  return parameters;
}

TEST(Spikes, AreReportedWhateverTheirSize)
{
  for (const float spike : {5.0f, 1000.0f, 1e10f, -1000.0f})
    for (const std::size_t one_in : {30u, 300u}) {
      const auto result =
          uvol_test::runPipeline(sample(sphere, 8000, one_in, spike), at(0.0));
      const auto warning = findWarning(result);
      ASSERT_TRUE(warning) << spike << ' ' << one_in;
      EXPECT_GT(uvol_test::numberOf(*warning, "percent"), 0.1)
          << spike << ' ' << one_in;
    }
}

TEST(Spikes, AreReportedInMeshesAndInTwoIsosurfaces)
{
  const auto samples = sample(sphere, 8000, 100, 1000.0f);
  auto parameters = at(0.0);
  parameters.mesh.emplace();
  EXPECT_TRUE(findWarning(uvol_test::runPipeline(samples, parameters)));
  parameters = at(0.0);
  parameters.isosurface.isovalues = {0.0, 0.1};
  EXPECT_TRUE(findWarning(uvol_test::runPipeline(samples, parameters)));
}

/** A level set replaces them and says so itself. */
TEST(Spikes, AreReportedOnceWhereALevelSetReplacesThem)
{
  auto parameters = at(0.0);
  parameters.smooth = true;
  const auto result =
      uvol_test::runPipeline(sample(sphere, 8000, 100, 1000.0f), parameters);
  EXPECT_FALSE(findWarning(result));
  ASSERT_EQ(1u, result.report.warnings.size());
  EXPECT_EQ("outliers", result.report.warnings[0].code);
}

/** A sample of noise within a cluster is its only stranger, and no outlier of a field.
 */
TEST(Spikes, AreNoneInMemberships)
{
  const auto samples = sample(sphere, 8000, 50, -1.0f);
  const CloudView view = viewOf(samples->cloud);
  const ScalarField value(view.fields, "intensity");
  std::vector<float> members;
  for (std::size_t i = 0; i < view.count; ++i)
    members.push_back(value.read(view.point(i)) > 0.0 ? 1.0f : 0.0f);
  IsosurfaceResult result;
  extractMembershipSurface(*samples, members, {}, false, 1, result.report);
  EXPECT_GT(result.report.getCount("isopoints"), 100u);
  EXPECT_FALSE(findWarning(result));
}

/** Isolated stars: a single sample may be all that lies above an isovalue. */
double
stars(const Vector3d& x)
{
  return std::pow(10.0, -10.0 * (x - Vector3d(0.3, 0.0, 0.0)).norm()) +
         std::pow(10.0, -20.0 * (x + Vector3d(0.5, 0.2, 0.1)).norm());
}

TEST(Spikes, AreNotSeenInSmoothFieldsOverTenDecades)
{
  const auto samples = sample(stars, 8000);
  for (int decade = -10; decade < 0; ++decade) {
    const auto result =
        uvol_test::runPipeline(samples, at(3.0 * std::pow(10.0, decade)));
    EXPECT_FALSE(findWarning(result)) << decade;
  }
}

TEST(Spikes, AreNotSeenWhereFieldsWaveWithinAFewSpacings)
{
  // A spacing is 0.1; a wave is 10, 5 and 3 of them long.
  for (const double length : {1.0, 0.5, 0.3}) {
    const double k = 6.283185307179586 / length;
    const auto waves = [&](const Vector3d& x) {
      return std::sin(k * x[0]) * std::sin(k * x[1]) * std::sin(k * x[2]);
    };
    const auto samples = sample(waves, 8000);
    for (const double isovalue : {0.0, 0.5, 0.9})
      EXPECT_FALSE(findWarning(uvol_test::runPipeline(samples, at(isovalue))))
          << length << ' ' << isovalue;
  }
}

TEST(Spikes, AreNotSeenInNoise)
{
  for (const double noise : {0.1, 3.0}) {
    const auto noisy =
        uvol_test::makeNoisyCloud(uvol_test::makeShape("sphere"), noise, 5);
    auto samples = std::make_shared<Dataset>();
    pcl::toPCLPointCloud2(*noisy.cloud, samples->cloud);
    EXPECT_FALSE(findWarning(uvol_test::runPipeline(samples, at(0.0)))) << noise;
  }
}

TEST(Spikes, AreNotSeenAtStepsAndLabels)
{
  const auto step = [](const Vector3d& x) { return x.norm() < 0.6 ? 1000.0 : 1.0; };
  EXPECT_FALSE(findWarning(uvol_test::runPipeline(sample(step, 8000), at(0.5 * 1e3))));
}

} // namespace test_spikes
