// SPDX-License-Identifier: BSD-3-Clause
// The memory of fields interpolated between samples.
#pragma once

#include "common/memory.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

namespace pcl_uvol {

/** \brief How many samples matter to queries: all of them, those about a plane or those
 * about a line. */
enum class QueryShape { Space, Plane, Line };

/** \brief What FieldInterpolator takes to be made, and to answer queries.
 * \param fields number of them
 * \param queries that are answered at a time */
PCL_UVOL_EXPORTS MemoryNeed
interpolationNeed(double samples,
                  double fields,
                  const InterpolationParameters& parameters,
                  double queries,
                  QueryShape shape);

} // namespace pcl_uvol
