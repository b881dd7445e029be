// SPDX-License-Identifier: BSD-3-Clause
#include "shared/isosurface_options.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

void
IsosurfaceOptions::declareSamples(Options& options,
                                  bool automatic,
                                  const std::string& need)
{
  options.group("Input");
  declareField(options, parameters.isosurface.field);
  scale_.declare(
      options, "distances", automatic ? AutomaticScale::Field : AutomaticScale::None);
  input_files_.declare(options);
  options.group("Surface");
  options.numbers("iso",
                  "v,...",
                  0,
                  parameters.isosurface.isovalues,
                  "isovalues (" + need +
                      "), or ranges: 0.1:0.1:0.6 in steps of 0.1, "
                      "0.01:1:5log five values with equal ratios");
  options.choice("outside",
                 parameters.isosurface.outside,
                 "side that normals point to: lower or higher values");
}

void
IsosurfaceOptions::declareMethod(Options& options)
{
  options.group("Surface");
  options
      .choice(
          "criterion",
          parameters.isosurface.criterion,
          "angle criterion against kept, against all or against no closer candidates")
      .rare();
  options
      .choice("interpolation",
              parameters.isosurface.interpolation,
              "isopoints on local polynomial fits, or along the edges; auto: along the "
              "edges where the samples contradict the fit")
      .rare();
}

void
IsosurfaceOptions::finish(const Options& options)
{
  if (parameters.isosurface.isovalues.empty())
    throw UsageError(
        "-iso is missing: give one isovalue or several, as in -iso 0.3,0.6.");
  scale_.finish(options);
  if (scale_.isGiven())
    parameters.automatic_scale = scale_.isFromField();
  parameters.isosurface.scale = scale_.getStretch().scale;
  parameters.rotation = scale_.getStretch().rotation;
}

void
IsosurfaceOptions::resolveSpacing(const pcl_uvol::Dataset& samples)
{
  parameters.isosurface.scale =
      scale_.findStretch(pcl_uvol::viewOf(samples.cloud)).scale;
}

pcl_uvol::LoadOptions
IsosurfaceOptions::makeLoadOptions() const
{
  return input_files_.makeLoadOptions();
}

} // namespace uvol_tools
