// SPDX-License-Identifier: BSD-3-Clause
// Fields between the samples: a model that answers queries, and the places of lines,
// slices and grids.
#include "common/sample_checks.h"
#include "core/bindings.h"
#include "core/large_memory.h"
#include "interpolation/answer_summary.h"
#include "interpolation/query_lattice.h"
#include "interpolation/variogram.h"
#include "neighbors/periodic_box.h"
#include "shared/cell_mask.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <array>
#include <memory>
#include <numeric>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

using detail::AnswerSummary;
using detail::Bounds;
using detail::FieldInterpolator;
using detail::Place;
using detail::QueryLattice;
using Queries = py::array_t<double, py::array::c_style | py::array::forcecast>;

/** Before so many numbers are made for each of so many places. */
void
checkPlaces(std::size_t places, std::size_t numbers)
{
  checkLargeMemory("An array of " + std::to_string(places) + " places",
                   static_cast<double>(places) *
                       static_cast<double>(numbers * sizeof(double)));
}

/** A model of some fields, ready for queries. Any number of threads may ask at once. */
class Interpolator {
public:
  /** \param own samples, which images follow
   * \param sides of the box that they repeat in, which begins where coordinates do
   * \param parameters JSON of InterpolationParameters
   * \param mask null: the samples say where the data are */
  Interpolator(const DatasetPtr& samples,
               std::size_t own,
               const std::array<double, 3>& sides,
               const std::string& parameters,
               const CellMask* mask,
               unsigned threads,
               const py::object& progress)
      : samples_(samples)
      , parameters_(InterpolationParameters::fromJson(parameters))
      , view_(viewOf(samples->cloud))
      , indices_(view_.count)
      , own_(own)
      , box_{{}, sides}
  {
    std::iota(indices_.begin(), indices_.end(), 0);
    std::iota(own_.begin(), own_.end(), 0);
    warnOfUnusedBox(*samples, sides, report_);
    if (parameters_.fields.empty())
      parameters_.fields = {chooseField(*samples, "")};
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      report_.progress = callback;
      if (parameters_.model == InterpolationModel::Auto)
        parameters_.model = chooseModel(view_, own_, parameters_, threads, report_)
                                .scores.front()
                                .model;
      auto interpolator = std::make_unique<FieldInterpolator>(
          view_, indices_, parameters_, threads, report_);
      if (mask)
        interpolator->setCells(mask->cells);
      interpolator_ = std::move(interpolator);
      report_.progress = nullptr;
    });
  }

  /** \param queries in coordinates with the origin added, shape (n, 3)
   * \return values, errors and gradients, field by field, support, and the report */
  py::dict
  answer(const Queries& queries, unsigned threads, const py::object& progress) const
  {
    const auto size = static_cast<std::size_t>(queries.shape(0));
    checkPlaces(size, countNumbers());
    const double* const numbers = queries.data();
    InterpolatedFields answers;
    std::vector<std::uint8_t> support;
    Report report;
    report.counts = report_.counts;
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      report.progress = callback;
      std::vector<Place> places(size);
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          places[i][axis] = numbers[3 * i + axis] - samples_->origin[axis];
        places[i] = box_.toBox(places[i]);
      }
      answers = interpolator_->interpolate(places, threads, report);
      for (const FieldSupport kind : answers.support)
        support.push_back(static_cast<std::uint8_t>(kind));
      AnswerSummary summary(view_, own_, interpolator_->getNames());
      summary.add(answers);
      summary.warn(report);
    });
    return toAnswers(std::move(answers), std::move(support), report);
  }

  /** Copies of points with the answers at their places, as uvol_probe writes them. */
  py::tuple
  probe(const Dataset& points, unsigned threads, const py::object& progress) const
  {
    auto result = std::make_shared<Dataset>(points);
    std::vector<Place> places = detail::readPlaces(viewOf(points.cloud));
    for (Place& place : places) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] += points.origin[axis] - samples_->origin[axis];
      place = box_.toBox(place);
    }
    Report report;
    report.counts = report_.counts;
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      report.progress = callback;
      const auto answers = interpolator_->interpolate(places, threads, report);
      AnswerSummary summary(view_, own_, interpolator_->getNames());
      summary.add(answers);
      summary.warn(report);
      if (const auto map = findMap(*samples_);
          map && !findGlobeFields(result->cloud.fields)) {
        setMap(*result, *map);
        setGlobeFields(*result);
      }
      appendFields(answers, result->cloud);
    });
    return py::make_tuple(result, toDict(report));
  }

  /** How well fields are told at samples that are left out.
   * \param by random, blocks, or a field whose values stay together */
  py::tuple
  validate(std::size_t folds,
           const std::string& by,
           unsigned threads,
           const py::object& progress) const
  {
    std::vector<FieldScore> scores;
    Report report;
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      report.progress = callback;
      scores = crossValidate(
          view_, own_, parameters_, split(folds, by, threads), 0, threads, report);
    });
    py::dict fields;
    for (const FieldScore& score : scores) {
      py::dict dict;
      dict["tested"] = score.tested;
      dict["covered"] = score.covered;
      dict["rms"] = score.rms;
      dict["bias"] = score.bias;
      dict["within_error"] = score.share;
      fields[toText(score.field)] = dict;
    }
    return py::make_tuple(fields, toDict(report));
  }

  py::list
  getNames() const
  {
    py::list names;
    for (const std::string& name : interpolator_->getNames())
      names.append(toText(name));
    return names;
  }

  /** The variograms of kriging, by field, and what they were fitted to. */
  py::dict
  getVariograms() const
  {
    const auto toColumn = [](const std::vector<double>& numbers) {
      return toArray(std::vector<double>(numbers),
                     {static_cast<py::ssize_t>(numbers.size())});
    };
    py::dict variograms;
    const std::vector<std::string>& names = interpolator_->getNames();
    for (std::size_t field = 0; field < names.size(); ++field)
      if (const auto found = interpolator_->findVariogram(field);
          found && found->model.nugget + found->model.psill > 0.0) {
        py::dict dict;
        dict["kind"] = toWord(found->model.kind);
        dict["nugget"] = found->model.nugget;
        dict["psill"] = found->model.psill;
        dict["range"] = found->model.range;
        dict["distances"] = toColumn(found->empirical.all.distance);
        dict["values"] = toColumn(found->empirical.all.value);
        dict["pairs"] = toColumn(found->empirical.all.pairs);
        variograms[toText(names[field])] = dict;
      }
    return variograms;
  }

  /** Whether values of a field are float32 in files, see findFileType(). */
  bool
  isShort(const std::string& name) const
  {
    return detail::findFileType(view_.fields, name) == pcl::PCLPointField::FLOAT32;
  }

  std::string
  getParameters() const
  {
    return parameters_.toJson();
  }

  py::dict
  getReport() const
  {
    return toDict(report_);
  }

private:
  /** The numbers of a place and of the answer there. */
  std::size_t
  countNumbers() const
  {
    const std::size_t of_field =
        1u + (parameters_.errors ? 1u : 0u) + (parameters_.gradients ? 3u : 0u);
    return 3u + of_field * interpolator_->getNames().size();
  }

  Folds
  split(std::size_t folds, const std::string& by, unsigned threads) const
  {
    if (by == "random")
      return Folds::byRandom(view_.count, folds);
    if (by == "blocks")
      return Folds::byBlocks(view_, folds, threads);
    return Folds::byField(view_, by, folds);
  }

  py::dict
  toAnswers(InterpolatedFields&& answers,
            std::vector<std::uint8_t>&& support,
            const Report& report) const
  {
    const auto fields = static_cast<py::ssize_t>(answers.names.size());
    const auto size = static_cast<py::ssize_t>(answers.size);
    py::dict dict;
    dict["values"] = toArray(std::move(answers.values), {fields, size});
    if (!answers.errors.empty() || (size == 0 && parameters_.errors))
      dict["errors"] = toArray(std::move(answers.errors), {fields, size});
    if (!answers.gradients.empty() || (size == 0 && parameters_.gradients))
      dict["gradients"] = toArray(std::move(answers.gradients), {fields, size, 3});
    dict["support"] = toArray(std::move(support), {size});
    dict["report"] = toDict(report);
    return dict;
  }

  DatasetPtr samples_;
  InterpolationParameters parameters_;
  CloudView view_;
  pcl::Indices indices_, own_; ///< of all points, and of those that are no images
  PeriodicBox box_;
  std::unique_ptr<const FieldInterpolator> interpolator_;
  Report report_; ///< of making the model
};

/** The box of samples, in coordinates with the origin added.
 * \param sides of a box that repeats and begins where coordinates do, or 0 */
py::tuple
findBounds(const Dataset& samples, const std::array<double, 3>& sides)
{
  Bounds bounds = detail::findBounds(viewOf(samples.cloud));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (sides[axis] > 0.0) {
      bounds.low[axis] = 0.0;
      bounds.high[axis] = sides[axis];
    }
    bounds.low[axis] += samples.origin[axis];
    bounds.high[axis] += samples.origin[axis];
  }
  return py::make_tuple(bounds.low, bounds.high);
}

/** \return all places, and along each axis how many, and the step */
py::tuple
describe(const QueryLattice& lattice)
{
  checkPlaces(lattice.size(), 3);
  std::vector<double> places;
  places.reserve(3 * lattice.size());
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Place place = lattice.at(i);
    places.insert(places.end(), place.begin(), place.end());
  }
  const auto count = static_cast<py::ssize_t>(lattice.size());
  return py::make_tuple(
      toArray(std::move(places), {count, 3}), lattice.counts, lattice.steps);
}

py::tuple
placeSlice(const Place& point,
           const Place& normal,
           const Bounds& box,
           const std::array<std::size_t, 2>& counts)
{
  const auto slice = detail::makeSlice({point, normal}, box, counts);
  return py::make_tuple(describe(slice.lattice), slice.horizontal, slice.vertical);
}

} // namespace

void
bindInterpolation(py::module_& module)
{
  py::class_<CellMask>(module, "CellMask");
  py::class_<Interpolator>(module, "Interpolator")
      .def(py::init<const DatasetPtr&,
                    std::size_t,
                    const std::array<double, 3>&,
                    const std::string&,
                    const CellMask*,
                    unsigned,
                    const py::object&>())
      .def("answer", &Interpolator::answer)
      .def("probe", &Interpolator::probe)
      .def("validate", &Interpolator::validate)
      .def("is_short", &Interpolator::isShort)
      .def_property_readonly("names", &Interpolator::getNames)
      .def_property_readonly("parameters", &Interpolator::getParameters)
      .def_property_readonly("variograms", &Interpolator::getVariograms)
      .def_property_readonly("report", &Interpolator::getReport);
  module.def("bounds", &findBounds);
  module.def("line", [](const Place& from, const Place& to, std::size_t count) {
    return describe(detail::makeLine(from, to, count));
  });
  module.def("slice",
             [](const Place& point,
                const Place& normal,
                const Place& low,
                const Place& high,
                const std::array<std::size_t, 2>& counts) {
               return placeSlice(point, normal, {low, high}, counts);
             });
  module.def("cubic_grid", [](const Place& low, const Place& high, std::size_t count) {
    return describe(detail::makeCubicGrid({low, high}, count));
  });
  module.def("grid",
             [](const Place& low,
                const Place& high,
                const std::array<std::size_t, 3>& counts) {
               return describe(detail::makeGrid({low, high}, counts));
             });
}

} // namespace pcl_uvol::python
