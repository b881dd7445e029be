// SPDX-License-Identifier: BSD-3-Clause
// Means and covariances of clusters: all that a projection is chosen by.
#pragma once

#include "multivariate/attributes.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Number, mean and sum of squares about the mean (upper triangle) of some rows.
 */
struct Moments {
  double count = 0.0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd scatter;

  /** \brief The sums divided by the number of rows. */
  Eigen::MatrixXd
  covariance() const;

  /** \brief Take in those of other rows. */
  void
  join(const Moments& other);
};

/** \brief Moments of the noise, which may be no rows, and then of the clusters by
 * label.
 * \param labels one per row; negative ones are noise
 * \throws InvalidArgument for a table without rows or columns, or sizes that disagree
 */
std::vector<Moments>
momentsPerCluster(const AttributeTable& table,
                  const std::vector<std::int32_t>& labels,
                  unsigned threads);

} // namespace pcl_uvol
