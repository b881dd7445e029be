// SPDX-License-Identifier: BSD-3-Clause
// The k nearest neighbours of every sample, by FLANN or by a search of the user's.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <pcl/point_types.h>
#include <pcl/search/search.h>

#include <cstddef>

namespace pcl_uvol {

/** \brief The k nearest of every sample without the sample itself, in leaf order; all
 * others where there are no more than k.
 *
 * Storage and queries in leaf order are spatially coherent, which is most of the speed,
 * and make FLANN's choice among equally far neighbours independent of the order of the
 * input.
 * \param k >= 1
 * \param report gets the time of "nearest_neighbors". Memory: 4 bytes per neighbour, 8
 * per sample, and FLANN's copy of the positions.
 * \throws InvalidArgument for k = 0 */
PCL_UVOL_EXPORTS NeighborGraph
computeNearestNeighbors(const SampleSet& samples,
                        std::size_t k,
                        unsigned threads,
                        Report& report);

/** \brief The same by a search of the user's, whose input cloud becomes the samples in
 * leaf order, in the unit of the input unless float has no squares of such lengths. It
 * is called from several threads at once, as by pcl::NormalEstimationOMP, unless
 * threads is 1; an approximate search may give fewer than k.
 * \throws InvalidArgument for k = 0 or a null search */
PCL_UVOL_EXPORTS NeighborGraph
computeNearestNeighbors(const SampleSet& samples,
                        std::size_t k,
                        unsigned threads,
                        const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
                        Report& report);

} // namespace pcl_uvol
