// SPDX-License-Identifier: BSD-3-Clause
#include "filters/filter_run.h"
#include <pcl_uvol/filters/vtkUvolIsosurface.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <vtkCellArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <algorithm>

vtkStandardNewMacro(vtkUvolIsosurface);

namespace {

vtkSmartPointer<vtkCellArray>
toCells(const std::vector<pcl_uvol::Triangle>& triangles)
{
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& [a, b, c] : triangles)
    cells->InsertNextCell({a, b, c});
  return cells;
}

/** Edges between measured samples: predicted ones, whose indices follow, are replaced
 * by those whose fields they have. */
pcl_uvol::IsoEdges
toMeasured(pcl_uvol::IsoEdges edges,
           const std::vector<std::uint32_t>& sources,
           std::uint32_t measured)
{
  const auto source_of = [&](std::uint32_t sample) {
    return sample < measured ? sample : sources[sample - measured];
  };
  for (pcl_uvol::IsoEdge& edge : edges) {
    edge.first = source_of(edge.first);
    edge.second = source_of(edge.second);
  }
  return edges;
}

} // namespace

/** The input as it was read last, and the pipeline that keeps its tree. */
struct vtkUvolIsosurface::Samples {
  vtkWeakPointer<vtkDataSet> input;
  vtkMTimeType input_time = 0;
  pcl_uvol::PointArrays points;
  pcl_uvol::IsosurfacePipeline pipeline;
};

vtkUvolIsosurface::vtkUvolIsosurface()
{
  this->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkUvolIsosurface::~vtkUvolIsosurface() = default;

void
vtkUvolIsosurface::PrintSelf(std::ostream& out, vtkIndent indent)
{
  this->Superclass::PrintSelf(out, indent);
  out << indent << "ArrayComponent: " << this->ArrayComponent << '\n'
      << indent << "Outside: " << (this->Outside == OUTSIDE_LOWER ? "Lower" : "Higher")
      << '\n'
      << indent << "Interpolation: "
      << (this->Interpolation == INTERPOLATION_LINEAR ? "Linear" : "Fit") << '\n'
      << indent
      << "AngleCriterion: " << (this->AngleCriterion == CRITERION_KEPT ? "Kept" : "All")
      << '\n'
      << indent << "Mesh: " << (this->Mesh ? "On" : "Off") << '\n'
      << indent << "Scale: " << this->Scale[0] << ' ' << this->Scale[1] << ' '
      << this->Scale[2] << '\n'
      << indent << "FillGaps: " << (this->FillGaps ? "On" : "Off") << '\n'
      << indent << "Smooth: " << (this->Smooth ? "On" : "Off") << '\n'
      << indent << "MaximumError: " << this->MaximumError << '\n'
      << indent
      << "AutomaticMaximumError: " << (this->AutomaticMaximumError ? "On" : "Off")
      << '\n'
      << indent << "DropBridged: " << (this->DropBridged ? "On" : "Off") << '\n'
      << indent << "Values:\n";
  this->Values->PrintSelf(out, indent.GetNextIndent());
}

vtkMTimeType
vtkUvolIsosurface::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Values->GetMTime());
}

void
vtkUvolIsosurface::ReadInput(vtkDataSet& input, const std::vector<int>& visible)
{
  if (this->Read && this->Read->input == &input &&
      this->Read->input_time == input.GetMTime())
    return;
  this->Read.reset(); // before the next one takes memory
  auto read = std::make_unique<Samples>();
  read->input = &input;
  read->input_time = input.GetMTime();
  read->points = pcl_uvol::collectPoints(input);
  read->pipeline.setInput({&read->points.dataset, [](const void*) {}});
  read->pipeline.setIndices(pcl::make_shared<pcl::Indices>(visible));
  this->Read = std::move(read);
}

void
vtkUvolIsosurface::Execute(pcl_uvol::FilterRun& run)
{
  this->ReadInput(run.input, run.visible);
  const pcl_uvol::PointArrays& points = this->Read->points;
  const bool fits = this->Interpolation == INTERPOLATION_FIT;
  const double* const values = this->Values->GetValues();
  run.report.warnings = points.dataset.notes;
  // The tree, then neighbourhoods and roots of each isovalue.
  run.progress.expect(1 + (fits ? 2 : 1) * this->Values->GetNumberOfContours());

  pcl_uvol::IsosurfacePipelineParameters parameters;
  pcl_uvol::IsosurfaceParameters& isosurface = parameters.isosurface;
  isosurface.field = this->FieldToProcess(0, this->ArrayComponent, run.input, points);
  isosurface.isovalues = {values, values + this->Values->GetNumberOfContours()};
  isosurface.scale = Eigen::Array3d(this->Scale).cast<float>();
  isosurface.outside = this->Outside == OUTSIDE_LOWER ? pcl_uvol::Outside::Lower
                                                      : pcl_uvol::Outside::Higher;
  isosurface.interpolation =
      fits ? pcl_uvol::Interpolation::Auto : pcl_uvol::Interpolation::Linear;
  isosurface.criterion = this->AngleCriterion == CRITERION_KEPT
                             ? pcl_uvol::AngleCriterion::Kept
                             : pcl_uvol::AngleCriterion::All;
  parameters.fill_gaps = this->FillGaps;
  parameters.smooth = this->Smooth;
  if (this->MaximumError > 0.0)
    parameters.max_error = this->MaximumError;
  parameters.automatic_max_error = this->AutomaticMaximumError;
  parameters.drop_bridged = this->DropBridged;
  if (this->Mesh)
    parameters.mesh.emplace();
  pcl_uvol::IsosurfacePipeline& pipeline = this->Read->pipeline;
  pipeline.setParameters(parameters);
  pipeline.setNumberOfThreads(static_cast<unsigned>(this->NumberOfThreads));
  pipeline.setProgressCallback(run.report.progress);
  const pcl_uvol::IsosurfaceResult result = pipeline.run();
  run.report.merge(result.report);
  const std::uint32_t measured = points.dataset.cloud.width;
  pcl_uvol::fillOutput(result.surface,
                       points,
                       result.gaps
                           ? toMeasured(result.edges, result.gaps->sources, measured)
                           : result.edges,
                       run);
  if (!this->Mesh)
    return;
  run.output.SetVerts(nullptr);
  run.output.SetPolys(toCells(result.triangles));
}
