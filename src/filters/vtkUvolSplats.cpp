// SPDX-License-Identifier: BSD-3-Clause
#include "filter_run.h"
#include <pcl_uvol/filters/vtkUvolSplats.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <pcl/conversions.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkUvolSplats);

void
vtkUvolSplats::PrintSelf(std::ostream& out, vtkIndent indent)
{
  this->Superclass::PrintSelf(out, indent);
  out << indent << "Delta: " << this->Delta << '\n'
      << indent << "DeltaIsLength: " << (this->DeltaIsLength ? "On" : "Off") << '\n'
      << indent << "Lambda: " << this->Lambda << '\n';
}

void
vtkUvolSplats::Execute(pcl_uvol::FilterRun& run)
{
  const pcl_uvol::PointArrays points = pcl_uvol::collectPoints(run.input);
  run.report.warnings = points.dataset.notes;
  run.progress.expect(3); // tree, neighbours, splats
  pcl_uvol::SplatParameters parameters;
  parameters.delta = this->Delta;
  parameters.delta_is_length = this->DeltaIsLength;
  parameters.lambda = this->Lambda;
  parameters.threads = static_cast<unsigned>(this->NumberOfThreads);
  const pcl::PCLPointCloud2& cloud = points.dataset.cloud;
  const pcl_uvol::Splats splats =
      pcl_uvol::generateSplats(pcl_uvol::viewOf(cloud),
                               {run.visible.begin(), run.visible.end()},
                               parameters,
                               run.report);

  pcl_uvol::Dataset result;
  result.origin = points.dataset.origin;
  result.double_coordinates = points.dataset.double_coordinates;
  pcl::toPCLPointCloud2(splats.cloud, result.cloud);
  const pcl_uvol::IsoEdges edges = pcl_uvol::edgesAt(splats.sources);
  pcl_uvol::interpolateFields(cloud, edges, result.cloud, parameters.threads);
  pcl_uvol::fillOutput(result, points, edges, run);
}
