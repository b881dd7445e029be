// SPDX-License-Identifier: BSD-3-Clause
// Bytes of fields interpolated between samples, at their peak.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

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

/** \brief How many samples matter to queries: all of them, those about a plane or those
 * about a line. */
enum class QueryShape { Space, Plane, Line };

/** \brief Of a FieldInterpolator that answers queries, besides the cloud.
 * \param fields number of them
 * \param queries that are answered at a time */
PCL_UVOL_EXPORTS double
interpolationBytes(double samples,
                   double fields,
                   const InterpolationParameters& parameters,
                   double queries,
                   QueryShape shape);

/** \brief Least of a FieldInterpolator before it answers: fits are made where queries
 * are. */
inline double
leastInterpolationBytes(double samples,
                        double fields,
                        const InterpolationParameters& parameters)
{
  return interpolationBytes(samples, fields, parameters, 0.0, QueryShape::Line);
}

/** \brief Of the queries of a FieldInterpolator and their answers. */
PCL_UVOL_EXPORTS double
answerBytes(double queries, double fields, const InterpolationParameters& parameters);

} // namespace pcl_uvol
