// SPDX-License-Identifier: BSD-3-Clause
// Bytes of a clustering.
#pragma once

#include "common/memory.h"
#include <pcl_uvol/common/export.h>

namespace pcl_uvol {

/** \brief The memory of DensityClustering besides the cloud: 60 bytes per point, 12 per
 * point and attribute, and 8 per neighbour that core distances reach to, of which there
 * are 8 at least; labels and probabilities remain. */
PCL_UVOL_EXPORTS MemoryNeed
clusteringNeed(double points, double attributes, double neighbors);

} // namespace pcl_uvol
