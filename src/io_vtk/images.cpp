// SPDX-License-Identifier: BSD-3-Clause
// Volumes in files of VTK.
#include "io/files.h"
#include "io/volume_data.h"
#include "io_vtk/entries.h"
#include "io_vtk/vtk_readers.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>

namespace pcl_uvol {
namespace io {
namespace {

Volume
makeVolume(const std::string& path, vtkImageData& image)
{
  vtkPointData* const data = image.GetPointData();
  vtkDataArray* const scalars =
      data->GetScalars() != nullptr ? data->GetScalars() : data->GetArray(0);
  if (scalars == nullptr || scalars->GetNumberOfComponents() != 1 ||
      scalars->GetNumberOfTuples() == 0 ||
      scalars->GetNumberOfTuples() != image.GetNumberOfPoints())
    throwUnreadable(path, "not_scalar_volume");
  if (!image.GetDirectionMatrix()->IsIdentity())
    throwOblique(path);
  Volume volume;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    volume.dims[a] = static_cast<std::size_t>(image.GetDimensions()[axis]);
    volume.spacing[a] = image.GetSpacing()[axis];
    volume.origin[a] = image.GetOrigin()[axis] +
                       image.GetExtent()[2 * axis] * image.GetSpacing()[axis];
  }
  volume.values.resize(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (std::size_t i = 0; i < volume.values.size(); ++i)
    volume.values[i] =
        static_cast<float>(scalars->GetTuple1(static_cast<vtkIdType>(i)));
  if (scalars->GetName() != nullptr)
    volume.name = scalars->GetName();
  return volume;
}

} // namespace

Volume
readImage(const std::string& path)
{
  const auto content =
      getEnding(path) == ".vti" ? readVtkXml(path) : readVtkLegacy(path);
  auto* const image = vtkImageData::SafeDownCast(content.data);
  if (!image)
    throwUnreadable(path, "not_scalar_volume");
  return makeVolume(path, *image);
}

bool
holdsImage(const std::string& path)
{
  try {
    return findLegacyKind(path) == "structured_points";
  }
  catch (const IOError&) {
    const InputFile exists(path);
    return false; // what is wrong with it, reading says
  }
}

} // namespace io
} // namespace pcl_uvol
