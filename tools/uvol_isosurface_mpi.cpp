// SPDX-License-Identifier: BSD-3-Clause
// The main job by many processes: each reads a part of the samples, and writes a part
// of the isosurface.
#include "distributed/merge_reports.h"
#include "distributed/periodic_ranks.h"
#include "io/rank_files.h"
#include "shared/isosurface_options.h"
#include "shared/periodic_option.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/sampling_fact.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/mpi/mpi_communicator.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <vtkMPIController.h>
#include <vtkNew.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

namespace {

using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using uvol_tools::joined;
using uvol_tools::Options;
using uvol_tools::UsageError;

constexpr const char* tool = "uvol_isosurface_mpi";

struct Arguments : uvol_tools::IsosurfaceOptions {
  std::vector<std::string> inputs;
  std::string output;
  uvol_tools::PeriodicOption periodic;
  bool progress = false, ascii = false;

  bool
  inPieces() const
  {
    return std::filesystem::path(output).extension() == ".pvtp";
  }

  unsigned
  threads(const Options& options) const
  {
    return options.given("threads") ? options.threads() : 1;
  }
};

void
declare(Options& options, Arguments& arguments)
{
  options.files("in", arguments.inputs);
  options.file("out", arguments.output);
  arguments.declareSamples(options, false);
  arguments.declareMethod(options);
  options.group("Run");
  options.flag("progress",
               arguments.progress,
               "draw the progress of the first process, whatever its stderr is");
  options.group("Input");
  arguments.periodic.declare(options);
  options.group("Output");
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
}

/** What can be said before any file is read. */
void
finishParameters(const Options& options, Arguments& arguments)
{
  arguments.finish(options);
  if (arguments.parameters.takesAutomaticScale())
    throw UsageError("-scale auto is not offered, as no process sees all samples: give "
                     "three factors.");
  arguments.periodic.check();
  arguments.parameters.normals = pcl_uvol::NormalMethod::Edge;
  if (arguments.inPieces())
    pcl_uvol::checkSavePieces(arguments.output);
  else
    pcl_uvol::checkSavePath(arguments.output);
}

pcl_uvol::Dataset
load(Arguments& arguments,
     unsigned threads,
     pcl_uvol::Communicator& communicator,
     Report& report)
{
  const pcl_uvol::DerivedFieldOptions options{
      threads,
      "from the part of the samples that a process holds: use uvol_isosurface"};
  const StepTimer timer(report, "read");
  pcl_uvol::Dataset part = pcl_uvol::loadPart(pcl_uvol::findPieces(arguments.inputs),
                                              arguments.makeLoadOptions(),
                                              communicator);
  report.warnings = part.notes;
  report.count("points", part.cloud.width);
  if (!arguments.getWhere().empty())
    report.count("removed_by_where",
                 pcl_uvol::selectRows(part, arguments.getWhere(), options, report));
  std::vector<std::uint64_t> left{part.cloud.width};
  communicator.allReduce(left);
  if (left[0] == 0)
    throw pcl_uvol::InvalidArgument(
        "no_points_where",
        {{"path", joined(arguments.inputs)}, {"where", arguments.getWhere()}});
  const auto sides = arguments.periodic.findSides(part);
  arguments.parameters.periodic = Eigen::Array3d(sides.data());
  std::string& field = arguments.parameters.isosurface.field;
  if (!field.empty())
    field = pcl_uvol::addDerivedField(part, field, options, report);
  return part;
}

void
save(const Arguments& arguments,
     const std::string& field,
     const pcl_uvol::Dataset& output,
     pcl_uvol::Communicator& communicator,
     Report& report)
{
  const StepTimer timer(report, "write");
  if (arguments.inPieces())
    return pcl_uvol::savePieces(arguments.output, output, communicator);
  if (communicator.rank() == 0) {
    pcl_uvol::SaveOptions options;
    options.ascii = arguments.ascii;
    options.comments = {"isosurface of " + field + " at " +
                        joined(arguments.parameters.isosurface.isovalues)};
    pcl_uvol::saveDataset(arguments.output, output, options);
    uvol_tools::warnOfLosses(arguments.output, output, report);
  }
  communicator.barrier();
}

/** Isopoints of each isovalue, of all processes. */
uvol_tools::Fact
countIsopoints(const pcl_uvol::IsosurfaceResult& result,
               pcl_uvol::Communicator& communicator)
{
  std::vector<std::uint64_t> counts(result.isopoints.begin(), result.isopoints.end());
  communicator.allReduce(counts);
  return {"isopoints per isovalue", uvol_tools::toNumbers(counts)};
}

/** \return what there is to tell of the samples and of the surface */
uvol_tools::Facts
extract(Arguments& arguments,
        unsigned threads,
        pcl_uvol::Communicator& communicator,
        Report& report)
{
  const StepTimer timer(report, "total");
  const auto part = std::make_shared<pcl_uvol::Dataset>(
      load(arguments, threads, communicator, report));
  if (!arguments.inPieces())
    pcl_uvol::checkSavePath(arguments.output, part->cloud.fields);
  pcl_uvol::DistributedIsosurfacePipeline pipeline(communicator);
  pipeline.setInput(part);
  pipeline.setParameters(arguments.parameters);
  pipeline.setGathered(!arguments.inPieces());
  pipeline.setNumberOfThreads(threads);
  pipeline.setProgressCallback(report.progress);
  const pcl_uvol::IsosurfaceResult result = pipeline.run();
  report.merge(result.report);
  save(arguments, result.field, result.surface, communicator, report);
  uvol_tools::Facts facts{{"field", result.field}};
  if (result.box)
    facts.push_back(uvol_tools::describeBox(*result.box));
  const auto& isovalues = arguments.parameters.isosurface.isovalues;
  facts.emplace_back("isovalues", joined(isovalues), isovalues);
  facts.push_back(countIsopoints(result, communicator));
  facts.push_back(uvol_tools::describeSampling(*result.sampling));
  return facts;
}

int
run(int argc, char** argv, pcl_uvol::Communicator& communicator)
{
  Arguments arguments;
  Options options(
      tool,
      "in.pvtp|in.vtp...|in.pcd out.pvtp -iso v[,v...] [options]",
      "Extract the isosurface of scattered samples by many processes. The isopoints "
      "are those of\n"
      "uvol_isosurface. For example: mpirun -np 8 uvol_isosurface_mpi in.pcd "
      "out.pvtp -iso 0.5.\n"
      "Input: one file (pcd ply csv txt), a pvtp, or several files; each process "
      "reads a part.\n"
      "Output: a pvtp with a vtp of each process, or pcd ply vtp csv by the first "
      "process.\n"
      "Normals: from the fits, else along the edges. Threads: 1 per process "
      "(-threads).");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  finishParameters(options, arguments);
  if (arguments.inPieces())
    uvol_tools::checkDistinct(
        pcl_uvol::findPieces(arguments.inputs),
        pcl_uvol::listPieces(arguments.output, communicator.size()));

  Report report;
  std::optional<uvol_tools::ProgressBar> bar;
  if (communicator.rank() == 0)
    report.progress = std::ref(bar.emplace(arguments.progress));
  const uvol_tools::Facts of_samples =
      extract(arguments, arguments.threads(options), communicator, report);
  bar.reset();
  Report together =
      mergeReports(report,
                   communicator,
                   {"bytes_redistributed", "bytes_exchanged", "bytes_of_fields"});
  uvol_tools::Facts facts{{"input", joined(arguments.inputs)},
                          {"output", arguments.output},
                          {"processes", static_cast<double>(communicator.size())}};
  uvol_tools::append(facts, of_samples);
  facts.insert(
      facts.end(),
      {{"scale", uvol_tools::toNumbers(arguments.parameters.isosurface.scale)},
       {"interpolation", toWord(arguments.parameters.isosurface.interpolation)}});
  if (communicator.rank() == 0)
    uvol_tools::printReport(
        options, together, facts, true); // mpirun's pipes look like terminals
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  const vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  int exit_code = 0;
  {
    pcl_uvol::MpiCommunicator communicator(*controller);
    // Only the first process has anything to say, if all goes well.
    std::ostringstream silence;
    std::streambuf* const out = std::cout.rdbuf();
    if (communicator.rank() != 0)
      std::cout.rdbuf(silence.rdbuf());
    const uvol_tools::Outcome outcome =
        uvol_tools::catchErrors(tool, [&] { return run(argc, argv, communicator); });
    std::cout.rdbuf(out);
    const std::size_t failed = communicator.agree(outcome.exit_code != 0);
    if (failed == communicator.rank())
      uvol_tools::printError(tool, outcome);
    exit_code = failed == communicator.size() ? 0 : std::max(outcome.exit_code, 1);
  }
  controller->Finalize();
  return exit_code;
}
