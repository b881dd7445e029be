// SPDX-License-Identifier: BSD-3-Clause
// Splats of a surface given as points (thesis 4.2.1).
#include "common/records.h"
#include "common/scalar_field.h"
#include "render/gaussian_splats.h"
#include "shared/color_options.h"
#include "shared/point_job.h"
#include "shared/splat_options.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <pcl/conversions.h>

#include <filesystem>

namespace {

using pcl_uvol::Report;

/** Covers points; the splats have all other fields of the points that they are grown
 * from. */
pcl::PCLPointCloud2
generateSplats(const pcl::PCLPointCloud2& cloud,
               const pcl_uvol::SplatParameters& parameters,
               unsigned threads,
               Report& report)
{
  pcl_uvol::SplatGeneration<pcl::PCLPointCloud2> generation;
  generation.setInputCloud(pcl::PCLPointCloud2::ConstPtr(&cloud, [](const void*) {}));
  generation.setParameters(parameters);
  generation.setNumberOfThreads(threads);
  generation.setProgressCallback(report.progress);
  pcl::PointCloud<pcl_uvol::PointSplat> splats;
  generation.compute(splats);
  report.merge(generation.getReport());
  pcl::PCLPointCloud2 result;
  pcl::toPCLPointCloud2(splats, result);
  pcl_uvol::copyFields(cloud, generation.getSources(), result, threads);
  return result;
}

int
run(int argc, char** argv)
{
  uvol_tools::SplatOptions splat_options;
  bool is_gaussian = false;
  std::string color = "auto";
  uvol_tools::ColorOptions colors;
  uvol_tools::Options options(
      "uvol_splats",
      "in.ply out.ply [options]",
      "Cover a surface given as points with discs that have fields of normals, for "
      "uvol_raytrace.\n"
      "Normals are those of the input; missing ones are estimated.");
  uvol_tools::PointJob job(options);
  options.group("Splats");
  splat_options.declare(options);
  job.declareOutput();
  options.flag("gaussians",
               is_gaussian,
               "write a .ply that viewers of 3D Gaussian splats show, lit");
  options.text("color",
               "field",
               color,
               "of Gaussians, a scalar field (default: rgb if there, else isovalue if "
               "there are several)");
  colors.declareMapping(options);
  if (!options.parse(argc, argv))
    return 0;
  for (const char* const name : {"color", "colormap", "range", "log"})
    if (options.given(name) && !is_gaussian)
      throw uvol_tools::UsageError(std::string("-") + name + " needs -gaussians.");
  colors.check();
  if (is_gaussian && std::filesystem::path(job.getOutput()).extension() != ".ply")
    throw uvol_tools::UsageError("-gaussians are written as .ply.");
  const pcl_uvol::SplatParameters parameters = splat_options.parameters(options);
  const pcl_uvol::Dataset dataset = job.read();
  pcl_uvol::Dataset result = pcl_uvol::withoutCloud(dataset);
  result.cloud =
      generateSplats(dataset.cloud, parameters, options.threads(), job.report);
  if (is_gaussian) {
    const pcl_uvol::CloudView splats = pcl_uvol::viewOf(result.cloud);
    const std::string field = pcl_uvol::resolveColor(splats, color);
    const pcl_uvol::ColorMapping mapping = colors.mapFor(splats, field);
    result = pcl_uvol::makeGaussians(result, field, mapping, job.report);
  }
  return job.finish(result);
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_splats", [&] { return run(argc, argv); });
}
