// SPDX-License-Identifier: BSD-3-Clause
// Density clustering of planted clusters, and projections that keep them apart.
#include "multivariate/cluster_attributes.h"
#include "multivariate/planted_clusters.h"
#include "multivariate/star_clusters.h"

#include <cstdio>
#include <cstdlib>

namespace {

void
printClustering(std::size_t points)
{
  constexpr std::size_t columns = 6, unit = 2200 + 550; // clusters and noise
  const std::size_t times = std::max<std::size_t>(1, points / unit);
  const auto planted = uvol_test::plantClusters(columns, 550 * times, 1, times);
  pcl_uvol::Report report;
  const auto clustering = pcl_uvol::detail::clusterAttributes(
      uvol_test::tableOf(columns, planted.values), {}, 0, report);
  std::printf("%zu points, %zu attributes: %d clusters, adjusted Rand index %.4f;",
              planted.labels.size(),
              columns,
              static_cast<int>(report.getCount("clusters")),
              uvol_test::adjustedRandIndex(planted.labels, clustering.labels));
  for (const auto& [step, milliseconds] : report.milliseconds)
    std::printf(" %s %.2f s", step.c_str(), 1e-3 * milliseconds);
  std::puts("");
}

} // namespace

/** clusters POINTS: one line of clustering, then one per planted set for projections.
 */
int
main(int argc, char** argv)
{
  if (argc != 2) {
    std::fputs("usage: clusters POINTS\n", stderr);
    return 2;
  }
  printClustering(static_cast<std::size_t>(std::atof(argv[1])));
  std::puts("# set principal_axes star_coordinates (smallest Fisher ratio)");
  for (const auto& planted : uvol_test::allPlanted())
    std::printf("%s %.4g %.4g\n",
                planted.name,
                uvol_test::ratioIn(planted, pcl_uvol::principalAxes(planted.table)),
                uvol_test::ratioIn(planted, uvol_test::optimize(planted)));
  return 0;
}
