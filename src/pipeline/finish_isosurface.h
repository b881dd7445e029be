// SPDX-License-Identifier: BSD-3-Clause
// From isopoints that were extracted elsewhere to a surface with all fields.
#pragma once

#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/point_cloud.h>

#include <optional>

namespace pcl_uvol {

/** \brief What a surface stands for, and is said of it where it is a guess. */
enum class SurfaceRole {
  Isosurface,
  ClusterBorder ///< between the samples of a cluster and the others
};

/** \brief The second half of the way, for isopoints that were extracted elsewhere, out
 * of core or by another process: normals, filters, fields and warnings.
 * \param samples between which the edges lie; with a box that repeats they count from
 * its low corner, and isopoints outside of it are left out
 * \param parameters with the field and the scale that were taken
 * \param sampling of all samples, if it is known
 * \param communicator of those among which the isopoints of one surface lie: they are
 * warned of together, by all processes
 * \param report continued
 * \param isopoints that were extracted
 * \param edges one per isopoint
 * \param threads 0: all cores */
IsosurfaceResult
finishIsosurface(const Dataset& samples,
                 pcl::PointCloud<PointIso>&& isopoints,
                 IsoEdges&& edges,
                 const IsosurfacePipelineParameters& parameters,
                 const std::optional<SamplingSummary>& sampling,
                 Communicator& communicator,
                 unsigned threads,
                 Report&& report,
                 SurfaceRole role = SurfaceRole::Isosurface);

} // namespace pcl_uvol
