// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_isosurface/input_samples.h"

#include "shared/point_files.h"
#include <pcl_uvol/io/dataset.h>

namespace uvol_tools {

using pcl_uvol::Report;

void
checkOutput(const PipelineOptions& arguments, const pcl_uvol::Dataset& samples)
{
  if (!pcl_uvol::isMeshOnly(arguments.output))
    pcl_uvol::checkSavePath(arguments.output, samples.cloud.fields);
}

std::shared_ptr<pcl_uvol::Dataset>
loadSamples(const Options& options, PipelineOptions& arguments, Report& report)
{
  std::size_t points = 0;
  auto samples =
      std::make_shared<pcl_uvol::Dataset>(loadPoints(arguments.input,
                                                     report,
                                                     arguments.makeLoadOptions(),
                                                     arguments.getWhere(),
                                                     options.threads(),
                                                     &points));
  report.count("points", points);
  arguments.resolveSpacing(*samples);
  const auto sides = arguments.periodic.findSides(*samples);
  arguments.parameters.periodic = Eigen::Array3d(sides.data());
  arguments.density.addField(*samples, options.threads(), report, sides);
  if (arguments.density.isAskedFor() && arguments.parameters.isosurface.field.empty())
    arguments.parameters.isosurface.field = "sph_density";
  addField(*samples, arguments.parameters.isosurface.field, options, report, sides);
  arguments.picture.addColorOfSamples(options, *samples, report, sides);
  checkOutput(arguments, *samples);
  return samples;
}

} // namespace uvol_tools
