// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_isosurface/pipeline_options.h"

#include "expressions/formula.h"
#include "shared/level_set.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <filesystem>
#include <string>
#include <vector>

namespace uvol_tools {

using pcl_uvol::NeighborSource;

namespace {

bool
isTurned(const pcl_uvol::IsosurfacePipelineParameters& parameters)
{
  return (parameters.rotation != 0.0).any();
}

} // namespace

void
PipelineOptions::declare(Options& options)
{
  options.file("in", input);
  options.file("out", output);
  declareSamples(options);
  options
      .choice("neighbors",
              parameters.isosurface.neighbors,
              "candidates from touching cells of the tree, from adjacent regions of a "
              "discrete Voronoi diagram (slower), or from exact Voronoi cells (much "
              "slower)")
      .rare();
  options
      .integer("grid",
               grid_,
               1,
               pcl_uvol::GridShape::largest_side,
               "cells of -neighbors voronoi along the longest side (default: 4 samples "
               "per cell)")
      .rare();
  declareMethod(options);
  options.flag("smooth",
               parameters.smooth,
               "smooth noisy or uneven samples by a level set first");
  for (const char* const name : {"mu", "max_steps"})
    options.members(parameters.level_set, {name}, "with -smooth: ").rare();
  options
      .choice("normals",
              parameters.normals,
              "normals from the fits, from principal components of the isopoints, or "
              "along the edges where no fit exists; auto: chosen from the sampling, "
              "pca with linear interpolation")
      .rare();
  options.integer("k", k_, 2, 1000, "number of isopoints for a normal by pca").rare();
  options
      .text("max-error",
            "v|auto",
            max_error_,
            "remove isopoints with a larger estimated error, in units of length; auto: "
            "larger than half the distance between the two samples of the isopoint")
      .rare();
  options.flag("drop-bridged",
               parameters.drop_bridged,
               "remove isopoints in gaps of the sampling");
  options
      .flag("fill-gaps",
            parameters.fill_gaps,
            "fill gaps between lines or sheets of samples by kriging, up to the "
            "variogram range and half a gap beyond the convex hull (-scale is auto "
            "unless given)")
      .rare();
  options.integer(
      "validate",
      parameters.validation.folds,
      2,
      1000,
      "n-fold cross-validation: report how many held-out samples the surface "
      "classifies correctly (n + 1 times the run time)");
  options
      .text("validate-by",
            "random|blocks|FIELD",
            validate_by_,
            "with -validate, samples held out together: random ones, compact blocks, "
            "or those with the same value of a field, such as a dive (default random)")
      .rare();
  options.group("Run");
  options
      .text("max-memory",
            "bytes",
            max_memory_,
            "memory limit, such as 1500M or 2G: samples are kept on disk; for pcd, "
            "ply and text that are not compressed")
      .rare();
  options
      .text("scratch",
            "folder",
            scratch_,
            "with -max-memory: folder of the samples on disk, 24 bytes each (default: "
            "the folder of the output)")
      .rare();
  options.group("Input");
  density.declare(options);
  periodic.declare(options);
  options
      .number("outside-value",
              outside_value_,
              std::numeric_limits<double>::lowest(),
              std::numeric_limits<double>::max(),
              "add samples of that value one spacing outside the data, where the field "
              "ends; isopoints are then on their edges, as with -interpolation linear "
              "(default: none)")
      .rare();
  mesh_.declare(options);
  options.group("Output");
  options.flag("ascii", ascii, "write PCD and PLY as text");
  picture.declare(options);
}

std::vector<std::string>
PipelineOptions::listNeedingAllSamples() const
{
  std::vector<std::string> names;
  const auto add = [&](bool is_given, const char* name) {
    if (is_given)
      names.push_back(name);
  };
  add(density.isAskedFor(), "-density");
  add(parameters.outside_value.has_value(), "-outside-value");
  add(periodic.isAskedFor(), "-periodic");
  add(parameters.smooth, "-smooth");
  add(!getWhere().empty(), "-where");
  // -fill-gaps may imply it, but is named itself.
  add(parameters.automatic_scale.value_or(false), "-scale auto");
  add(getScale().isFromSpacing(), "-scale spacing");
  add(isTurned(parameters), "-rotate or a matrix of -scale");
  add(parameters.validation.folds > 0, "-validate");
  add(parameters.fill_gaps, "-fill-gaps");
  add(parameters.mesh.has_value(), "-mesh");
  add(mesh_.isMeasured(), "-measure");
  add(parameters.isosurface.neighbors == NeighborSource::Voronoi, "-neighbors voronoi");
  add(parameters.isosurface.neighbors == NeighborSource::Exact, "-neighbors exact");
  add(pcl_uvol::mayHaveDerivative(parameters.isosurface.field),
      "derivatives in -field");
  add(picture.hasColorOfSamples(), "derivatives in -color");
  return names;
}

bool
PipelineOptions::needsAllSamples() const
{
  return !listNeedingAllSamples().empty();
}

void
PipelineOptions::checkCombinations(const Options& options) const
{
  if (options.given("grid") &&
      parameters.isosurface.neighbors != NeighborSource::Voronoi)
    throw UsageError("-grid needs -neighbors voronoi.");
  for (const char* const name : {"mu", "steps"})
    if (options.given(name) && !parameters.smooth)
      throw UsageError(std::string("-") + name + " needs -smooth.");
  if (options.given("validate-by") && !options.given("validate"))
    throw UsageError("-validate-by needs -validate.");
  if (options.given("periodic-mesh") && !periodic.isAskedFor())
    throw UsageError("-periodic-mesh needs -periodic.");
  if (options.given("scratch") && !options.given("max-memory"))
    throw UsageError("-scratch needs -max-memory.");
  if (options.given("max-memory") && needsAllSamples()) {
    std::string names;
    for (const std::string& name : listNeedingAllSamples())
      names += (names.empty() ? "" : ", ") + name;
    throw UsageError("-max-memory cannot be combined with " + names +
                     ": all samples must be in memory.");
  }
  try {
    checkParameters(parameters);
  }
  catch (const pcl_uvol::InvalidArgument& error) {
    throw UsageError(error.asMessage().text(pcl_uvol::ParameterNames::Options));
  }
}

void
PipelineOptions::finish(const Options& options)
{
  IsosurfaceOptions::finish(options);
  parameters.isosurface.voronoi_cells = static_cast<std::uint32_t>(grid_);
  parameters.normal_neighbors = k_;
  if (options.given("max-error")) {
    parameters.max_error = parseAutomatic(
        "max-error", max_error_, 0.0, std::numeric_limits<double>::infinity());
    parameters.automatic_max_error = !parameters.max_error;
  }
  parameters.validation.by = validate_by_ == "random"   ? pcl_uvol::ValidateBy::Random
                             : validate_by_ == "blocks" ? pcl_uvol::ValidateBy::Blocks
                                                        : pcl_uvol::ValidateBy::Field;
  if (parameters.validation.by == pcl_uvol::ValidateBy::Field)
    parameters.validation.field = validate_by_;
  if (options.given("outside-value"))
    parameters.outside_value = outside_value_;
  parameters.mesh = mesh_.finish(options, output);
  parameters.periodic_mesh = mesh_.getPeriodicMesh();
  parameters.periodic = Eigen::Array3d(periodic.check(isTurned(parameters)).data());
  checkCombinations(options);
  if (!parameters.mesh)
    pcl_uvol::checkSavePath(output);
  picture.check(options);
}

pcl_uvol::OutOfCoreSettings
PipelineOptions::makeOutOfCoreSettings(const Options& options) const
{
  pcl_uvol::OutOfCoreSettings settings;
  settings.max_memory = parseBytes("max-memory", max_memory_);
  settings.scratch_folder =
      scratch_.empty() ? std::filesystem::absolute(output).parent_path().string()
                       : scratch_;
  settings.threads = options.threads();
  return settings;
}

} // namespace uvol_tools
