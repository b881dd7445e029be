// SPDX-License-Identifier: BSD-3-Clause
// What the steps of IsosurfacePipeline work on.
#pragma once

#include "common/large_array.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <pcl/types.h>

#include <memory>
#include <numeric>

namespace pcl_uvol {

/** \brief Samples and parameters. A step that changes the space of the samples replaces
 * them when it is entered, and brings the surface back when it is left. */
struct PipelineInput {
  std::shared_ptr<const Dataset> samples;
  pcl::IndicesPtr use; ///< points to take; null: all
  IsosurfacePipelineParameters parameters;
};

/** \brief The cloud, which keeps the data set alive. */
inline pcl::PCLPointCloud2::ConstPtr
shareCloud(const PipelineInput& input)
{
  return {input.samples, &input.samples->cloud};
}

inline std::size_t
countPoints(const PipelineInput& input)
{
  return input.use ? input.use->size() : viewOf(input.samples->cloud).count;
}

/** \brief The points to take. */
inline pcl::Indices
listPoints(const PipelineInput& input)
{
  if (input.use)
    return *input.use;
  pcl::Indices all;
  resizeLarge(all, input.samples->cloud.width);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

} // namespace pcl_uvol
