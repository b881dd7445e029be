// SPDX-License-Identifier: BSD-3-Clause
#include "shared/density_options.h"

#include "common/scalar_field.h"
#include "interpolation/sph_density.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace uvol_tools {

void
DensityOptions::declare(Options& options)
{
  options
      .flag("density",
            is_asked_for_,
            "add the field sph_density, of particles with a mass and a smoothing "
            "length (fields with usual names; else all masses are 1, and lengths by "
            "48 neighbours)")
      .rare();
  options
      .number("density-length",
              length_,
              std::numeric_limits<double>::min(),
              std::numeric_limits<double>::max(),
              "one smoothing length h for -density, whose kernel ends at 2 h")
      .rare();
}

double
DensityOptions::findBytes(double points) const
{
  // Samples with their tree, kernels, masses twice, densities.
  constexpr double sums = 36.0 + 40.0 + 3 * 8.0 + 24.0;
  return isAskedFor() ? sums * points : 0.0;
}

double
DensityOptions::findReach(const pcl_uvol::Dataset& dataset) const
{
  constexpr double kernel_end = 2.0; // of the cubic spline, in smoothing lengths
  if (length_ > 0.0)
    return kernel_end * length_;
  const std::string name = pcl_uvol::findSphFields(dataset.cloud.fields).length_field;
  if (name.empty())
    return 0.0;
  const pcl_uvol::ScalarField field(dataset.cloud.fields, name);
  double longest = 0.0;
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    longest = std::fmax(longest,
                        field.read(&dataset.cloud.data[i * dataset.cloud.point_step]));
  return std::isfinite(longest) ? kernel_end * pcl_uvol::lengthFactorOf(name) * longest
                                : 0.0;
}

void
DensityOptions::addField(pcl_uvol::Dataset& dataset,
                         unsigned threads,
                         pcl_uvol::Report& report,
                         const std::array<double, 3>& periodic) const
{
  if (length_ > 0.0 && !is_asked_for_)
    throw UsageError("-density-length requires -density.");
  if (!is_asked_for_)
    return;
  if (pcl_uvol::findField(dataset.cloud.fields, "sph_density") != nullptr)
    throw pcl_uvol::InvalidArgument("There is a field sph_density already.");
  const pcl_uvol::StepTimer timer(report, "density");
  if (!pcl_uvol::isPeriodic(periodic))
    return computeField(dataset, threads, report);
  pcl_uvol::Report own; // whoever uses the box tells of it
  own.progress = report.progress;
  pcl_uvol::PeriodicReach reach;
  reach.least = findReach(dataset);
  auto images = pcl_uvol::addPeriodicImages(
      dataset,
      pcl_uvol::cutAtWidestGap(
          dataset, pcl_uvol::findPeriodicBox(dataset, periodic, own), threads),
      reach,
      threads,
      own);
  computeField(images.samples, threads, report);
  dataset = pcl_uvol::dropPeriodicImages(std::move(images), dataset);
}

void
DensityOptions::computeField(pcl_uvol::Dataset& dataset,
                             unsigned threads,
                             pcl_uvol::Report& report) const
{
  const auto fields = pcl_uvol::findSphFields(dataset.cloud.fields);
  pcl_uvol::Report own; // the samples are counted by whoever uses them
  own.progress = report.progress;
  const auto densities = pcl_uvol::computeSphDensity(
      pcl_uvol::viewOf(dataset.cloud),
      fields,
      {length_, pcl_uvol::lengthFactorOf(fields.length_field)},
      threads,
      own);
  pcl_uvol::setField(dataset, "sph_density", densities);
  if (fields.mass_field.empty())
    report.warn("no_masses");
}

} // namespace uvol_tools
