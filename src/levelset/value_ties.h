// SPDX-License-Identifier: BSD-3-Clause
// Values that many samples have in common, as those of eight bits, of classes or at the
// limit of a sensor.
#pragma once

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The share of some samples that have the value that most of them have.
 * \param values of all samples
 * \param samples at least one */
double
shareOfCommonest(const std::vector<float>& values,
                 const std::vector<std::uint32_t>& samples);

} // namespace pcl_uvol
