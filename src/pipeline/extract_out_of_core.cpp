// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/extract_out_of_core.h"

#include "common/memory.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "isosurface/edge_ends.h"
#include "neighbors/sampling.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/isosurface_run.h"
#include "pipeline/periodic_surface.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <memory>
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
  surface.read = runOutOfCore(stage, std::move(read.samples), out_of_core, report);
  surface.read.sampling = toInput(surface.read.sampling, read.unit);
  SelfCommunicator alone;
  auto found = stage.take(alone, report);
  surface.tally = stage.getTally();
  std::size_t count = 0;
  for (const auto& part : found)
    count += part.size();
  surface.isopoints.reserve(count);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const GlobalIsopoint& isopoint : found[i])
      surface.isopoints.push_back(toPointIso(isopoint, settings.isovalues[i]));
  const StepTimer timer(report, "fields");
  EdgeEnds ends = findEdgeEnds(found);
  found = {};
  surface.edges = std::move(ends.edges);
  checkMemoryOf("The fields of a surface",
                ends.points.size(),
                static_cast<double>(points.getHeader().cloud.point_step) *
                    static_cast<double>(ends.points.size()));
  points.seek(0);
  points.readRows(ends.points, surface.samples);
  return surface;
}

namespace {

/** Samples on disk, of which those at the edges of the surface are read again. */
class SamplesOnDisk : public SampleStore {
public:
  SamplesOnDisk(PointSource& points, const OutOfCoreSettings& settings)
      : points_(points)
      , settings_(settings)
  {
  }

  void
  enter(IsosurfacePipelineParameters& parameters, Report& report) override
  {
    if (parameters.smooth || parameters.takesAutomaticScale() || parameters.mesh ||
        parameters.fill_gaps || parameters.outside_value ||
        parameters.validation.folds > 0 || (parameters.periodic > 0.0).any() ||
        detail::StretchAxes(parameters.rotation).areTurned() ||
        parameters.isosurface.neighbors != NeighborSource::KdTree)
      throw InvalidArgument("not_out_of_core", {});
    std::string& field = parameters.isosurface.field;
    field = chooseField(points_.getHeader(), field);
    warnOfUnusedBox(points_.getHeader(), sidesOf(parameters), report);
  }

  ExtractedSurface
  extract(const IsosurfacePipelineParameters& parameters, Report& report) override
  {
    OutOfCoreIsosurface found =
        extractOutOfCore(points_, withErrors(parameters), settings_, report);
    warnOfConflicts(found.read, alone_, report);
    const auto samples = std::make_shared<Dataset>(points_.getHeader());
    samples->cloud = std::move(found.samples);
    ExtractedSurface surface;
    surface.samples = samples;
    surface.triangles.vertices = std::move(found.isopoints);
    surface.triangles.edges = std::move(found.edges);
    surface.triangles.tally = found.tally;
    surface.sampling = found.read.sampling;
    return surface;
  }

  Communicator&
  getCommunicator() override
  {
    return alone_;
  }

  void
  leave(const IsosurfacePipelineParameters&, IsosurfaceResult&) override
  {
  }

private:
  PointSource& points_;
  const OutOfCoreSettings& settings_;
  SelfCommunicator alone_;
};

} // namespace

IsosurfaceResult
runPipelineOutOfCore(PointSource& points,
                     const IsosurfacePipelineParameters& parameters,
                     const OutOfCoreSettings& out_of_core,
                     const ProgressCallback& progress)
{
  Report report;
  report.progress = progress;
  const MemoryLimit limit(out_of_core.max_memory);
  SamplesOnDisk samples(points, out_of_core);
  return runIsosurface(samples, parameters, out_of_core.threads, std::move(report));
}

} // namespace pcl_uvol
