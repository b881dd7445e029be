// SPDX-License-Identifier: BSD-3-Clause
// Level sets, and what is made of points on a surface.
#include "common/parameter_description.h"
#include "common/records.h"
#include "core/bindings.h"
#include "core/run_stage.h"
#include "pipeline/level_set_job.h"
#include "render/gaussian_splats.h"
#include "surface/dataset_normals.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <array>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

py::list
describeSteps(const std::vector<LevelSetStep>& steps)
{
  py::list list;
  for (const LevelSetStep& step : steps) {
    py::dict dict;
    forEachMember<LevelSetStep>(
        [&](const char* name, auto pointer) { dict[name] = step.*pointer; });
    list.append(dict);
  }
  return list;
}

/** \param snapshots steps between two of them; 0: there are none
 * \param sides of the box that the samples repeat in, or 0
 * \return the samples with phi, steps and surface of each snapshot, and the report */
py::tuple
evolveLevelSet(const DatasetPtr& dataset,
               std::size_t snapshots,
               const std::array<double, 3>& sides,
               bool automatic_scale,
               const std::string& parameters,
               unsigned threads,
               const py::object& progress)
{
  const LevelSetRequest request{
      LevelSetParameters::fromJson(parameters), sides, automatic_scale, snapshots};
  SmoothedSamples smoothed;
  std::vector<std::pair<std::size_t, Dataset>> surfaces;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    smoothed = runLevelSet(
        dataset,
        nullptr,
        request,
        [&](auto steps, auto surface) {
          surfaces.emplace_back(steps, std::move(surface));
        },
        threads,
        callback);
  });
  py::dict report = toDict(smoothed.report);
  report["parameters"] = toText(smoothed.taken.toJson());
  const LevelSetSummary& summary = smoothed.summary;
  report["field"] = toText(smoothed.taken.field);
  report["spacing"] = summary.spacing;
  report["noise"] = summary.noise;
  report["logarithmic"] = summary.logarithmic;
  report["mu"] = summary.mu;
  report["smoothed"] = summary.smoothed;
  report["converged"] = summary.converged;
  report["steps"] = describeSteps(summary.steps);
  py::list found;
  for (auto& [steps, surface] : surfaces)
    found.append(py::make_tuple(steps, share(std::move(surface))));
  return py::make_tuple(share(std::move(smoothed.samples)), found, report);
}

py::tuple
estimateNormals(const DatasetPtr& dataset,
                const std::string& parameters,
                unsigned threads,
                const py::object& progress)
{
  const auto taken = SurfaceNormalParameters::fromJson(parameters);
  Report report;
  Dataset result;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    report.progress = callback;
    result = pcl_uvol::estimateNormals(*dataset, taken, threads, report);
  });
  py::dict entries = toDict(report);
  entries["parameters"] = toText(taken.toJson());
  return py::make_tuple(share(std::move(result)), entries);
}

py::tuple
generateSplats(const DatasetPtr& dataset,
               const std::string& parameters,
               unsigned threads,
               const py::object& progress)
{
  SplatGeneration<Cloud> generation;
  Cloud cloud;
  const py::dict report =
      runStage(generation, dataset, parameters, threads, progress, [&] {
        pcl::PointCloud<PointSplat> splats;
        generation.compute(splats);
        pcl::toPCLPointCloud2(splats, cloud);
        copyFields(dataset->cloud, generation.getSources(), cloud, threads);
      });
  return py::make_tuple(withCloud(*dataset, std::move(cloud)), report);
}

/** Splats as viewers of 3D Gaussian splats read them, and warnings. */
py::tuple
describeGaussians(const Dataset& splats, const std::string& color)
{
  const CloudView view = viewOf(splats.cloud);
  const std::string field = resolveColor(view, color);
  Report report;
  const auto gaussians = std::make_shared<Dataset>(
      makeGaussians(splats, field, usualColorMapping(view, field), report));
  return py::make_tuple(gaussians, toDicts(report.warnings));
}

} // namespace

void
bindSurfaceStages(py::module_& module)
{
  module.def("describe_level_set", &writeDescription<LevelSetParameters>);
  module.def("describe_normals", &writeDescription<SurfaceNormalParameters>);
  module.def("evolve_level_set", &evolveLevelSet);
  module.def("estimate_normals", &estimateNormals);
  module.def("make_gaussians", &describeGaussians);
  module.def("generate_splats", &generateSplats);
}

} // namespace pcl_uvol::python
