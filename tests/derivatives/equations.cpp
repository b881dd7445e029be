// SPDX-License-Identifier: BSD-3-Clause
#include "derivatives/equations.h"

#include <Eigen/QR>

namespace uvol_test {

LongVector
solve(const LongMatrix& rows, const LongVector& values)
{
  return Eigen::ColPivHouseholderQR<LongMatrix>(rows).solve(values);
}

Eigen::VectorXd
solve(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values)
{
  return solve(LongMatrix(rows.cast<long double>()),
               LongVector(values.cast<long double>()))
      .cast<double>();
}

LongMatrix
invert(const LongMatrix& matrix)
{
  return Eigen::ColPivHouseholderQR<LongMatrix>(matrix).inverse();
}

Eigen::MatrixXd
invert(const Eigen::MatrixXd& matrix)
{
  return invert(LongMatrix(matrix.cast<long double>())).cast<double>();
}

} // namespace uvol_test
