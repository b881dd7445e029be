// SPDX-License-Identifier: BSD-3-Clause
// Which isopoints a pipeline keeps, and what it says of them.
#pragma once

#include "pipeline/isopoint_choice.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <string>

namespace pcl_uvol {

/** \brief Leave out what belongs to images, and what max_error and drop_bridged do not
 * want: counted as "removed_by_error" and "removed_bridged". */
void
dropIsopoints(pcl::PointCloud<PointIso>& isopoints,
              IsoEdges& edges,
              IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              Report& report);

/** \brief What may help where samples leave much open, of what was not asked for: a
 * sentence behind a space, empty if it was all. */
std::string
adviseRemedies(const IsosurfacePipelineParameters& parameters);

/** \brief Warn where most isopoints do not rest on samples around them, and count those
 * that rest on predicted ones. */
void
warnOfGuesses(const pcl::PointCloud<PointIso>& isopoints,
              const IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              Report& report);

/** \brief Warn of samples next to the surface whose values stand alone, and where
 * max_error and drop_bridged left no isopoint, as the counts of a whole run tell.
 * \param isopoints that are left */
void
warnOfLosses(const IsosurfacePipelineParameters& parameters,
             std::uint64_t isopoints,
             Report& report);

} // namespace pcl_uvol
