// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/memory_need.h"

#include "multivariate/point_tree.h"
#include "multivariate/spanning_tree.h"

namespace pcl_uvol {

namespace {

constexpr double float_bytes = sizeof(float), index_bytes = sizeof(std::uint32_t);

/** As spanningTree does. */
constexpr double fewest_listed = 8.0;

/** A shortest edge on its way to the tree: two places and a weight. */
constexpr double candidate_bytes = 2 * index_bytes + float_bytes;

/** The tree's edges that the first round finds, in parts of all: most points
 * have the same nearest one as another point. */
constexpr double first_edges = 0.65;

/** Boruvka's method: labels of components, their parents, sizes and bounds, and what is
 * known to be nearest outside; then the shortest edge of every point, sorted by merging
 * halves, beside the edges of the first round. */
constexpr double forest_bytes = 3 * index_bytes + float_bytes +
                                sizeof(OutsideSearch::Found) + candidate_bytes +
                                first_edges * candidate_bytes;

} // namespace

MemoryNeed
clusteringNeed(double points, double attributes, double neighbors)
{
  const double row = attributes * float_bytes;
  MemoryForecast forecast(0.0);
  // Columns in double precision, complete rows as they are found and joined; the table.
  const double columns = (attributes * sizeof(double) + index_bytes) * points;
  forecast.hold(columns);
  forecast.hold((row + index_bytes) * points);
  forecast.release(columns);
  forecast.hold(row * points); // scaled
  // Bringing rows into order takes a copy, keys and as much room to move them.
  constexpr double key_bytes = float_bytes + 2 * index_bytes;
  constexpr double boxes = 2.0 / (PointTree::lanes - 1); // of points, two corners each
  forecast.run({(2.0 * row + index_bytes + key_bytes) * points,
                (row * (1.0 + boxes) + index_bytes) * points});
  const double listed = std::max(neighbors, fewest_listed);
  forecast.hold((listed * (index_bytes + float_bytes) + float_bytes) * points);
  forecast.hold(forest_bytes * points);
  return {forecast.getPeak(), (index_bytes + float_bytes) * points};
}

} // namespace pcl_uvol
