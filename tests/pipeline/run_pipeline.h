// SPDX-License-Identifier: BSD-3-Clause
// The pipeline run on samples, as its tests do.
#pragma once

#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/conversions.h>

#include <memory>
#include <optional>
#include <string>

namespace uvol_test {

inline pcl_uvol::IsosurfaceResult
runPipeline(const std::shared_ptr<pcl_uvol::Dataset>& samples,
            const pcl_uvol::IsosurfacePipelineParameters& parameters,
            unsigned threads = 0)
{
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(threads);
  return pipeline.run();
}

/** \brief The first warning of a code. */
inline std::optional<pcl_uvol::Message>
findWarning(const pcl_uvol::IsosurfaceResult& result, const std::string& code)
{
  for (const pcl_uvol::Message& warning : result.report.warnings)
    if (warning.code == code)
      return warning;
  return std::nullopt;
}

inline pcl::PointCloud<pcl_uvol::PointIso>
toIsopoints(const pcl_uvol::IsosurfaceResult& result)
{
  pcl::PointCloud<pcl_uvol::PointIso> points;
  pcl::fromPCLPointCloud2(result.surface.cloud, points);
  return points;
}

} // namespace uvol_test
