// SPDX-License-Identifier: BSD-3-Clause
// The extension _io: files, which take VTK's libraries with them.
#include "shared/convert.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/io/mesh.h>
#include <pcl_uvol/io/volume.h>

#include <array>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace py = pybind11;

namespace pcl_uvol::python {
namespace {

template <typename T>
using DenseArray = py::array_t<T, py::array::c_style | py::array::forcecast>;

DatasetPtr
readPoints(const std::string& path, const std::array<std::string, 3>& xyz_columns)
{
  const py::gil_scoped_release unlocked;
  LoadOptions options;
  options.xyz_columns = xyz_columns;
  return share(loadDataset(path, options));
}

std::vector<Triangle>
toTriangles(const DenseArray<std::uint32_t>& indices)
{
  std::vector<Triangle> triangles(static_cast<std::size_t>(indices.shape(0)));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::copy_n(indices.data() + 3 * i, 3, triangles[i].begin());
  return triangles;
}

/** With triangles a mesh, else points. */
void
writePoints(const std::string& path,
            const Dataset& points,
            const DenseArray<std::uint32_t>& triangles,
            bool ascii,
            const std::vector<std::string>& comments)
{
  const std::vector<Triangle> mesh = toTriangles(triangles);
  const py::gil_scoped_release unlocked;
  SaveOptions options;
  options.ascii = ascii;
  options.comments = comments;
  if (mesh.empty() && !isMeshOnly(path)) {
    checkSavePath(path, points.cloud.fields);
    saveDataset(path, points, options);
    return;
  }
  checkMeshPath(path);
  saveMesh(path, points, mesh, options);
}

void
writePng(const std::string& path, const DenseArray<std::uint8_t>& pixels)
{
  Image image;
  image.height = static_cast<std::uint32_t>(pixels.shape(0));
  image.width = static_cast<std::uint32_t>(pixels.shape(1));
  image.color.assign(pixels.data(), pixels.data() + pixels.size());
  const py::gil_scoped_release unlocked;
  savePng(path, image);
}

/** \return values with z slowest, origin, spacing and name */
py::tuple
readVolume(const std::string& path)
{
  Volume volume;
  {
    const py::gil_scoped_release unlocked;
    volume = loadVolume(path);
  }
  const auto side = [&](int axis) {
    return static_cast<py::ssize_t>(volume.dims[static_cast<std::size_t>(axis)]);
  };
  return py::make_tuple(toArray(std::move(volume.values), {side(2), side(1), side(0)}),
                        volume.origin,
                        volume.spacing,
                        toText(volume.name));
}

} // namespace
} // namespace pcl_uvol::python

PYBIND11_MODULE(_io, module)
{
  using namespace pcl_uvol::python;
  py::module_::import("pcl_uvol._core"); // the dataset's class
  module.def("read", &readPoints);
  module.def("write", &writePoints);
  module.def("write_png", &writePng);
  module.def("is_volume", &pcl_uvol::isVolumeFile);
  module.def("read_volume", &readVolume);
}
