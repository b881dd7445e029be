// SPDX-License-Identifier: BSD-3-Clause
// How far values lie off the quadratics through them.
#pragma once

#include "neighbors/nearest_finder.h"
#include "neighbors/sample_set.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The standard deviation of values about their least-squares quadratic; 0 where
 * there are no more values than terms.
 * \param row samples around a centre, one of which it is
 * \param reach to the farthest, about
 * \param f by sample */
double
measureResidual(const SampleSet& samples,
                std::uint32_t center,
                const NearestFinder::Row& row,
                double reach,
                const std::vector<float>& f);

} // namespace pcl_uvol
