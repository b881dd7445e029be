// SPDX-License-Identifier: BSD-3-Clause
// Systems of equations for oracles of kernels: each unit that decomposes a matrix of
// any size takes seconds to compile.
#pragma once

#include <Eigen/Core>

namespace uvol_test {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/** \brief The solution of a system of equations; of more than unknowns the one of least
 * squares. @{ */
LongVector
solve(const LongMatrix& rows, const LongVector& values);
Eigen::VectorXd
solve(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values);
/** @} */

/** \brief The inverse of a square matrix. @{ */
LongMatrix
invert(const LongMatrix& matrix);
Eigen::MatrixXd
invert(const Eigen::MatrixXd& matrix);
/** @} */

} // namespace uvol_test
