// SPDX-License-Identifier: BSD-3-Clause
// Bytes of fields interpolated between samples, at their peak.
#pragma once

#include <pcl_uvol/interpolation/field_interpolation.h>

namespace pcl_uvol {

/** \brief Of detail::computeDerivatives of three fields, with what goes in and comes
 * out. */
constexpr double
derivativeBytes(double points)
{
  return 160.0 * points;
}

/** \brief Of addSphDensity: samples with their tree, kernels, masses twice, densities.
 */
constexpr double
sphDensityBytes(double points)
{
  return (36.0 + 40.0 + 3 * 8.0 + 24.0) * points;
}

/** \brief Of a FieldInterpolator that answers queries, besides the cloud.
 * \param fields number of them */
double
interpolationBytes(double samples,
                   double fields,
                   const InterpolationParameters& parameters,
                   const detail::ExpectedQueries& expected);

/** \brief Of the queries of a FieldInterpolator and their answers. */
double
answerBytes(double queries, double fields, const InterpolationParameters& parameters);

} // namespace pcl_uvol
