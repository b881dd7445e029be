// SPDX-License-Identifier: BSD-3-Clause
// The two steps of ClusterMembership.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief 1 for the points of a cluster, 0 for all others.
 * \param cluster one of the labels, that of noise as well
 * \throws InvalidArgument for a label that no point has, naming those that there are */
PCL_UVOL_EXPORTS std::vector<float>
membership(const std::vector<std::int32_t>& labels, std::int32_t cluster);

/** \brief Smooth membership as ClusterMembership tells.
 *
 * Points that cannot be smoothed are counted as "not_smoothed".
 * \param values, smoothing_lengths one per index
 * \throws InvalidArgument for another number of values or lengths than of indices, and
 * values out of range */
PCL_UVOL_EXPORTS std::vector<float>
smoothMembership(const CloudView& cloud,
                 const pcl::Indices& indices,
                 const std::vector<float>& values,
                 const std::vector<float>& smoothing_lengths,
                 unsigned threads,
                 Report& report);

} // namespace pcl_uvol
