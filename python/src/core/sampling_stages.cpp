// SPDX-License-Identifier: BSD-3-Clause
// What samples are like: statistics, spacings, and the nearest of them by Voronoi
// diagrams.
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "core/bindings.h"
#include "core/run_stage.h"
#include "neighbors/anisotropy.h"
#include "pipeline/dataset_info.h"
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <array>
#include <numeric>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** \return a point in the nearest filled cell, and the distance, per cell with z
 * slowest; the lower corner and the sides of the cells */
py::tuple
computeVoronoi(const DatasetPtr& dataset,
               const std::string& parameters,
               unsigned threads,
               const py::object& progress)
{
  VoronoiDiagram<Cloud> diagram;
  std::vector<std::uint32_t> nearest;
  std::vector<float> distances;
  GridShape shape;
  const py::dict report =
      runStage(diagram, dataset, parameters, threads, progress, [&] {
        const auto grid = diagram.compute();
        shape = grid->getShape();
        nearest = grid->getNearest();
        for (std::uint32_t& site : nearest)
          site = *grid->getMembers()[site].begin();
        distances = grid->computeDistances(threads);
      });
  const std::vector<py::ssize_t> sides(shape.cells.rbegin(), shape.cells.rend());
  for (std::size_t axis = 0; axis < 3; ++axis)
    shape.origin[axis] += dataset->origin[axis];
  return py::make_tuple(toArray(std::move(nearest), sides),
                        toArray(std::move(distances), sides),
                        shape.origin,
                        shape.spacing,
                        report);
}

py::dict
describe(const ValueStatistics& statistics)
{
  py::dict dict;
  if (statistics.finite > 0) {
    dict["min"] = statistics.min;
    dict["max"] = statistics.max;
    dict["mean"] = statistics.mean;
  }
  dict["finite"] = statistics.finite;
  dict["missing"] = statistics.missing;
  dict["histogram"] = statistics.histogram;
  dict["isovalues"] = statistics.isovalues;
  return dict;
}

py::dict
describeField(const Dataset& dataset, const std::string& field)
{
  ValueStatistics statistics;
  {
    const py::gil_scoped_release unlocked;
    statistics = describeValues(
        readFieldValues(dataset, ScalarField(dataset.cloud.fields, field)));
  }
  return describe(statistics);
}

py::dict
describePlaces(const Dataset& dataset,
               const std::array<float, 3>& scale,
               const std::array<double, 3>& rotation,
               unsigned threads,
               const py::object& progress)
{
  PositionStatistics statistics;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    statistics = describePositions(
        dataset,
        {Eigen::Array3f(scale.data()), Eigen::Array3d(rotation.data())},
        threads,
        callback);
  });
  py::dict dict;
  dict["non_finite"] = statistics.non_finite;
  dict["duplicates"] = statistics.duplicates;
  dict["lower"] = statistics.lower;
  dict["upper"] = statistics.upper;
  dict["spacing"] = py::dict(py::arg("min") = statistics.spacing_min,
                             py::arg("median") = statistics.spacing_median,
                             py::arg("max") = statistics.spacing_max);
  dict["sampling"] = py::dict(py::arg("shares") = statistics.sampling.shares,
                              py::arg("along") = statistics.sampling.along,
                              py::arg("across") = statistics.sampling.across);
  dict["warnings"] = toDicts(statistics.warnings);
  return dict;
}

/** A copy with what the sampling is like around each point. */
DatasetPtr
withSampling(const Dataset& dataset,
             const std::array<float, 3>& scale,
             const std::array<double, 3>& rotation,
             unsigned threads,
             const py::object& progress)
{
  DatasetPtr result;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    result = std::make_shared<Dataset>(dataset);
    addSamplingFields(*result,
                      {Eigen::Array3f(scale.data()), Eigen::Array3d(rotation.data())},
                      threads,
                      callback);
  });
  return result;
}

std::array<float, 3>
equalScale(const Dataset& dataset, const std::array<double, 3>& rotation)
{
  const py::gil_scoped_release unlocked;
  const detail::StretchAxes axes{Eigen::Array3d(rotation.data())};
  const Eigen::Array3f scale = equalizingScale(axes.turn(viewOf(dataset.cloud)));
  return {scale[0], scale[1], scale[2]};
}

std::array<float, 3>
chooseFieldScale(const Dataset& dataset,
                 const std::string& field,
                 const std::array<double, 3>& rotation,
                 unsigned threads)
{
  const py::gil_scoped_release unlocked;
  Report own;
  pcl::Indices all(dataset.cloud.width);
  std::iota(all.begin(), all.end(), 0);
  const Eigen::Array3f scale = chooseScale(viewOf(dataset.cloud),
                                           all,
                                           chooseField(dataset, field),
                                           Eigen::Array3d(rotation.data()),
                                           threads,
                                           own)
                                   .scale;
  return {scale[0], scale[1], scale[2]};
}

/** \param map row by row
 * \return factors along axes, and the rotation of these */
std::pair<std::array<float, 3>, std::array<double, 3>>
splitMap(const std::array<double, 9>& map)
{
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const auto stretch = detail::Stretch::ofMap(Eigen::Map<const Rows>(map.data()));
  return {{stretch.scale[0], stretch.scale[1], stretch.scale[2]},
          {stretch.rotation[0], stretch.rotation[1], stretch.rotation[2]}};
}

} // namespace

void
bindSamplingStages(py::module_& module)
{
  module.def("compute_voronoi", &computeVoronoi);
  module.def("describe_field", &describeField);
  module.def("describe_places", &describePlaces);
  module.def("with_sampling", &withSampling);
  module.def("equalizing_scale", &equalScale);
  module.def("scale_of_field", &chooseFieldScale);
  module.def("split_map", &splitMap);
}

} // namespace pcl_uvol::python
