// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/parameter_json.h"
#include "multivariate/cluster_attributes.h"
#include "multivariate/cluster_tree.h"
#include "multivariate/memory_need.h"
#include "multivariate/rounded_attributes.h"
#include "multivariate/spanning_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t most_neighbors = 1000;

/** The default size of the smallest clusters is this at least. */
constexpr std::size_t fewest_members = 10;

void
checkParameters(const ClusteringParameters& parameters)
{
  if (parameters.neighbors > most_neighbors)
    throw InvalidArgument("too_many_core_neighbors",
                          {{"neighbors", parameters.neighbors}});
  if (parameters.min_cluster_size == 1)
    throw InvalidArgument("cluster_of_one_point", {});
  if (!(parameters.cut_distance >= 0.0) || !std::isfinite(parameters.cut_distance))
    throw InvalidArgument("cut_distance_not_allowed",
                          {{"distance", parameters.cut_distance}});
}

/** More than chance brings together in noise, less than what stands out. */
std::size_t
usualSize(std::size_t points)
{
  const double root = std::sqrt(static_cast<double>(points));
  return std::max(fewest_members, static_cast<std::size_t>(root));
}

/** Per cluster the chosen one that it belongs to, or -1. */
std::vector<std::int32_t>
chosenAbove(const CondensedTree& tree, const std::vector<std::uint8_t>& chosen)
{
  std::vector<std::int32_t> above(chosen.size(), -1);
  for (std::size_t c = 0; c < chosen.size(); ++c)
    if (chosen[c])
      above[c] = static_cast<std::int32_t>(c);
    else if (tree.clusters[c].parent >= 0)
      above[c] = above[static_cast<std::size_t>(tree.clusters[c].parent)];
  return above;
}

/** Label clusters by decreasing number of members, then by first member.
 * \param members per point its chosen cluster, or -1
 * \return the label per cluster, -1 for those without members */
std::vector<std::int32_t>
labelClusters(const std::vector<std::int32_t>& members, std::size_t clusters)
{
  std::vector<std::size_t> sizes(clusters, 0), firsts(clusters, members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i] < 0)
      continue;
    const auto cluster = static_cast<std::size_t>(members[i]);
    ++sizes[cluster];
    firsts[cluster] = std::min(firsts[cluster], i);
  }
  std::vector<std::size_t> order(clusters);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sizes[a] != sizes[b] ? sizes[a] > sizes[b] : firsts[a] < firsts[b];
  });
  std::vector<std::int32_t> labels(clusters, -1);
  for (std::size_t rank = 0; rank < clusters && sizes[order[rank]] > 0; ++rank)
    labels[order[rank]] = static_cast<std::int32_t>(rank);
  return labels;
}

/** Labels and probabilities of the members of the chosen clusters.
 * \param reach points that leave their cluster at a larger distance are noise */
Clustering
assignMembers(const CondensedTree& tree,
              const std::vector<double>& stabilities,
              const std::vector<std::uint8_t>& chosen,
              double reach)
{
  const std::size_t count = tree.last_clusters.size();
  const std::vector<std::int32_t> above = chosenAbove(tree, chosen);
  std::vector<std::int32_t> members(count, -1);
  for (std::size_t i = 0; i < count; ++i)
    if (tree.leave_distances[i] <= reach)
      members[i] = above[tree.last_clusters[i]];
  const auto cluster_labels = labelClusters(members, tree.clusters.size());
  Clustering clustering;
  clustering.labels.assign(count, -1);
  clustering.probabilities.assign(count, 0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    if (members[i] < 0)
      continue;
    const auto cluster = static_cast<std::size_t>(members[i]);
    clustering.labels[i] = cluster_labels[cluster];
    const double highest = tree.densityAt(tree.clusters[cluster].death_distance);
    clustering.probabilities[i] = static_cast<float>(
        std::min(1.0, tree.densityAt(tree.leave_distances[i]) / highest));
  }
  for (std::size_t c = 0; c < tree.clusters.size(); ++c) {
    const CondensedCluster& cluster = tree.clusters[c];
    clustering.tree.push_back(
        {cluster.parent,
         cluster.parent < 0 ? 0.0 : tree.densityAt(cluster.birth_distance),
         tree.densityAt(cluster.death_distance),
         cluster.size,
         stabilities[c],
         cluster_labels[c]});
  }
  return clustering;
}

void
countClusters(const Clustering& clustering,
              std::size_t min_size,
              const ClusteringParameters& parameters,
              Report& report)
{
  const auto& labels = clustering.labels;
  const auto clusters =
      static_cast<std::size_t>(*std::max_element(labels.begin(), labels.end()) + 1);
  const auto noise =
      static_cast<std::size_t>(std::count(labels.begin(), labels.end(), -1));
  report.count("points", labels.size());
  report.count("clusters", clusters);
  report.count("noise", noise);
  if (clusters == 0)
    report.warn(parameters.cut_distance > 0.0 ? "no_clusters_at_distance"
                                              : "no_clusters",
                {{"points", labels.size()},
                 {"min_size", min_size},
                 {"distance", parameters.cut_distance}});
  else if (2 * noise > labels.size())
    report.warn("mostly_noise", {{"noise", noise}, {"points", labels.size()}});
}

} // namespace

namespace detail {

Clustering
clusterAttributes(const AttributeTable& table,
                  const ClusteringParameters& parameters,
                  unsigned threads,
                  Report& report)
{
  checkParameters(parameters);
  if (table.rows() == 0)
    throw InvalidArgument("no_points_to_cluster", {});
  checkMemoryOf("Clustering",
                table.rows(),
                clusteringBytes(static_cast<double>(table.rows()),
                                static_cast<double>(table.columns()),
                                static_cast<double>(parameters.neighbors)));
  const std::size_t min_size = parameters.min_cluster_size > 0
                                   ? parameters.min_cluster_size
                                   : usualSize(table.rows());
  const auto edges = spanningTree(
      table.values, table.columns(), parameters.neighbors, threads, report);
  Clustering clustering;
  {
    const StepTimer step(report, "cluster_tree");
    const CondensedTree tree = condenseTree(table.rows(), edges, min_size);
    const auto stabilities = computeStabilities(tree);
    const bool is_cut = parameters.cut_distance > 0.0;
    auto eligible = findSignificantClusters(
        tree, stabilities, table.columns(), parameters.neighbors);
    eligible.front() = parameters.allow_single_cluster ? 1 : 0;
    auto chosen = is_cut ? chooseByDistance(tree, parameters.cut_distance)
                         : chooseByPersistence(tree, stabilities, eligible);
    // All other clusters are large enough from birth on.
    if (tree.clusters.front().size < min_size)
      chosen.front() = 0;
    const double reach =
        is_cut ? parameters.cut_distance : std::numeric_limits<double>::infinity();
    clustering = assignMembers(tree, stabilities, chosen, reach);
  }
  countClusters(clustering, min_size, parameters, report);
  warnOfRounding(table, clustering.labels, threads, report);
  return clustering;
}

Clustering
clusterCloud(const CloudView& cloud,
             const pcl::Indices& indices,
             const ClusteringParameters& parameters,
             unsigned threads,
             Report& report)
{
  checkParameters(parameters);
  const std::vector<std::uint32_t> use(indices.begin(), indices.end());
  const AttributeTable table = readAttributes(
      cloud, use, parameters.attributes, parameters.is_standardized, threads, report);
  Clustering of_rows = clusterAttributes(table, parameters, threads, report);
  Clustering clustering;
  clustering.labels.assign(cloud.count, -1);
  clustering.probabilities.assign(cloud.count, 0.0f);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    clustering.labels[table.points[row]] = of_rows.labels[row];
    clustering.probabilities[table.points[row]] = of_rows.probabilities[row];
  }
  clustering.tree = std::move(of_rows.tree);
  return clustering;
}

} // namespace detail

std::string
ClusteringParameters::toJson() const
{
  return writeJson(*this);
}

ClusteringParameters
ClusteringParameters::fromJson(const std::string& text)
{
  return readJson<ClusteringParameters>(text);
}

} // namespace pcl_uvol
