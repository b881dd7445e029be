// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/isosurface_run.h"

#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/isopoint_filter.h"
#include <pcl_uvol/common/map_projection.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

/** The counts of all processes together. By all of them. */
Report
addCounts(const std::vector<std::string>& names,
          const Report& report,
          Communicator& communicator)
{
  std::vector<std::uint64_t> counts;
  for (const std::string& name : names)
    counts.push_back(report.getCount(name));
  communicator.allReduce(counts);
  Report together;
  for (std::size_t i = 0; i < counts.size(); ++i)
    together.setCount(names[i], counts[i]);
  return together;
}

/** Warn of what only the counts of all processes tell: each says the same. */
void
warnOfLosses(const IsosurfacePipelineParameters& parameters,
             Communicator& communicator,
             Report& report)
{
  Report together = addCounts({"crossing_samples",
                               "spikes",
                               "contradicted",
                               "removed_by_error",
                               "removed_bridged",
                               "isopoints"},
                              report,
                              communicator);
  warnOfLosses(parameters, together.getCount("isopoints"), together);
  for (Message& warning : together.warnings)
    report.warnings.push_back(std::move(warning));
}

} // namespace

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
                                             store.getGaps());
  result.level_sets = std::move(surface.level_sets);
  warnOfLosses(entered, store.getCommunicator(), result.report);
  store.leave(entered, result);
  setGlobeFields(result.surface);
  return result;
}

void
findField(const Dataset& samples, IsosurfacePipelineParameters& parameters)
{
  std::string& field = parameters.isosurface.field;
  if (field.empty())
    field = ScalarField::defaultName(listNumberFields(samples));
  refuseNames(samples, field);
}

void
warnOfConflicts(Communicator& communicator, Report& report)
{
  const Report together =
      addCounts({"samples", "conflicting_duplicates"}, report, communicator);
  warnOfConflicts(together.getCount("conflicting_duplicates"),
                  together.getCount("samples"),
                  report);
}

} // namespace pcl_uvol
