// SPDX-License-Identifier: BSD-3-Clause
// The stages around clusters, as users of the library call them: on clouds of any point
// type, with indices, and with input that they cannot use.
#include "multivariate/projections.h"
#include "support/clouds.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/multivariate/cluster_membership.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/multivariate/star_coordinates.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace test_cluster_stages {

using pcl_uvol::ClusterMembership;
using pcl_uvol::InvalidArgument;
using pcl_uvol::ProjectionMethod;
using pcl_uvol::StarCoordinates;
using pcl_uvol::VoronoiDiagram;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;

const std::vector<std::string> attributes{"x", "y", "z", "intensity"};

/** Two clusters that the fourth attribute tells apart, and a point without it. */
struct TwoClusters {
  Cloud::Ptr cloud{new Cloud};
  std::vector<int> labels;

  TwoClusters()
  {
    *cloud = *uvol_test::makeCloud("uniform", 400, 3);
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      labels.push_back(static_cast<int>(i % 2));
      (*cloud)[i].intensity = static_cast<float>(i % 2) + 0.01f * (*cloud)[i].x;
    }
    (*cloud)[7].intensity = std::numeric_limits<float>::quiet_NaN();
  }
};

TEST(StarCoordinates, GiveWhatTheirKernelGives)
{
  const TwoClusters clusters;
  StarCoordinates<pcl::PointXYZI> star;
  star.setInputCloud(clusters.cloud);
  star.setAttributes(attributes);
  star.setLabels(clusters.labels);
  pcl::PointCloud<pcl::PointXYZ> points;
  star.compute(points);
  ASSERT_EQ(points.size(), clusters.cloud->size() - 1);
  EXPECT_EQ(star.getReport().getCount("missing_values"), 1u);
  const pcl_uvol::ProjectedPoints& result = star.getResult();
  EXPECT_EQ(result.projection.names, attributes);
  EXPECT_GT(result.smallest_ratio, 1000.0);

  const auto view = pcl_uvol::viewOf(*clusters.cloud);
  std::vector<std::uint32_t> all(clusters.cloud->size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  const auto table = readAttributes(view, all, attributes, true, 1, report);
  std::vector<std::int32_t> labels;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto source = static_cast<std::size_t>(result.sources[row]);
    EXPECT_EQ(source, table.points[row]);
    EXPECT_EQ(result.labels[row], clusters.labels[source]);
    labels.push_back(clusters.labels[source]);
  }
  const auto projection = starCoordinates(table, labels, {}, 1, report);
  EXPECT_EQ(projection.rows, result.projection.rows);
  EXPECT_EQ(projection.project(table.row(5)), result.places[5]);
  EXPECT_EQ(points[5].x, result.places[5][0]);
  // Back to the field: the mean of the attribute is that of the field.
  EXPECT_NEAR(
      projection.offsets[3] + projection.units[3] * projection.mean[3], 0.5, 0.02);
}

TEST(StarCoordinates, TakeTheirParameters)
{
  const TwoClusters clusters;
  StarCoordinates<pcl::PointXYZI> star;
  star.setInputCloud(clusters.cloud);
  star.setAttributes({"x", "y", "z", "intensity"});
  star.setLabels(clusters.labels);
  star.setMethod(ProjectionMethod::PrincipalAxes);
  pcl::PointCloud<pcl::PointXYZ> points;
  star.compute(points);
  const double of_axes = star.getResult().smallest_ratio;
  star.setMethod(ProjectionMethod::Star);
  star.compute(points);
  EXPECT_GE(star.getResult().smallest_ratio, of_axes);
  const auto some = std::make_shared<pcl::Indices>(pcl::Indices{9, 3, 12, 5, 11, 8});
  star.setIndices(some);
  star.compute(points);
  EXPECT_EQ(star.getResult().sources, *some);
}

TEST(StarCoordinates, RefuseWhatTheyCannotUse)
{
  const TwoClusters clusters;
  StarCoordinates<pcl::PointXYZI> star;
  pcl::PointCloud<pcl::PointXYZ> points(1, 1);
  EXPECT_THROW(star.compute(points), InvalidArgument);
  star.setInputCloud(clusters.cloud);
  EXPECT_THROW(star.compute(points), InvalidArgument); // no attributes
  star.setAttributes({"density"});
  EXPECT_THROW(star.compute(points), InvalidArgument);
  star.setAttributes(attributes);
  star.setLabels({1, 2, 3});
  EXPECT_THROW(star.compute(points), InvalidArgument);
  EXPECT_EQ(points.size(), 1u);
}

TEST(ClusterMembership, IsOneForMembersTimesTheirProbability)
{
  const TwoClusters clusters;
  for (auto& point : *clusters.cloud)
    point.intensity = 0.25f;
  ClusterMembership<pcl::PointXYZI> membership;
  membership.setInputCloud(clusters.cloud);
  membership.setLabels(clusters.labels);
  membership.setCluster(1);
  std::vector<float> values;
  membership.compute(values);
  ASSERT_EQ(values.size(), clusters.cloud->size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i], static_cast<float>(clusters.labels[i]));
  EXPECT_EQ(membership.getReport().getCount("cluster_points"), 200u);

  pcl_uvol::MembershipParameters parameters = membership.getParameters();
  parameters.probability = "intensity";
  membership.setParameters(parameters);
  membership.setIndices(std::make_shared<pcl::Indices>(pcl::Indices{3, 0}));
  membership.compute(values);
  EXPECT_EQ(values, (std::vector<float>{0.25f, 0.0f}));

  clusters.cloud->points[3].intensity = 1.5f;
  EXPECT_THROW(membership.compute(values), InvalidArgument);
  parameters.probability.clear();
  parameters.smoothing_length = "intensity";
  membership.setParameters(parameters);
  membership.setIndices(pcl::IndicesPtr());
  membership.compute(values);
  EXPECT_GT(values[3], 0.0f); // smoothed: its neighbours are mixed
  EXPECT_LT(values[3], 1.0f);
}

TEST(ClusterMembership, RefusesWhatItCannotUse)
{
  const TwoClusters clusters;
  ClusterMembership<pcl::PointXYZI> membership;
  std::vector<float> values{7.0f};
  EXPECT_THROW(membership.compute(values), InvalidArgument);
  membership.setInputCloud(clusters.cloud);
  EXPECT_THROW(membership.compute(values), InvalidArgument); // no labels
  membership.setLabels(clusters.labels);
  membership.setCluster(5);
  EXPECT_THROW(membership.compute(values), InvalidArgument);
  EXPECT_EQ(values, std::vector<float>{7.0f});
}

TEST(VoronoiDiagram, KnowsTheNearestPointOfEveryCell)
{
  const auto cloud = uvol_test::makeCloud("uniform", 300, 5);
  VoronoiDiagram<pcl::PointXYZI> diagram;
  diagram.setInputCloud(cloud);
  diagram.setCells(20);
  diagram.setMargin(2);
  const auto grid = diagram.compute();
  const pcl_uvol::GridShape& shape = grid->getShape();
  EXPECT_EQ(*std::max_element(shape.cells.begin(), shape.cells.end()), 24u);
  for (std::uint64_t cell = 0; cell < shape.size(); cell += 97) {
    double least = 1e300;
    for (const auto& site : grid->getSites())
      least = std::min(least, shape.distance(shape.cellOf(cell), site));
    const auto& found = grid->getSites()[grid->getNearest()[cell]];
    EXPECT_NEAR(shape.distance(shape.cellOf(cell), found), least, 1e-4 * least);
  }
  diagram.setMargin(0);
  diagram.setCells(5, 6, 7);
  EXPECT_EQ(diagram.compute()->getShape().cells,
            (std::array<std::uint32_t, 3>{{5, 6, 7}}));
}

TEST(VoronoiDiagram, RefusesWhatItCannotUse)
{
  VoronoiDiagram<pcl::PointXYZI> diagram;
  EXPECT_THROW(diagram.compute(), InvalidArgument);
  diagram.setInputCloud(uvol_test::makeCloud("uniform", 30, 5));
  diagram.setCells(0);
  EXPECT_THROW(diagram.compute(), InvalidArgument);
  diagram.setCells(pcl_uvol::GridShape::largest_side + 1);
  EXPECT_THROW(diagram.compute(), InvalidArgument);
  diagram.setCells(4, 4, 4);
  diagram.setMargin(1);
  EXPECT_THROW(diagram.compute(), InvalidArgument);
  diagram.setMargin(0);
  diagram.setIndices(std::make_shared<pcl::Indices>(pcl::Indices{30}));
  EXPECT_THROW(diagram.compute(), InvalidArgument);
}

} // namespace test_cluster_stages
