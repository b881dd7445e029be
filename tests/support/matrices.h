// SPDX-License-Identifier: BSD-3-Clause
// Matrices of any size, of whose decompositions each unit that holds them takes seconds
// and hundreds of MB to compile.
#pragma once

#include <Eigen/Core>

namespace uvol_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

/** \brief A rotation that mixes all attributes. */
MatrixXd
mixing(Index size);

/** \brief Products of what columns differ from their mean by, summed up. */
MatrixXd
computeScatter(const MatrixXd& columns);

/** \brief Eigenvectors of a symmetric matrix, by ascending eigenvalues. */
MatrixXd
computeEigenvectors(const MatrixXd& symmetric);

} // namespace uvol_test
