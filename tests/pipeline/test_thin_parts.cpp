// SPDX-License-Identifier: BSD-3-Clause
// Parts that are one layer of samples thick are told, and no others.
#include "pipeline/run_pipeline.h"
#include "pipeline/thin_parts.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace test_thin_parts {

using namespace pcl_uvol;
using Field = std::function<float(const Eigen::Vector3f&)>;

/** 8,000 samples of a field, with 20 along each side of the cube [0, 1]^3.
 * \param jitter of the nodes of a lattice, in spacings; 1 hides it
 * \param squeeze of z, whose spacing it divides */
std::shared_ptr<Dataset>
makeSamples(const Field& field, double jitter, float squeeze = 1.0f)
{
  uvol_test::Random random(3);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int node = 0; node < 8000; ++node) {
    pcl::PointXYZI point;
    const int steps[] = {node % 20, node / 20 % 20, node / 400};
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(
          (steps[axis] + 0.5 + jitter * (random.uniform() - 0.5)) / 20.0);
    point.intensity = field(point.getVector3fMap());
    point.z /= squeeze;
    cloud.push_back(point);
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

/** What is said of thin parts. */
std::optional<Message>
tell(const std::shared_ptr<Dataset>& samples, bool has_mesh = false)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {0.0};
  if (has_mesh)
    parameters.mesh.emplace();
  return uvol_test::findWarning(uvol_test::runPipeline(samples, parameters),
                                "thin_parts");
}

/** \param layers of samples that the plate, or the gap between two, is thick */
Field
makePlate(float layers, float sign = 1.0f)
{
  return [=](const Eigen::Vector3f& x) {
    return sign * (layers / 40.0f - std::abs(x.z() - 0.525f));
  };
}

TEST(ThinParts, PlatesOfOneLayerOfSamplesAreReported)
{
  for (const double jitter : {0.0, 0.3, 1.0})
    for (const float sign : {1.0f, -1.0f})
      for (const bool has_mesh : {false, true}) {
        const auto told = tell(makeSamples(makePlate(1.0f, sign), jitter), has_mesh);
        ASSERT_TRUE(told) << jitter << sign << has_mesh;
        EXPECT_GE(uvol_test::numberOf(*told, "percent"), 25.0);
      }
}

TEST(ThinParts, ThickOnesAreNot)
{
  const Field ball = [](const Eigen::Vector3f& x) {
    return 0.3f - (x.array() - 0.5f).matrix().norm();
  };
  const Field cube = [](const Eigen::Vector3f& x) {
    return 0.3f - (x.array() - 0.5f).abs().maxCoeff();
  };
  for (const double jitter : {0.0, 0.3, 1.0})
    for (const float squeeze : {1.0f, 20.0f})
      for (const Field& field : {ball, cube, makePlate(4.0f)})
        EXPECT_FALSE(tell(makeSamples(field, jitter, squeeze))) << jitter << squeeze;
}

/** Isovalues are apart, and the order of a plate's isopoints is no matter. */
TEST(ThinParts, SidesOfOneIsovalueMeetInASample)
{
  pcl::PointCloud<PointIso> isopoints(4, 1);
  const IsoEdges edges{{0, 1, 0.5f}, {1, 2, 0.5f}, {1, 2, 0.5f}, {2, 3, 0.5f}};
  for (std::size_t i = 0; i < 4; ++i) {
    isopoints[i].getNormalVector3fMap() =
        Eigen::Vector3f(0.0f, 0.0f, i < 1 ? 1.0f : -1.0f);
    isopoints[i].isovalue = i < 2 ? 1.0f : 2.0f;
  }
  EXPECT_EQ((std::vector<std::uint8_t>{1, 1, 0, 0}), findThinParts(isopoints, edges));
  EXPECT_TRUE(findThinParts(pcl::PointCloud<PointIso>(), {}).empty());
}

} // namespace test_thin_parts
