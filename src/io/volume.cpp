// SPDX-License-Identifier: BSD-3-Clause
#include "files.h"
#include "vtk_messages.h"
#include <pcl_uvol/io/volume.h>

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <teem/nrrd.h>

namespace pcl_uvol {

namespace {

std::string
endingOf(const std::string& path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return ending;
}

/** Teem's last error without its trace, which is one line per function. */
std::string
teemError()
{
  const std::unique_ptr<char, decltype(&std::free)> trace(biffGetDone(NRRD),
                                                          &std::free);
  std::string text = trace ? trace.get() : "";
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  const std::size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

Volume
readNrrd(const std::string& path)
{
  const std::unique_ptr<Nrrd, decltype(&nrrdNuke)> nrrd(nrrdNew(), &nrrdNuke);
  nrrdStateVerboseIO = 0;
  if (nrrdLoad(nrrd.get(), path.c_str(), nullptr) != 0)
    io::throwUnreadable(path, "Teem says: " + teemError());
  if (nrrd->dim != 3 || nrrd->type == nrrdTypeBlock)
    io::throwUnreadable(path, "it is not a volume of one number per point in 3-D");
  Volume volume;
  for (unsigned axis = 0; axis < 3; ++axis) {
    volume.dims[axis] = nrrd->axis[axis].size;
    double spacing = nrrd->axis[axis].spacing;
    if (nrrd->spaceDim == 3) // the length of the axis' direction
      spacing = std::hypot(nrrd->axis[axis].spaceDirection[0],
                           nrrd->axis[axis].spaceDirection[1],
                           nrrd->axis[axis].spaceDirection[2]);
    if (std::isfinite(spacing) && spacing != 0.0)
      volume.spacing[axis] = std::abs(spacing);
    if (nrrd->spaceDim == 3 && std::isfinite(nrrd->spaceOrigin[axis]))
      volume.origin[axis] = nrrd->spaceOrigin[axis];
  }
  volume.values.resize(nrrdElementNumber(nrrd.get()));
  const auto lookup = nrrdDLookup[nrrd->type];
  for (std::size_t i = 0; i < volume.values.size(); ++i)
    volume.values[i] = static_cast<float>(lookup(nrrd->data, i));
  return volume;
}

template <typename Reader>
Volume
readByVtk(const std::string& path)
{
  const io::VtkMessages messages;
  vtkNew<Reader> reader;
  // MetaIO prints its complaints itself, so what is no MetaImage must not reach it.
  if (reader->CanReadFile(path.c_str()) == 0)
    io::throwUnreadable(path, "it is no volume of the kind that its ending promises");
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!messages.getError().empty())
    io::throwUnreadable(path, "VTK says: " + messages.getError());
  vtkImageData* const image = reader->GetOutput();
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (scalars == nullptr)
    scalars = image->GetPointData()->GetArray(0);
  if (reader->GetErrorCode() != 0 || scalars == nullptr ||
      scalars->GetNumberOfComponents() != 1 || scalars->GetNumberOfTuples() == 0)
    io::throwUnreadable(path, "it holds no volume of one number per point");
  Volume volume;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    volume.dims[a] = static_cast<std::size_t>(image->GetDimensions()[axis]);
    volume.spacing[a] = std::abs(image->GetSpacing()[axis]);
    volume.origin[a] = image->GetOrigin()[axis] +
                       image->GetExtent()[2 * axis] * image->GetSpacing()[axis];
  }
  if (scalars->GetName() != nullptr && endingOf(path) == ".vti")
    volume.name = scalars->GetName();
  volume.values.resize(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (std::size_t i = 0; i < volume.values.size(); ++i)
    volume.values[i] =
        static_cast<float>(scalars->GetTuple1(static_cast<vtkIdType>(i)));
  return volume;
}

} // namespace

double
Volume::sample(const std::array<double, 3>& position) const
{
  std::size_t low[3], high[3];
  double weight[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(dims[axis] - 1);
    const double cell =
        std::clamp((position[axis] - origin[axis]) / spacing[axis], 0.0, last);
    low[axis] = static_cast<std::size_t>(cell);
    high[axis] = std::min(low[axis] + 1, dims[axis] - 1);
    weight[axis] = cell - static_cast<double>(low[axis]);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const bool right = corner & 1, back = corner & 2, up = corner & 4;
    const std::size_t index =
        (right ? high[0] : low[0]) +
        dims[0] * ((back ? high[1] : low[1]) + dims[1] * (up ? high[2] : low[2]));
    sum += (right ? weight[0] : 1.0 - weight[0]) *
           (back ? weight[1] : 1.0 - weight[1]) * (up ? weight[2] : 1.0 - weight[2]) *
           values[index];
  }
  return sum;
}

std::array<double, 3>
Volume::upper() const
{
  std::array<double, 3> position = origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
    position[axis] += spacing[axis] * static_cast<double>(dims[axis] - 1);
  return position;
}

bool
isVolumePath(const std::string& path)
{
  const std::string ending = endingOf(path);
  return ending == ".nrrd" || ending == ".nhdr" || ending == ".vti" ||
         ending == ".mha" || ending == ".mhd";
}

Volume
loadVolume(const std::string& path)
{
  { // missing, empty or a directory: said in our words
    const io::InputFile exists(path);
  }
  const std::string ending = endingOf(path);
  if (ending == ".nrrd" || ending == ".nhdr")
    return readNrrd(path);
  if (ending == ".vti")
    return readByVtk<vtkXMLImageDataReader>(path);
  if (ending == ".mha" || ending == ".mhd")
    return readByVtk<vtkMetaImageReader>(path);
  io::throwUnreadable(path, "volumes are read from .nrrd, .nhdr, .vti, .mha and .mhd");
}

} // namespace pcl_uvol
