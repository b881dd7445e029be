// SPDX-License-Identifier: BSD-3-Clause
#include "shared/density_options.h"

#include "interpolation/sph_density.h"

#include <limits>

namespace uvol_tools {

void
DensityOptions::declare(Options& options)
{
  options
      .flag("density",
            is_asked_for_,
            "add the field sph_density, by SPH interpolation from masses and smoothing "
            "lengths (fields with usual names; default: equal masses, lengths from 48 "
            "neighbours)")
      .rare();
  options
      .number("density-length",
              length_,
              std::numeric_limits<double>::min(),
              std::numeric_limits<double>::max(),
              "one smoothing length h for -density, whose kernel ends at 2 h")
      .rare();
}

void
DensityOptions::addField(pcl_uvol::Dataset& dataset,
                         unsigned threads,
                         pcl_uvol::Report& report,
                         const std::array<double, 3>& periodic) const
{
  if (length_ > 0.0 && !is_asked_for_)
    throw UsageError("-density-length requires -density.");
  if (is_asked_for_)
    pcl_uvol::addSphDensity(dataset, length_, threads, report, periodic);
}

} // namespace uvol_tools
