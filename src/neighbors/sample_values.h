// SPDX-License-Identifier: BSD-3-Clause
// The scalar field of a cloud at its samples: what every stage on scattered values
// starts from.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/neighbors/sample_set.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The scalar of every input point: NaN where float holds no finite value. */
std::vector<float>
readValues(const CloudView& cloud, const ScalarField& field, unsigned threads);

/** \brief The indices whose point has a value. \throws InvalidArgument if there is none
 */
std::vector<std::uint32_t>
pointsWithValue(const std::vector<float>& values,
                const std::vector<int>& indices,
                const ScalarField& field);

/** \brief The scalar in leaf order. */
struct SampleValues {
  std::vector<float> values;
  std::vector<std::uint32_t> sources; ///< input index whose value it is
};

/** \brief Bring values into leaf order; a merged sample takes the lower median of its
 * members' values, and becomes the member that has it.
 * \param report gets the count "conflicting_duplicates": merged samples of unequal
 * values */
SampleValues
gatherValues(const SampleSet& samples,
             const std::vector<float>& input_values,
             unsigned threads,
             Report& report);

} // namespace pcl_uvol
