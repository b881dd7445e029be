// SPDX-License-Identifier: BSD-3-Clause
// Bytes of fields interpolated between samples, at their peak.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

namespace pcl_uvol {

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

} // namespace pcl_uvol
