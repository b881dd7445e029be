// SPDX-License-Identifier: BSD-3-Clause
// Every layout of points is read right or refused by name, whatever the stage.
#include "support/clouds.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/register_point_struct.h>

#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

struct DoublePoint {
  double x, y, z;
  float intensity;
};

#pragma pack(push, 1)
struct PackedPoint {
  char tag;
  float z, y, x;
  float intensity;
};
#pragma pack(pop)

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(DoublePoint,
    (double, x, x)(double, y, y)(double, z, z)(float, intensity, intensity))
POINT_CLOUD_REGISTER_POINT_STRUCT(PackedPoint,
    (float, z, z)(float, y, y)(float, x, x)(float, intensity, intensity))
// clang-format on

namespace test_cloud_view {

using pcl_uvol::InvalidArgument;
using pcl_uvol::Message;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Isopoints = pcl::PointCloud<pcl_uvol::PointIso>;

Cloud::Ptr
makeSamples(std::size_t n = 3000)
{
  return uvol_test::makeCloud("uniform", n, 1);
}

template <typename PointT>
Isopoints
extract(const typename pcl_uvol::IsosurfaceExtraction<PointT>::Cloud::ConstPtr& cloud)
{
  pcl_uvol::IsosurfaceExtraction<PointT> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(0.3);
  Isopoints isopoints;
  extraction.extract(isopoints);
  return isopoints;
}

void
expectSame(const Isopoints& expected, const Isopoints& actual)
{
  ASSERT_GT(expected.size(), 100u);
  ASSERT_EQ(expected.size(), actual.size());
  EXPECT_EQ(0,
            std::memcmp(expected.points.data(),
                        actual.points.data(),
                        expected.size() * sizeof(pcl_uvol::PointIso)));
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
convert(const Cloud& cloud)
{
  const auto other = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const auto& point : cloud) {
    PointT converted{};
    converted.x = point.x;
    converted.y = point.y;
    converted.z = point.z;
    converted.intensity = point.intensity;
    other->push_back(converted);
  }
  return other;
}

pcl::PCLPointCloud2::Ptr
makeMessage(const Cloud& cloud)
{
  const auto message = pcl::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(cloud, *message);
  return message;
}

TEST(CloudView, ReadsAnyNumericCoordinates)
{
  const auto samples = makeSamples();
  const Isopoints expected = extract<pcl::PointXYZI>(samples);
  expectSame(expected, extract<DoublePoint>(convert<DoublePoint>(*samples)));
  expectSame(expected, extract<PackedPoint>(convert<PackedPoint>(*samples)));
}

TEST(CloudView, ReadsPaddedRows)
{
  const auto samples = makeSamples();
  const auto message = makeMessage(*samples);
  const Isopoints expected = extract<pcl::PCLPointCloud2>(message);
  const auto padded = pcl::make_shared<pcl::PCLPointCloud2>(*message);
  padded->height = 30;
  padded->width = 100;
  padded->row_step = 100 * padded->point_step + 7;
  padded->data.assign(std::size_t(30) * padded->row_step, 0xff);
  for (std::size_t row = 0; row < 30; ++row)
    std::memcpy(&padded->data[row * padded->row_step],
                &message->data[row * 100 * message->point_step],
                100 * message->point_step);
  expectSame(expected, extract<pcl::PCLPointCloud2>(padded));
}

Message
refusal(const std::function<void(pcl::PCLPointCloud2&)>& spoil)
{
  const auto message = makeMessage(*makeSamples(100));
  spoil(*message);
  return uvol_test::thrownBy<InvalidArgument>(
      [&] { extract<pcl::PCLPointCloud2>(message); });
}

TEST(CloudView, RefusesByNameWhatItCannotRead)
{
  EXPECT_EQ(Message("cloud_big_endian", {}),
            refusal([](auto& cloud) { cloud.is_bigendian = 1; }));
  EXPECT_EQ(Message("field_beyond_point", {{"field", "intensity"}, {"bytes", 32}}),
            refusal([](auto& cloud) { cloud.fields[3].offset = 30; }));
  EXPECT_EQ(Message("unknown_datatype", {{"type", 77}}),
            refusal([](auto& cloud) { cloud.fields[3].datatype = 77; }));
  EXPECT_EQ(Message("cloud_too_short", {{"bytes", 3199}, {"points", 100}}),
            refusal([](auto& cloud) { cloud.data.pop_back(); }));
  EXPECT_EQ("cloud_without_xyz",
            refusal([](auto& cloud) { cloud.fields[1].name = "why"; }).code);
  EXPECT_EQ(Message("cloud_beyond_numbers", {{"points", 4294967296}}),
            refusal([](auto& cloud) { cloud.width = cloud.height = 65536; }));
}

/** \param run a stage with these indices into 100 points */
void
expectChecked(const std::function<void(const pcl::IndicesPtr&)>& run)
{
  for (const std::vector<int>& bad : {std::vector<int>{0, 100},
                                      std::vector<int>{-1},
                                      std::vector<int>{std::numeric_limits<int>::max()},
                                      std::vector<int>{}})
    EXPECT_THROW(run(pcl::make_shared<pcl::Indices>(bad.begin(), bad.end())),
                 InvalidArgument);
}

TEST(CloudView, StagesCheckIndices)
{
  const auto samples = makeSamples(100);
  const auto with = [&](auto& stage, const pcl::IndicesPtr& indices) {
    stage.setInputCloud(samples);
    stage.setIndices(indices);
  };
  expectChecked([&](const auto& indices) {
    pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> stage;
    with(stage, indices);
    stage.setIsoValue(0.3);
    Isopoints out;
    stage.extract(out);
  });
  expectChecked([&](const auto& indices) {
    pcl_uvol::LevelSetEvolution<pcl::PointXYZI> stage;
    with(stage, indices);
    stage.setIsoValue(0.3);
    std::vector<float> out;
    stage.evolve(out);
  });
  expectChecked([&](const auto& indices) {
    pcl_uvol::GradientEstimation<pcl::PointXYZI> stage;
    with(stage, indices);
    pcl::PointCloud<pcl_uvol::PointGradient> out;
    stage.compute(out);
  });
  expectChecked([&](const auto& indices) {
    pcl_uvol::NaturalNeighbors<pcl::PointXYZI> stage;
    with(stage, indices);
    pcl_uvol::NeighborGraph out;
    stage.compute(out);
  });
  expectChecked([&](const auto& indices) {
    pcl_uvol::DensityClustering<pcl::PointXYZI> stage;
    with(stage, indices);
    stage.setAttributes({"intensity"});
    std::vector<int> out;
    stage.compute(out);
  });
  pcl::PointCloud<pcl::PointNormal>::Ptr surface(new pcl::PointCloud<pcl::PointNormal>);
  for (const auto& point : *samples)
    surface->push_back({point.x, point.y, point.z, 0.0f, 0.0f, 1.0f});
  expectChecked([&](const auto& indices) {
    pcl_uvol::SurfaceNormalEstimation<pcl::PointNormal> stage;
    stage.setInputCloud(surface);
    stage.setIndices(indices);
    pcl::PointCloud<pcl::Normal> out;
    stage.compute(out);
  });
  expectChecked([&](const auto& indices) {
    pcl_uvol::SplatGeneration<pcl::PointNormal> stage;
    stage.setInputCloud(surface);
    stage.setIndices(indices);
    pcl::PointCloud<pcl_uvol::PointSplat> out;
    stage.compute(out);
  });
}

/** Indices are kept when a smaller cloud takes the place of a larger one. */
TEST(CloudView, AStageIsReusedWithASmallerCloud)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setIsoValue(0.3);
  Isopoints out;
  extraction.setInputCloud(makeSamples(3000));
  extraction.extract(out);
  const auto few = makeSamples(400);
  extraction.setInputCloud(few);
  extraction.extract(out);
  expectSame(extract<pcl::PointXYZI>(few), out);
}

/** PCLBase's own setInputCloud is not virtual for PCLPointCloud2. */
TEST(CloudView, AnotherCloudThroughTheBaseIsNoticed)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setIsoValue(0.3);
  Isopoints out;
  extraction.setInputCloud(makeMessage(*makeSamples(3000)));
  extraction.extract(out);
  const auto few = makeMessage(*makeSamples(400));
  static_cast<pcl::PCLBase<pcl::PCLPointCloud2>&>(extraction).setInputCloud(few);
  extraction.extract(out);
  expectSame(extract<pcl::PCLPointCloud2>(few), out);
}

} // namespace test_cloud_view
