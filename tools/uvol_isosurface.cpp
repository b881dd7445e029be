// SPDX-License-Identifier: BSD-3-Clause
// The main job: a file of scattered samples in, an oriented isosurface out.
#include "common/memory.h"
#include "common/numbers.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/series.h"
#include "uvol_isosurface/pipeline_run.h"
#include "uvol_isosurface/result_facts.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/mesh.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

namespace {

using pcl_uvol::IsosurfaceResult;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::joined;
using uvol_tools::Options;
using Arguments = uvol_tools::PipelineOptions;

/** As MemoryGuard::describe() for a run within a bound. */
Fact
describeBound(const Options& options, const Arguments& arguments)
{
  const auto bound =
      static_cast<double>(arguments.makeOutOfCoreSettings(options).max_memory);
  const auto peak = static_cast<double>(pcl_uvol::peakMemory());
  return {"memory",
          "bound " + pcl_uvol::formatBytes(bound) + ", peak " +
              pcl_uvol::formatBytes(peak),
          Fact::Members{{"bound", {bound}}, {"peak", {peak}}}};
}

bool
isStl(const std::string& path)
{
  return pcl_uvol::lowerCase(std::filesystem::path(path).extension().string()) ==
         ".stl";
}

void
saveMesh(const std::string& path,
         const IsosurfaceResult& result,
         const pcl_uvol::SaveOptions& options,
         Report& report)
{
  const StepTimer timer(report, "write");
  const auto& origin = result.surface.origin;
  if (isStl(path) && origin != std::array<double, 3>{})
    report.warnings.push_back(
        "STL holds single precision, which these coordinates exceed: those in the file "
        "are relative to " +
        joined(std::vector<double>(origin.begin(), origin.end())) + ".");
  pcl_uvol::saveMesh(path, result.surface, result.triangles, options);
  uvol_tools::warnOfLabels(path, result.surface, report);
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_isosurface",
      "in.pcd out.ply -iso v[,v...] [options]",
      "Extracts the isosurface of a scalar field given at scattered points, as "
      "an oriented point cloud,\nor with -mesh as a closed triangle mesh.\nReads pcd "
      "ply csv txt vtk vtp vtu vts h5 nc, snapshots of Gadget and others (uvol "
      "--list-formats), writes pcd ply vtp vtkhdf csv, "
      "meshes as ply vtp vtkhdf "
      "obj off stl.");
  arguments.declare(options);
  uvol_tools::declareSeries(options);
  if (!options.parse(argc, argv))
    return 0;
  arguments.finish(options);
  const bool is_bounded = options.given("max-memory");
  uvol_tools::MemoryGuard memory(arguments.needsAllSamples()
                                     ? "An isosurface"
                                     : "Without -max-memory an isosurface");
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  auto total = std::make_unique<StepTimer>(report, "total");
  uvol_tools::Facts figures;
  IsosurfaceResult result =
      is_bounded ? runFromDisk(options, arguments, report)
                 : runInMemory(options, arguments, memory, report, figures);
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
  Facts facts = {{"input", arguments.input}, {"output", arguments.output}};
  const auto append = [&](const Facts& more) {
    facts.insert(facts.end(), more.begin(), more.end());
  };
  append(uvol_tools::describeSurface(result,
                                     arguments.parameters,
                                     arguments.getMesh().isMeasured() &&
                                         !result.triangles.empty()));
  append(figures);
  append(uvol_tools::describeModels(result, arguments.parameters));
  if (arguments.picture.isAskedFor())
    facts.emplace_back("backend",
                       arguments.picture.draw(options, result.surface, report));
  total.reset();
  facts.push_back(is_bounded ? describeBound(options, arguments) : memory.describe());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_isosurface", argc, argv, run);
}
