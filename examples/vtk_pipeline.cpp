// Samples of a sphere through a VTK pipeline: smoothed, extracted, covered with splats,
// and written by VTK's own writer, to be opened with ParaView.
#include <pcl_uvol/filters/vtkUvolIsosurface.h>
#include <pcl_uvol/filters/vtkUvolLevelSet.h>
#include <pcl_uvol/filters/vtkUvolSplats.h>

#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <iostream>

int
main(int argc, char** argv)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> density;
  density->SetName("density");
  for (int i = 0; i < 5000; ++i) { // density falls with the distance from the origin
    double point[3];
    for (double& coordinate : point)
      coordinate = random->GetNextRangeValue(-1.0, 1.0);
    points->InsertNextPoint(point);
    density->InsertNextValue(static_cast<float>(1.0 - vtkMath::Norm(point)));
  }
  vtkNew<vtkPolyData> samples;
  samples->SetPoints(points);
  samples->GetPointData()->AddArray(density);

  vtkNew<vtkUvolLevelSet> level_set;
  level_set->SetInputData(samples);
  level_set->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");
  level_set->SetIsovalue(0.4);
  vtkNew<vtkUvolIsosurface> isosurface; // of phi at 0, which level_set makes active
  isosurface->SetInputConnection(level_set->GetOutputPort());
  vtkNew<vtkUvolSplats> splats;
  splats->SetInputConnection(isosurface->GetOutputPort());
  splats->SetDelta(0.01);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(splats->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "splats.vtp");
  std::cout << (writer->Write() ? "" : "not ")
            << "written: " << splats->GetOutput()->GetNumberOfPoints() << " splats\n";
}
