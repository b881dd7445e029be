// SPDX-License-Identifier: BSD-3-Clause
// Eigen's solvers of matrices whose size is known at run time, compiled once: every
// source that uses one would take the compiler some ten seconds more. Matrices and
// right sides are to be Eigen::MatrixXd or Eigen::VectorXd, not expressions of these.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>

#define PCL_UVOL_EIGEN_SOLVER(declaration, Solver)                                     \
  declaration template class Solver<MatrixXd>;                                         \
  declaration template Solver<MatrixXd>& Solver<MatrixXd>::compute(                    \
      const EigenBase<MatrixXd>&);                                                     \
  declaration template void Solver<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&)  \
      const;                                                                           \
  declaration template void Solver<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&)  \
      const;

#define PCL_UVOL_EIGEN_SOLVERS(declaration)                                            \
  namespace Eigen {                                                                    \
  PCL_UVOL_EIGEN_SOLVER(declaration, ColPivHouseholderQR)                              \
  PCL_UVOL_EIGEN_SOLVER(declaration, CompleteOrthogonalDecomposition)                  \
  PCL_UVOL_EIGEN_SOLVER(declaration, LLT)                                              \
  }

PCL_UVOL_EIGEN_SOLVERS(extern)
