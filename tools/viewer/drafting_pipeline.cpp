// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/drafting_pipeline.h"

#include "common/random.h"

#include <set>

namespace uvol_tools {

namespace {

/** At random, so that lattices leave no stripes; each of fewer is one of more. */
pcl::IndicesPtr
chooseSamples(std::size_t count, unsigned thinning)
{
  auto chosen = pcl::make_shared<pcl::Indices>();
  chosen->reserve(count / thinning);
  for (std::size_t i = 0; i < count; ++i)
    if (pcl_uvol::mixBits(i) % thinning == 0)
      chosen->push_back(static_cast<pcl::index_t>(i));
  return chosen;
}

pcl_uvol::IsosurfacePipelineParameters
parametersFor(const SurfaceRequest& request, const std::string& field)
{
  pcl_uvol::IsosurfacePipelineParameters parameters;
  if (request.is_meshed)
    parameters.mesh.emplace().open = true; // caps would hide the surface
  parameters.isosurface.field = field;
  const std::set<double> isovalues(request.isovalues.begin(), request.isovalues.end());
  parameters.isosurface.isovalues = {isovalues.begin(), isovalues.end()};
  return parameters;
}

} // namespace

DraftingPipeline::DraftingPipeline(
    const std::shared_ptr<const pcl_uvol::Dataset>& samples,
    const std::string& field,
    unsigned threads)
    : field_(field)
{
  whole_.setInput(samples);
  whole_.setNumberOfThreads(threads);
  draft_.setNumberOfThreads(threads);
}

pcl_uvol::IsosurfaceResult
DraftingPipeline::run(const SurfaceRequest& request,
                      unsigned thinning,
                      const pcl_uvol::ProgressCallback& progress)
{
  pcl_uvol::IsosurfacePipeline& pipeline = pipelineOf(thinning);
  pipeline.setParameters(parametersFor(request, field_));
  pipeline.setProgressCallback(progress);
  return pipeline.run();
}

pcl_uvol::IsosurfacePipeline&
DraftingPipeline::pipelineOf(unsigned thinning)
{
  if (thinning <= 1)
    return whole_;
  if (thinning != thinning_) {
    draft_.setInput(whole_.getInput());
    draft_.setIndices(chooseSamples(whole_.getInput()->cloud.width, thinning));
    thinning_ = thinning;
  }
  return draft_;
}

} // namespace uvol_tools
