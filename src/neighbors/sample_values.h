// SPDX-License-Identifier: BSD-3-Clause
// The scalar field of a cloud at its samples: what every stage on scattered values
// starts from.
#pragma once

#include "common/scalar_field.h"
#include "common/value_frame.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/stage.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The scalar of every input point in a frame: NaN where float holds no finite
 * value. */
std::vector<float>
readValues(const CloudView& cloud,
           const ScalarField& field,
           const ValueFrame& frame,
           unsigned threads);

/** \brief The indices whose point has a value.
 * \throws InvalidArgument if there is none */
template <typename Value>
std::vector<std::uint32_t>
pointsWithValue(const std::vector<Value>& values,
                const std::vector<int>& indices,
                const ScalarField& field)
{
  std::vector<std::uint32_t> use;
  use.reserve(indices.size());
  for (const int index : indices)
    if (!std::isnan(values[static_cast<std::size_t>(index)]))
      use.push_back(static_cast<std::uint32_t>(index));
  if (use.empty())
    throw InvalidArgument("No sample has a finite value of " + field.getName() + ".");
  return use;
}

/** \brief The scalar in leaf order. */
struct SampleValues {
  std::vector<float> values;
  std::vector<std::uint32_t> sources; ///< input index whose value it is
};

/** \brief Who stands for members that coincide: the first that has the lower median of
 * their values.
 * \param members in their order; come out sorted by value
 * \param value_of a member
 * \param conflicting gets one more if values differ */
template <typename ValueOf>
std::uint32_t
chooseRepresentative(std::vector<std::uint32_t>& members,
                     const ValueOf& value_of,
                     std::uint64_t& conflicting)
{
  std::stable_sort(members.begin(), members.end(), [&](auto a, auto b) {
    return value_of(a) < value_of(b);
  });
  conflicting += value_of(members.front()) != value_of(members.back());
  const auto median = value_of(members[(members.size() - 1) / 2]);
  return *std::find_if(members.begin(), members.end(), [&](auto member) {
    return value_of(member) == median;
  });
}

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
