// SPDX-License-Identifier: BSD-3-Clause
// How the difference of two values grows with the distance of their samples (Chiles and
// Delfiner, Geostatistics, chapter 2): models, and models fitted to samples.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

struct SampledFields;

/** \brief Half the mean squared difference of two values: nugget + psill * (1 -
 * correlation(h / range)). */
struct PCL_UVOL_EXPORTS Variogram {
  VariogramKind kind = VariogramKind::Spherical;
  double nugget = 0.0; ///< of values that differ however close their samples are
  double psill = 0.0;  ///< the partial sill: without the nugget
  double range = 1.0;

  /** \brief The value of the part without the nugget.
   * \param h >= 0 */
  double
  covariance(double h) const;

  /** \brief Its derivative by h, divided by h: finite where the variogram is smooth. */
  double
  covarianceSlope(double h) const;

  double
  value(double h) const
  {
    return h > 0.0 ? nugget + psill - covariance(h) : 0.0;
  }
};

/** \brief Classes of distance, and what pairs of samples have in them. */
struct EmpiricalVariogram {
  std::vector<double> distance; ///< mean of the pairs
  std::vector<double> value;    ///< half the squared difference, by the estimator
  std::vector<double> pairs;    ///< number
};

/** \brief What pairs of samples have in all directions, and along single axes. */
struct EmpiricalVariograms {
  EmpiricalVariogram all;
  /** One for each axis, from pairs within 30 degrees of it; without classes where there
   * are none. */
  std::array<EmpiricalVariogram, 3> along;
};

/** \brief How differences of many pairs make one number. */
enum class VariogramEstimator {
  MeanSquare, ///< Matheron 1963; a few large values are all that it tells of
  MeanRoot    ///< from the mean root of absolute differences, robust against these;
              ///< unbiased for normal differences only (Cressie and Hawkins 1980)
};

/** \brief Bytes of the pairs that computeEmpiricalVariograms() looks at, at most. */
double
variogramBytes(double samples);

/** \brief Half squared differences of pairs of near samples, and of samples out of all
 * parts of the cloud, up to a third of its size.
 * \param metric from offsets of samples to those whose length and direction count
 * \param trend degree of a polynomial through all samples that is subtracted first: 0,
 * 1 or 2 */
EmpiricalVariograms
computeEmpiricalVariograms(
    const SampledFields& sampled,
    std::size_t field,
    const Eigen::Matrix3d& metric,
    int trend,
    VariogramEstimator estimator = VariogramEstimator::MeanSquare);

/** \brief Fit what a variogram lacks, its NaNs, by least squares weighted with the
 * number of pairs over the squared model (Cressie 1985). */
Variogram
fitVariogram(const EmpiricalVariogram& empirical, const Variogram& given);

/** \brief A variogram, and what it was fitted to. */
struct FittedVariogram {
  Variogram model;
  EmpiricalVariograms empirical;
};

/** \brief Terms of a polynomial of degree 0, 1 or 2. */
Eigen::Index
trendTerms(int degree);

/** \brief These terms at a place: 1, x, y, z, xx, xy, xz, yy, yz, zz. */
Eigen::RowVectorXd
trendAt(const Eigen::Vector3d& x, int degree);

} // namespace pcl_uvol::detail
