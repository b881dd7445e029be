// SPDX-License-Identifier: BSD-3-Clause
// Steps of level sets against the equations of the thesis in double precision, on
// random stencils.
#include "src/levelset/evolution_kernel.h"
#include "support/simd_levels.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace test_evolution_kernel {

using namespace pcl_uvol;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const KernelTable<const EvolutionKernels*> kernels{
    &baseline::evolution_kernels, &avx2::evolution_kernels, &avx512::evolution_kernels};

constexpr std::size_t groups = 3, neighbors = 11, others = 9;
/** The last lanes of the last group are no centres. */
constexpr std::size_t centers = groups * stencil_lanes - 5;
constexpr std::size_t center_places = groups * stencil_lanes,
                      places = center_places + others;

/** Rounding of numbers near 1 that sums of some floats leave. */
constexpr double rounding = 2e-5;

/** Random numbers by place. */
class Numbers {
public:
  std::vector<float>
  between(double low, double high, std::size_t count = places)
  {
    std::vector<float> values(count);
    for (float& value : values)
      value = static_cast<float>(
          low + (high - low) * static_cast<double>(engine_() % 4096) / 4096.0);
    return values;
  }

  std::size_t
  below(std::size_t end)
  {
    return engine_() % end;
  }

private:
  std::mt19937_64 engine_{3};
};

/** Stencils with random neighbours and weights. */
struct RandomStencils {
  std::vector<std::uint32_t> indices;
  std::vector<std::int16_t> weights;
  std::vector<float> scales;
  std::size_t rows;

  RandomStencils(Numbers& numbers, std::size_t row_count)
      : rows(row_count)
  {
    for (std::size_t i = 0; i < center_places * neighbors; ++i)
      indices.push_back(static_cast<std::uint32_t>(numbers.below(places)));
    for (std::size_t i = 0; i < center_places * neighbors * rows; ++i)
      weights.push_back(
          static_cast<std::int16_t>(static_cast<int>(numbers.below(65535)) - 32767));
    scales = numbers.between(0.5e-5, 1.5e-5, center_places * rows);
  }

  StencilView
  view() const
  {
    return {rows, neighbors, indices.data(), weights.data(), scales.data()};
  }

  std::uint32_t
  neighbor(std::size_t place, std::size_t j) const
  {
    return indices[(place / stencil_lanes * neighbors + j) * stencil_lanes +
                   place % stencil_lanes];
  }

  /** A derivative at a centre.
   * \param value of a neighbour's place */
  template <typename Value>
  double
  derivative(std::size_t place, std::size_t row, const Value& value, double own) const
  {
    const std::size_t group = place / stencil_lanes, lane = place % stencil_lanes;
    double sum = 0.0;
    for (std::size_t j = 0; j < neighbors; ++j)
      sum += weights[((group * neighbors + j) * rows + row) * stencil_lanes + lane] *
             (value(neighbor(place, j)) - own);
    return sum * scales[(group * rows + row) * stencil_lanes + lane];
  }

  template <typename Value>
  Vector3d
  gradient(std::size_t place, const Value& value, double own) const
  {
    return {derivative(place, 0, value, own),
            derivative(place, 1, value, own),
            derivative(place, 2, value, own)};
  }

  template <typename Value>
  Matrix3d
  hessian(std::size_t place, const Value& value, double own) const
  {
    constexpr int entry[3][3] = {{3, 4, 5}, {4, 6, 7}, {5, 7, 8}};
    Matrix3d h;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        h(i, j) = derivative(place, static_cast<std::size_t>(entry[i][j]), value, own);
    return h;
  }
};

/** Everything that a step reads and writes, and the right side of (3.7). */
struct Problem {
  Numbers numbers;
  RandomStencils stencils;
  std::vector<float> phi = numbers.between(-2.0, 2.0), rate = numbers.between(-1, 1),
                     target = numbers.between(-3.0, 3.0),
                     trust = numbers.between(0.1, 1.0, center_places),
                     reference = numbers.between(-0.5, 0.5, center_places),
                     sq_length = numbers.between(0.5, 2.0, center_places);
  std::vector<float> next = std::vector<float>(center_places), curvature = next,
                     slope = next;
  EvolutionStep step;

  explicit Problem(std::size_t rows)
      : stencils(numbers, rows)
      , step{stencils.view(),
             {phi.data(), rate.data(), 0.25f},
             target.data(),
             trust.data(),
             reference.data(),
             sq_length.data(),
             1.25f, // pull
             1.5f,  // slope
             0.3f,
             0.05f,
             0.02f,
             next.data(),
             curvature.data(),
             slope.data()}
  {
  }

  double
  now(std::size_t place) const
  {
    return phi[place] + static_cast<double>(rate[place]) * step.lines.time;
  }

  /** phi after the step.
   * \param bend mean curvature times slope */
  double
  after(std::size_t i, double of_slope, double bend, double to_distance) const
  {
    const double own = now(i), gap = target[i] - own;
    const bool other_side = target[i] * own < 0.0;
    const double pull =
        (other_side ? 1.0 : trust[i]) *
        std::clamp(gap, static_cast<double>(-step.most_pull), double(step.most_pull)) *
        std::min(of_slope, static_cast<double>(step.most_slope));
    if (step.reference != nullptr)
      bend -= reference[i] * of_slope;
    return own + step.advection * pull +
           sq_length[i] * (step.diffusion * bend + step.to_distance * to_distance);
  }
};

TEST(EvolutionKernel, EvolveIsTheEquationOfTheThesis)
{
  for (const bool has_reference : {true, false})
    for (const float time : {0.0f, 0.25f}) {
      Problem s(9);
      s.step.lines.time = time;
      if (!has_reference)
        s.step.reference = nullptr;
      uvol_test::forLevels(kernels, [&](const EvolutionKernels* kernel) {
        std::fill(s.next.begin(), s.next.end(), 0.0f);
        kernel->evolve(s.step, 0, 1);
        EXPECT_EQ(0.0f, s.next[stencil_lanes]) << "of another group";
        kernel->evolve(s.step, 1, groups);
        int steep = 0, flat = 0;
        for (std::size_t i = 0; i < center_places; ++i) {
          const auto value = [&](std::size_t place) { return s.now(place); };
          const Vector3d gradient = s.stencils.gradient(i, value, s.now(i));
          const Matrix3d hessian = s.stencils.hessian(i, value, s.now(i));
          const double slope = gradient.norm();
          const Vector3d normal = gradient / slope;
          const double across = hessian.trace() - normal.dot(hessian * normal);
          (slope > s.step.most_slope ? steep : flat) += 1;
          EXPECT_NEAR(slope, s.slope[i], rounding);
          EXPECT_NEAR(0.5 * across, s.curvature[i], rounding);
          EXPECT_NEAR(s.after(i, slope, 0.5 * across, hessian.trace() - across / slope),
                      s.next[i],
                      rounding);
        }
        EXPECT_GT(steep, 5);
        EXPECT_GT(flat, 5);
      });
    }
}

TEST(EvolutionKernel, NormalsAreUnitGradientsAndZeroWhereThereIsNone)
{
  Problem s(3);
  // All values alike: no slope.
  for (std::size_t j = 0; j < neighbors; ++j) {
    const std::uint32_t place = s.stencils.neighbor(7, j);
    s.phi[place] = s.phi[7];
    s.rate[place] = s.rate[7];
  }
  std::vector<float> normal[3];
  for (auto& coordinate : normal)
    coordinate.resize(center_places);
  uvol_test::forLevels(kernels, [&](const EvolutionKernels* kernel) {
    kernel->findNormals({s.step.stencils,
                         s.step.lines,
                         {normal[0].data(), normal[1].data(), normal[2].data()},
                         s.slope.data()},
                        0,
                        groups);
    for (std::size_t i = 0; i < center_places; ++i) {
      const Vector3d gradient = s.stencils.gradient(
          i, [&](std::size_t place) { return s.now(place); }, s.now(i));
      const double slope = gradient.norm();
      EXPECT_NEAR(slope, s.slope[i], rounding);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(i == 7 ? 0.0 : gradient[axis] / slope, normal[axis][i], rounding);
    }
  });
}

TEST(EvolutionKernel, EvolveByNormalsTakesTheirDivergence)
{
  Problem s(3);
  std::vector<float> normal[3];
  for (auto& coordinate : normal)
    coordinate = s.numbers.between(-1.0, 1.0, center_places);
  s.slope = s.numbers.between(0.2, 2.5, center_places);
  s.step.slope = s.slope.data();
  const float* const normals[3] = {
      normal[0].data(), normal[1].data(), normal[2].data()};
  uvol_test::forLevels(kernels, [&](const EvolutionKernels* kernel) {
    kernel->evolveByNormals(s.step, normals, centers, 0, groups);
    for (std::size_t i = 0; i < centers; ++i) {
      // Who is no centre counts as the sample itself.
      const auto of = [&](const std::vector<float>& values) {
        return [&, i](std::size_t place) -> double {
          return values[place < centers ? place : i];
        };
      };
      double divergence = 0.0, along = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        divergence += s.stencils.derivative(i, axis, of(normal[axis]), normal[axis][i]);
        along +=
            normal[axis][i] * s.stencils.derivative(i, axis, of(s.slope), s.slope[i]);
      }
      const double bend = 0.5 * divergence * s.slope[i];
      EXPECT_NEAR(bend, s.curvature[i], rounding);
      EXPECT_NEAR(s.after(i, s.slope[i], bend, (s.slope[i] - 1.0) * divergence + along),
                  s.next[i],
                  rounding);
    }
  });
}

TEST(EvolutionKernel, RelaxationIsUpwindAndDamped)
{
  Problem s(9);
  const auto sign = s.numbers.between(-1.0, 1.0, center_places);
  const DistanceStep step{s.stencils.view(),
                          s.phi.data(),
                          sign.data(),
                          0.2f,
                          0.05f,
                          s.next.data(),
                          s.slope.data()};
  uvol_test::forLevels(kernels, [&](const EvolutionKernels* kernel) {
    kernel->relaxToDistance(step, 0, groups);
    int upwind_steps = 0;
    for (std::size_t i = 0; i < center_places; ++i) {
      const double own = s.phi[i];
      const auto value = [&](std::size_t place) -> double { return s.phi[place]; };
      const auto nearer = [&](std::size_t place) {
        return sign[i] >= 0.0f ? std::min(value(place), own)
                               : std::max(value(place), own);
      };
      const Vector3d gradient = s.stencils.gradient(i, value, own);
      const double slope = gradient.norm(),
                   upwind = 3.0 * s.stencils.gradient(i, nearer, own).norm();
      upwind_steps += upwind < slope ? 1 : 0;
      const Vector3d normal = gradient / slope;
      const double along = normal.dot(s.stencils.hessian(i, value, own) * normal);
      EXPECT_NEAR(slope, s.slope[i], rounding);
      EXPECT_NEAR(own + step.change * sign[i] * (1.0 - std::min(slope, upwind)) +
                      step.damping * std::abs(sign[i]) * along,
                  s.next[i],
                  rounding);
    }
    EXPECT_GT(upwind_steps, 2);
    EXPECT_LT(upwind_steps, static_cast<int>(center_places) - 2);
  });
}

TEST(EvolutionKernel, AveragesAreThoseOverCentres)
{
  Problem s(3);
  for (std::size_t fields = 1; fields <= AverageStep::most_fields; ++fields) {
    std::array<std::vector<float>, AverageStep::most_fields> values, means;
    AverageStep step{s.stencils.view(), centers, fields, {}, {}};
    for (std::size_t field = 0; field < fields; ++field) {
      values[field] = s.numbers.between(-1.0, 1.0);
      means[field].resize(center_places);
      step.values[field] = values[field].data();
      step.means[field] = means[field].data();
    }
    uvol_test::forLevels(kernels, [&](const EvolutionKernels* kernel) {
      kernel->average(step, 0, groups);
      for (std::size_t i = 0; i < centers; ++i)
        for (std::size_t field = 0; field < fields; ++field) {
          double sum = values[field][i];
          int count = 1;
          for (std::size_t j = 0; j < neighbors; ++j)
            if (const std::size_t place = s.stencils.neighbor(i, j); place < centers) {
              sum += values[field][place];
              ++count;
            }
          EXPECT_NEAR(sum / count, means[field][i], 1e-6);
        }
    });
  }
}

} // namespace test_evolution_kernel
