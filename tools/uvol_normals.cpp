// SPDX-License-Identifier: BSD-3-Clause
// Normals of a surface given as points (thesis 4.1).
#include "common/records.h"
#include "common/scalar_field.h"
#include "shared/point_job.h"
#include "shared/scale_option.h"
#include "surface/memory_need.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <pcl/conversions.h>

#include <numeric>

namespace {

using pcl_uvol::IsoEdge;
using pcl_uvol::Report;

/** The cloud with new normals and curvature; all other fields as they were. */
pcl::PCLPointCloud2
estimateNormals(const pcl::PCLPointCloud2& cloud,
                const pcl_uvol::SurfaceNormalParameters& parameters,
                unsigned threads,
                Report& report)
{
  pcl_uvol::SurfaceNormalEstimation<pcl::PCLPointCloud2, pcl::PointNormal> estimation;
  estimation.setInputCloud(pcl::PCLPointCloud2::ConstPtr(&cloud, [](const void*) {}));
  estimation.setParameters(parameters);
  estimation.setNumberOfThreads(threads);
  estimation.setProgressCallback(report.progress);
  pcl::PointCloud<pcl::PointNormal> points;
  estimation.compute(points);
  report.merge(estimation.getReport());
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(cloud);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].getVector3fMap() = Eigen::Vector3f(view.xyz(i));
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  pcl::PCLPointCloud2 result;
  pcl::toPCLPointCloud2(points, result);
  pcl_uvol::copyFields(cloud, all, result, threads);
  return result;
}

/** What the tool holds beside the points: while it estimates, then a cloud of normals,
 * the same as bytes, and the output. */
uvol_tools::MemoryGuard::Bytes
forecastMemory(std::uint64_t k)
{
  return [k](double points, double step) {
    constexpr double output_bytes = 176.0;
    return std::max(pcl_uvol::surfaceNormalsBytes(points, static_cast<double>(k)),
                    (output_bytes + step) * points);
  };
}

int
run(int argc, char** argv)
{
  std::vector<double> view_point;
  uvol_tools::ScaleOption scale;
  pcl_uvol::SurfaceNormalParameters parameters;
  uvol_tools::Options options(
      "uvol_normals",
      "in.ply out.ply [options]",
      "Estimate normals of a surface given as points, from the principal components "
      "of the nearest\n"
      "neighbours. Normals in the file orient the new ones.");
  uvol_tools::PointJob job(options, "Estimating normals");
  job.declareInput();
  options.group("Normals");
  options.members(parameters, {"k"});
  options.numbers("viewpoint",
                  "x,y,z",
                  3,
                  view_point,
                  "position that new normals point to (default 0,0,0)");
  scale.declare(options, "distances", uvol_tools::AutomaticScale::Spacing);
  job.declareOutput();
  if (!options.parse(argc, argv))
    return 0;
  scale.finish(options);
  const auto bytes = forecastMemory(parameters.k);
  const pcl_uvol::Dataset dataset = job.read(bytes);
  job.check(dataset, bytes);
  uvol_tools::Facts of_scale;
  const auto stretch = scale.resolve(
      pcl_uvol::viewOf(dataset.cloud), "", options.threads(), job.report, of_scale);
  uvol_tools::append(job.facts, of_scale);
  parameters.scale = stretch.scale;
  parameters.rotation = stretch.rotation;
  if (view_point.empty())
    view_point.assign(3, 0.0);
  parameters.view_point =
      (Eigen::Array3d(view_point.data()) - Eigen::Array3d(dataset.origin.data()))
          .cast<float>();
  if (pcl_uvol::findField(dataset.cloud.fields, "normal_x") == nullptr &&
      !options.given("viewpoint"))
    job.report.warn("oriented_to_zero");

  pcl_uvol::Dataset result = pcl_uvol::withoutCloud(dataset);
  result.cloud =
      estimateNormals(dataset.cloud, parameters, options.threads(), job.report);
  return job.finish(result);
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_normals", [&] { return run(argc, argv); });
}
