// SPDX-License-Identifier: BSD-3-Clause
// Volumes by Teem and VTK, turned so that all axes ascend.
#include "files.h"
#include "vtk_messages.h"
#include <pcl_uvol/io/volume.h>

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <teem/nrrd.h>

namespace pcl_uvol {

namespace {

constexpr double oblique = 1e-6; // tangent of the angle up to which axes are parallel

std::string
endingOf(const std::string& path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return ending;
}

[[noreturn]] void
throwOblique(const std::string& path)
{
  io::throwUnreadable(path,
                      "its axes are not parallel to x, y and z in this order, resample "
                      "it to such axes first");
}

/** Let axes of negative spacing run the other way. */
void
makeAscending(const std::string& path, Volume& volume)
{
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; stride *= volume.dims[axis++]) {
    double& spacing = volume.spacing[axis];
    if (!std::isfinite(spacing) || spacing == 0.0 ||
        !std::isfinite(volume.origin[axis]))
      io::throwUnreadable(path, "its spacing or origin is zero or not finite");
    if (spacing > 0.0)
      continue;
    const std::size_t n = volume.dims[axis];
    volume.origin[axis] += spacing * static_cast<double>(n - 1);
    spacing = -spacing;
    for (std::size_t i = 0; i < volume.values.size(); ++i)
      if (const std::size_t k = i / stride % n; k < n / 2)
        std::swap(volume.values[i], volume.values[i + (n - 1 - 2 * k) * stride]);
  }
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
  const bool in_space = nrrd->spaceDim == 3;
  for (unsigned axis = 0; axis < 3; ++axis) {
    volume.dims[axis] = nrrd->axis[axis].size;
    if (const double spacing = nrrd->axis[axis].spacing; std::isfinite(spacing))
      volume.spacing[axis] = spacing;
    const double* const direction = nrrd->axis[axis].spaceDirection;
    if (in_space && std::isfinite(direction[axis])) {
      for (unsigned other = 0; other < 3; ++other)
        if (other != axis &&
            !(std::abs(direction[other]) <= oblique * std::abs(direction[axis])))
          throwOblique(path);
      volume.spacing[axis] = direction[axis];
    }
    if (in_space && std::isfinite(nrrd->spaceOrigin[axis]))
      volume.origin[axis] = nrrd->spaceOrigin[axis];
  }
  volume.values.resize(nrrdElementNumber(nrrd.get()));
  const auto lookup = nrrdDLookup[nrrd->type];
  for (std::size_t i = 0; i < volume.values.size(); ++i)
    volume.values[i] = static_cast<float>(lookup(nrrd->data, i));
  return volume;
}

/** Keeps what is written to std::cerr: MetaIO tells of truncated data there only. */
class ErrorStream {
public:
  ErrorStream()
      : previous_(std::cerr.rdbuf(text_.rdbuf()))
  {
  }
  ErrorStream(const ErrorStream&) = delete;
  ErrorStream&
  operator=(const ErrorStream&) = delete;
  ~ErrorStream()
  {
    std::cerr.rdbuf(previous_);
  }

  /** The first line; empty if there was none. */
  std::string
  getLine() const
  {
    const std::string text = text_.str();
    return text.substr(0, text.find_first_of("\r\n"));
  }

private:
  std::ostringstream text_;
  std::streambuf* previous_;
};

Volume
volumeOf(const std::string& path, vtkImageData& image)
{
  vtkPointData* const data = image.GetPointData();
  vtkDataArray* const scalars =
      data->GetScalars() != nullptr ? data->GetScalars() : data->GetArray(0);
  if (scalars == nullptr || scalars->GetNumberOfComponents() != 1 ||
      scalars->GetNumberOfTuples() == 0 ||
      scalars->GetNumberOfTuples() != image.GetNumberOfPoints())
    io::throwUnreadable(path, "it holds no volume of one number per point");
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
  // The name that VTK gives to the scalars of a MetaImage says nothing.
  if (scalars->GetName() != nullptr && std::string(scalars->GetName()) != "MetaImage")
    volume.name = scalars->GetName();
  return volume;
}

template <typename Reader>
Volume
readByVtk(const std::string& path)
{
  const io::VtkMessages messages;
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  std::string complaint;
  {
    const ErrorStream errors;
    reader->Update();
    complaint = errors.getLine();
  }
  if (!complaint.empty())
    io::throwUnreadable(path, "MetaIO says: " + complaint);
  if (!messages.getError().empty())
    io::throwUnreadable(path, "VTK says: " + messages.getError());
  if (reader->GetErrorCode() != 0)
    io::throwUnreadable(path, "VTK cannot make sense of it");
  return volumeOf(path, *reader->GetOutput());
}

Volume
readVolume(const std::string& path, const std::string& ending)
{
  if (ending == ".nrrd" || ending == ".nhdr")
    return readNrrd(path);
  if (ending == ".vti")
    return readByVtk<vtkXMLImageDataReader>(path);
  if (ending == ".mha" || ending == ".mhd")
    return readByVtk<vtkMetaImageReader>(path);
  if (ending == ".vtk")
    return readByVtk<vtkStructuredPointsReader>(path);
  io::throwUnreadable(path,
                      "volumes are read from .nrrd, .nhdr, .vti, .mha, .mhd and .vtk");
}

/** The header of a legacy VTK file names the kind of its data in one of five lines. */
bool
isStructuredPoints(const std::string& path)
{
  constexpr std::uint64_t header_bytes = 1024; // a title has at most 256
  return io::InputFile(path).head(header_bytes).find("STRUCTURED_POINTS") !=
         std::string::npos;
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
isVolumeFile(const std::string& path)
{
  const std::string ending = endingOf(path);
  return ending == ".nrrd" || ending == ".nhdr" || ending == ".vti" ||
         ending == ".mha" || ending == ".mhd" ||
         (ending == ".vtk" && isStructuredPoints(path));
}

Volume
loadVolume(const std::string& path)
{
  { // missing, empty or a directory: said in our words
    const io::InputFile exists(path);
  }
  Volume volume = readVolume(path, endingOf(path));
  makeAscending(path, volume);
  return volume;
}

} // namespace pcl_uvol
