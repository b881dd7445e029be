// SPDX-License-Identifier: BSD-3-Clause
// Bytes of the samples in leaf order and of what is found among them.
#pragma once

#include "common/memory.h"
#include <pcl_uvol/common/export.h>

namespace pcl_uvol {

/** \brief The memory of SampleSet::build: 24 to 32 bytes per sample remain, by how far
 * their number is from a power of two. */
PCL_UVOL_EXPORTS MemoryNeed
sampleSetNeed(double samples);

/** \brief Bytes of KdTree::computeRanges: 8 to 16 per sample. */
PCL_UVOL_EXPORTS double
nodeRangesBytes(double samples);

/** \brief The memory of computeNearestNeighbors, by FLANN. */
PCL_UVOL_EXPORTS MemoryNeed
nearestNeighborsNeed(double samples, double k);

} // namespace pcl_uvol
