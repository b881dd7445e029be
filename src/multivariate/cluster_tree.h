// SPDX-License-Identifier: BSD-3-Clause
// The condensed tree of HDBSCAN* (Campello et al. 2013): clusters that split into
// clusters while lesser parts only leave them.
#pragma once

#include "multivariate/spanning_tree.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol {

/** \brief A cluster of the condensed tree, between two distances. */
struct CondensedCluster {
  std::int32_t parent = -1;
  double birth_distance = std::numeric_limits<double>::infinity();
  double death_distance = 0.0;
  std::uint32_t size = 0;
};

/** \brief Clusters, parents before children, and where points are last in one. */
struct CondensedTree {
  std::vector<CondensedCluster> clusters;
  std::vector<std::uint32_t> last_clusters; ///< per point
  std::vector<double> leave_distances;      ///< per point: at which it leaves that one

  /** \brief Points at distance 0 have the density of half the smallest distance that is
   * not 0, and 1 if there is none. */
  double zero_density = 1.0;

  double
  densityAt(double distance) const
  {
    return distance > 0.0 ? 1.0 / distance : zero_density;
  }
};

/** \brief Condense the hierarchy of single linkage.
 * \param count number of points, > 0
 * \param edges their spanning tree by increasing weight
 * \param min_size of clusters; the root has any size */
CondensedTree
condenseTree(std::size_t count,
             const std::vector<SpanningEdge>& edges,
             std::size_t min_size);

/** \brief Excess of mass of every cluster. */
std::vector<double>
computeStabilities(const CondensedTree& tree);

/** \brief Which clusters are denser than where they split off by more than chance
 * brings about in points without clusters, as one flag per cluster; the root always is.
 * \param columns dimension of the space
 * \param neighbors that tell the density: the fewer, the more it varies by chance */
std::vector<std::uint8_t>
findSignificantClusters(const CondensedTree& tree,
                        const std::vector<double>& stabilities,
                        std::size_t columns,
                        std::size_t neighbors);

/** \brief The clusters that do not overlap and have the largest sum of stabilities, as
 * one flag per cluster.
 * \param eligible one flag per cluster: the others are not chosen */
std::vector<std::uint8_t>
chooseByPersistence(const CondensedTree& tree,
                    const std::vector<double>& stabilities,
                    const std::vector<std::uint8_t>& eligible);

/** \brief The clusters that exist at a distance. */
std::vector<std::uint8_t>
chooseByDistance(const CondensedTree& tree, double distance);

} // namespace pcl_uvol
