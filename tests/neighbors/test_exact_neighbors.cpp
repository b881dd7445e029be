// SPDX-License-Identifier: BSD-3-Clause
// Exact natural neighbours against the Delaunay tetrahedra of brute force, on lattices,
// sheets and lines, and as edges of isosurfaces.
#include "common/random.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace test_exact_neighbors {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;
using pcl_uvol::AngleCriterion;
using pcl_uvol::NeighborSource;

Cloud::Ptr
makeRandomCloud(std::size_t n, std::uint64_t seed)
{
  auto cloud = std::make_shared<Cloud>();
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(
          pcl_uvol::uniformAt(seed, i, static_cast<std::uint64_t>(axis)));
    point.intensity = (point.getVector3fMap() - Eigen::Vector3f::Constant(0.5f)).norm();
    cloud->push_back(point);
  }
  return cloud;
}

pcl_uvol::NeighborGraph
findExact(const Cloud::Ptr& cloud, unsigned threads = 0)
{
  pcl_uvol::NaturalNeighbors<pcl::PointXYZI> natural;
  natural.setInputCloud(cloud);
  natural.setNeighborSource(NeighborSource::Exact);
  natural.setAngleCriterion(AngleCriterion::None);
  natural.setNumberOfThreads(threads);
  pcl_uvol::NeighborGraph graph;
  natural.compute(graph);
  return graph;
}

Edges
toEdges(const pcl_uvol::NeighborGraph& graph)
{
  Edges edges;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    for (const std::uint32_t j : graph[i])
      edges.emplace(i, j);
  return edges;
}

/** The edges of all tetrahedra whose circumscribed sphere is empty. */
Edges
findDelaunayEdges(const Cloud& cloud)
{
  const auto place = [&](std::uint32_t i) -> Eigen::Vector3d {
    return cloud[i].getVector3fMap().cast<double>();
  };
  const auto n = static_cast<std::uint32_t>(cloud.size());
  Edges edges;
  std::array<std::uint32_t, 4> corners{};
  for (corners[0] = 0; corners[0] < n; ++corners[0])
    for (corners[1] = corners[0] + 1; corners[1] < n; ++corners[1])
      for (corners[2] = corners[1] + 1; corners[2] < n; ++corners[2])
        for (corners[3] = corners[2] + 1; corners[3] < n; ++corners[3]) {
          Eigen::Matrix3d sides;
          Eigen::Vector3d halves;
          for (int k = 0; k < 3; ++k) {
            sides.row(k) =
                (place(corners[static_cast<std::size_t>(k + 1)]) - place(corners[0]));
            halves[k] = 0.5 * sides.row(k).squaredNorm();
          }
          const Eigen::Vector3d center = sides.inverse() * halves;
          const Eigen::Vector3d at = place(corners[0]) + center;
          bool is_empty = true;
          for (std::uint32_t other = 0; other < n && is_empty; ++other)
            is_empty = std::count(corners.begin(), corners.end(), other) > 0 ||
                       (place(other) - at).squaredNorm() > center.squaredNorm();
          if (!is_empty)
            continue;
          for (const std::uint32_t a : corners)
            for (const std::uint32_t b : corners)
              if (a != b)
                edges.emplace(a, b);
        }
  return edges;
}

TEST(ExactNeighbors, AreTheEdgesOfDelaunayTetrahedra)
{
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Cloud::Ptr cloud = makeRandomCloud(40, seed);
    EXPECT_EQ(findDelaunayEdges(*cloud), toEdges(findExact(cloud))) << "seed " << seed;
  }
}

TEST(ExactNeighbors, RandomSamplesInsideHaveFifteenAndAHalf)
{
  const Cloud::Ptr cloud = makeRandomCloud(8000, 5);
  const auto graph = findExact(cloud);
  double sum = 0.0, count = 0.0;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if ((cloud->at(i).getVector3fMap().array() - 0.5f).abs().maxCoeff() < 0.3f) {
      sum += static_cast<double>(graph[i].size());
      ++count;
    }
  // 2 + 48 pi^2 / 35 (Meijering 1953).
  EXPECT_NEAR(2.0 + 48.0 * M_PI * M_PI / 35.0, sum / count, 0.2);
}

TEST(ExactNeighbors, ThoseOfALatticeAreBesideAlongItsAxes)
{
  auto cloud = std::make_shared<Cloud>();
  constexpr int n = 6;
  for (int i = 0; i < n * n * n; ++i) {
    pcl::PointXYZI point;
    point.x = 0.1f * static_cast<float>(i % n);
    point.y = 0.1f * static_cast<float>(i / n % n);
    point.z = 0.1f * static_cast<float>(i / n / n);
    cloud->push_back(point);
  }
  const auto graph = findExact(cloud);
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    for (const std::uint32_t j : graph[i])
      EXPECT_NEAR(
          0.1f,
          (cloud->at(i).getVector3fMap() - cloud->at(j).getVector3fMap()).norm(),
          1e-6f);
  EXPECT_EQ(2u * 3u * n * n * (n - 1), graph.indices.size());
}

TEST(ExactNeighbors, SheetsAndLinesHaveThoseOfTwoDimensionsAndOne)
{
  Cloud::Ptr sheet = makeRandomCloud(500, 6), line = makeRandomCloud(50, 7);
  for (auto& point : *sheet)
    point.z = 0.25f;
  for (auto& point : *line)
    point.y = point.z = 0.25f;
  const auto in_sheet = findExact(sheet), on_line = findExact(line);
  // Euler: 3 n - 3 - h edges, of which h bound the hull.
  EXPECT_LT(in_sheet.indices.size(), 2u * 3u * 500u);
  EXPECT_GT(in_sheet.indices.size(), 2u * 29u * 50u);
  EXPECT_EQ(2u * 49u, on_line.indices.size());
}

TEST(ExactNeighbors, FewSamplesAndDuplicatesHaveWhatThereIs)
{
  EXPECT_TRUE(findExact(makeRandomCloud(1, 8)).indices.empty());
  EXPECT_EQ((Edges{{0, 1}, {1, 0}}), toEdges(findExact(makeRandomCloud(2, 8))));
  Cloud::Ptr cloud = makeRandomCloud(40, 9);
  const Edges once = toEdges(findExact(cloud));
  cloud->insert(cloud->end(), cloud->begin(), cloud->begin() + 40);
  EXPECT_EQ(once, toEdges(findExact(cloud)));
}

TEST(ExactNeighbors, DependNeitherOnThreadsNorOnLengths)
{
  const Cloud::Ptr cloud = makeRandomCloud(3000, 10);
  const auto graph = findExact(cloud, 1);
  const auto again = findExact(cloud, 3);
  EXPECT_EQ(graph.offsets, again.offsets);
  EXPECT_EQ(graph.indices, again.indices);
  for (auto& point : *cloud)
    point.getVector3fMap() *= 0x1p-40f;
  EXPECT_EQ(graph.indices, findExact(cloud).indices);
}

TEST(ExactNeighbors, GiveAnIsosurfaceAnIsopointPerDelaunayEdgeAcross)
{
  const Cloud::Ptr cloud = makeRandomCloud(3000, 11);
  constexpr float radius = 0.3f;
  std::size_t across = 0;
  for (const auto& [i, j] : toEdges(findExact(cloud)))
    across += (cloud->at(i).intensity >= radius) && (cloud->at(j).intensity < radius);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(radius);
  extraction.setNeighborSource(NeighborSource::Exact);
  extraction.setAngleCriterion(AngleCriterion::None);
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  extraction.extract(isopoints);
  EXPECT_EQ(across, isopoints.size());
  for (const auto& point : isopoints)
    ASSERT_NEAR(radius,
                (point.getVector3fMap() - Eigen::Vector3f::Constant(0.5f)).norm(),
                0.02f);
  const std::size_t all = isopoints.size();
  extraction.setAngleCriterion(AngleCriterion::Kept);
  extraction.extract(isopoints);
  EXPECT_LT(isopoints.size(), 2 * all / 3);
}

} // namespace test_exact_neighbors
