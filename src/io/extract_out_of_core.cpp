// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/extract_out_of_core.h>
#include <pcl_uvol/isosurface/edge_ends.h>

#include <algorithm>
#include <utility>

namespace pcl_uvol {

namespace {

/** Bytes of points that are read at once. */
constexpr std::size_t block_bytes = 16u << 20;

ScratchSamples
readPoints(PointStream& points,
           const IsosurfaceParameters& settings,
           const OutOfCoreSettings& out_of_core,
           Report& report)
{
  ScratchSamples samples(out_of_core);
  StepTimer step(report, "scratch", points.size());
  pcl::PCLPointCloud2 block;
  const std::size_t count =
      std::max<std::size_t>(block_bytes / points.getHeader().cloud.point_step, 1);
  for (std::uint64_t begin = points.tell(); points.read(count, block) > 0;
       begin = points.tell()) {
    const CloudView view = viewOf(block);
    samples.append(readSamples(view,
                               ScalarField(view.fields, settings.field),
                               toPosition(settings.scale),
                               begin,
                               out_of_core.threads,
                               report));
    step.advance(view.count);
  }
  if (samples.size() == 0)
    throw InvalidArgument("No sample has a position and a finite value of " +
                          settings.field + ".");
  return samples;
}

} // namespace

std::uint64_t
leastOutOfCoreMemory(std::uint64_t samples, std::size_t isovalues)
{
  return computeLeastMemory(samples, isovalues, sizeof(GlobalIsopoint));
}

OutOfCoreIsosurface
extractOutOfCore(PointStream& points,
                 const IsosurfaceParameters& settings,
                 const OutOfCoreSettings& out_of_core,
                 Report& report)
{
  IsosurfaceStage stage(settings);
  runOutOfCore(
      stage, readPoints(points, settings, out_of_core, report), out_of_core, report);
  const auto found = std::move(stage).take();
  OutOfCoreIsosurface surface;
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

} // namespace pcl_uvol
