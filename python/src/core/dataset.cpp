// SPDX-License-Identifier: BSD-3-Clause
// Points with their fields, in memory that numpy looks into.
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "core/bindings.h"
#include "core/large_memory.h"
#include "interpolation/outer_layer.h"
#include "interpolation/sph_density.h"
#include "pipeline/dataset_info.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/expressions/derived_fields.h>

#include <array>
#include <cstring>
#include <pybind11/stl.h>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** Name, numpy's type and components of a field. */
using FieldSpec = std::tuple<std::string, std::string, std::size_t>;

struct NumberType {
  const char* name;
  std::uint8_t datatype;
};

using Type = pcl::PCLPointField;
constexpr std::array<NumberType, 11> number_types = {{{"?", Type::BOOL},
                                                      {"i1", Type::INT8},
                                                      {"u1", Type::UINT8},
                                                      {"i2", Type::INT16},
                                                      {"u2", Type::UINT16},
                                                      {"i4", Type::INT32},
                                                      {"u4", Type::UINT32},
                                                      {"i8", Type::INT64},
                                                      {"u8", Type::UINT64},
                                                      {"f4", Type::FLOAT32},
                                                      {"f8", Type::FLOAT64}}};

std::uint8_t
toDatatype(const std::string& name)
{
  for (const NumberType& type : number_types)
    if (name == type.name)
      return type.datatype;
  throw InvalidArgument("unknown_numpy_type", {{"type", name}});
}

const char*
toTypeName(std::uint8_t datatype)
{
  for (const NumberType& type : number_types)
    if (datatype == type.datatype)
      return type.name;
  throw InvalidArgument("field_type_not_in_numpy", {{"datatype", datatype}});
}

/** Records to be filled in through their bytes; settle() makes points of them. */
DatasetPtr
allocate(const std::vector<FieldSpec>& specs, std::uint64_t count)
{
  Fields fields;
  for (const auto& [name, type, components] : specs)
    appendField(fields, name, toDatatype(type), components);
  Dataset dataset;
  dataset.cloud = makeRecords(std::move(fields), 0);
  // Points that are records already need not be moved: their step is a multiple of 4.
  dataset.cloud.point_step = (dataset.cloud.point_step + 3u) / 4u * 4u;
  checkSize(count, dataset.cloud.point_step);
  checkLargeMemory("A cloud of " + std::to_string(count) + " points",
                   static_cast<double>(count) * dataset.cloud.point_step);
  resizePoints(dataset.cloud, count);
  return share(std::move(dataset));
}

/** Coordinates of any type become float32 beside an origin, as in files. Arrays that
 * look into the records are of no use any more. */
void
settle(Dataset& dataset)
{
  const py::gil_scoped_release unlocked;
  RecordInfo info;
  info.labels = std::move(dataset.labels);
  dataset = makeDataset(std::move(dataset.cloud), std::move(info));
}

/** The bytes of all points, a row each: no copy. */
py::array
viewBytes(const py::object& self)
{
  auto& cloud = self.cast<Dataset&>().cloud;
  return py::array_t<std::uint8_t>({static_cast<py::ssize_t>(cloud.width),
                                    static_cast<py::ssize_t>(cloud.point_step)},
                                   cloud.data.data(),
                                   self);
}

/** Name, numpy's type, components and first byte of all fields. */
py::list
listFields(const Dataset& dataset)
{
  py::list list;
  for (const pcl::PCLPointField& field : dataset.cloud.fields)
    if (!isPadding(field))
      list.append(py::make_tuple(toText(field.name),
                                 toTypeName(field.datatype),
                                 std::max<std::size_t>(field.count, 1),
                                 field.offset));
  return list;
}

/** The dataset itself where it has the field, else a copy with it.
 * \param no_derivatives, sides see DerivedFieldOptions */
py::tuple
withField(const DatasetPtr& dataset,
          const std::string& expression,
          const std::string& no_derivatives,
          const std::array<double, 3>& sides,
          unsigned threads,
          const py::object& progress)
{
  Report report;
  DatasetPtr result = dataset;
  std::string name = expression;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    try {
      ScalarField(dataset->cloud.fields, expression);
    }
    catch (const InvalidArgument&) {
      result = std::make_shared<Dataset>(*dataset);
      name = addDerivedField(
          *result, expression, {threads, no_derivatives, sides}, report);
    }
  });
  return py::make_tuple(result, toText(name), toDict(report));
}

/** A copy with the field sph_density.
 * \param length of all particles; 0: by their field, or by neighbours */
py::tuple
withDensity(const DatasetPtr& dataset,
            double length,
            unsigned threads,
            const py::object& progress)
{
  auto result = std::make_shared<Dataset>(*dataset);
  Report report;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    addSphDensity(*result, length, threads, report);
  });
  return py::make_tuple(result, toDict(report));
}

/** A copy with samples of a value outside of the others. */
py::tuple
withOuterLayer(const DatasetPtr& dataset,
               const std::string& field,
               double value,
               unsigned threads,
               const py::object& progress)
{
  const std::string taken = chooseField(*dataset, field);
  auto result = std::make_shared<Dataset>(*dataset);
  Report report;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    addOuterLayer(*result, nullptr, taken, value, threads, report);
  });
  return py::make_tuple(result, toDict(report));
}

py::tuple
selectPoints(const Dataset& dataset,
             const std::string& where,
             unsigned threads,
             const py::object& progress)
{
  DatasetPtr result;
  std::size_t removed = 0;
  Report report;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    result = std::make_shared<Dataset>(dataset);
    removed = selectRows(*result, where, {threads, ""}, report);
  });
  return py::make_tuple(result, removed);
}

/** The points of some indices. */
DatasetPtr
takePoints(
    const Dataset& dataset,
    const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>& indices)
{
  auto result = std::make_shared<Dataset>(withoutCloud(dataset));
  result->cloud = makeRecords(dataset.cloud.fields, 0);
  result->cloud.header = dataset.cloud.header;
  const std::size_t step = dataset.cloud.point_step;
  result->cloud.point_step = static_cast<pcl::uindex_t>(step);
  resizePoints(result->cloud, static_cast<std::size_t>(indices.size()));
  for (py::ssize_t i = 0; i < indices.size(); ++i) {
    const std::int64_t index = indices.data()[i];
    if (index < 0 || index >= std::int64_t{dataset.cloud.width})
      throw py::index_error("There is no point " + std::to_string(index) + ".");
    std::memcpy(&result->cloud.data[static_cast<std::size_t>(i) * step],
                &dataset.cloud.data[static_cast<std::size_t>(index) * step],
                step);
  }
  return result;
}

/** The map that the coordinates are on. */
MapNumbers
getMap(const Dataset& dataset)
{
  const auto map = findMap(dataset);
  if (!map)
    return std::nullopt;
  return std::array<double, 3>{{map->longitude, map->latitude, map->per_kilometre}};
}

/** The points on another map. */
DatasetPtr
putOnMap(const Dataset& dataset, const MapNumbers& map)
{
  auto result = std::make_shared<Dataset>(dataset);
  changeMap(*result, *toMap(map));
  return result;
}

/** Pairs of numbers, a row each, from the globe to a map or back. */
template <std::array<double, 2> (MapProjection::*transform)(double, double) const>
py::array_t<double>
transformPairs(
    const MapNumbers& map,
    const py::array_t<double, py::array::c_style | py::array::forcecast>& pairs)
{
  const MapProjection projection = *toMap(map);
  std::vector<double> found;
  for (py::ssize_t i = 0; i < pairs.shape(0); ++i)
    for (const double number : (projection.*transform)(pairs.at(i, 0), pairs.at(i, 1)))
      found.push_back(number);
  return toArray(std::move(found), {pairs.shape(0), 2});
}

/** Say that an int32 field holds numbers of names. */
void
setLabels(Dataset& dataset, const std::string& field, std::vector<std::string> names)
{
  dataset.labels[field] = std::move(names);
}

/** Names of labels by field, as `convert` makes them of texts. */
template <typename Convert>
py::dict
listLabels(const Dataset& dataset, const Convert& convert)
{
  py::dict labels;
  for (const auto& [field, names] : dataset.labels) {
    py::list list;
    for (const std::string& name : names)
      list.append(convert(name));
    labels[convert(field)] = list;
  }
  return labels;
}

/** Values of a scalar that needs no computation: `vel[1]`, `|vel|`. */
py::array_t<double>
readScalar(const Dataset& dataset, const std::string& name)
{
  std::vector<double> values =
      readFieldValues(dataset, ScalarField(dataset.cloud.fields, name));
  const auto count = static_cast<py::ssize_t>(values.size());
  return toArray(std::move(values), {count});
}

py::tuple
getState(const Dataset& dataset)
{
  py::list fields;
  for (const pcl::PCLPointField& field : dataset.cloud.fields)
    fields.append(py::make_tuple(
        py::bytes(field.name), field.offset, field.datatype, field.count));
  py::list notes;
  for (const Message& note : dataset.notes)
    notes.append(py::make_tuple(note.code, toDict(note)["values"], toText(note.about)));
  const auto& data = dataset.cloud.data;
  return py::make_tuple(
      fields,
      dataset.cloud.width,
      dataset.cloud.point_step,
      py::bytes(reinterpret_cast<const char*>(data.data()), data.size()),
      dataset.origin,
      dataset.double_coordinates,
      dataset.has_coordinates,
      notes,
      listLabels(dataset, [](const std::string& name) { return py::bytes(name); }),
      dataset.box,
      dataset.cloud.header.frame_id);
}

DatasetPtr
setState(const py::tuple& state)
{
  Dataset dataset;
  auto& cloud = dataset.cloud;
  for (const py::handle item : state[0]) {
    const auto values = item.cast<py::tuple>();
    pcl::PCLPointField field;
    field.name = values[0].cast<std::string>();
    field.offset = values[1].cast<pcl::uindex_t>();
    field.datatype = values[2].cast<std::uint8_t>();
    field.count = values[3].cast<pcl::uindex_t>();
    cloud.fields.push_back(std::move(field));
  }
  cloud.point_step = state[2].cast<pcl::uindex_t>();
  const auto bytes = state[3].cast<std::string_view>();
  cloud.data.assign(bytes.begin(), bytes.end());
  cloud.height = 1;
  cloud.width = state[1].cast<pcl::uindex_t>();
  cloud.row_step = cloud.width * cloud.point_step;
  checkComplete(cloud);
  dataset.origin = state[4].cast<std::array<double, 3>>();
  dataset.double_coordinates = state[5].cast<bool>();
  dataset.has_coordinates = state[6].cast<bool>();
  for (const py::handle item : state[7]) {
    const auto note = item.cast<py::tuple>();
    dataset.notes.push_back(
        toMessage(note[0].cast<std::string>(), note[1].cast<py::dict>()));
    dataset.notes.back().about = note[2].cast<std::string>();
  }
  dataset.labels = state[8].cast<LabelNames>();
  dataset.box = state[9].cast<std::array<double, 3>>();
  cloud.header.frame_id = state[10].cast<std::string>();
  return share(std::move(dataset));
}

} // namespace

void
bindDataset(py::module_& module)
{
  py::class_<Dataset, DatasetPtr>(module, "Dataset")
      .def_static("allocate", &allocate)
      .def("settle", &settle)
      .def_property_readonly("bytes", &viewBytes)
      .def_property_readonly("fields", &listFields)
      .def_property_readonly("count",
                             [](const Dataset& dataset) { return dataset.cloud.width; })
      .def_readonly("origin", &Dataset::origin)
      .def_readonly("double_coordinates", &Dataset::double_coordinates)
      .def_readonly("has_coordinates", &Dataset::has_coordinates)
      .def_property_readonly(
          "notes", [](const Dataset& dataset) { return toDicts(dataset.notes); })
      .def_readonly("box", &Dataset::box)
      .def_property_readonly("map", &getMap)
      .def("on_map", &putOnMap)
      .def_property_readonly("labels",
                             [](const Dataset& dataset) {
                               return listLabels(dataset, [](const std::string& name) {
                                 return toText(name);
                               });
                             })
      .def("set_labels", &setLabels)
      .def("refuse_names", &refuseNames)
      .def("with_field", &withField)
      .def("with_density", &withDensity)
      .def("with_outer_layer", &withOuterLayer)
      .def("select", &selectPoints)
      .def("take", &takePoints)
      .def("read_scalar", &readScalar)
      .def(py::pickle(&getState, &setState));
  module.def("to_map", &transformPairs<&MapProjection::toMap>);
  module.def("to_globe", &transformPairs<&MapProjection::toGlobe>);
}

} // namespace pcl_uvol::python
