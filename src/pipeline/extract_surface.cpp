// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/extract_surface.h"

#include "levelset/level_set_input.h"
#include "neighbors/sampling.h"
#include "pipeline/extract_points.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/zero_level.h"
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <limits>

namespace pcl_uvol {

namespace {

/** Of samples as they are. */
SurfaceTriangles
extractPlain(const PipelineInput& input,
             const IsosurfaceParameters& parameters,
             IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
             unsigned threads,
             Report& report)
{
  if (input.parameters.mesh)
    return detail::makeSurfaceMesh(viewOf(input.samples->cloud),
                                   listPoints(input),
                                   {parameters, *input.parameters.mesh},
                                   parameters.isovalues,
                                   threads,
                                   report);
  return extractPoints(extraction, parameters, threads, report);
}

/** One isovalue after the other, each by a level set of its own.
 * \param sampling set if a level set has looked at it */
SurfaceTriangles
extractLevelSets(const PipelineInput& input,
                 IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
                 std::vector<LevelSetSummary>& summaries,
                 std::optional<SamplingSummary>& sampling,
                 unsigned threads,
                 Report& report)
{
  const IsosurfaceParameters& parameters = input.parameters.isosurface;
  LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  evolution.setInputCloud(shareCloud(input));
  evolution.setIndices(input.use);
  evolution.setNumberOfThreads(threads);
  evolution.setProgressCallback(report.progress);
  LevelSetParameters level_set = input.parameters.level_set;
  level_set.initial =
      moveShape(level_set.initial, Eigen::Array3d(input.samples->origin.data()));
  evolution.setParameters(level_set);
  evolution.setScalarField(parameters.field);
  evolution.setScale(parameters.scale);
  evolution.setOutside(parameters.outside);
  SurfaceTriangles all;
  for (const double isovalue : parameters.isovalues) {
    evolution.setIsoValue(isovalue);
    IsosurfaceParameters of_isovalue = parameters;
    of_isovalue.isovalues = {isovalue};
    summaries.emplace_back();
    summaries.back().smoothed = false;
    std::vector<float> phi;
    try {
      evolution.evolve(phi);
      summaries.back() = evolution.getSummary();
      sampling = evolution.getSampling();
      report.merge(evolution.getReport());
    }
    catch (const NoLevelSet&) {
      // Extraction says what is wrong with the isovalue, and goes on.
    }
    SurfaceTriangles found;
    Report of_surface;
    of_surface.progress = report.progress;
    if (summaries.back().smoothed) {
      // Among points at one position edges name only the one that phi was made from.
      std::vector<float> of_sources(phi.size(),
                                    std::numeric_limits<float>::quiet_NaN());
      for (const std::uint32_t source : evolution.getSources())
        of_sources[source] = phi[source];
      found = extractZeroLevel(viewOf(input.samples->cloud),
                               of_sources,
                               evolution.getDeviations(),
                               of_isovalue,
                               input.parameters.mesh,
                               threads,
                               of_surface);
      if (found.vertices.empty()) // the level set has told that it vanished
        of_surface.warnings.clear();
    }
    else
      found = extractPlain(input, of_isovalue, extraction, threads, of_surface);
    report.merge(of_surface);
    all.append(found);
  }
  return all;
}

} // namespace

ExtractedSurface
extractSurface(const PipelineInput& input,
               IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
               const std::optional<SamplingSummary>& sampling,
               unsigned threads,
               Report& report)
{
  const IsosurfacePipelineParameters& parameters = input.parameters;
  const auto summarize = [&] {
    const StepTimer timer(report, "sampling");
    if (!parameters.mesh)
      return summarizeSampling(*extraction.getSamples(), threads);
    // By a tree of its own, as that of a mesh has another order of samples.
    return summarizeSampling(viewOf(input.samples->cloud),
                             listPoints(input),
                             parameters.isosurface.field,
                             parameters.isosurface.scale,
                             Eigen::Array3d::Zero(),
                             threads);
  };
  ExtractedSurface surface;
  surface.samples = input.samples;
  std::optional<SamplingSummary> known = sampling;
  if (!known && parameters.mesh && !parameters.smooth)
    known = summarize(); // before the mesh takes the memory for it
  std::optional<SamplingSummary> of_level_set;
  surface.triangles =
      parameters.smooth
          ? extractLevelSets(
                input, extraction, surface.level_sets, of_level_set, threads, report)
          : extractPlain(input, withErrors(parameters), extraction, threads, report);
  if (!known)
    known = of_level_set ? of_level_set : summarize();
  surface.sampling = *known;
  return surface;
}

} // namespace pcl_uvol
