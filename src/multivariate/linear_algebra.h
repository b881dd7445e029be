// SPDX-License-Identifier: BSD-3-Clause
// Orthonormal columns, and Eigen's decompositions of matrices of any size. They are
// compiled in one unit: each unit that holds them takes several seconds and some 300 MB
// more.
#pragma once

#include <Eigen/Core>

namespace pcl_uvol {

/** \brief Columns made orthonormal one after the other; those that depend on earlier
 * ones become 0. */
Eigen::MatrixXd
orthonormalized(Eigen::MatrixXd columns);

/** \brief Eigenvalues in ascending order, and unit eigenvectors in that order as
 * columns. */
struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/** \brief Decomposes a symmetric matrix, of which the lower triangle is read. */
EigenPairs
computeEigenPairs(const Eigen::MatrixXd& symmetric);

/** \brief The lower triangular L with L L^T = the positive definite matrix. */
Eigen::MatrixXd
computeCholeskyRoot(const Eigen::MatrixXd& positive);

/** \brief x with positive x = right, by Cholesky. */
Eigen::VectorXd
solvePositive(const Eigen::MatrixXd& positive, const Eigen::VectorXd& right);

/** \brief Replaces b by x with lower x = b. */
void
solveLowerInPlace(const Eigen::MatrixXd& lower, Eigen::VectorXd& right);
void
solveLowerInPlace(const Eigen::MatrixXd& lower, Eigen::MatrixXd& columns);

/** \brief x with lower^T x = columns. */
Eigen::MatrixXd
solveLowerTransposed(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& columns);

} // namespace pcl_uvol
