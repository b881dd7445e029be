// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/reduced_fit.h"

#include "common/eigen_solvers.h"

#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

namespace {

/** Residuals of fewer degrees of freedom say nothing about the error. */
constexpr double least_freedom = 5.0;

constexpr Eigen::Index terms_of_degree[4] = {1, 4, 10, 20};

/** The terms of a cubic: by degree, then falling powers of x and y. */
Eigen::Matrix<double, 1, 20>
termsAt(const Eigen::RowVector3d& u)
{
  const double x = u[0], y = u[1], z = u[2];
  Eigen::Matrix<double, 1, 20> terms;
  terms << 1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z, x * x * x, x * x * y,
      x * x * z, x * y * y, x * y * z, x * z * z, y * y * y, y * y * z, y * z * z,
      z * z * z;
  return terms;
}

} // namespace

ReducedFit::ReducedFit(const Eigen::MatrixX3d& offsets,
                       double smallest_pivot,
                       bool all_terms)
{
  const Eigen::Index count = offsets.rows();
  root_weights_ = (1.0 - offsets.rowwise().squaredNorm().array()).matrix();
  Eigen::MatrixXd all(count, terms_of_degree[3]);
  for (Eigen::Index j = 0; j < count; ++j)
    all.row(j) = root_weights_[j] * termsAt(offsets.row(j));
  for (int degree = 1; degree <= 3; ++degree) {
    const Eigen::MatrixXd terms = all.leftCols(terms_of_degree[degree]);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(smallest_pivot);
    decomposition.compute(terms);
    const double freedom = static_cast<double>(count - decomposition.rank());
    if (degree > 1 && freedom < least_freedom)
      break;
    if (degree > 1 && all_terms && decomposition.rank() < terms.cols())
      break;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
    Eigen::MatrixXd inverse = decomposition.solve(identity);
    const double leverage = inverse.row(0).squaredNorm();
    degrees_.push_back({terms, std::move(inverse), leverage, freedom});
  }
}

double
ReducedFit::solve(const Eigen::VectorXd& values, double* coefficients) const
{
  const Eigen::VectorXd weighted = root_weights_.cwiseProduct(values);
  double least = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd best;
  for (const Degree& degree : degrees_) {
    const Eigen::VectorXd solution = degree.inverse * weighted;
    const double error =
        degree.freedom > 0.0
            ? std::sqrt(degree.leverage *
                        (degree.terms * solution - weighted).squaredNorm() /
                        degree.freedom)
            : std::numeric_limits<double>::quiet_NaN();
    if (best.size() == 0 || error < least) {
      best = solution;
      least = error;
    }
  }
  std::fill(coefficients, coefficients + terms_of_degree[3], 0.0);
  std::copy(best.begin(), best.end(), coefficients);
  return least;
}

} // namespace pcl_uvol::detail
