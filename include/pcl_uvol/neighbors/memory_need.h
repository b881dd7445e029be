// SPDX-License-Identifier: BSD-3-Clause
// Bytes of the samples in leaf order and of what is found among them.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/memory.h>

namespace pcl_uvol {

/** \brief Of SampleSet::build: 24 to 32 bytes per sample remain, by how far their
 * number is from a power of two. */
PCL_UVOL_EXPORTS MemoryNeed
sampleSetNeed(double samples);

/** \brief Bytes of KdTree::computeRanges: 8 to 16 per sample. */
PCL_UVOL_EXPORTS double
nodeRangesBytes(double samples);

/** \brief Of computeNearestNeighbors, by FLANN. */
PCL_UVOL_EXPORTS MemoryNeed
nearestNeighborsNeed(double samples, double k);

} // namespace pcl_uvol
