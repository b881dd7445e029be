// SPDX-License-Identifier: BSD-3-Clause
#include "filters/filter_run.h"
#include "pipeline/level_set_job.h"
#include <pcl_uvol/filters/vtkUvolLevelSet.h>

#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkUvolLevelSet);

vtkUvolLevelSet::vtkUvolLevelSet()
{
  this->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

void
vtkUvolLevelSet::PrintSelf(std::ostream& out, vtkIndent indent)
{
  this->Superclass::PrintSelf(out, indent);
  constexpr const char* reinitializations[] = {
      "None", "Distance", "Eikonal", "Diffusion"};
  out << indent << "Isovalue: " << this->Isovalue << '\n'
      << indent << "ArrayComponent: " << this->ArrayComponent << '\n'
      << indent << "AutomaticMu: " << (this->AutomaticMu ? "On" : "Off") << '\n'
      << indent << "Mu: " << this->Mu << '\n'
      << indent
      << "Scheme: " << (this->Scheme == SCHEME_LINEAR ? "Linear" : "Quadratic") << '\n'
      << indent
      << "CurvatureFlow: " << (this->CurvatureFlow == FLOW_MEAN ? "Mean" : "Relative")
      << '\n'
      << indent << "StepBound: " << (this->StepBound == BOUND_CFL ? "Cfl" : "Stencil")
      << '\n'
      << indent << "Integration: "
      << (this->Integration == INTEGRATION_SYNCHRONOUS ? "Synchronous" : "Asynchronous")
      << '\n'
      << indent << "Reinitialization: " << reinitializations[this->Reinitialization]
      << '\n'
      << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << '\n'
      << indent << "MaximumNumberOfSteps: " << this->MaximumNumberOfSteps << '\n'
      << indent << "Tolerance: " << this->Tolerance << '\n'
      << indent << "BandWidth: " << this->BandWidth << '\n'
      << indent << "Scale: " << this->Scale[0] << ' ' << this->Scale[1] << ' '
      << this->Scale[2] << '\n';
}

pcl_uvol::LevelSetParameters
vtkUvolLevelSet::Parameters() const
{
  using pcl_uvol::LevelSetParameters;
  LevelSetParameters parameters;
  if (!this->AutomaticMu)
    parameters.mu = this->Mu;
  parameters.scheme = this->Scheme == SCHEME_LINEAR ? pcl_uvol::FitScheme::Linear
                                                    : pcl_uvol::FitScheme::Quadratic;
  parameters.flow = this->CurvatureFlow == FLOW_MEAN
                        ? pcl_uvol::CurvatureFlow::Mean
                        : pcl_uvol::CurvatureFlow::Relative;
  parameters.bound = this->StepBound == BOUND_CFL ? pcl_uvol::StepBound::Cfl
                                                  : pcl_uvol::StepBound::Stencil;
  parameters.integration = this->Integration == INTEGRATION_SYNCHRONOUS
                               ? pcl_uvol::Integration::Synchronous
                               : pcl_uvol::Integration::Asynchronous;
  using Kind = pcl_uvol::Reinitialization;
  constexpr Kind kinds[] = {Kind::None, Kind::Distance, Kind::Eikonal, Kind::Diffusion};
  parameters.reinitialization = kinds[this->Reinitialization];
  parameters.scale = Eigen::Array3d(this->Scale).cast<float>();
  parameters.k = static_cast<std::size_t>(this->NumberOfNeighbors);
  parameters.max_steps = static_cast<std::size_t>(this->MaximumNumberOfSteps);
  parameters.tolerance = this->Tolerance;
  parameters.band_width = this->BandWidth;
  return parameters;
}

void
vtkUvolLevelSet::Execute(pcl_uvol::FilterRun& run)
{
  const pcl_uvol::PointArrays points = pcl_uvol::collectPoints(run.input);
  run.report.warnings = points.dataset.notes;
  run.progress.expect(4); // tree, neighbours, stencils, evolution
  pcl_uvol::LevelSetParameters parameters = this->Parameters();
  parameters.field = this->FieldToProcess(0, this->ArrayComponent, run.input, points);
  parameters.isovalue = this->Isovalue;
  vtkInformation& start = *this->GetInputArrayInformation(1);
  if (start.Has(vtkDataObject::FIELD_NAME()) ||
      start.Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
    parameters.initial =
        pcl_uvol::InitialFunction::field(this->FieldToProcess(1, 0, run.input, points));
  const std::shared_ptr<const pcl_uvol::Dataset> samples(
      &points.dataset, [](const void*) {}); // which lives as long as the run
  const pcl_uvol::SmoothedSamples result =
      pcl_uvol::runLevelSet(samples,
                            pcl::make_shared<pcl::Indices>(run.visible),
                            {parameters},
                            {},
                            static_cast<unsigned>(this->NumberOfThreads),
                            run.report.progress);
  run.report.merge(result.report);
  const std::vector<std::uint32_t> sources(run.visible.begin(), run.visible.end());
  pcl_uvol::fillOutput(result.samples, points, pcl_uvol::edgesAt(sources), run);
  run.output.GetPointData()->SetActiveScalars("phi");
}
