// SPDX-License-Identifier: BSD-3-Clause
// The row of a least-squares fit by a quadratic.
#pragma once

#include "neighbors/kd_tree.h"

#include <Eigen/Core>

namespace pcl_uvol {

constexpr int quadratic_terms = 10;

/** \brief 1, coordinates, and their products, of a sample as seen from a centre; the
 * first coefficient of a fit is then its value at the centre.
 * \param reach length 1 */
inline Eigen::Matrix<double, 1, quadratic_terms>
quadraticTerms(const Position& center, const Position& sample, double reach)
{
  const auto along = [&](int axis) {
    return (static_cast<double>(sample[axis]) - center[axis]) / reach;
  };
  const double x = along(0), y = along(1), z = along(2);
  Eigen::Matrix<double, 1, quadratic_terms> row;
  row << 1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z;
  return row;
}

} // namespace pcl_uvol
