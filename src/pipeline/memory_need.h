// SPDX-License-Identifier: BSD-3-Clause
// Bytes of whole jobs besides the samples, at their peak.
#pragma once

#include "pipeline/level_set_job.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

namespace pcl_uvol {

/** \brief Of IsosurfacePipeline, from the samples to surfaces of usual size with all
 * fields.
 *
 * \param point_step bytes of a sample */
PCL_UVOL_EXPORTS double
pipelineBytes(double samples,
              double point_step,
              const IsosurfacePipelineParameters& parameters);

/** \brief Of runLevelSet(), and of writing what comes of it. */
PCL_UVOL_EXPORTS double
levelSetJobBytes(double samples, double point_step, const LevelSetRequest& request);

} // namespace pcl_uvol
