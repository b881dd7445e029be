// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/sph_density.h"

#include "common/memory.h"
#include "common/scalar_field.h"
#include "interpolation/kernel_sums.h"
#include "interpolation/memory_need.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol {
namespace {

constexpr const char* density_name = "sph_density";
constexpr const char* mass_names[] = {
    "MASS", "Masses", "Mass", "mass", "masses", "m", "mass_g", "mass_kg"};
constexpr const char* length_names[] = {"HSML",
                                        "SmoothingLength",
                                        "SmoothingLengths",
                                        "hsml",
                                        "h",
                                        "h_cm",
                                        "smoothing_length"};

template <std::size_t N>
std::string
findAny(const std::vector<pcl::PCLPointField>& fields, const char* const (&names)[N])
{
  for (const char* const name : names)
    if (const auto* const field = findField(fields, name); field && field->count <= 1)
      return name;
  return "";
}

/** The mass of a particle counts as KernelSums takes it. */
double
massOf(const ScalarField& field, const std::uint8_t* point)
{
  const double mass = field.read(point);
  return std::isfinite(mass) && mass > 0.0 ? mass : 1.0;
}

/** How far the kernels of particles reach, where a length for all or a field tells; 0:
 * not known. */
double
findKernelReach(const Dataset& dataset, double length)
{
  constexpr double kernel_end = 2.0; // of the cubic spline, in smoothing lengths
  if (length > 0.0)
    return kernel_end * length;
  const std::string name = findSphFields(dataset.cloud.fields).length_field;
  if (name.empty())
    return 0.0;
  const ScalarField field(dataset.cloud.fields, name);
  double longest = 0.0;
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    longest = std::fmax(longest,
                        field.read(&dataset.cloud.data[i * dataset.cloud.point_step]));
  return std::isfinite(longest) ? kernel_end * lengthFactorOf(name) * longest : 0.0;
}

void
setSphDensity(Dataset& dataset, double length, unsigned threads, Report& report)
{
  const SphParameters fields = findSphFields(dataset.cloud.fields);
  setField(dataset,
           density_name,
           computeSphDensity(viewOf(dataset.cloud),
                             fields,
                             {length, lengthFactorOf(fields.length_field)},
                             threads,
                             report));
}

} // namespace

SphParameters
findSphFields(const std::vector<pcl::PCLPointField>& fields)
{
  SphParameters parameters;
  parameters.mass_field = findAny(fields, mass_names);
  parameters.length_field = findAny(fields, length_names);
  return parameters;
}

double
lengthFactorOf(const std::string& field)
{
  if (field == "HSML" || field == "hsml" || field == "SmoothingLength")
    return 0.5;
  return field == "SmoothingLengths" ? 0.5 * 1.825742 : 1.0;
}

std::vector<double>
computeSphDensity(const CloudView& cloud,
                  const SphParameters& parameters,
                  const SphLengths& lengths,
                  unsigned threads,
                  Report& report)
{
  checkMemoryOf(
      "A density", cloud.count, sphDensityBytes(static_cast<double>(cloud.count)));
  std::vector<std::uint32_t> use(cloud.count);
  std::iota(use.begin(), use.end(), 0u);
  detail::SampledFields sampled;
  sampled.samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), use, Position{{1.0f, 1.0f, 1.0f}}, threads, report);
  const SampleSet& samples = *sampled.samples;
  const auto factor = static_cast<double>(samples.getUnit().factor);
  SphParameters own = parameters;
  own.density_field.clear();
  detail::Particles particles = detail::readParticles(cloud, samples, own);
  for (double& length : particles.lengths)
    length *= lengths.factor;
  if (lengths.constant > 0.0)
    particles.lengths.assign(samples.size(), lengths.constant * factor);
  if (particles.masses.empty())
    particles.masses.assign(samples.size(), 1.0);
  for (double& mass : particles.masses)
    mass = std::isfinite(mass) && mass > 0.0 ? mass : 1.0;
  for (const SampleSet::Merged& merged : samples.getMerged()) {
    double& mass = particles.masses[merged.sample];
    mass = 0.0;
    for (const auto member : merged.members)
      mass += own.mass_field.empty()
                  ? 1.0
                  : massOf(ScalarField(cloud.fields, own.mass_field),
                           cloud.point(static_cast<std::size_t>(member)));
  }
  const std::vector<double> masses = particles.masses;
  const detail::KernelSums sums(sampled, own, std::move(particles), threads, report);
  const double volume = factor * factor * factor; // of the input's unit
  std::vector<double> densities(cloud.count, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < samples.size(); ++i)
    densities[samples.getInputIndex(i)] = masses[i] / sums.getVolumes()[i] * volume;
  for (const SampleSet::Merged& merged : samples.getMerged())
    for (const auto member : merged.members)
      densities[static_cast<std::size_t>(member)] =
          densities[samples.getInputIndex(merged.sample)];
  return densities;
}

void
addSphDensity(Dataset& dataset,
              double length,
              unsigned threads,
              Report& report,
              const std::array<double, 3>& sides)
{
  if (!std::isfinite(length) || length < 0.0)
    throw InvalidArgument("bad_smoothing_length", {});
  if (findField(dataset.cloud.fields, density_name) != nullptr)
    throw InvalidArgument("field_exists", {{"field", density_name}});
  const StepTimer timer(report, "density");
  const bool has_masses = !findSphFields(dataset.cloud.fields).mass_field.empty();
  Report own; // whoever uses the samples counts them, and tells of the box
  own.progress = report.progress;
  if (isPeriodic(sides)) {
    PeriodicReach reach;
    reach.least = findKernelReach(dataset, length);
    PeriodicSamples images = addPeriodicImages(
        dataset,
        cutAtWidestGap(dataset, findPeriodicBox(dataset, sides, own), threads),
        reach,
        threads,
        own);
    setSphDensity(images.samples, length, threads, own);
    dataset = dropPeriodicImages(std::move(images), dataset);
  }
  else
    setSphDensity(dataset, length, threads, own);
  if (!has_masses)
    report.warn("no_masses");
}

} // namespace pcl_uvol
