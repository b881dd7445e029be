// SPDX-License-Identifier: BSD-3-Clause
// Whether a cloud still holds what it held when it was read: stages that keep what they
// made of a cloud notice by it that somebody has written into that cloud.
#pragma once

#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>

#include <cstdint>

namespace pcl_uvol {

/** \brief Hashes of what a stage reads of all points, each with its place in the cloud.
 * Different contents have equal ones by chance only, one time in 2^64. */
struct CloudFingerprint {
  std::uint64_t positions = 0;
  std::uint64_t values = 0; ///< of the components of a field, bit by bit
};

/** \brief The fingerprint of a cloud: one look at its points, which takes as long as
 * reading them from memory. */
CloudFingerprint
computeFingerprint(const CloudView& cloud, const ScalarField& field, unsigned threads);

} // namespace pcl_uvol
