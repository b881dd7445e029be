// SPDX-License-Identifier: BSD-3-Clause
// What uvol_isosurface tells of its result.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

namespace uvol_tools {

/** \brief The field and the isovalues, how many isopoints there are, how they were made
 * and how far off they may be, the sampling, filled gaps, and the pieces of a mesh.
 *
 * \param is_measured whether describeMeasures() tells programs of the pieces */
Facts
describeSurface(const pcl_uvol::IsosurfaceResult& result,
                const pcl_uvol::IsosurfacePipelineParameters& parameters,
                bool is_measured);

/** \brief The level set and the hold-out test of each isovalue, where there were any.
 */
Facts
describeModels(const pcl_uvol::IsosurfaceResult& result,
               const pcl_uvol::IsosurfacePipelineParameters& parameters);

} // namespace uvol_tools
