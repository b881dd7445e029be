// SPDX-License-Identifier: BSD-3-Clause
#include "derivatives/planar_fit.h"

#include "common/eigen_solvers.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

/** Share of the variances of samples across a plane and along it: 2 % of the extent. */
constexpr double sq_thickness = 0.0004;

/** Share of the variances along the plane: samples around its border have 0.28. With
 * less they are a few lines, even if those next to each other lie on a plane, and say
 * little of what is beside them. */
constexpr double sq_width = 0.1;
constexpr Eigen::Index few_samples = 8;

/** Residuals of fewer degrees of freedom say nothing about the error. */
constexpr Eigen::Index least_freedom = 5;

/** A pivot that is a smaller part of the largest one is rounding of coordinates in
 * float. */
constexpr double smallest_planar_pivot = 1e-5;

constexpr int newton_steps = 6;

/** Newton's last step in radii: far below what coordinates in float resolve. */
constexpr double converged_step = 1e-7;

constexpr Eigen::Index quadratic_terms = 6, cubic_terms = 10;

using Terms = Eigen::Matrix<double, cubic_terms, 1>;

/** The terms of a cubic: by degree, then falling powers of u. */
Terms
termsAt(const Vector2d& at)
{
  const double u = at[0], v = at[1];
  Terms terms;
  terms << 1.0, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v;
  return terms;
}

Terms
slopesAt(const Vector2d& at, const Vector2d& direction)
{
  const double u = at[0], v = at[1], du = direction[0], dv = direction[1];
  Terms slopes;
  slopes << 0.0, du, dv, 2.0 * u * du, u * dv + v * du, 2.0 * v * dv, 3.0 * u * u * du,
      2.0 * u * v * du + u * u * dv, v * v * du + 2.0 * u * v * dv, 3.0 * v * v * dv;
  return slopes;
}

/** A polynomial of one degree. */
struct Polynomial {
  Eigen::Index terms;
  bool is_determined;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors; ///< of the weighted terms
  Terms coefficients = Terms::Zero();
  double variance; ///< of the weighted values

  /** \param weighted terms of a cubic, a sample per row
   * \param values as much weighted */
  Polynomial(const Eigen::MatrixXd& weighted,
             const VectorXd& values,
             Eigen::Index weight_count,
             Eigen::Index term_count)
      : terms(term_count)
  {
    factors.setThreshold(smallest_planar_pivot);
    factors.compute(Eigen::MatrixXd(weighted.leftCols(terms)));
    const Eigen::Index freedom = weight_count - terms;
    is_determined = factors.rank() == terms && freedom >= least_freedom;
    if (!is_determined)
      return;
    const VectorXd solution = factors.solve(values);
    coefficients.head(terms) = solution;
    variance =
        (weighted * coefficients - values).squaredNorm() / static_cast<double>(freedom);
  }

  double
  computeLeverage(const Terms& influence) const
  {
    VectorXd rest = factors.colsPermutation().transpose() * influence.head(terms);
    const auto& upper = factors.matrixR();
    for (Eigen::Index i = 0; i < terms; ++i)
      rest[i] = (rest[i] - upper.col(i).head(i).dot(rest.head(i))) / upper(i, i);
    return rest.squaredNorm();
  }

  /** \brief The standard error of the value, or of what else terms tell. */
  double
  computeError(const Terms& influence) const
  {
    return std::sqrt(computeLeverage(influence) * variance);
  }

  /** \brief How much one more term, as large as it is in the fit with it, adds to the
   * value at a place; zero where the samples do not tell it from the others.
   * \param weighted,values see the constructor
   * \param term of the samples, as much weighted
   * \param at_place the term there */
  double
  computeBias(const Eigen::MatrixXd& weighted,
              const VectorXd& values,
              const VectorXd& term,
              const Terms& place,
              double at_place) const
  {
    const VectorXd given = factors.solve(term);
    const VectorXd rest = term - weighted.leftCols(terms) * given;
    if (!(rest.norm() > smallest_planar_pivot * term.norm()))
      return 0.0;
    return rest.dot(values) / rest.squaredNorm() *
           (at_place - given.dot(place.head(terms)));
  }

  double
  valueAt(const Vector2d& at) const
  {
    return coefficients.dot(termsAt(at));
  }

  Vector2d
  gradientAt(const Vector2d& at) const
  {
    return {coefficients.dot(slopesAt(at, Vector2d::UnitX())),
            coefficients.dot(slopesAt(at, Vector2d::UnitY()))};
  }

  Matrix2d
  hessianAt(const Vector2d& at) const
  {
    const Terms& c = coefficients;
    const double u = at[0], v = at[1];
    const double uv = c[4] + 2.0 * (c[7] * u + c[8] * v);
    Matrix2d hessian;
    hessian << 2.0 * c[3] + 6.0 * c[6] * u + 2.0 * c[7] * v, uv, //
        uv, 2.0 * c[5] + 2.0 * c[8] * u + 6.0 * c[9] * v;
    return hessian;
  }

  /** \brief Newton's way along the gradient from the centre. */
  Vector2d
  findRoot() const
  {
    Vector2d at = Vector2d::Zero();
    for (int step = 0; step < newton_steps; ++step) {
      const Vector2d gradient = gradientAt(at);
      at -= valueAt(at) / gradient.squaredNorm() * gradient;
    }
    return at;
  }
};

using Variances = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/** Along three axes, ascending, times their number. */
Variances
findVariances(const Eigen::Matrix3Xd& offsets)
{
  const Eigen::Matrix3Xd around_mean = offsets.colwise() - offsets.rowwise().mean();
  return Variances(around_mean * around_mean.transpose());
}

} // namespace

bool
findPlane(const Eigen::Matrix3Xd& offsets, PlaneAxes& axes)
{
  const Variances all = findVariances(offsets);
  axes << all.eigenvectors().col(2), all.eigenvectors().col(1);
  if (!(all.eigenvalues()[0] < sq_thickness * all.eigenvalues()[1]))
    return false;
  for (Eigen::Index count = offsets.cols(); count >= few_samples; count /= 2) {
    const Eigen::Vector3d variances =
        findVariances(offsets.leftCols(count)).eigenvalues();
    if (!(variances[1] > sq_width * variances[2]))
      return false;
  }
  return true;
}

void
fitZeroLevelInPlane(const FitSample* samples,
                    std::size_t count,
                    std::size_t lane,
                    const PlaneAxes& axes,
                    FitResult& result)
{
  const auto rows = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd weighted(rows, cubic_terms);
  VectorXd values(rows), fourth_powers(rows);
  double weights = 0.0;
  Eigen::Index weight_count = 0;
  for (Eigen::Index j = 0; j < rows; ++j) {
    const FitSample& sample = samples[static_cast<std::size_t>(j)];
    const Eigen::Vector3d offset(sample.x[lane], sample.y[lane], sample.z[lane]);
    const double root_weight = std::max(0.0, 1.0 - offset.squaredNorm());
    const Vector2d in_plane = axes.transpose() * offset;
    weighted.row(j) = root_weight * termsAt(in_plane);
    values[j] = root_weight * static_cast<double>(sample.value[lane]);
    fourth_powers[j] = root_weight * std::pow(in_plane.squaredNorm(), 2);
    weights += root_weight * root_weight;
    weight_count += root_weight > 0.0;
  }
  const Polynomial quadratic(weighted, values, weight_count, quadratic_terms),
      cubic(weighted, values, weight_count, cubic_terms);
  const Terms middle = termsAt(Vector2d::Zero());
  const bool is_cubic = cubic.is_determined &&
                        (!quadratic.is_determined ||
                         cubic.computeError(middle) <= quadratic.computeError(middle));
  const Polynomial& fit = is_cubic ? cubic : quadratic;
  result.pivot[lane] = 1.0;
  result.order[lane] = fit_failed;
  result.value[lane] = std::numeric_limits<double>::quiet_NaN();
  if (!fit.is_determined)
    return;
  const Vector2d root = fit.findRoot(), gradient = fit.gradientAt(root);
  const double slope = gradient.norm();
  const Eigen::Vector3d offset = axes * root, gradient_in_space = axes * gradient;
  const Eigen::Matrix3d hessian = axes * fit.hessianAt(root) * axes.transpose();
  constexpr int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int axis = 0; axis < 3; ++axis) {
    result.offset[axis][lane] = offset[axis];
    result.gradient[axis][lane] = gradient_in_space[axis];
  }
  for (int i = 0; i < 6; ++i)
    result.hessian[i][lane] = hessian(row[i], column[i]);
  result.value[lane] = fit.coefficients[0];
  result.error[lane] = fit.computeError(termsAt(root)) / slope;
  result.bias[lane] = std::abs(fit.computeBias(weighted,
                                               values,
                                               fourth_powers,
                                               termsAt(root),
                                               std::pow(root.squaredNorm(), 2))) /
                      slope;
  result.slope_error[lane] = fit.computeError(slopesAt(root, gradient / slope)) / slope;
  result.residual[lane] =
      std::sqrt(fit.variance * static_cast<double>(weight_count - fit.terms) / weights);
  if (std::abs(fit.valueAt(root) / slope) < converged_step && root.norm() < 1.0)
    result.order[lane] = is_cubic ? fit_cubic : fit_quadratic;
}

} // namespace pcl_uvol
