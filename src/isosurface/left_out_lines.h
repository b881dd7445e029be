// SPDX-License-Identifier: BSD-3-Clause
// What lies between lines of samples: a fit follows every sample on them, so that its
// residuals do not tell how far it is off elsewhere. Leaving one line after another out
// does.
#pragma once

#include "derivatives/fit_kernel.h"

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Lines of samples, in a metric in which these are as far apart along a line as
 * lines are. */
struct SampleLines {
  Eigen::Vector3d along = Eigen::Vector3d::Zero(); ///< unit vector
  double spacing = 0.0; ///< of samples and of lines; 0: samples lie on none
};

/** \param spacings its eigenvalues are squared spacings, its eigenvectors their
 * directions */
SampleLines
findLines(const Eigen::Matrix3d& spacings);

/** \brief Zero levels of fits without one line of samples or another; one object per
 * thread. */
class LeftOutLines {
public:
  /** \param fit that which made the results */
  explicit LeftOutLines(FitKernel fit);

  /** \brief The standard error of a zero level's place in radii of the support, from
   * how far it moves where one of the lines nearest to it is left out (the jackknife,
   * Miller 1974). It is smaller than that: a line that is left out leaves a gap twice
   * as wide as those that are there.
   * \param samples that the result of a lane is made from
   * \param lines with the spacing in radii of the support */
  double
  measureError(const std::vector<FitSample>& samples,
               std::size_t lane,
               const SampleLines& lines,
               const FitResult& result);

private:
  /** Tell the line of each sample, counted from the centre outwards. */
  void
  sortIntoLines(const std::vector<FitSample>& samples,
                std::size_t lane,
                const SampleLines& lines);

  /** Copy the samples of a lane to a lane that lacks a line.
   * \return how many have a weight */
  int
  copyWithout(std::size_t line,
              const std::vector<FitSample>& samples,
              std::size_t lane,
              std::size_t target);

  FitKernel fit_;
  std::vector<FitSample> rest_; ///< every lane without another line
  std::vector<std::pair<double, std::size_t>> order_;
  std::vector<Eigen::Vector3d> feet_; ///< by line: where it is next to the centre
  std::vector<std::size_t> lines_;    ///< by sample
};

} // namespace pcl_uvol
