// SPDX-License-Identifier: BSD-3-Clause
// Clusters of any attributes, projections that keep them apart, and hulls of clusters.
#include "meshes.h"
#include "multivariate/cluster_hull.h"
#include "promises.h"
#include "random_cloud.h"
#include "targets.h"
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/multivariate/star_coordinates.h>

#include <cmath>

namespace uvol_fuzz {

namespace {

using Cloud = pcl::PCLPointCloud2;

/** Rows are perpendicular to each other, and of length 1 or 0. */
void
requireFrame(const std::array<std::vector<double>, 3>& rows)
{
  constexpr double tolerance = 1e-6;
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      double product = 0.0;
      for (std::size_t i = 0; i < rows[a].size(); ++i)
        product += rows[a][i] * rows[b][i];
      const bool is_one = a == b && std::abs(product - 1.0) < tolerance;
      require(is_one || std::abs(product) < tolerance, "axes are perpendicular");
    }
}

/** Labels from -1, by the number of the point; none of 0: they are to be found. */
std::vector<int>
makeLabels(std::size_t points, std::size_t labels, std::size_t run)
{
  std::vector<int> label_of;
  for (std::size_t i = 0; labels > 0 && i < points; ++i)
    label_of.push_back(static_cast<int>(i / run % labels) - 1);
  return label_of;
}

} // namespace

void
clusterAttributes(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::ClusteringParameters parameters;
  parameters.attributes = {"intensity", "x"};
  if (input.flip())
    parameters.attributes.emplace_back("y");
  parameters.is_standardized = input.flip();
  parameters.neighbors = input.choose(20);
  parameters.min_cluster_size = input.choose(6);
  parameters.allow_single_cluster = input.flip();
  parameters.cut_distance = input.flip() ? 0.25 * input.take<std::uint8_t>() : 0.0;
  pcl_uvol::DensityClustering<Cloud> clustering;
  const auto cloud = takeCloud(input, sample_fields);
  clustering.setInputCloud(cloud);
  clustering.setParameters(parameters);
  clustering.setNumberOfThreads(1);
  refusalOf([&] {
    std::vector<int> labels;
    clustering.compute(labels);
    require(labels.size() == cloud->width, "every point has a label");
    const auto& tree = clustering.getTree();
    for (std::size_t i = 0; i < tree.size(); ++i)
      require(tree[i].parent < static_cast<std::int32_t>(i),
              "parents stand before their children");
    for (const float probability : clustering.getProbabilities())
      require(probability >= 0.0f && probability <= 1.0f,
              "probabilities are between 0 and 1");
  });
}

void
projectAttributes(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  pcl_uvol::StarCoordinateParameters parameters;
  parameters.attributes = {"a", "b", "c", "d"};
  if (input.flip())
    parameters.attributes.emplace_back("x");
  parameters.is_standardized = input.flip();
  parameters.method = chooseOne(input, listWords(pcl_uvol::ProjectionMethod()));
  parameters.steps = static_cast<unsigned>(input.choose(10));
  const std::size_t labels = input.choose(9), run = 1 + input.choose(16);
  pcl_uvol::StarCoordinates<Cloud> star;
  const auto cloud =
      takeCloud(input, std::array<const char*, 7>{"x", "y", "z", "a", "b", "c", "d"});
  star.setInputCloud(cloud);
  star.setParameters(parameters);
  star.setLabels(makeLabels(cloud->width, labels, run));
  star.setNumberOfThreads(1);
  refusalOf([&] {
    pcl::PointCloud<pcl::PointXYZ> points;
    star.compute(points);
    const auto& result = star.getResult();
    require(result.sources.size() == points.size() &&
                result.labels.size() == points.size(),
            "every place is one of a point and has a label");
    requireFrame(result.projection.rows);
    require(result.smallest_ratio >= 0.0, "ratios are not negative");
  });
}

void
wrapCluster(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t most_regions = 12;
  Bytes input(bytes, size);
  const ClosedMesh mesh = takeMesh(input);
  std::vector<std::uint32_t> regions(mesh.vertices);
  for (std::uint32_t& region : regions)
    region = static_cast<std::uint32_t>(input.choose(most_regions));
  const auto hull = pcl_uvol::makeClusterHull(mesh.triangles, regions);
  requireNoRim(hull.triangles, hull.regions.size());
  if (!hull.triangles.empty())
    require(hull.regions.size() + 2 * mesh.genus == 2 + hull.triangles.size() / 2,
            "a hull has the handles of its surface");
}

} // namespace uvol_fuzz
