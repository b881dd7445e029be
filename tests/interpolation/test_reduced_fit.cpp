// SPDX-License-Identifier: BSD-3-Clause
// Polynomials where samples do not determine all terms, against cubics that are known
// and normal equations.
#include "common/random.h"
#include "derivatives/equations.h"
#include "src/interpolation/reduced_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace test_reduced_fit {

using pcl_uvol::detail::ReducedFit;

constexpr Eigen::Index cubic_terms = 20;

/** Places in a ball of that radius, the first one in its middle. */
Eigen::MatrixX3d
makeOffsets(Eigen::Index count, double radius)
{
  Eigen::MatrixX3d offsets = Eigen::MatrixX3d::Zero(count, 3);
  std::uint64_t draw = 0;
  for (Eigen::Index i = 1; i < count; ++i)
    do
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        offsets(i, axis) = radius * (2.0 * pcl_uvol::uniformAt(7, draw++, 0) - 1.0);
    while (offsets.row(i).norm() >= radius);
  return offsets;
}

/** The terms of a cubic, by degree and then by falling powers of x and y. */
Eigen::RowVectorXd
termsAt(const Eigen::RowVector3d& place)
{
  Eigen::RowVectorXd terms(cubic_terms);
  Eigen::Index at = 0;
  for (int degree = 0; degree <= 3; ++degree)
    for (int x = degree; x >= 0; --x)
      for (int y = degree - x; y >= 0; --y)
        terms[at++] = std::pow(place[0], x) * std::pow(place[1], y) *
                      std::pow(place[2], degree - x - y);
  return terms;
}

Eigen::VectorXd
randomNumbers(Eigen::Index count, std::uint64_t seed)
{
  Eigen::VectorXd numbers(count);
  for (Eigen::Index i = 0; i < count; ++i)
    numbers[i] =
        2.0 * pcl_uvol::uniformAt(seed, static_cast<std::uint64_t>(i), 0) - 1.0;
  return numbers;
}

TEST(ReducedFit, CubicsHaveTheirCoefficients)
{
  const Eigen::MatrixX3d offsets = makeOffsets(60, 0.95);
  const Eigen::VectorXd cubic = randomNumbers(cubic_terms, 1);
  Eigen::VectorXd values(offsets.rows());
  for (Eigen::Index i = 0; i < offsets.rows(); ++i)
    values[i] = termsAt(offsets.row(i)) * cubic;
  std::array<double, cubic_terms> found{};
  EXPECT_LT(ReducedFit(offsets).solve(values, found.data()), 1e-12);
  for (std::size_t term = 0; term < found.size(); ++term)
    EXPECT_NEAR(cubic[static_cast<Eigen::Index>(term)], found[term], 1e-10) << term;
}

/** Least squares with the weights (1 - d^2)^2, written out: the degree with the
 * smallest standard error of the value in the middle. */
TEST(ReducedFit, ErrorsAndCoefficientsAreThoseOfWeightedLeastSquares)
{
  const Eigen::MatrixX3d offsets = makeOffsets(40, 0.95);
  const Eigen::VectorXd values = randomNumbers(offsets.rows(), 2);
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best;
  for (const Eigen::Index terms : {4, 10, 20}) {
    Eigen::MatrixXd matrix(offsets.rows(), terms);
    Eigen::VectorXd weights(offsets.rows());
    for (Eigen::Index i = 0; i < offsets.rows(); ++i) {
      matrix.row(i) = termsAt(offsets.row(i)).head(terms);
      weights[i] = std::pow(1.0 - offsets.row(i).squaredNorm(), 2.0);
    }
    const Eigen::MatrixXd inverse = uvol_test::invert(
        Eigen::MatrixXd(matrix.transpose() * weights.asDiagonal() * matrix));
    const Eigen::VectorXd solution =
        inverse * (matrix.transpose() * weights.asDiagonal() * values);
    const Eigen::VectorXd residuals = matrix * solution - values;
    const double squares = residuals.cwiseAbs2().dot(weights);
    const double error = std::sqrt(inverse(0, 0) * squares /
                                   static_cast<double>(offsets.rows() - terms));
    if (error < least) {
      least = error;
      best = solution;
    }
  }
  std::array<double, cubic_terms> found{};
  EXPECT_NEAR(least, ReducedFit(offsets).solve(values, found.data()), 1e-10 * least);
  for (std::size_t term = 0; term < found.size(); ++term) {
    const auto at = static_cast<Eigen::Index>(term);
    EXPECT_NEAR(at < best.size() ? best[at] : 0.0, found[term], 1e-9) << term;
  }
}

/** Derivatives across a plane that samples lie on are 0. */
TEST(ReducedFit, PlanesHaveNoDerivativesAcross)
{
  Eigen::MatrixX3d offsets = makeOffsets(40, 0.95);
  offsets.col(2).setZero();
  Eigen::VectorXd values(offsets.rows());
  for (Eigen::Index i = 0; i < offsets.rows(); ++i)
    values[i] = 1.0 + offsets(i, 0) - 2.0 * offsets(i, 0) * offsets(i, 1);
  std::array<double, cubic_terms> found{};
  ReducedFit(offsets).solve(values, found.data());
  EXPECT_NEAR(1.0, found[0], 1e-10);
  EXPECT_NEAR(1.0, found[1], 1e-10);
  EXPECT_NEAR(-2.0, found[5], 1e-9);
  for (const std::size_t term : {3u, 6u, 8u, 9u})
    EXPECT_NEAR(0.0, found[term], 1e-9) << term;
}

} // namespace test_reduced_fit
