// SPDX-License-Identifier: BSD-3-Clause
#include "vtk/contour.h"

#include <pcl_uvol/common/exceptions.h>

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <string>

namespace pcl_uvol {

Mesh
contourGrid(const GridShape& shape, const std::vector<float>& values, double isovalue)
{
  if (values.size() != shape.size())
    throw InvalidArgument("unfitting_grid_values",
                          {{"cells", shape.size()}, {"values", values.size()}});
  vtkNew<vtkFloatArray> scalars;
  // VTK only reads them.
  scalars->SetArray(
      const_cast<float*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(shape.cells[0]),
                       static_cast<int>(shape.cells[1]),
                       static_cast<int>(shape.cells[2]));
  // In units of cells: vertices are floats, and coordinates may be large.
  image->GetPointData()->SetScalars(scalars);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, isovalue);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* const surface = contour->GetOutput();
  Mesh mesh;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    double place[3];
    surface->GetPoint(i, place);
    std::array<float, 3> vertex{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      vertex[axis] = static_cast<float>(shape.origin[axis] +
                                        shape.spacing[axis] * (place[axis] + 0.5));
    mesh.vertices.push_back(vertex);
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i) {
    surface->GetCellPoints(i, corners);
    // VTK's look to where values are higher from the other side.
    mesh.triangles.push_back({{static_cast<std::uint32_t>(corners->GetId(0)),
                               static_cast<std::uint32_t>(corners->GetId(2)),
                               static_cast<std::uint32_t>(corners->GetId(1))}});
  }
  return mesh;
}

} // namespace pcl_uvol
