// SPDX-License-Identifier: BSD-3-Clause
// Stencils on random samples: derivatives of polynomials, and the bounds that time
// steps rest on.
#include "derivatives/equations.h"
#include "src/derivatives/stencils.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace test_stencils {

using namespace pcl_uvol;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t neighbors = 26;

/** Stencils of all samples of a block of side 12, about 1 apart. */
struct Block {
  SampleSet::ConstPtr samples;
  Stencils stencils;
  Report report;
  double unit;

  explicit Block(FitScheme scheme)
  {
    std::mt19937_64 engine(9);
    std::vector<Position> places(1728);
    for (Position& place : places)
      for (int axis = 0; axis < 3; ++axis)
        place[axis] = static_cast<float>(engine() % 4096) * 12.0f / 4096.0f - 6.0f;
    std::vector<std::uint32_t> all(places.size());
    std::iota(all.begin(), all.end(), 0u);
    samples = SampleSet::build(
        places.front().x, 3, all, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
    unit = samples->getScale()[0];
    std::vector<std::uint32_t> centers(samples->size());
    std::iota(centers.begin(), centers.end(), 0u);
    stencils.compute(*samples, centers, scheme, neighbors, 1, report);
  }

  Vector3d
  place(std::size_t i) const
  {
    const Position& x = samples->getPositions()[i];
    return Vector3d(x[0], x[1], x[2]) / unit;
  }

  std::uint32_t
  neighbor(std::size_t center, std::size_t j) const
  {
    return stencils.view().indicesOf(
        center / stencil_lanes)[j * stencil_lanes + center % stencil_lanes];
  }

  /** The weight of a neighbour in a derivative, lengths in those of the input. */
  double
  weight(std::size_t center, std::size_t j, std::size_t row) const
  {
    const StencilView view = stencils.view();
    const std::size_t group = center / stencil_lanes, lane = center % stencil_lanes;
    return static_cast<double>(view.computeWeights(
               group)[(j * view.rows + row) * stencil_lanes + lane]) *
           view.scalesOf(group)[row * stencil_lanes + lane] *
           (row < 3 ? unit : unit * unit);
  }

  template <typename Function>
  double
  derivative(std::size_t center, std::size_t row, const Function& f) const
  {
    double sum = 0.0;
    for (std::size_t j = 0; j < stencils.view().neighbors; ++j)
      sum +=
          weight(center, j, row) * (f(place(neighbor(center, j))) - f(place(center)));
    return sum;
  }

  /** Second derivatives that are those of a fit: within the block they mostly are. */
  bool
  isInside(std::size_t center) const
  {
    return place(center).cwiseAbs().maxCoeff() < 4.0;
  }
};

/** The quadratic has all terms; weights have 16 bits. */
TEST(Stencils, DerivativesOfAQuadraticAreExact)
{
  const Block block(FitScheme::Quadratic);
  Matrix3d hessian;
  hessian << 0.8, 0.3, -0.4, 0.3, -0.6, 0.2, -0.4, 0.2, 1.0;
  const Vector3d slope(1.0, -2.0, 0.5);
  const auto f = [&](const Vector3d& x) {
    return 3.0 + slope.dot(x) + 0.5 * x.dot(hessian * x);
  };
  const std::array<double, 6> second{hessian(0, 0),
                                     hessian(0, 1),
                                     hessian(0, 2),
                                     hessian(1, 1),
                                     hessian(1, 2),
                                     hessian(2, 2)};
  std::size_t inside = 0, exact = 0;
  for (std::size_t i = 0; i < block.samples->size(); ++i) {
    if (!block.isInside(i))
      continue;
    ++inside;
    const Vector3d gradient = slope + hessian * block.place(i);
    double worst = 0.0;
    for (std::size_t row = 0; row < 9; ++row)
      worst = std::max(worst,
                       std::abs(block.derivative(i, row, f) -
                                (row < 3 ? gradient[static_cast<Eigen::Index>(row)]
                                         : second[row - 3])));
    exact += worst < 2e-3 ? 1 : 0;
  }
  EXPECT_GT(inside, 300u);
  EXPECT_GE(exact, inside * 98 / 100); // the others do not smooth as quadratics
  EXPECT_LE(block.report.getCount("isotropic_fits"), block.samples->size() / 2);
}

TEST(Stencils, DerivativesOfPlanesAreThoseOfAllNeighboursAndTheSample)
{
  const Block block(FitScheme::Linear);
  const auto f = [](const Vector3d& x) { return std::sin(x[0]) + x[1] * x[2]; };
  for (std::size_t i = 0; i < block.samples->size(); i += 7) {
    Eigen::MatrixXd rows(neighbors + 1, 4);
    Eigen::VectorXd values(neighbors + 1);
    for (std::size_t j = 0; j <= neighbors; ++j) {
      const Vector3d x = block.place(j < neighbors ? block.neighbor(i, j) : i);
      rows.row(static_cast<Eigen::Index>(j)) << 1.0, (x - block.place(i)).transpose();
      values[static_cast<Eigen::Index>(j)] = f(x);
    }
    const Eigen::VectorXd plane = uvol_test::solve(rows, values);
    for (std::size_t row = 0; row < 3; ++row)
      EXPECT_NEAR(
          plane[static_cast<Eigen::Index>(row) + 1], block.derivative(i, row, f), 1e-3);
  }
}

/** Weights are rounded to the nearest of 32767 steps, so that rounding does not add up.
 */
TEST(Stencils, WeightsAreThoseOfTheFitToHalfAStep)
{
  const Block block(FitScheme::Quadratic);
  LocalFit fit(FitScheme::Quadratic);
  std::size_t inside = 0, rounded = 0;
  for (std::size_t i = 0; i < block.samples->size(); ++i) {
    if (!block.isInside(i))
      continue;
    std::vector<std::uint32_t> others;
    others.reserve(neighbors);
    for (std::size_t j = 0; j < neighbors; ++j)
      others.push_back(block.neighbor(i, j));
    ASSERT_EQ(FitOutcome::Full,
              fit.fit(block.samples->getPositions(),
                      static_cast<std::uint32_t>(i),
                      others.data(),
                      neighbors));
    double worst = 0.0; // in steps
    for (std::size_t row = 0; row < 3; ++row) {
      const double* const exact = fit.getWeights(row);
      double largest = 0.0;
      for (std::size_t j = 0; j < neighbors; ++j)
        largest = std::max(largest, std::abs(exact[j]));
      for (std::size_t j = 0; j < neighbors; ++j)
        worst = std::max(worst,
                         std::abs(block.weight(i, j, row) / block.unit - exact[j]) /
                             largest * 32767.0);
    }
    ++inside;
    rounded += worst < 0.51 ? 1 : 0;
  }
  EXPECT_GE(rounded, inside * 98 / 100); // the others do not smooth as quadratics
}

/** The sum of absolute weights of curvature times slope, over unit normals. */
TEST(Stencils, StiffnessIsThatOfTheCurvatureAcrossAnyNormal)
{
  const Block block(FitScheme::Quadratic);
  for (std::size_t i = 0; i < block.samples->size(); i += 5) {
    double stiffest = 0.0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0)
            continue;
          const Vector3d n = Vector3d(x, y, z).normalized();
          const Matrix3d across = 0.5 * (Matrix3d::Identity() - n * n.transpose());
          double sum = 0.0;
          for (std::size_t j = 0; j < neighbors; ++j) {
            const auto w = [&](std::size_t row) { return block.weight(i, j, row); };
            Matrix3d second;
            second << w(3), w(4), w(5), w(4), w(6), w(7), w(5), w(7), w(8);
            sum += std::abs(across.cwiseProduct(second).sum());
          }
          stiffest = std::max(stiffest, sum);
        }
    const double stiffness = block.stencils.getStiffness()[i] * block.unit * block.unit;
    EXPECT_NEAR(stiffest, stiffness, 1e-3 * stiffest);
  }
}

TEST(Stencils, KnowTheirNearestAndFarthestNeighbour)
{
  const Block block(FitScheme::Quadratic);
  for (std::size_t i = 0; i < block.samples->size(); i += 5) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < block.samples->size(); ++j)
      if (j != i)
        distances.push_back((block.place(j) - block.place(i)).norm());
    std::sort(distances.begin(), distances.end());
    EXPECT_NEAR(distances[0], block.stencils.getNearest()[i] / block.unit, 1e-5);
    EXPECT_NEAR(
        distances[neighbors - 1], block.stencils.getReach()[i] / block.unit, 1e-5);
  }
}

} // namespace test_stencils
