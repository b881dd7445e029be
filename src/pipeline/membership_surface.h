// SPDX-License-Identifier: BSD-3-Clause
// The surface between the samples of a cluster and the others (thesis 2.6, Figure 2.23
// a).
#pragma once

#include "common/stretch_axes.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <vector>

namespace pcl_uvol {

/** \brief Isopoints where the membership in a cluster is a half, with the fields of the
 * samples; those that are closer to the cluster's samples are inside.
 * \param members one per sample, see ClusterMembership
 * \param stretch of the space that distances are measured in
 * \param is_smooth the membership was smoothed, so that fits follow it; else it jumps,
 * and isopoints lie on the edges between samples
 * \param report continued: counts and times of the extraction, and its warnings */
PCL_UVOL_EXPORTS Dataset
extractMembershipSurface(const Dataset& samples,
                         const std::vector<float>& members,
                         const detail::Stretch& stretch,
                         bool is_smooth,
                         unsigned threads,
                         Report& report);

} // namespace pcl_uvol
