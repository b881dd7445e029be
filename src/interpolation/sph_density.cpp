// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/sph_density.h"

#include "common/scalar_field.h"
#include "interpolation/kernel_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {
namespace {

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

} // namespace pcl_uvol
