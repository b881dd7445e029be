// SPDX-License-Identifier: BSD-3-Clause
// Parts of a surface, and gaps between them, that are one layer of samples thick.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/point_cloud.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Find the isopoints on parts, or beside gaps, that are one layer of samples
 * thick: the two sides of the layer share its samples, which cannot tell one side from
 * the other.
 *
 * An isopoint is one of them if around a sample of its edge the normals of the
 * isovalue's isopoints cancel: their mean is shorter than half of a unit vector. At the
 * corner of a cube it has 0.58 of it, at an edge 0.71.
 * \param isopoints one isovalue after another
 * \param edges of isopoints, with indices into the samples
 * \return one per isopoint: 1 if it is one of them */
PCL_UVOL_EXPORTS std::vector<std::uint8_t>
findThinParts(const pcl::PointCloud<PointIso>& isopoints, const IsoEdges& edges);

} // namespace pcl_uvol
