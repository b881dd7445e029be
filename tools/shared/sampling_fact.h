// SPDX-License-Identifier: BSD-3-Clause
// What the sampling is like, in a report.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/neighbors/neighbor_graph.h>

namespace uvol_tools {

/** \brief "lines, spacing 1.3 along, 24 across (92 % of the samples)", and the shares
 * and spacings as numbers. */
Fact
describeSampling(const pcl_uvol::SamplingSummary& sampling);

} // namespace uvol_tools
