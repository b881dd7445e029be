// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/site_distances.h"

#include "common/parallel.h"

namespace pcl_uvol {

std::vector<float>
computeSiteDistances(const GridShape& shape,
                     const std::vector<GridCell>& sites,
                     const std::vector<std::uint32_t>& nearest,
                     unsigned threads)
{
  std::vector<float> distances(nearest.size());
  parallelBlocks(nearest.size(), shape.cells[0], threads, [&](auto begin, auto end) {
    GridCell cell = shape.cellOf(begin); // the first one of a row
    for (std::size_t index = begin; index < end; ++index, ++cell[0])
      distances[index] =
          static_cast<float>(shape.distance(cell, sites[nearest[index]]));
  });
  return distances;
}

} // namespace pcl_uvol
