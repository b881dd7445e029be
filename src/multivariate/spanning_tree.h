// SPDX-License-Identifier: BSD-3-Clause
// The minimum spanning tree of points in a space of many dimensions (thesis 2.6): where
// clusters hang together, and how far apart they are.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Two points, a < b, and their distance. */
struct SpanningEdge {
  std::uint32_t a, b;
  double weight;
};

/** \brief The minimum spanning tree of points by mutual reachability distance.
 *
 * The distance of two points is the largest of their Euclidean one and their core
 * distances, which reach to their k-th nearest other points (Campello et al. 2013).
 * Boruvka's method on a kd-tree (March et al. 2010, McInnes and Healy 2017): exact but
 * for the rounding of distances to float. Distances below 1e-19 of the extent are 0.
 * \param values finite, row by row
 * \param columns numbers per row, > 0
 * \param neighbors k, cut down to the number of other points; 0: Euclidean distance
 * \param report gets the times "neighbors" and "spanning_tree"
 * \return one edge less than there are points, by (weight, a, b); of several such trees
 * always the same one, whatever the number of threads
 * \throws InvalidArgument without columns, for a number of values that is no multiple
 * of them, a value that is not finite, and more than 2^31 - 1 rows */
PCL_UVOL_EXPORTS std::vector<SpanningEdge>
spanningTree(const std::vector<float>& values,
             std::size_t columns,
             std::size_t neighbors,
             unsigned threads,
             Report& report);

/** \brief The longest edge of the Euclidean minimum spanning tree of positions: balls
 * of half this radius about them just hang together; 0 for less than two.
 * \throws InvalidArgument for a position that is not finite */
PCL_UVOL_EXPORTS double
longestSpanningEdge(const std::vector<Position>& positions,
                    unsigned threads,
                    Report& report);

} // namespace pcl_uvol
