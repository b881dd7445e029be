// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/linear_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pcl_uvol {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

namespace {

/** Columns whose part perpendicular to earlier ones is shorter are none of their own.
 */
constexpr double least_new_part = 1e-6;

} // namespace

MatrixXd
orthonormalized(MatrixXd columns)
{
  for (Index k = 0; k < columns.cols(); ++k) {
    VectorXd column = columns.col(k).stableNormalized();
    for (int pass = 0; pass < 2; ++pass) { // twice is enough (Parlett 1980)
      for (Index earlier = 0; earlier < k; ++earlier)
        column -= columns.col(earlier).dot(column) * columns.col(earlier);
      if (column.norm() < least_new_part)
        column.setZero();
      column.stableNormalize();
    }
    columns.col(k) = column;
  }
  return columns;
}

EigenPairs
computeEigenPairs(const MatrixXd& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

MatrixXd
computeCholeskyRoot(const MatrixXd& positive)
{
  return positive.llt().matrixL();
}

VectorXd
solvePositive(const MatrixXd& positive, const VectorXd& right)
{
  return positive.llt().solve(right);
}

void
solveLowerInPlace(const MatrixXd& lower, VectorXd& right)
{
  lower.triangularView<Eigen::Lower>().solveInPlace(right);
}

void
solveLowerInPlace(const MatrixXd& lower, MatrixXd& columns)
{
  lower.triangularView<Eigen::Lower>().solveInPlace(columns);
}

MatrixXd
solveLowerTransposed(const MatrixXd& lower, const MatrixXd& columns)
{
  return lower.triangularView<Eigen::Lower>().transpose().solve(columns);
}

} // namespace pcl_uvol
