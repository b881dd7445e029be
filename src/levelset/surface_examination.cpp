// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/surface_examination.h"

#include "isosurface/isopoints.h"
#include "neighbors/sampling.h"

#include <pcl/point_cloud.h>

namespace pcl_uvol {

namespace {

/** Count what those rest on that an extraction of linear isopoints examines. */
void
countExaminedRoots(const LevelSetInput& input,
                   unsigned threads,
                   SurfaceTally& tally,
                   Report& report)
{
  const NodeRanges ranges = input.samples->getTree().computeRanges(input.f, threads);
  const TouchingCells candidates(*input.samples);
  const IsopointInput of_isopoints{*input.samples,
                                   input.f,
                                   ranges,
                                   candidates,
                                   AngleCriterion::Kept,
                                   Outside::Lower,
                                   Interpolation::Linear,
                                   threads};
  pcl::PointCloud<PointIso> isopoints;
  IsoEdges edges;
  Report own; // the level set counts for itself
  own.progress = report.progress;
  appendIsopoints(of_isopoints, input.sources, 0.0f, isopoints, edges, tally, own);
  report.count("examined", tally.examined);
  report.count("examined_bridged", tally.examined_bridged);
  report.count("examined_rim", tally.examined_rim);
}

} // namespace

SamplingSummary
examineSurface(const LevelSetInput& input,
               bool is_examined,
               unsigned threads,
               SurfaceTally& tally,
               Report& report)
{
  const StepTimer timer(report, "sampling");
  const SamplingSummary sampling = summarizeSampling(*input.samples, threads);
  if (is_examined && sampling.most != LocalDimension::Volume)
    countExaminedRoots(input, threads, tally, report);
  return sampling;
}

} // namespace pcl_uvol
