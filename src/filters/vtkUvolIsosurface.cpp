// SPDX-License-Identifier: BSD-3-Clause
#include "filter_run.h"
#include <pcl_uvol/filters/vtkUvolIsosurface.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <pcl/conversions.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkWeakPointer.h>

#include <algorithm>

vtkStandardNewMacro(vtkUvolIsosurface);

/** The input as it was read last, and the extraction that keeps its tree. */
struct vtkUvolIsosurface::Samples {
  vtkWeakPointer<vtkDataSet> input;
  vtkMTimeType input_time = 0;
  pcl_uvol::PointArrays points;
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
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
      << (this->Interpolation == INTERPOLATION_LINEAR ? "Linear" : "Smooth") << '\n'
      << indent
      << "AngleCriterion: " << (this->AngleCriterion == CRITERION_KEPT ? "Kept" : "All")
      << '\n'
      << indent << "Scale: " << this->Scale[0] << ' ' << this->Scale[1] << ' '
      << this->Scale[2] << '\n'
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
  const pcl::PCLPointCloud2& cloud = read->points.dataset.cloud;
  read->extraction.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&cloud, [](const void*) {}));
  read->extraction.setIndices(pcl::make_shared<std::vector<int>>(visible));
  this->Read = std::move(read);
}

void
vtkUvolIsosurface::Execute(pcl_uvol::FilterRun& run)
{
  this->ReadInput(run.input, run.visible);
  const pcl_uvol::PointArrays& points = this->Read->points;
  const bool smooth = this->Interpolation == INTERPOLATION_SMOOTH;
  const auto threads = static_cast<unsigned>(this->NumberOfThreads);
  const Eigen::Array3f scale = Eigen::Array3d(this->Scale).cast<float>();
  const double* const values = this->Values->GetValues();
  run.report.warnings = points.dataset.notes;
  // The tree, then neighbourhoods and roots of each isovalue.
  run.progress.expect(1 + (smooth ? 2 : 1) * this->Values->GetNumberOfContours());

  auto& extraction = this->Read->extraction;
  extraction.setScalarField(
      this->FieldToProcess(0, this->ArrayComponent, run.input, points));
  extraction.setIsoValues({values, values + this->Values->GetNumberOfContours()});
  extraction.setScale(scale);
  extraction.setOutside(this->Outside == OUTSIDE_LOWER ? pcl_uvol::Outside::Lower
                                                       : pcl_uvol::Outside::Higher);
  extraction.setInterpolation(smooth ? pcl_uvol::Interpolation::Smooth
                                     : pcl_uvol::Interpolation::Linear);
  extraction.setAngleCriterion(this->AngleCriterion == CRITERION_KEPT
                                   ? pcl_uvol::AngleCriterion::Kept
                                   : pcl_uvol::AngleCriterion::All);
  extraction.setNumberOfThreads(threads);
  extraction.setProgressCallback(run.report.progress);
  pcl::PointCloud<PointIso> isopoints;
  extraction.extract(isopoints);
  run.report.merge(extraction.getReport());

  pcl_uvol::SurfaceNormalParameters normals;
  normals.scale = scale;
  normals.threads = threads;
  if (!isopoints.empty() && smooth)
    pcl_uvol::replaceMissingNormals(isopoints, normals, run.report);
  else if (!isopoints.empty())
    pcl_uvol::replaceNormals(isopoints, normals, run.report);

  pcl_uvol::Dataset result;
  result.origin = points.dataset.origin;
  result.double_coordinates = points.dataset.double_coordinates;
  pcl::toPCLPointCloud2(isopoints, result.cloud);
  pcl_uvol::warnOfReplacedFields(points.dataset.cloud, result.cloud, run.report);
  pcl_uvol::interpolateFields(
      points.dataset.cloud, extraction.getEdges(), result.cloud, threads);
  pcl_uvol::fillOutput(result, points, extraction.getEdges(), run);
}
