// SPDX-License-Identifier: BSD-3-Clause
// Density-based clustering of a table of attributes.
#pragma once

#include "multivariate/attributes.h"
#include <pcl_uvol/multivariate/density_clustering.h>

namespace pcl_uvol::detail {

/** \brief The kernel of DensityClustering for any points.
 * \param report gets the counts "points", "clusters" and "noise", and times
 * \return per row of the table
 * \throws InvalidArgument as DensityClustering::compute */
PCL_UVOL_EXPORTS Clustering
clusterAttributes(const AttributeTable& table,
                  const ClusteringParameters& parameters,
                  unsigned threads,
                  Report& report);

} // namespace pcl_uvol::detail
