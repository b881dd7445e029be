// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/sample_checks.h"
#include "interpolation/outer_layer.h"
#include "pipeline/extract_surface.h"
#include "pipeline/gap_filling.h"
#include "pipeline/hold_out.h"
#include "pipeline/isosurface_run.h"
#include "pipeline/memory_need.h"
#include "pipeline/periodic_surface.h"
#include "pipeline/pipeline_input.h"
#include "pipeline/turned_axes.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <memory>
#include <numeric>
#include <string>
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
  IsosurfacePipelineParameters parameters = input.parameters;
  std::string& field = parameters.isosurface.field;
  field = chooseField(*input.samples, field);
  if (!parameters.takesAutomaticScale())
    return parameters.isosurface;
  Report own;
  choice = chooseScale(viewOf(input.samples->cloud),
                       listPoints(input),
                       field,
                       parameters.rotation,
                       threads,
                       own);
  parameters.isosurface.scale = choice->scale;
  return parameters.isosurface;
}

/** Adds samples of the value outside, as asked for. */
void
closeOutside(PipelineInput& input, unsigned threads, Report& report)
{
  IsosurfacePipelineParameters& parameters = input.parameters;
  if (!parameters.outside_value)
    return;
  parameters.isosurface.interpolation = parameters.takenInterpolation();
  if (parameters.isosurface.interpolation != Interpolation::Linear)
    report.warn("fits_oscillate");
  std::string& field = parameters.isosurface.field;
  field = chooseField(*input.samples, field);
  const auto closed = std::make_shared<Dataset>(*input.samples);
  addOuterLayer(
      *closed, input.use.get(), field, *parameters.outside_value, threads, report);
  if (input.use) {
    const std::size_t given = input.use->size();
    input.use = pcl::make_shared<pcl::Indices>(*input.use);
    input.use->resize(given + closed->cloud.width - input.samples->cloud.width);
    std::iota(input.use->begin() + static_cast<std::ptrdiff_t>(given),
              input.use->end(),
              static_cast<pcl::index_t>(input.samples->cloud.width));
  }
  input.samples = closed;
  parameters.outside_value.reset();
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

double
estimateBytes(const PipelineInput& input)
{
  return pipelineBytes(static_cast<double>(countPoints(input)),
                       static_cast<double>(input.samples->cloud.point_step),
                       input.parameters);
}

/** All samples in memory: their axes may be turned, their gaps filled and their box
 * repeat, and some may be left out to test the surface of the others. */
class SamplesInMemory : public SampleStore {
public:
  /** \param extraction of these samples, whose tree serves again */
  SamplesInMemory(PipelineInput&& input,
                  IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
                  unsigned threads)
      : given_(input.samples)
      , input_(std::move(input))
      , extraction_(extraction)
      , threads_(threads)
  {
  }

  void
  enter(IsosurfacePipelineParameters& parameters, Report& report) override
  {
    checkMemoryOf("An isosurface", countPoints(input_), estimateBytes(input_));
    warnOfUnusedBox(*given_, sidesOf(input_.parameters), report);
    closeOutside(input_, threads_, report);
    axes_.emplace(input_);
    input_.parameters.isosurface = resolve(input_, threads_, scale_choice_);
    if (input_.parameters.validation.folds > 0)
      hold_out_.emplace(input_, threads_);
    measured_ = input_.samples;
    if (input_.parameters.fill_gaps)
      gaps_ = std::make_unique<detail::FilledGaps>(input_, threads_, report);
    box_.emplace(input_, threads_, report);
    parameters = input_.parameters;
  }

  ExtractedSurface
  extract(const IsosurfacePipelineParameters&, Report& report) override
  {
    std::optional<SamplingSummary> sampling;
    if (gaps_)
      sampling = gaps_->getSampling();
    if (input_.samples == given_)
      return extractSurface(input_, extraction_, sampling, threads_, report);
    IsosurfaceExtraction<pcl::PCLPointCloud2> other;
    other.setInputCloud(shareCloud(input_));
    other.setIndices(input_.use);
    return extractSurface(input_, other, sampling, threads_, report);
  }

  Communicator&
  getCommunicator() override
  {
    return alone_;
  }

  const detail::FilledGaps*
  getGaps() const override
  {
    return gaps_.get();
  }

  void
  leave(const IsosurfacePipelineParameters& parameters,
        IsosurfaceResult& result) override
  {
    result.scale_choice = scale_choice_;
    box_->leave(parameters, result);
    if (gaps_)
      result.gaps = gaps_->getSummary();
    if (hold_out_)
      hold_out_->leave(
          [this](const auto& of_part, const auto& use, const auto& progress) {
            return extractPart(of_part, use, progress);
          },
          result);
    axes_->leave(result);
  }

private:
  /** The same steps with some of the samples. */
  IsosurfaceResult
  extractPart(const IsosurfacePipelineParameters& parameters,
              const pcl::IndicesPtr& use,
              const ProgressCallback& progress) const
  {
    IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
    extraction.setInputCloud(shareCloud({measured_, use, parameters}));
    extraction.setIndices(use);
    SamplesInMemory part({measured_, use, parameters}, extraction, threads_);
    Report report;
    report.progress = progress;
    return runIsosurface(part, parameters, threads_, std::move(report));
  }

  const std::shared_ptr<const Dataset> given_;
  PipelineInput input_;
  std::shared_ptr<const Dataset> measured_; ///< before gaps were filled
  IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction_;
  unsigned threads_;
  SelfCommunicator alone_;
  std::optional<TurnedAxes> axes_;
  std::optional<ScaleChoice> scale_choice_;
  std::optional<HoldOutTest> hold_out_;
  std::unique_ptr<detail::FilledGaps> gaps_;
  std::optional<RepeatedBox> box_;
};

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
  return estimateBytes(takeInput(samples_, indices_, parameters_));
}

IsosurfaceResult
IsosurfacePipeline::run()
{
  SamplesInMemory samples(
      takeInput(samples_, indices_, parameters_), extraction_, threads_);
  startReport();
  IsosurfaceResult result =
      runIsosurface(samples, parameters_, threads_, std::move(report_));
  report_ = result.report;
  return result;
}

} // namespace pcl_uvol
