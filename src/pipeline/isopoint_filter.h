// SPDX-License-Identifier: BSD-3-Clause
// Which isopoints a pipeline keeps, and what it says of them.
#pragma once

#include "pipeline/isopoint_choice.h"
#include "pipeline/supported_isopoints.h"
#include "pipeline/weak_support.h"
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <cstdint>
#include <optional>

namespace pcl_uvol {

/** \brief Isopoints that were dropped. */
struct DroppedIsopoints {
  std::uint64_t unlocated = 0;  ///< in gaps, where nothing locates them
  std::uint64_t by_error = 0;   ///< by max_error
  std::uint64_t by_support = 0; ///< by drop_bridged
};

/** \brief Leave out what belongs to images, isopoints in gaps that nothing
 * locates, and what max_error and drop_bridged do not want: counted as "unlocated",
 * "removed_by_error" and "removed_bridged". By all processes together.
 * \param supported what an automatic bound of the error keeps
 * \param removes_unlocated whether those that nothing locates are left out */
DroppedIsopoints
dropIsopoints(pcl::PointCloud<PointIso>& isopoints,
              IsoEdges& edges,
              IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              const SupportedIsopoints& supported,
              bool removes_unlocated,
              Communicator& communicator,
              unsigned threads,
              Report& report);

/** \brief Warn where most isopoints do not rest on samples around them. */
void
warnOfWeakSupport(const SupportCounts& counts,
                  SurfaceRole role,
                  const IsosurfacePipelineParameters& parameters,
                  const std::optional<SamplingSummary>& sampling,
                  Report& report);

/** \brief Warn of samples next to the surface whose values stand alone, and where few
 * isopoints are left or none, of all processes together. By all of them.
 * \param tally, dropped, isopoints of this process: isopoints that are left */
void
warnOfLosses(const IsosurfacePipelineParameters& parameters,
             const SurfaceTally& tally,
             const DroppedIsopoints& dropped,
             std::uint64_t isopoints,
             Communicator& communicator,
             Report& report);

} // namespace pcl_uvol
