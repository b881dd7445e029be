// SPDX-License-Identifier: BSD-3-Clause
// From isopoints or triangles to a surface with all fields.
#pragma once

#include "pipeline/weak_support.h"
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <optional>

namespace pcl_uvol {

namespace detail {
class FilledGaps;
}

/** \brief The second half of the way, wherever a surface was extracted: normals,
 * filters, fields and warnings.
 * \param samples between which the edges lie; with a box that repeats they count from
 * its low corner, and isopoints outside of it are left out
 * \param found isopoints, which are vertices without triangles, or a mesh
 * \param parameters with the field and the scale that were taken
 * \param sampling of all samples, if it is known
 * \param communicator of those among which the isopoints of one surface lie: they are
 * warned of together, by all processes
 * \param threads 0: all cores
 * \param report continued
 * \param gaps of the samples; null if they were not filled
 * \param removes_unlocated isopoints in gaps, see SampleStore */
IsosurfaceResult
finishIsosurface(const Dataset& samples,
                 SurfaceTriangles&& found,
                 const IsosurfacePipelineParameters& parameters,
                 const std::optional<SamplingSummary>& sampling,
                 Communicator& communicator,
                 unsigned threads,
                 Report&& report,
                 SurfaceRole role = SurfaceRole::Isosurface,
                 const detail::FilledGaps* gaps = nullptr,
                 bool removes_unlocated = false);

} // namespace pcl_uvol
