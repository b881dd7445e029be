// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/entries.h"
#include "io_vtk/vtk_messages.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

/** \param values distances, which the image refers to */
void
fillImage(const VoronoiGrid& grid,
          const std::array<double, 3>& origin,
          std::vector<float>& values,
          vtkImageData* image)
{
  const GridShape& shape = grid.getShape();
  std::array<double, 3> first{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    first[axis] = origin[axis] + shape.origin[axis] + 0.5 * shape.spacing[axis];
  image->SetDimensions(static_cast<int>(shape.cells[0]),
                       static_cast<int>(shape.cells[1]),
                       static_cast<int>(shape.cells[2]));
  image->SetOrigin(first.data());
  image->SetSpacing(shape.spacing.data());
  const auto count = static_cast<vtkIdType>(shape.size());
  vtkNew<vtkUnsignedIntArray> sites;
  sites->SetName("site");
  sites->SetNumberOfValues(count);
  std::transform(grid.getNearest().begin(),
                 grid.getNearest().end(),
                 sites->GetPointer(0),
                 [&](std::uint32_t site) { return *grid.getMembers()[site].begin(); });
  vtkNew<vtkFloatArray> distances;
  distances->SetName("distance");
  distances->SetArray(values.data(), count, 1);
  image->GetPointData()->AddArray(sites);
  image->GetPointData()->SetScalars(distances);
}

} // namespace

void
writeVoronoiGrid(const std::string& file,
                 const std::string& path,
                 const VoronoiGrid& grid,
                 const std::array<double, 3>& origin,
                 unsigned threads)
{
  std::vector<float> distances = grid.computeDistances(threads); // outlives the image
  vtkNew<vtkImageData> image;
  fillImage(grid, origin, distances, image);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writeXml(*writer, file, path);
}

} // namespace io
} // namespace pcl_uvol
