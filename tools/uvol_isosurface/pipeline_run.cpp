// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_isosurface/pipeline_run.h"

#include "common/memory.h"
#include "expressions/derived_source.h"
#include "io/point_stream.h"
#include "pipeline/extract_out_of_core.h"
#include "pipeline/gap_filling.h"
#include "shared/measure_table.h"
#include "shared/point_files.h"
#include "uvol_isosurface/input_samples.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <memory>

namespace uvol_tools {

using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::IsosurfaceResult;
using pcl_uvol::Report;

namespace {

/** Measure the surface and look for intersections, as asked for, and give its points
 * their share of the area and their piece. */
Facts
measureResult(const Options& options,
              const PipelineOptions& arguments,
              const std::shared_ptr<const pcl_uvol::Dataset>& samples,
              IsosurfaceResult& result)
{
  const bool is_measured = arguments.getMesh().isMeasured();
  pcl_uvol::SurfaceMeasuresParameters parameters;
  parameters.find_intersections = arguments.getMesh().isChecked();
  parameters.field = result.field;
  parameters.outside = arguments.parameters.isosurface.outside;
  parameters.periodic = arguments.parameters.periodic;
  const bool is_mesh = !result.triangles.empty();
  if (result.surface.cloud.width == 0 ||
      arguments.parameters.mesh.has_value() != is_mesh ||
      (!is_measured && !parameters.find_intersections))
    return {};
  const auto vertices = std::make_shared<pcl_uvol::Dataset>(std::move(result.surface));
  const pcl_uvol::SurfaceFigures figures =
      measureSurface(vertices,
                     result.triangles,
                     is_measured ? samples : nullptr,
                     arguments.parameters.isosurface.isovalues,
                     parameters,
                     options.threads(),
                     result.report);
  result.surface = std::move(*vertices);
  if (!is_measured)
    return {};
  setField(result.surface, "area", figures.vertex_areas);
  if (!is_mesh)
    setField(result.surface, "piece", figures.piece_of);
  return describeMeasures(figures);
}

} // namespace

IsosurfaceResult
runInMemory(const Options& options,
            PipelineOptions& arguments,
            Report& report,
            Facts& figures)
try {
  const auto samples = loadSamples(options, arguments, report);
  const IsosurfacePipelineParameters& parameters = arguments.parameters;
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(options.threads());
  pipeline.setProgressCallback(report.progress);
  IsosurfaceResult result = pipeline.run();
  if (result.box)
    figures.push_back(describeBox(*result.box));
  for (const Fact& fact : measureResult(options, arguments, samples, result))
    figures.push_back(fact);
  return result;
}
catch (const pcl_uvol::NotEnoughMemory& error) {
  if (arguments.needsAllSamples())
    throw;
  pcl_uvol::Message message = error.asMessage();
  message.about = "Without -max-memory";
  throw pcl_uvol::NotEnoughMemory(message);
}

IsosurfaceResult
runFromDisk(const Options& options, const PipelineOptions& arguments, Report& report)
{
  const pcl_uvol::LoadOptions load = onMapOfCommand(arguments.makeLoadOptions());
  pcl_uvol::PointStream file(arguments.input, load);
  pcl_uvol::IsosurfacePipelineParameters parameters = arguments.parameters;
  pcl_uvol::DerivedSource points(file, parameters.isosurface.field, options.threads());
  parameters.isosurface.field = points.getField();
  checkOutput(arguments, points.getHeader());
  report.warnings = points.getHeader().notes;
  keepMap(arguments.input, points.getHeader(), load, report);
  report.count("points", points.size());
  auto result = pcl_uvol::runPipelineOutOfCore(
      points, parameters, arguments.makeOutOfCoreSettings(options), report.progress);
  points.addTo(report);
  return result;
}

} // namespace uvol_tools
