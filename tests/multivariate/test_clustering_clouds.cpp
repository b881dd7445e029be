// SPDX-License-Identifier: BSD-3-Clause
// The clustering stage: clouds of known and unknown point types, indices, missing
// values, units, bad input (thesis 2.6).
#include "multivariate/planted_clusters.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/multivariate/density_clustering.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <limits>

namespace test_clustering_clouds {

using namespace uvol_test;
using pcl_uvol::InvalidArgument;

/** Agreement with planted clusters, in the adjusted Rand index. */
constexpr double least_agreement = 0.95;

pcl::PointCloud<pcl::PointXYZI>::Ptr
makeSearchCloud(const PlantedClusters& planted)
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (std::size_t i = 0; i < planted.labels.size(); ++i) {
    pcl::PointXYZI point;
    point.x = planted.values[3 * i];
    point.y = planted.values[3 * i + 1];
    point.z = 0.0f;
    point.intensity = planted.values[3 * i + 2];
    cloud->push_back(point);
  }
  return cloud;
}

TEST(DensityClusteringOfClouds, ClustersACloudOfAnyUnits)
{
  const auto planted = plantClusters(3, 400, 1);
  const auto cloud = makeSearchCloud(planted);
  for (auto& point : *cloud) {
    point.x *= 1e-9f;
    point.intensity *= 1e12f;
  }
  (*cloud)[3].y = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[4].z = std::numeric_limits<float>::quiet_NaN();
  pcl_uvol::DensityClustering<pcl::PointXYZI> clustering;
  clustering.setInputCloud(cloud);
  clustering.setAttributes({"x", "y", "intensity"});
  std::vector<int> labels;
  clustering.compute(labels);
  ASSERT_EQ(labels.size(), cloud->size());
  EXPECT_EQ(labels[3], -1);
  EXPECT_NE(labels[4], -1) << "z is not asked for";
  auto truth = planted.labels;
  truth[3] = -1;
  EXPECT_GE(adjustedRandIndex(truth, labels), least_agreement);
  const auto& report = clustering.getReport();
  EXPECT_EQ(report.getCount("points"), cloud->size() - 1);
  EXPECT_EQ(report.getCount("missing_values"), 1u);
  EXPECT_EQ(report.getCount("clusters"), 4u);
  EXPECT_EQ(report.getCount("noise") + 1,
            static_cast<std::uint64_t>(std::count(labels.begin(), labels.end(), -1)));
  std::vector<std::string> steps;
  for (const auto& entry : report.milliseconds)
    steps.push_back(entry.first);
  EXPECT_EQ(steps,
            (std::vector<std::string>{
                "attributes", "neighbors", "spanning_tree", "cluster_tree"}));
  ASSERT_EQ(clustering.getProbabilities().size(), cloud->size());
  EXPECT_EQ(clustering.getProbabilities()[3], 0.0f);
  EXPECT_EQ(clustering.getTree().front().size, cloud->size() - 1);
  clustering.setStandardized(false); // the intensity alone counts: two clusters
  clustering.compute(labels);
  EXPECT_LT(adjustedRandIndex(truth, labels), 0.7);
}

TEST(DensityClusteringOfClouds, ReadsCloudsWithoutAPointType)
{
  const auto planted = plantClusters(3, 400, 1);
  pcl::PCLPointCloud2::Ptr bytes(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*makeSearchCloud(planted), *bytes);
  pcl_uvol::DensityClustering<pcl::PCLPointCloud2> clustering;
  clustering.setInputCloud(bytes);
  clustering.setAttributes({"x", "y", "intensity"});
  std::vector<int> labels;
  clustering.compute(labels);
  EXPECT_GE(adjustedRandIndex(planted.labels, labels), least_agreement);
}

TEST(DensityClusteringOfClouds, UsesTheIndicesOnly)
{
  const auto planted = plantClusters(3, 0, 1);
  pcl_uvol::DensityClustering<pcl::PointXYZI> clustering;
  clustering.setInputCloud(makeSearchCloud(planted));
  clustering.setAttributes({"x", "y", "intensity"});
  pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 700; i < 2200; ++i)
    indices->push_back(i);
  clustering.setIndices(indices);
  std::vector<int> labels;
  clustering.compute(labels);
  ASSERT_EQ(labels.size(), 2200u);
  EXPECT_EQ(std::count(labels.begin(), labels.begin() + 700, -1), 700);
  EXPECT_EQ(labels[705], 0);
  EXPECT_EQ(*std::max_element(labels.begin(), labels.end()), 2);
}

TEST(DensityClusteringOfClouds, BadInputThrowsAndLeavesTheLabels)
{
  pcl_uvol::DensityClustering<pcl::PointXYZI> clustering;
  std::vector<int> labels = {7};
  EXPECT_THROW(clustering.compute(labels), InvalidArgument);
  clustering.setInputCloud(makeSearchCloud(plantClusters(3, 0, 1)));
  EXPECT_THROW(clustering.compute(labels), InvalidArgument) << "no attributes";
  clustering.setAttributes({"y", "temperature"});
  EXPECT_THROW(clustering.compute(labels), InvalidArgument);
  clustering.setAttributes({"y"});
  clustering.setMinClusterSize(1);
  EXPECT_THROW(clustering.compute(labels), InvalidArgument);
  EXPECT_EQ(labels, std::vector<int>{7});
}

} // namespace test_clustering_clouds
