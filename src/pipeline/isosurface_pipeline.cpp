// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "pipeline/extract_surface.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/gap_filling.h"
#include "pipeline/hold_out.h"
#include "pipeline/isopoint_filter.h"
#include "pipeline/memory_need.h"
#include "pipeline/periodic_surface.h"
#include "pipeline/pipeline_input.h"
#include "pipeline/turned_axes.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <utility>

namespace pcl_uvol {

namespace {

/** The field and the scale that are taken.
 * \param choice gets how an automatic scale was found */
IsosurfaceParameters
resolve(const PipelineInput& input,
        unsigned threads,
        std::optional<ScaleChoice>& choice)
{
  IsosurfaceParameters parameters = input.parameters.isosurface;
  if (parameters.field.empty())
    parameters.field = ScalarField::defaultName(listNumberFields(*input.samples));
  refuseNames(*input.samples, parameters.field);
  if (!input.parameters.automatic_scale)
    return parameters;
  Report own;
  choice = chooseScale(viewOf(input.samples->cloud),
                       listPoints(input),
                       parameters.field,
                       input.parameters.rotation,
                       threads,
                       own);
  parameters.scale = choice->scale;
  return parameters;
}

/** What a pipeline works on before the first step. */
PipelineInput
takeInput(const std::shared_ptr<const Dataset>& samples,
          const pcl::IndicesPtr& use,
          const IsosurfacePipelineParameters& parameters)
{
  if (!samples)
    throw InvalidArgument("pipeline_without_input", {});
  return {samples, use, parameters};
}

/** Runs the pipeline on parts of its samples: for a hold-out test. */
ExtractPart
extractParts(const PipelineInput& input, unsigned threads)
{
  IsosurfacePipeline pipeline;
  pipeline.setInput(input.samples);
  pipeline.setNumberOfThreads(threads);
  return [pipeline](const IsosurfacePipelineParameters& parameters,
                    const pcl::IndicesPtr& use,
                    const ProgressCallback& progress) mutable {
    pipeline.setParameters(parameters);
    pipeline.setIndices(use);
    pipeline.setProgressCallback(progress);
    return pipeline.run();
  };
}

} // namespace

void
IsosurfacePipeline::setInput(const std::shared_ptr<const Dataset>& samples)
{
  samples_ = samples;
  extraction_.setInputCloud(samples ? shareCloud({samples, nullptr, {}}) : nullptr);
}

void
IsosurfacePipeline::setIndices(const pcl::IndicesPtr& indices)
{
  indices_ = indices;
  extraction_.setIndices(indices);
}

IsosurfaceParameters
IsosurfacePipeline::resolveParameters(std::optional<ScaleChoice>* choice) const
{
  std::optional<ScaleChoice> found;
  const auto parameters =
      resolve(takeInput(samples_, indices_, parameters_), threads_, found);
  if (choice && found)
    *choice = found;
  return parameters;
}

double
IsosurfacePipeline::estimateMemory() const
{
  const PipelineInput input = takeInput(samples_, indices_, parameters_);
  return pipelineBytes(static_cast<double>(countPoints(input)),
                       static_cast<double>(input.samples->cloud.point_step),
                       parameters_);
}

IsosurfaceResult
IsosurfacePipeline::run()
{
  checkParameters(parameters_);
  startReport();
  PipelineInput input = takeInput(samples_, indices_, parameters_);
  checkMemoryOf("An isosurface", countPoints(input), estimateMemory());
  std::optional<ScaleChoice> scale_choice;
  std::optional<SamplingSummary> sampling;
  std::unique_ptr<detail::FilledGaps> gaps;

  const TurnedAxes axes(input);
  input.parameters.isosurface = resolve(input, threads_, scale_choice);
  const ValidationParameters& validation = parameters_.validation;
  std::optional<Folds> folds; // a field that is none fails early
  if (validation.folds > 0)
    folds = makeFolds(viewOf(input.samples->cloud), validation, threads_);
  const PipelineInput measured = input;
  if (parameters_.fill_gaps) {
    gaps = std::make_unique<detail::FilledGaps>(input, threads_, report_);
    sampling = gaps->getSampling();
  }
  const RepeatedBox box(input, threads_, report_);

  ExtractedSurface surface;
  if (input.samples == samples_)
    surface = extractSurface(input, extraction_, sampling, threads_, report_);
  else {
    IsosurfaceExtraction<pcl::PCLPointCloud2> other;
    other.setInputCloud(shareCloud(input));
    other.setIndices(input.use);
    surface = extractSurface(input, other, sampling, threads_, report_);
  }
  SelfCommunicator alone;
  IsosurfaceResult result = finishIsosurface(*input.samples,
                                             std::move(surface.triangles),
                                             input.parameters,
                                             surface.sampling,
                                             alone,
                                             threads_,
                                             std::move(report_),
                                             SurfaceRole::Isosurface,
                                             gaps.get());
  warnOfLosses(input.parameters, result.surface.cloud.width, result.report);
  result.level_sets = std::move(surface.level_sets);
  result.scale_choice = scale_choice;

  box.leave(input.parameters, result);
  if (gaps)
    result.gaps = gaps->getSummary();
  if (folds) {
    result.validation = scoreHeldOut(
        measured, *folds, extractParts(measured, threads_), threads_, result.report);
    warnOfScores(
        result.validation, measured.parameters, result.sampling, result.report);
  }
  axes.leave(result);
  setGlobeFields(result.surface);
  report_ = result.report;
  return result;
}

} // namespace pcl_uvol
