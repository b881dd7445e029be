// SPDX-License-Identifier: BSD-3-Clause
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "distributed/fetch_points.h"
#include "isosurface/edge_ends.h"
#include "pipeline/extract_from_ranks.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/isopoint_filter.h"
#include "pipeline/part_in_box.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

using Isopoints = std::vector<std::vector<GlobalIsopoint>>;

/** Refuses what needs samples of other processes. */
void
checkDistributed(const IsosurfacePipelineParameters& parameters)
{
  checkParameters(parameters);
  if (parameters.automatic_scale)
    throw InvalidArgument("distributed_scale", {});
  if (detail::StretchAxes(parameters.rotation).areTurned())
    throw InvalidArgument("distributed_rotation", {});
  if (parameters.mesh)
    throw InvalidArgument("distributed_mesh", {});
  if (parameters.smooth)
    throw InvalidArgument("distributed_level_set", {});
  if (parameters.fill_gaps)
    throw InvalidArgument("distributed_gaps", {});
  if (parameters.validation.folds > 0)
    throw InvalidArgument("distributed_hold_out", {});
  if (parameters.normals != NormalMethod::Auto &&
      parameters.normals != NormalMethod::Edge)
    throw InvalidArgument("distributed_normals", {});
}

/** The isopoints of this process with the fields of the samples at their edges. */
IsosurfaceResult
finishIsopoints(const Isopoints& isopoints,
                const PartInBox& part,
                const IsosurfacePipelineParameters& parameters,
                const SamplingSummary& sampling,
                Communicator& communicator,
                unsigned threads,
                Report&& report)
{
  EdgeEnds ends = findEdgeEnds(isopoints);
  SurfaceTriangles found;
  found.edges = std::move(ends.edges);
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    for (const GlobalIsopoint& isopoint : isopoints[i])
      found.vertices.push_back(
          toPointIso(isopoint, parameters.isosurface.isovalues[i]));
  Dataset samples = withoutCloud(part.getPoints());
  samples.cloud = fetchPoints(
      part.getPoints().cloud, part.getFirstPoint(), ends.points, communicator, report);
  samples.cloud.header = part.getPoints().cloud.header;
  IsosurfaceResult result = finishIsosurface(samples,
                                             std::move(found),
                                             parameters,
                                             sampling,
                                             communicator,
                                             threads,
                                             std::move(report));
  part.finish(communicator, result);
  setGlobeFields(result.surface);
  return result;
}

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

/** Warn of samples that differ at one place, images among them as in one process. */
void
warnOfConflicts(Communicator& communicator, Report& report)
{
  const Report together =
      addCounts({"samples", "conflicting_duplicates"}, report, communicator);
  warnOfConflicts(together.getCount("conflicting_duplicates"),
                  together.getCount("samples"),
                  report);
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
DistributedIsosurfacePipeline::run()
{
  if (!part_)
    throw InvalidArgument("distributed_without_input", {});
  checkDistributed(parameters_);
  startReport();
  IsosurfacePipelineParameters parameters = parameters_;
  parameters.normals = NormalMethod::Edge; // of isopoints that have none yet
  IsosurfaceParameters& isosurface = parameters.isosurface;
  // Isopoints around one may belong to other processes: none is put back to its edge.
  if (isosurface.interpolation == Interpolation::Auto)
    isosurface.interpolation = Interpolation::Fit;
  if (isosurface.field.empty())
    isosurface.field = ScalarField::defaultName(listNumberFields(*part_));
  refuseNames(*part_, isosurface.field);
  const PartInBox part(part_, parameters, communicator_, threads_, report_);
  const CloudView view = viewOf(part.getPoints().cloud);
  const ScalarField field(view.fields, isosurface.field);
  const ValueFrame frame = findValueFrame(view, field, communicator_, threads_);
  IsosurfaceParameters extraction = withErrors(parameters);
  if (parameters_.isosurface.interpolation == Interpolation::Auto)
    extraction.interpolation = Interpolation::Auto; // without contradicted ones
  auto [isopoints, sampling] =
      extractFromRanks(part.readSamples(field, frame, threads_, report_),
                       extraction,
                       frame,
                       communicator_,
                       threads_,
                       report_);
  warnOfConflicts(communicator_, report_);
  if (is_gathered_)
    isopoints = gatherIsopoints(std::move(isopoints), communicator_, threads_);
  part.numberByPoints(isopoints);
  IsosurfaceResult result = finishIsopoints(isopoints,
                                            part,
                                            parameters,
                                            sampling,
                                            communicator_,
                                            threads_,
                                            std::move(report_));
  warnOfLosses(parameters, communicator_, result.report);
  report_ = result.report;
  return result;
}

} // namespace pcl_uvol
