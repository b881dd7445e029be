// SPDX-License-Identifier: BSD-3-Clause
// The main job: a file of scattered samples in, an oriented isosurface out.
#include "common/memory.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/series.h"
#include "uvol_isosurface/pipeline_run.h"
#include "uvol_isosurface/result_facts.h"
#include <pcl_uvol/io/dataset.h>

#include <memory>
#include <optional>
#include <utility>

namespace {

using pcl_uvol::IsosurfaceResult;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::Facts;
using uvol_tools::joined;
using uvol_tools::Options;
using Arguments = uvol_tools::PipelineOptions;

void
saveMesh(const std::string& path,
         const IsosurfaceResult& result,
         const pcl_uvol::SaveOptions& options,
         Report& report)
{
  const StepTimer timer(report, "write");
  pcl_uvol::saveMesh(path, result.surface, result.triangles, options);
  uvol_tools::warnOfLosses(path, result.surface, report);
}

/** A run on its way to its report. */
struct Job {
  Arguments arguments;
  Options options{
      "uvol_isosurface",
      "in.pcd out.ply -iso v[,v...] [options]",
      "Extract the isosurface of scattered samples as oriented points, or as a "
      "closed triangle mesh (-mesh).\n"
      "Input: pcd ply csv txt vtk vtp vtu vts h5 nc, snapshots of Gadget and others "
      "(uvol --list-formats).\n"
      "Output: points as pcd ply vtp vtkhdf csv, meshes as ply vtp vtkhdf obj off "
      "stl."};
  uvol_tools::ProgressBar bar;
  Report report;
  Facts facts;
  std::uint64_t bound = 0; ///< of -max-memory; 0: it is not given

  /** Extract, and write everything but the picture. */
  pcl_uvol::Dataset
  extract()
  {
    const StepTimer total(report, "total");
    Facts figures;
    IsosurfaceResult result = bound > 0
                                  ? runFromDisk(options, arguments, report)
                                  : runInMemory(options, arguments, report, figures);
    report.merge(result.report);
    arguments.picture.addColor(options, result.surface, report);

    const auto& isovalues = arguments.parameters.isosurface.isovalues;
    pcl_uvol::SaveOptions save;
    save.ascii = arguments.ascii;
    save.comments = {"isosurface of " + result.field + " at " + joined(isovalues)};
    if (arguments.parameters.mesh)
      saveMesh(arguments.output, result, save, report);
    else
      uvol_tools::savePoints(arguments.output, result.surface, save, report);
    facts = {{"input", arguments.input}, {"output", arguments.output}};
    append(facts,
           uvol_tools::describeSurface(result,
                                       arguments.parameters,
                                       arguments.getMesh().isMeasured() &&
                                           !result.triangles.empty()));
    append(facts, figures);
    append(facts, uvol_tools::describeModels(result, arguments.parameters));
    arguments.picture.getLook().exaggerate(result.surface);
    return std::move(result.surface);
  }

  void
  draw(const pcl_uvol::Dataset& surface)
  {
    std::optional<pcl_uvol::MemoryLimit> limit;
    if (bound > 0)
      limit.emplace(bound);
    const StepTimer total(report, "total");
    facts.emplace_back("backend", arguments.picture.draw(options, surface, report));
  }

  void
  print()
  {
    facts.push_back(uvol_tools::describeMemory(static_cast<double>(bound)));
    uvol_tools::printReport(options, report, facts);
  }
};

int
run(int argc, char** argv, uvol_tools::SeriesStep* step)
{
  const auto job = std::make_shared<Job>();
  Arguments& arguments = job->arguments;
  arguments.declare(job->options);
  uvol_tools::declareSeries(job->options);
  if (!job->options.parse(argc, argv))
    return 0;
  arguments.finish(job->options);
  if (job->options.given("max-memory"))
    job->bound = arguments.makeOutOfCoreSettings(job->options).max_memory;
  job->report.progress = std::ref(job->bar);
  pcl_uvol::Dataset surface = job->extract();
  const bool is_drawn = arguments.picture.isAskedFor();
  if (is_drawn && step && surface.cloud.width > 0 &&
      arguments.picture.getLook().sharesView()) {
    step->pictures.add(job->options,
                       arguments.picture.getLook(),
                       std::move(surface),
                       [job](const auto& waiting) {
                         job->draw(waiting);
                         job->print();
                       });
    return 0;
  }
  if (is_drawn)
    job->draw(surface);
  job->print();
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_isosurface", argc, argv, run);
}
