// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/membership_surface.h"

#include "common/memory.h"
#include "isosurface/memory_need.h"
#include "pipeline/extract_points.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/pipeline_input.h"
#include "pipeline/turned_axes.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <utility>

namespace pcl_uvol {

Dataset
extractMembershipSurface(const Dataset& samples,
                         const std::vector<float>& members,
                         const detail::Stretch& stretch,
                         bool is_smooth,
                         unsigned threads,
                         Report& report)
{
  PipelineInput input{{&samples, [](const void*) {}}, nullptr, {}};
  IsosurfacePipelineParameters& parameters = input.parameters;
  parameters.rotation = stretch.rotation;
  parameters.isosurface.field = "membership";
  parameters.isosurface.isovalues = {0.5};
  parameters.isosurface.scale = stretch.scale;
  parameters.isosurface.interpolation =
      is_smooth ? Interpolation::Fit : Interpolation::Linear;
  parameters.normals = NormalMethod::Edge;
  const std::size_t count = countPoints(input);
  const auto points = static_cast<double>(count);
  checkMemoryOf("An isosurface",
                count,
                (sizeof(float) + samples.cloud.point_step) * points +
                    isosurfaceBytes(points, 1));
  const TurnedAxes axes(input);
  Dataset with_field = *input.samples;
  setField(with_field, "membership", members);
  IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&with_field.cloud, [](const void*) {}));
  SurfaceTriangles found =
      extractPoints(extraction, parameters.isosurface, threads, report);
  SelfCommunicator alone;
  // Without the field, whose value is the same everywhere.
  auto result = finishIsosurface(*input.samples,
                                 std::move(found),
                                 parameters,
                                 std::nullopt,
                                 alone,
                                 threads,
                                 std::move(report),
                                 SurfaceRole::ClusterBorder);
  report = std::move(result.report);
  axes.leave(result);
  setGlobeFields(result.surface);
  return std::move(result.surface);
}

} // namespace pcl_uvol
