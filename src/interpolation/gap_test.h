// SPDX-License-Identifier: BSD-3-Clause
// Errors at samples that are left out with those around them that are nearer than gaps
// of the sampling are wide: what a stretching of space is worth.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Some samples of all parts of a set, some of which are asked for. */
class PCL_UVOL_EXPORTS GapTest {
public:
  /** \param samples stretched so that they spread alike along all axes
   * \param values in leaf order
   * \param dimensions of space that the samples spread in, 1 to 3 */
  GapTest(const SampleSet& samples,
          const std::vector<double>& values,
          int dimensions,
          unsigned threads);

  /** \brief Number of samples that are asked for. */
  std::size_t
  size() const
  {
    return asked_.size();
  }

  /** \brief Roots of the absolute errors there, kriged from the nearest samples by the
   * variogram h, with a linear trend where these lie all around.
   * \param factors per axis, on top of those of the samples */
  std::vector<double>
  computeErrors(const Eigen::Array3d& factors, unsigned threads) const;

private:
  struct Asked {
    std::size_t sample;
    double sq_width; ///< samples that are no farther are left out with it
  };

  double
  findWidth(std::size_t sample, int dimensions) const;

  double
  computeError(const Asked& asked, const Eigen::Array3d& factors) const;

  std::vector<Eigen::Vector3d> places_;
  std::vector<double> values_;
  std::vector<Asked> asked_;
};

} // namespace pcl_uvol::detail
