// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/kernel_sums.h"

#include "common/constants.h"
#include "common/parallel.h"
#include "common/scalar_field.h"
#include "interpolation/query_search.h"
#include "interpolation/support_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t sum_block = 1024;
double
power(double base, int exponent)
{
  double product = 1.0;
  for (int i = 0; i < exponent; ++i)
    product *= base;
  return product;
}

/** The sum of factor * (end - q)^degree over the ends beyond q. */
template <std::size_t n>
double
splineAt(double q, int degree, const double (&ends)[n], const double (&factors)[n])
{
  double sum = 0.0;
  for (std::size_t i = 0; i < n && q < ends[i]; ++i)
    sum += factors[i] * power(ends[i] - q, degree);
  return sum;
}

/** A spline of a degree on [0, ends[0]], times a norm. */
template <typename Spline>
SmoothingKernel
splineKernel()
{
  return {Spline::ends[0],
          [](double q) {
            return Spline::norm *
                   splineAt(q, Spline::degree, Spline::ends, Spline::factors);
          },
          [](double q) {
            return -Spline::norm * Spline::degree *
                   splineAt(q, Spline::degree - 1, Spline::ends, Spline::factors);
          }};
}

struct Cubic {
  static constexpr int degree = 3;
  static constexpr double norm = 1.0 / (4.0 * pi);
  static constexpr double ends[] = {2.0, 1.0}, factors[] = {1.0, -4.0};
};

struct Quartic {
  static constexpr int degree = 4;
  static constexpr double norm = 1.0 / (20.0 * pi);
  static constexpr double ends[] = {2.5, 1.5, 0.5}, factors[] = {1.0, -5.0, 10.0};
};

struct Quintic {
  static constexpr int degree = 5;
  static constexpr double norm = 1.0 / (120.0 * pi);
  static constexpr double ends[] = {3.0, 2.0, 1.0}, factors[] = {1.0, -6.0, 15.0};
};

/** Wendland's functions, which end at 2 h. */
double
wendland2(double q)
{
  const double rest = 1.0 - 0.5 * q;
  return rest > 0.0 ? 21.0 / (16.0 * pi) * power(rest, 4) * (1.0 + 2.0 * q) : 0.0;
}

double
wendland2Slope(double q)
{
  const double rest = 1.0 - 0.5 * q;
  return rest > 0.0 ? -21.0 / (16.0 * pi) * 5.0 * q * power(rest, 3) : 0.0;
}

double
wendland4(double q)
{
  const double rest = 1.0 - 0.5 * q;
  return rest > 0.0 ? 495.0 / (256.0 * pi) * power(rest, 6) *
                          (1.0 + q * (3.0 + 35.0 / 12.0 * q))
                    : 0.0;
}

double
wendland4Slope(double q)
{
  const double rest = 1.0 - 0.5 * q;
  return rest > 0.0
             ? -495.0 / (256.0 * pi) * power(rest, 5) * 14.0 / 3.0 * q * (1.0 + 2.5 * q)
             : 0.0;
}

double
wendland6(double q)
{
  const double rest = 1.0 - 0.5 * q;
  return rest > 0.0 ? 1365.0 / (512.0 * pi) * power(rest, 8) *
                          (1.0 + q * (4.0 + q * (6.25 + 4.0 * q)))
                    : 0.0;
}

double
wendland6Slope(double q)
{
  const double rest = 1.0 - 0.5 * q;
  return rest > 0.0 ? -1365.0 / (512.0 * pi) * power(rest, 7) * 5.5 * q *
                          (1.0 + q * (3.5 + 4.0 * q))
                    : 0.0;
}

/** The numbers of a field by sample. */
std::vector<double>
readBySample(const CloudView& cloud, const SampleSet& samples, const std::string& name)
{
  std::vector<double> numbers;
  if (name.empty())
    return numbers;
  const ScalarField field(cloud.fields, name);
  for (std::size_t i = 0; i < samples.size(); ++i)
    numbers.push_back(field.read(cloud.point(samples.getInputIndex(i))));
  return numbers;
}

bool
isPositive(double number)
{
  return std::isfinite(number) && number > 0.0;
}

} // namespace

const SmoothingKernel&
smoothingKernel(SphKernel kernel)
{
  static const std::array<SmoothingKernel, 6> kernels{
      {splineKernel<Cubic>(),
       splineKernel<Quartic>(),
       splineKernel<Quintic>(),
       {2.0, wendland2, wendland2Slope},
       {2.0, wendland4, wendland4Slope},
       {2.0, wendland6, wendland6Slope}}};
  return kernels[static_cast<std::size_t>(kernel)];
}

Particles
readParticles(const CloudView& cloud,
              const SampleSet& samples,
              const SphParameters& parameters)
{
  Particles particles{readBySample(cloud, samples, parameters.length_field),
                      readBySample(cloud, samples, parameters.mass_field),
                      readBySample(cloud, samples, parameters.density_field)};
  for (double& length : particles.lengths)
    length *= static_cast<double>(samples.getUnit().factor);
  return particles;
}

KernelSums::KernelSums(const SampledFields& sampled,
                       const SphParameters& parameters,
                       Particles particles,
                       unsigned threads,
                       Report& report)
    : sampled_(sampled)
    , parameters_(parameters)
    , kernel_(smoothingKernel(parameters.kernel))
    , sparse_(sparseSamples(*sampled.samples))
    , lengths_(std::move(particles.lengths))
{
  StepTimer step(report, "density", 2 * sampled.samples->size());
  completeLengths(threads, step);
  balls_.emplace(
      *sampled.samples,
      [this](const BallTree::Bucket& bucket) {
        return kernel_.reach *
               *std::max_element(lengths_.begin() + bucket.begin,
                                 lengths_.begin() + bucket.begin + bucket.count);
      },
      threads);
  setVolumes(particles, threads, step);
}

void
KernelSums::completeLengths(unsigned threads, StepTimer& step)
{
  const SampleSet& samples = *sampled_.samples;
  lengths_.resize(samples.size(), 0.0);
  parallelBlocks(samples.size(), sum_block, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, parameters_.k + 1);
    float reach = 1.0f;
    for (std::size_t i = begin; i < end; ++i) {
      if (isPositive(lengths_[i]))
        continue;
      const auto near = finder.find(samples.getPositions()[i], reach);
      reach = std::sqrt(*std::max_element(near.sq_dists, near.sq_dists + near.size));
      // A particle alone: any length.
      if (!(reach > 0.0f))
        reach = 1.0f;
      lengths_[i] = static_cast<double>(reach) / kernel_.reach;
    }
    step.advance(end - begin);
  });
}

void
KernelSums::setVolumes(const Particles& particles, unsigned threads, StepTimer& step)
{
  const SampleSet& samples = *sampled_.samples;
  volumes_.resize(samples.size());
  const auto massOf = [&](std::size_t i) {
    return particles.masses.empty() || !isPositive(particles.masses[i])
               ? 1.0
               : particles.masses[i];
  };
  parallelBlocks(samples.size(), sum_block, threads, [&](auto begin, auto end) {
    std::vector<std::uint32_t> buckets;
    for (std::size_t i = begin; i < end; ++i) {
      if (!particles.densities.empty() && isPositive(particles.densities[i])) {
        volumes_[i] = massOf(i) / particles.densities[i];
        continue;
      }
      // The density at a particle, by its own length.
      const Position& x = samples.getPositions()[i];
      const Query center{{x[0], x[1], x[2]}};
      const double reach = kernel_.reach * lengths_[i];
      buckets.clear();
      // Boxes of particles, whatever their lengths.
      balls_->findReaching(
          {center.x[0] - reach, center.x[1] - reach, center.x[2] - reach},
          {center.x[0] + reach, center.x[1] + reach, center.x[2] + reach},
          0.0,
          std::numeric_limits<std::size_t>::max(),
          buckets);
      double density = 0.0;
      for (const std::uint32_t bucket : buckets) {
        const BallTree::Bucket& particles_of = balls_->getBuckets()[bucket];
        for (std::size_t j = particles_of.begin;
             j < particles_of.begin + particles_of.count;
             ++j) {
          const double q =
              std::sqrt(sqDistance(center, samples.getPositions()[j])) / lengths_[i];
          if (q < kernel_.reach)
            density += massOf(j) * kernel_.value(q);
        }
      }
      volumes_[i] = massOf(i) * power(lengths_[i], 3) / density;
    }
    step.advance(end - begin);
  });
}

void
KernelSums::evaluate(const Query* queries,
                     std::size_t count,
                     const Estimates& estimates) const
{
  const SampleSet& samples = *sampled_.samples;
  SupportFinder support(samples, sparse_);
  support.expect(queries, count);
  QuerySearch search(samples, 1, queries, count);
  WeightedSum sum(sampled_.fields);
  const std::vector<double> zero(sampled_.fields, 0.0);
  std::vector<std::uint32_t> buckets;
  for (std::size_t i = 0; i < count; ++i) {
    const Query& query = queries[i];
    const std::array<double, 3> at{query.x[0], query.x[1], query.x[2]};
    const double* const nearest = sampled_.valuesOf(search.find(i).samples[0]);
    buckets.clear();
    balls_->findReaching(at, at, 1.0, std::numeric_limits<std::size_t>::max(), buckets);
    sum.start(parameters_.normalized ? nearest : zero.data());
    for (const std::uint32_t bucket : buckets) {
      const BallTree::Bucket& particles = balls_->getBuckets()[bucket];
      for (std::size_t j = particles.begin; j < particles.begin + particles.count;
           ++j) {
        const Position& x = samples.getPositions()[j];
        const double distance = std::sqrt(sqDistance(query, x)), h = lengths_[j];
        const double q = distance / h;
        if (!(q < kernel_.reach))
          continue;
        const double level = volumes_[j] / power(h, 3);
        const double slope =
            distance > 0.0 ? level * kernel_.slope(q) / (h * distance) : 0.0;
        sum.add(sampled_.valuesOf(j),
                level * kernel_.value(q),
                {slope * (query.x[0] - static_cast<double>(x[0])),
                 slope * (query.x[1] - static_cast<double>(x[1])),
                 slope * (query.x[2] - static_cast<double>(x[2]))});
      }
    }
    estimates.support[i] = support.findExpected(i);
    if (!(sum.getWeight() > 0.0)) {
      estimates.support[i] = FieldSupport::Outside;
      sum.add(sum.getReference(), 1.0, {});
    }
    if (parameters_.normalized)
      sum.finish(i, estimates);
    else
      sum.finishSum(i, estimates);
  }
}

} // namespace pcl_uvol::detail
