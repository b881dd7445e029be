// SPDX-License-Identifier: BSD-3-Clause
// Figures of meshes.
#include "core/bindings.h"
#include "mesh/surface_distance.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

py::tuple
toPair(const Measure& measure)
{
  return py::make_tuple(measure.value, measure.error);
}

py::dict
describe(const PieceMeasures& piece)
{
  py::dict on_surface, inside;
  for (const SurfaceFieldMeasures& field : piece.on_surface) {
    py::dict figures;
    figures["mean"] = field.mean;
    figures["integral"] = toPair(field.integral);
    on_surface[toText(field.name)] = figures;
  }
  for (const InnerFieldMeasures& field : piece.inside) {
    py::dict figures;
    figures["mean"] = field.mean;
    figures["integral"] = toPair(field.integral);
    figures["sum"] = field.sum;
    inside[toText(field.name)] = figures;
  }
  py::dict dict;
  dict["isovalue"] = piece.isovalue;
  dict["vertices"] = piece.vertices;
  dict["triangles"] = piece.triangles;
  dict["rims"] = piece.rims;
  dict["genus"] = piece.genus;
  dict["area"] = toPair(piece.area);
  dict["cap_area"] = piece.cap_area;
  dict["volume"] = toPair(piece.volume);
  dict["capped_volume"] = piece.capped_volume;
  dict["centroid"] = piece.centroid;
  dict["axes"] = Eigen::Matrix3d(piece.axes.transpose());
  dict["half_axes"] = piece.half_axes;
  dict["low"] = piece.low;
  dict["high"] = piece.high;
  dict["on_surface"] = on_surface;
  dict["samples"] = piece.samples;
  dict["inside"] = inside;
  py::dict beyond;
  for (const SampleSum& field : piece.sums_beyond)
    beyond[toText(field.name)] = field.sum;
  dict["samples_beyond"] = piece.samples_beyond;
  dict["sums_beyond"] = beyond;
  return dict;
}

py::list
toList(const std::vector<PieceMeasures>& pieces)
{
  py::list list;
  for (const PieceMeasures& piece : pieces)
    list.append(describe(piece));
  return list;
}

using TriangleArray =
    py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

/** \param samples null: none
 * \return figures of isovalues and of pieces, shares of the vertices in the area, the
 * piece of each, and the report */
py::tuple
measure(const DatasetPtr& vertices,
        const TriangleArray& triangles,
        const DatasetPtr& samples,
        const std::string& parameters,
        unsigned threads,
        const py::object& progress)
{
  SurfaceMeasures measures;
  measures.setParameters(SurfaceMeasuresParameters::fromJson(parameters));
  measures.setInputSurface(vertices, toTriangles(triangles));
  measures.setInputSamples(samples);
  measures.setNumberOfThreads(threads);
  SurfaceFigures figures;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    measures.setProgressCallback(callback);
    figures = measures.compute();
  });
  py::dict report = toDict(measures.getReport());
  report["intersections"] = figures.intersections.size();
  report["parameters"] = toText(measures.getParameters().toJson());
  const auto count = static_cast<py::ssize_t>(figures.vertex_areas.size());
  return py::make_tuple(toList(figures.isovalues),
                        toList(figures.pieces),
                        toArray(std::move(figures.vertex_areas), {count}),
                        toArray(std::move(figures.piece_of), {count}),
                        report);
}

py::dict
describe(detail::SurfaceDistances&& distances)
{
  py::dict fields;
  for (const detail::FieldDifference& field : distances.fields)
    fields[toText(field.name)] = py::make_tuple(field.mean, field.largest);
  const auto count = static_cast<py::ssize_t>(distances.at_vertices.size());
  py::dict dict;
  dict["mean"] = distances.mean;
  dict["root_mean_square"] = distances.root_mean_square;
  dict["percentile_99_9"] = distances.permille;
  dict["largest"] = distances.largest;
  dict["farthest"] = distances.farthest;
  dict["fields"] = fields;
  dict["at_vertices"] = toArray(std::move(distances.at_vertices), {count});
  return dict;
}

/** \return distances from the first surface to the second one, and back, the first one
 * with the field distance, and warnings */
py::tuple
compare(const Dataset& first,
        const TriangleArray& first_triangles,
        const Dataset& second,
        const TriangleArray& second_triangles,
        unsigned threads,
        const py::object& progress)
{
  const std::vector<Triangle> here = toTriangles(first_triangles),
                              there = toTriangles(second_triangles);
  detail::SurfaceComparison found;
  Report report;
  DatasetPtr surface;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    found = detail::compareSurfaces(
        {first, here}, {second, there}, {"a", "b"}, threads, report);
    surface = std::make_shared<Dataset>(first);
    setField(*surface, "distance", found.there.at_vertices);
  });
  return py::make_tuple(describe(std::move(found.there)),
                        describe(std::move(found.back)),
                        surface,
                        toDicts(report.warnings));
}

} // namespace

void
bindMeasures(py::module_& module)
{
  module.def("measure", &measure);
  module.def("compare", &compare);
}

} // namespace pcl_uvol::python
