// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/extract_out_of_core.h"

#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "isosurface/edge_ends.h"
#include "neighbors/sampling.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/isopoint_filter.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/map_projection.h>

#include <algorithm>
#include <utility>

namespace pcl_uvol {

namespace {

/** Bytes of points that are read at once. */
constexpr std::size_t block_bytes = 16u << 20;

/** The samples of a source, with their values in a frame.
 * \param range gets all values */
ScratchSamples
readPoints(PointSource& points,
           const IsosurfaceParameters& settings,
           const OutOfCoreSettings& out_of_core,
           const ValueFrame& frame,
           ValueRange& range,
           StepTimer& step,
           Report& report)
{
  ScratchSamples samples(out_of_core, toPosition(settings.scale));
  pcl::PCLPointCloud2 block;
  const std::size_t count =
      std::max<std::size_t>(block_bytes / points.getHeader().cloud.point_step, 1);
  for (std::uint64_t begin = points.tell(); points.read(count, block) > 0;
       begin = points.tell()) {
    const CloudView view = viewOf(block);
    const ScalarField field(view.fields, settings.field);
    samples.append(readSamples(view, field, frame, begin, out_of_core.threads, report));
    range.add(findValueRange(view, field, out_of_core.threads));
    step.advance(view.count);
  }
  return samples;
}

/** Samples in their unit and frame. */
struct ReadSamples {
  ScratchSamples samples;
  LengthUnit unit;
  ValueFrame frame;
};

ReadSamples
readPoints(PointSource& points,
           const IsosurfaceParameters& settings,
           const OutOfCoreSettings& out_of_core,
           Report& report)
{
  StepTimer step(report, "scratch", points.size());
  Report counts;
  ValueRange range;
  ReadSamples read{
      readPoints(points, settings, out_of_core, {}, range, step, counts), {}, {}};
  // Nearly always float holds the values as they are.
  if (const ValueFrame frame = range.findFrame(); !(frame == read.frame)) {
    points.seek(0);
    counts = Report();
    read.frame = frame;
    read.samples =
        readPoints(points, settings, out_of_core, frame, range, step, counts);
  }
  report.merge(counts);
  if (read.samples.size() == 0)
    throw InvalidArgument("no_sample_with_value", {{"field", settings.field}});
  read.unit = read.samples.normalize(report);
  return read;
}

} // namespace

std::uint64_t
leastOutOfCoreMemory(std::uint64_t samples, std::size_t isovalues)
{
  return computeLeastMemory(samples, isovalues, sizeof(GlobalIsopoint));
}

OutOfCoreIsosurface
extractOutOfCore(PointSource& points,
                 const IsosurfaceParameters& settings,
                 const OutOfCoreSettings& out_of_core,
                 Report& report)
{
  checkParameters(settings);
  ReadSamples read = readPoints(points, settings, out_of_core, report);
  IsosurfaceStage stage(settings, read.unit, read.frame);
  OutOfCoreIsosurface surface;
  surface.sampling = toInput(
      runOutOfCore(stage, std::move(read.samples), out_of_core, report), read.unit);
  SelfCommunicator alone;
  const auto found = std::move(stage).take(alone, report);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const GlobalIsopoint& isopoint : found[i])
      surface.isopoints.push_back(toPointIso(isopoint, settings.isovalues[i]));
  const StepTimer timer(report, "fields");
  EdgeEnds ends = findEdgeEnds(found);
  surface.edges = std::move(ends.edges);
  points.seek(0);
  points.readRows(ends.points, surface.samples);
  return surface;
}

IsosurfaceResult
runPipelineOutOfCore(PointSource& points,
                     const IsosurfacePipelineParameters& parameters,
                     const OutOfCoreSettings& out_of_core,
                     const ProgressCallback& progress)
{
  checkParameters(parameters);
  if (parameters.smooth || parameters.automatic_scale || parameters.mesh ||
      parameters.fill_gaps || parameters.validation.folds > 0 ||
      (parameters.periodic > 0.0).any() ||
      detail::StretchAxes(parameters.rotation).areTurned() ||
      parameters.isosurface.neighbors != NeighborSource::KdTree)
    throw InvalidArgument("not_out_of_core", {});
  Dataset samples = points.getHeader();
  IsosurfacePipelineParameters resolved = parameters;
  if (resolved.isosurface.field.empty())
    resolved.isosurface.field = ScalarField::defaultName(listNumberFields(samples));
  refuseNames(samples, resolved.isosurface.field);
  Report report;
  report.progress = progress;
  auto surface = extractOutOfCore(points, withErrors(resolved), out_of_core, report);
  samples.cloud = std::move(surface.samples);
  SurfaceTriangles found;
  found.vertices = std::move(surface.isopoints);
  found.edges = std::move(surface.edges);
  SelfCommunicator alone;
  IsosurfaceResult result = finishIsosurface(samples,
                                             std::move(found),
                                             resolved,
                                             surface.sampling,
                                             alone,
                                             out_of_core.threads,
                                             std::move(report));
  setGlobeFields(result.surface);
  warnOfConflicts(result.report.getCount("conflicting_duplicates"),
                  result.report.getCount("samples"),
                  result.report);
  warnOfLosses(resolved, result.surface.cloud.width, result.report);
  return result;
}

} // namespace pcl_uvol
