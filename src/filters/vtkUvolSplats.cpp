// SPDX-License-Identifier: BSD-3-Clause
#include "filters/filter_run.h"
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
  const pcl::PCLPointCloud2& cloud = points.dataset.cloud;
  const auto threads = static_cast<unsigned>(this->NumberOfThreads);
  pcl_uvol::SplatGeneration<pcl::PCLPointCloud2> generation;
  generation.setInputCloud(pcl::PCLPointCloud2::ConstPtr(&cloud, [](const void*) {}));
  generation.setIndices(pcl::make_shared<pcl::Indices>(run.visible));
  generation.setParameters(parameters);
  generation.setNumberOfThreads(threads);
  generation.setProgressCallback(run.report.progress);
  pcl::PointCloud<pcl_uvol::PointSplat> splats;
  generation.compute(splats);
  run.report.merge(generation.getReport());

  pcl_uvol::Dataset result;
  result.origin = points.dataset.origin;
  result.double_coordinates = points.dataset.double_coordinates;
  pcl::toPCLPointCloud2(splats, result.cloud);
  const pcl_uvol::IsoEdges edges = pcl_uvol::edgesAt(generation.getSources());
  pcl_uvol::interpolateFields(cloud, edges, result.cloud, threads);
  pcl_uvol::fillOutput(result, points, edges, run);
}
