// SPDX-License-Identifier: BSD-3-Clause
// The pipeline from samples to an isosurface, which keeps its tree.
#include "core/bindings.h"
#include "pipeline/gap_filling.h"
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <memory>
#include <mutex>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

py::dict
describe(const LevelSetSummary& summary)
{
  py::dict dict;
  dict["spacing"] = summary.spacing;
  dict["noise"] = summary.noise;
  dict["logarithmic"] = summary.logarithmic;
  dict["mu"] = summary.mu;
  dict["smoothed"] = summary.smoothed;
  dict["converged"] = summary.converged;
  dict["steps"] = summary.steps.size();
  return dict;
}

py::dict
describe(const SurfacePiece& piece)
{
  py::dict dict;
  dict["isovalue"] = piece.isovalue;
  dict["vertices"] = piece.vertices;
  dict["triangles"] = piece.triangles;
  dict["rims"] = piece.rims;
  dict["genus"] = piece.genus;
  return dict;
}

py::dict
describe(const ValidationScore& score)
{
  py::dict dict;
  dict["tested"] = score.tested;
  dict["near"] = score.covered;
  dict["side"] = score.side.predicted;
  dict["side_of_nearest"] = score.side.nearest;
  dict["side_base"] = score.side.base;
  dict["side_error"] = score.side_error;
  dict["side_of_field"] = score.side_of_field;
  dict["side_everywhere"] = score.side_everywhere;
  dict["class"] = score.field.predicted;
  dict["class_of_nearest"] = score.field.nearest;
  dict["class_base"] = score.field.base;
  dict["beyond_error"] = score.beyond_error;
  dict["side_beyond_error"] = score.side_beyond_error;
  return dict;
}

template <typename Items>
py::list
toList(const Items& items)
{
  py::list list;
  for (const auto& item : items)
    list.append(describe(item));
  return list;
}

/** What is told of a surface besides its points. */
py::dict
describe(const IsosurfaceResult& result)
{
  py::dict report = toDict(result.report);
  report["field"] = toText(result.field);
  report["isopoints"] = result.isopoints;
  report["scale"] = std::vector<float>(result.scale.data(), result.scale.data() + 3);
  if (result.scale_choice) {
    py::dict choice;
    choice["error_ratio"] = result.scale_choice->error_ratio;
    choice["tested"] = result.scale_choice->tested;
    choice["explained"] = result.scale_choice->explained;
    choice["explained_before"] = result.scale_choice->explained_before;
    report["scale_choice"] = choice;
  }
  report["level_sets"] = toList(result.level_sets);
  report["validation"] = toList(result.validation);
  if (result.errors) {
    py::dict errors;
    errors["median"] = result.errors->median;
    errors["percentile_95"] = result.errors->percentile_95;
    errors["largest"] = result.errors->largest;
    report["error"] = errors;
  }
  if (result.sampling) {
    py::dict sampling;
    sampling["shares"] = result.sampling->shares;
    sampling["along"] = result.sampling->along;
    sampling["across"] = result.sampling->across;
    report["sampling"] = sampling;
  }
  if (result.gaps) {
    py::dict gaps;
    gaps["predicted"] = result.gaps->predicted;
    gaps["unfilled"] = result.gaps->unfilled;
    gaps["width"] = result.gaps->width;
    gaps["spacing"] = result.gaps->spacing;
    gaps["range"] = result.gaps->range;
    gaps["nugget"] = result.gaps->nugget;
    gaps["psill"] = result.gaps->psill;
    report["gaps"] = gaps;
  }
  if (!result.pieces.empty()) {
    report["pieces"] = toList(result.pieces);
    report["smallest_angle"] = result.smallest_angle;
  }
  return report;
}

/** A pipeline for one caller at a time. */
class Extractor {
public:
  /** \param parameters JSON of IsosurfacePipelineParameters
   * \return points, triangles and report, in it "parameters" as JSON */
  py::tuple
  extract(const DatasetPtr& samples,
          const std::string& parameters,
          unsigned threads,
          const py::object& progress)
  {
    IsosurfaceResult result;
    auto taken = IsosurfacePipelineParameters::fromJson(parameters);
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      const std::lock_guard<std::mutex> lock(mutex_);
      result = run(samples, taken, threads, callback);
    });
    py::dict report = describe(result);
    report["isovalues"] = taken.isosurface.isovalues;
    taken.isosurface.field = result.field;
    report["parameters"] = toText(taken.toJson());
    return py::make_tuple(share(std::move(result.surface)),
                          toIndices(std::move(result.triangles)),
                          report);
  }

private:
  IsosurfaceResult
  run(const DatasetPtr& samples,
      const IsosurfacePipelineParameters& parameters,
      unsigned threads,
      const ProgressCallback& progress)
  {
    if (samples != samples_)
      pipeline_.setInput(samples);
    samples_ = samples;
    pipeline_.setParameters(parameters);
    pipeline_.setNumberOfThreads(threads);
    pipeline_.setProgressCallback(progress);
    checkParameters(pipeline_.getParameters());
    return pipeline_.run();
  }

  std::mutex mutex_;
  std::shared_ptr<const Dataset> samples_;
  IsosurfacePipeline pipeline_;
};

} // namespace

void
bindIsosurface(py::module_& module)
{
  py::class_<Extractor>(module, "Extractor")
      .def(py::init<>())
      .def("extract", &Extractor::extract)
      .def_property_readonly_static("default_parameters", [](const py::object&) {
        return toText(IsosurfacePipelineParameters().toJson());
      });
}

} // namespace pcl_uvol::python
