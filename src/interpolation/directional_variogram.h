// SPDX-License-Identifier: BSD-3-Clause
// How the difference of two values grows with the offset of their samples along each
// axis, and the factors per axis that make it a function of distance.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_uvol::detail {

/** \brief Pairs of samples with about the same offset along each axis. */
struct OffsetClass {
  Eigen::Array3d sq_offset; ///< mean of the squares
  double log_difference;    ///< logarithm of what values differ by, squared and robust
  double weight;            ///< below 1, the more pairs the nearer to it
};

/** \brief Classes of pairs: of samples out of all parts of the set, and of each of
 * these with those near it. Classes double their width with the offset, so that short
 * ones count as much as long ones.
 *
 * What values differ by is the fourth power of the mean root of absolute differences
 * (Cressie and Hawkins 1980).
 * \param values in leaf order
 * \param spread of the samples along every axis: they are stretched to be so */
PCL_UVOL_EXPORTS std::vector<OffsetClass>
classifyPairs(const SampleSet& samples,
              const std::vector<double>& values,
              double spread);

/** \brief The share of the variance of the logarithms over classes that the stretched
 * distance explains, if differences grow with it: by monotone regression.
 * \param log_factors logarithms of factors per axis */
PCL_UVOL_EXPORTS double
explainedBy(const std::vector<OffsetClass>& classes, const Eigen::Array3d& log_factors);

/** \brief Logarithms of factors that explain most, sought from several starts along one
 * axis after the other. */
PCL_UVOL_EXPORTS Eigen::Array3d
fitFactors(const std::vector<OffsetClass>& classes,
           const std::vector<Eigen::Array3d>& starts);

} // namespace pcl_uvol::detail
