// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/quadratic_residuals.h"

#include "common/eigen_solvers.h"
#include "levelset/quadratic_terms.h"

#include <Eigen/QR>

#include <cmath>

namespace pcl_uvol {

double
measureResidual(const SampleSet& samples,
                std::uint32_t center,
                const NearestFinder::Row& row,
                double reach,
                const std::vector<float>& f)
{
  const auto rows = static_cast<Eigen::Index>(row.size);
  if (rows <= quadratic_terms)
    return 0.0;
  const auto& positions = samples.getPositions();
  Eigen::MatrixXd a(rows, quadratic_terms);
  Eigen::VectorXd b(rows);
  for (std::size_t j = 0; j < row.size; ++j) {
    const auto r = static_cast<Eigen::Index>(j);
    a.row(r) = quadraticTerms(positions[center], positions[row.samples[j]], reach);
    b[r] = f[row.samples[j]];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(a);
  const double sq_residual = (b - a * factor.solve(b)).squaredNorm();
  return std::sqrt(sq_residual / static_cast<double>(rows - factor.rank()));
}

} // namespace pcl_uvol
