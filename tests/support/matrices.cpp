// SPDX-License-Identifier: BSD-3-Clause
#include "support/matrices.h"

#include "common/random.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace uvol_test {

MatrixXd
mixing(Index size)
{
  MatrixXd numbers(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      numbers(i, j) =
          pcl_uvol::normalAt(11, static_cast<std::uint64_t>(i * size + j), 0);
  return Eigen::HouseholderQR<MatrixXd>(numbers).householderQ();
}

MatrixXd
computeScatter(const MatrixXd& columns)
{
  const MatrixXd about = columns.colwise() - columns.rowwise().mean();
  return about * about.transpose();
}

MatrixXd
computeEigenvectors(const MatrixXd& symmetric)
{
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric).eigenvectors();
}

} // namespace uvol_test
