// SPDX-License-Identifier: BSD-3-Clause
// Smoothing kernels and sums of them over particles, against integrals and all pairs.
#include "common/random.h"
#include "src/interpolation/kernel_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace test_kernel_sums {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;

TEST(SmoothingKernel, IntegralsAreOne)
{
  for (const auto& word : listWords(SphKernel())) {
    const SmoothingKernel& kernel = smoothingKernel(word.value);
    constexpr int steps = 3000;
    const double step = kernel.reach / steps;
    double integral = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double q = (i + 0.5) * step;
      integral += 4.0 * M_PI * q * q * kernel.value(q) * step;
      EXPECT_NEAR(kernel.slope(q),
                  (kernel.value(q + 1e-6) - kernel.value(q - 1e-6)) / 2e-6,
                  1e-6)
          << word.word << " " << q;
    }
    EXPECT_NEAR(integral, 1.0, 1e-6) << word.word;
    EXPECT_EQ(kernel.value(kernel.reach), 0.0);
    EXPECT_GT(kernel.value(0.99 * kernel.reach), 0.0);
  }
}

/** Particles at random, some of them with a length of their own. */
struct Case {
  SampledFields sampled;
  Particles particles;

  explicit Case(std::size_t n)
  {
    std::vector<Position> positions(n);
    for (std::size_t i = 0; i < n; ++i)
      for (int axis = 0; axis < 3; ++axis)
        positions[i][axis] =
            static_cast<float>(uniformAt(1, i, static_cast<std::uint64_t>(axis)));
    std::vector<std::uint32_t> use(n);
    std::iota(use.begin(), use.end(), 0u);
    Report report;
    sampled.samples = SampleSet::build(
        positions.front().x, 3, use, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
    sampled.fields = 1;
    for (std::size_t i = 0; i < n; ++i) {
      sampled.values.push_back(uniformAt(2, i, 0));
      particles.masses.push_back(0.5 + uniformAt(2, i, 1));
      particles.lengths.push_back(0.1 + 0.3 * uniformAt(2, i, 2));
    }
  }

  double
  q(const double* x, std::size_t j, double h) const
  {
    return std::sqrt(
               sqDistance({{x[0], x[1], x[2]}}, sampled.samples->getPositions()[j])) /
           h;
  }
};

/** With lengths and masses of their own, normalised or not. */
TEST(KernelSums, AreSumsOverAllParticles)
{
  const Case at(300);
  const std::size_t n = at.sampled.samples->size();
  for (const auto& word : listWords(SphKernel())) {
    const SmoothingKernel& kernel = smoothingKernel(word.value);
    std::vector<double> volume(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Position& x = at.sampled.samples->getPositions()[i];
      const double center[3] = {x[0], x[1], x[2]}, h = at.particles.lengths[i];
      double density = 0.0;
      for (std::size_t j = 0; j < n; ++j)
        density +=
            at.particles.masses[j] * kernel.value(at.q(center, j, h)) / (h * h * h);
      volume[i] = at.particles.masses[i] / density;
    }
    SphParameters parameters;
    parameters.kernel = word.value;
    for (const bool normalized : {true, false}) {
      parameters.normalized = normalized;
      Report report;
      const KernelSums sums(at.sampled, parameters, at.particles, 1, report);
      for (std::uint64_t i = 0; i < 20; ++i) {
        const double unit = static_cast<double>(at.sampled.samples->getUnit().factor);
        const Query query{{unit * uniformAt(3, i, 0),
                           unit * uniformAt(3, i, 1),
                           unit * uniformAt(3, i, 2)}};
        const auto truthAt = [&](const Query& place) {
          double value = 0.0, weight = 0.0;
          for (std::size_t j = 0; j < n; ++j) {
            const double h = at.particles.lengths[j];
            const double part =
                volume[j] * kernel.value(at.q(place.x, j, h)) / (h * h * h);
            value += part * at.sampled.values[j];
            weight += part;
          }
          return normalized ? value / weight : value;
        };
        double value, error, gradient[3];
        FieldSupport support;
        sums.evaluate(&query, 1, {&value, gradient, &error, &support});
        EXPECT_NEAR(value, truthAt(query), 1e-12);
        for (int axis = 0; axis < 3; ++axis) {
          Query ahead = query, behind = query;
          ahead.x[axis] += 1e-6;
          behind.x[axis] -= 1e-6;
          EXPECT_NEAR(gradient[axis], (truthAt(ahead) - truthAt(behind)) / 2e-6, 1e-5);
        }
      }
    }
  }
}

/** Without lengths, masses and densities: kernels that end at the k-th neighbour, and
 * sums of ones that are about one among random particles, less by what each of them
 * adds to its own density. */
TEST(KernelSums, CompletesWhatParticlesLack)
{
  Case at(4000);
  std::fill(at.sampled.values.begin(), at.sampled.values.end(), 1.0);
  SphParameters parameters;
  parameters.normalized = false;
  Report report;
  const KernelSums sums(at.sampled, parameters, {}, 2, report);
  const double unit = static_cast<double>(at.sampled.samples->getUnit().factor);
  double mean = 0.0;
  constexpr std::uint64_t count = 200;
  for (std::uint64_t i = 0; i < count; ++i) {
    Query query;
    for (int axis = 0; axis < 3; ++axis)
      query.x[axis] =
          unit * (0.3 + 0.4 * uniformAt(4, i, static_cast<std::uint64_t>(axis)));
    double value;
    FieldSupport support;
    sums.evaluate(&query, 1, {&value, nullptr, nullptr, &support});
    EXPECT_NEAR(value, 1.0, 0.7);
    mean += value / count;
  }
  EXPECT_NEAR(mean, 0.9, 0.1);
}

} // namespace test_kernel_sums
