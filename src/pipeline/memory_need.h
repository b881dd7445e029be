// SPDX-License-Identifier: BSD-3-Clause
// The memory of IsosurfacePipeline, from the samples to the surface with all fields.
#pragma once

#include "isosurface/memory_need.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <memory>
#include <vector>

namespace pcl_uvol {

/** \brief Add the memory of IsosurfacePipeline::run() to a forecast.
 * \param points, point_step of the samples, which the forecast holds already
 * \param surfaces see estimateSurfaces; fewer than isovalues, or none, where their
 * sizes are not known
 * \param gap_nodes see estimateGapNodes; without gaps to fill they count for nothing */
PCL_UVOL_EXPORTS void
addMemoryNeed(const IsosurfacePipelineParameters& parameters,
              double points,
              double point_step,
              std::vector<SurfaceSize> surfaces,
              double gap_nodes,
              MemoryForecast& forecast);

/** \brief See IsosurfacePipeline::estimateMemory().
 * \param parameters with the field and the scale that are taken */
double
estimatePeak(const std::shared_ptr<const Dataset>& samples,
             const IsosurfacePipelineParameters& parameters,
             unsigned threads);

} // namespace pcl_uvol
