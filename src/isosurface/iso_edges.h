// SPDX-License-Identifier: BSD-3-Clause
// What becomes of isopoints and their edges before fields are carried along.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/PCLPointField.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief Leave only the isopoints, and their edges, that keep says yes to.
 * \param isopoints of an extraction
 * \param edges one per isopoint
 * \param keep asked once for each isopoint
 * \return how many went
 * \throws InvalidArgument if sizes disagree */
PCL_UVOL_EXPORTS std::size_t
filterIsopoints(pcl::PointCloud<PointIso>& isopoints,
                IsoEdges& edges,
                const std::function<bool(const PointIso&)>& keep);

/** \brief Warn of every field of the samples that gives way to one of the isopoints, a
 * column called error, say, before fields are carried along. Coordinates and normals
 * are meant to.
 * \param samples fields of the samples
 * \param isopoints fields of the isopoints
 * \param report gets the warnings */
PCL_UVOL_EXPORTS void
warnOfReplacedFields(const std::vector<pcl::PCLPointField>& samples,
                     const std::vector<pcl::PCLPointField>& isopoints,
                     Report& report);

} // namespace pcl_uvol
