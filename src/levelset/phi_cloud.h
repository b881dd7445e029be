// SPDX-License-Identifier: BSD-3-Clause
// Level-set functions as clouds, of which isosurfaces are extracted.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <vector>

namespace pcl_uvol {

/** \brief Bytes of a point of makePhiCloud(). */
constexpr std::size_t phi_point_bytes = 4 * sizeof(float);

/** \brief A cloud of the points' coordinates and the field `phi`, of which
 * IsosurfaceExtraction makes the zero level.
 * \param cloud of the samples
 * \param phi one per point
 * \throws InvalidArgument for another number */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
makePhiCloud(const CloudView& cloud, const std::vector<float>& phi);

} // namespace pcl_uvol
