// SPDX-License-Identifier: BSD-3-Clause
// Volumes, turned so that all axes ascend.
#include "io/files.h"
#include "io/volume_data.h"
#include "io/vtk_library.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Let axes of negative spacing run the other way. */
void
makeAscending(const std::string& path, Volume& volume)
{
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; stride *= volume.dims[axis++]) {
    double& spacing = volume.spacing[axis];
    if (!std::isfinite(spacing) || spacing == 0.0 ||
        !std::isfinite(volume.origin[axis]))
      io::throwUnreadable(path, {"invalid_part", "its spacing or origin"});
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

bool
isNrrd(const std::string& ending)
{
  return ending == ".nrrd" || ending == ".nhdr";
}

bool
isMetaImage(const std::string& ending)
{
  return ending == ".mha" || ending == ".mhd";
}

Volume
readVolume(const std::string& path, const std::string& ending)
{
  if (isNrrd(ending))
    return io::readNrrd(path);
  if (isMetaImage(ending))
    return io::readMetaImage(path);
  if (ending != ".vti" && ending != ".vtk")
    io::throwUnreadable(
        path, {"other_ending", "volumes", ".nrrd, .nhdr, .vti, .mha, .mhd and .vtk"});
  return io::vtkLibrary().readImage(path);
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

std::vector<std::string>
io::findVolumeFiles(const std::string& path)
{
  const std::string ending = getEnding(path);
  try {
    if (isNrrd(ending))
      return findNrrdFiles(path);
    if (isMetaImage(ending))
      return findMetaImageFiles(path);
  }
  catch (const IOError&) {
    // Whoever reads the volume tells what is wrong with it.
  }
  return {};
}

bool
isVolumeFile(const std::string& path)
{
  const std::string ending = io::getEnding(path);
  return isNrrd(ending) || isMetaImage(ending) || ending == ".vti" ||
         (ending == ".vtk" && io::vtkLibrary().holdsImage(path));
}

Volume
loadVolume(const std::string& path)
{
  { // missing, empty or a directory: said in our words
    const io::InputFile exists(path);
  }
  return io::reading(path, [&] {
    Volume volume = readVolume(path, io::getEnding(path));
    makeAscending(path, volume);
    return volume;
  });
}

} // namespace pcl_uvol
