// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/isosurface_run.h"

#include "common/sample_checks.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/isopoint_choice.h"
#include <pcl_uvol/common/map_projection.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

IsosurfaceResult
runIsosurface(SampleStore& store,
              const IsosurfacePipelineParameters& parameters,
              unsigned threads,
              Report&& report)
{
  checkParameters(parameters);
  IsosurfacePipelineParameters entered = parameters;
  store.enter(entered, report);
  ExtractedSurface surface = store.extract(entered, report);
  IsosurfaceResult result = finishIsosurface(*surface.samples,
                                             std::move(surface.triangles),
                                             entered,
                                             surface.sampling,
                                             store.getCommunicator(),
                                             threads,
                                             std::move(report),
                                             SurfaceRole::Isosurface,
                                             store.getGaps(),
                                             store.removesUnlocated(entered));
  result.level_sets = std::move(surface.level_sets);
  store.leave(entered, result);
  setGlobeFields(result.surface);
  return result;
}

bool
SampleStore::removesUnlocated(const IsosurfacePipelineParameters& entered) const
{
  return returnsToEdges(entered);
}

void
warnOfConflicts(const StageSamples& own, Communicator& communicator, Report& report)
{
  std::vector<std::uint64_t> counts{own.conflicting, own.samples};
  communicator.allReduce(counts);
  warnOfConflicts(counts[0], counts[1], report);
}

} // namespace pcl_uvol
