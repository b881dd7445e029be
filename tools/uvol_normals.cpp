// SPDX-License-Identifier: BSD-3-Clause
// Normals of a surface given as points (thesis 4.1).
#include "common/records.h"
#include "common/scalar_field.h"
#include "shared/memory_guard.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
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
  std::string input, output;
  std::vector<double> view_point;
  uvol_tools::ScaleOption scale;
  uvol_tools::InputOptions reading;
  pcl_uvol::SurfaceNormalParameters parameters;
  bool ascii = false;
  uvol_tools::Options options(
      "uvol_normals",
      "in.ply out.ply [options]",
      "Estimates normals of a surface given as points, from the principal components "
      "of the "
      "nearest neighbours.\nNormals that the file has orient the new ones.");
  options.file("in", input);
  options.file("out", output);
  options.group("Input");
  reading.declare(options);
  options.group("Normals");
  options.members(parameters, {"k"});
  options.numbers("viewpoint",
                  "x,y,z",
                  3,
                  view_point,
                  "points without a normal look there (default 0,0,0)");
  scale.declare(options, "distances", uvol_tools::AutomaticScale::Spacing);
  options.group("Output");
  options.flag("ascii", ascii, "write PCD and PLY as text");
  if (!options.parse(argc, argv))
    return 0;
  scale.finish(options);
  const pcl_uvol::LoadOptions load = reading.makeLoadOptions();
  const std::string& where = reading.getWhere();
  pcl_uvol::checkSavePath(output);
  uvol_tools::MemoryGuard memory("Estimating normals");
  memory.checkFile(input, where.empty() ? forecastMemory(parameters.k) : nullptr, load);

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  const pcl_uvol::Dataset dataset =
      uvol_tools::loadPoints(input, report, load, where, options.threads());
  pcl_uvol::checkSavePath(output, dataset.cloud.fields);
  memory.checkCloud(dataset, forecastMemory(parameters.k));
  uvol_tools::Facts facts = {{"input", input}, {"output", output}};
  uvol_tools::Facts of_scale;
  const auto stretch = scale.resolve(
      pcl_uvol::viewOf(dataset.cloud), "", options.threads(), report, of_scale);
  facts.insert(facts.end(), of_scale.begin(), of_scale.end());
  parameters.scale = stretch.scale;
  parameters.rotation = stretch.rotation;
  if (view_point.empty())
    view_point.assign(3, 0.0);
  parameters.view_point =
      (Eigen::Array3d(view_point.data()) - Eigen::Array3d(dataset.origin.data()))
          .cast<float>();
  if (pcl_uvol::findField(dataset.cloud.fields, "normal_x") == nullptr &&
      !options.given("viewpoint"))
    report.warn("oriented_to_zero");

  pcl_uvol::Dataset result = pcl_uvol::withoutCloud(dataset);
  result.cloud = estimateNormals(dataset.cloud, parameters, options.threads(), report);
  pcl_uvol::SaveOptions save;
  save.ascii = ascii;
  uvol_tools::savePoints(output, result, save, report);
  report.count("points", result.cloud.width);
  facts.push_back(memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_normals", [&] { return run(argc, argv); });
}
