// SPDX-License-Identifier: BSD-3-Clause
// Normals of a surface given as points (thesis 4.1).
#include "shared/point_job.h"
#include "shared/scale_option.h"
#include "surface/dataset_normals.h"

namespace {

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
  uvol_tools::PointJob job(options);
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
  const pcl_uvol::Dataset dataset = job.read();
  uvol_tools::Facts of_scale;
  const auto stretch = scale.resolve(
      pcl_uvol::viewOf(dataset.cloud), "", options.threads(), job.report, of_scale);
  uvol_tools::append(job.facts, of_scale);
  parameters.scale = stretch.scale;
  parameters.rotation = stretch.rotation;
  if (!view_point.empty())
    parameters.view_point = Eigen::Array3d(view_point.data());
  const pcl_uvol::Dataset result =
      pcl_uvol::estimateNormals(dataset, parameters, options.threads(), job.report);
  return job.finish(result);
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_normals", [&] { return run(argc, argv); });
}
