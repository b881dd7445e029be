// SPDX-License-Identifier: BSD-3-Clause
// The extension _io: files, which take VTK's libraries with them.
#include "io/cell_loader.h"
#include "io/held_fields.h"
#include "io/lattice_file.h"
#include "shared/cell_mask.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>

#include <array>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace pcl_uvol::python {
namespace {

template <typename T>
using DenseArray = py::array_t<T, py::array::c_style | py::array::forcecast>;

LoadOptions
makeOptions(const std::array<std::string, 3>& xyz_columns,
            const std::string& particles,
            bool cells,
            const MapNumbers& map)
{
  LoadOptions options;
  options.xyz_columns = xyz_columns;
  options.particles = particles;
  options.cells = cells;
  options.map = toMap(map);
  return options;
}

DatasetPtr
readPoints(const std::string& path,
           const std::array<std::string, 3>& xyz_columns,
           const std::string& particles,
           bool cells,
           const MapNumbers& map,
           const py::object& progress)
{
  LoadOptions options = makeOptions(xyz_columns, particles, cells, map);
  DatasetPtr points;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    options.progress = callback;
    points = share(loadDataset(path, options));
  });
  return points;
}

/** Where the data of points that were read so are.
 * \return the cells, and what was wrong with them */
py::tuple
readCells(const std::string& path,
          const std::array<std::string, 3>& xyz_columns,
          const std::string& particles,
          bool cells,
          const MapNumbers& map,
          const Dataset& points)
{
  const LoadOptions options = makeOptions(xyz_columns, particles, cells, map);
  CellMask mask;
  Report report;
  {
    const py::gil_scoped_release unlocked;
    mask.cells = findCells(path, options, points, report);
  }
  return py::make_tuple(mask, toDicts(report.warnings));
}

py::tuple
readMesh(const std::string& path, const MapNumbers& map)
{
  DatasetPtr vertices;
  std::vector<Triangle> triangles;
  {
    const py::gil_scoped_release unlocked;
    vertices = share(loadMesh(path, triangles, toMap(map)));
  }
  return py::make_tuple(vertices, toIndices(std::move(triangles)));
}

/** With triangles a mesh, else points.
 * \return messages of what the file does not hold of them */
py::list
writePoints(const std::string& path,
            const Dataset& points,
            const DenseArray<std::uint32_t>& triangles,
            bool ascii,
            const std::vector<std::string>& comments,
            const py::object& progress)
{
  const std::vector<Triangle> mesh = toTriangles(triangles);
  SaveOptions options;
  options.ascii = ascii;
  options.comments = comments;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    options.progress = callback;
    if (mesh.empty() && !isMeshOnly(path))
      saveDataset(path, points, options);
    else
      saveMesh(path, points, mesh, options);
  });
  return toDicts(describeLosses(path, points));
}

/** An array of a lattice as its file holds it. */
LatticeArray
describeArray(const std::string& name, const py::array& numbers)
{
  using Type = pcl::PCLPointField;
  const char kind = numbers.dtype().kind();
  const auto size = numbers.itemsize();
  LatticeArray array{name, Type::UINT8, static_cast<std::size_t>(numbers.shape(1))};
  if (kind == 'f' && (size == 4 || size == 8))
    array.datatype = size == 4 ? Type::FLOAT32 : Type::FLOAT64;
  else if (kind != 'u' || size != 1)
    throw InvalidArgument("bad_lattice_type", {});
  return array;
}

/** \param arrays names and numbers, a row for each place, in the order of the places
 */
void
writeLattice(const std::string& path,
             const std::array<double, 3>& origin,
             const std::array<std::array<double, 3>, 3>& steps,
             const std::array<std::size_t, 3>& counts,
             const std::vector<std::pair<std::string, py::array>>& arrays)
{
  detail::QueryLattice lattice;
  lattice.origin = origin;
  lattice.steps = steps;
  lattice.counts = counts;
  std::vector<LatticeArray> kinds;
  std::vector<const void*> numbers;
  for (const auto& [name, array] : arrays) {
    kinds.push_back(describeArray(name, array));
    numbers.push_back(array.data());
  }
  const py::gil_scoped_release unlocked;
  saveLattice(path, lattice, kinds, [&](const PutNumbers& put) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      put(i, 0, lattice.size(), numbers[i]);
  });
}

void
writePng(const std::string& path,
         const DenseArray<std::uint8_t>& pixels,
         double dots_per_inch)
{
  Image image;
  image.height = static_cast<std::uint32_t>(pixels.shape(0));
  image.width = static_cast<std::uint32_t>(pixels.shape(1));
  image.color.assign(pixels.data(), pixels.data() + pixels.size());
  const py::gil_scoped_release unlocked;
  savePng(path, image, {}, dots_per_inch);
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
  module.def("read_cells", &readCells);
  module.def("read_mesh", &readMesh);
  module.def("write", &writePoints);
  module.def("write_lattice", &writeLattice);
  module.def("is_lattice_file", &pcl_uvol::isLatticeFile);
  module.def("write_png", &writePng);
  module.def("is_volume", &pcl_uvol::isVolumeFile);
  module.def("read_volume", &readVolume);
}
