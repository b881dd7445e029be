// SPDX-License-Identifier: BSD-3-Clause
// The scalar field of a cloud at its samples: what every stage on scattered values
// starts from.
#pragma once

#include "common/large_array.h"
#include "common/scalar_field.h"
#include "common/value_frame.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/stage.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
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
  reserveLarge(use, indices.size());
  for (const int index : indices)
    if (!std::isnan(values[static_cast<std::size_t>(index)]))
      use.push_back(static_cast<std::uint32_t>(index));
  if (use.empty())
    throw InvalidArgument("no_finite_value", {{"field", field.getName()}});
  return use;
}

/** \brief The scalar in leaf order. */
struct SampleValues {
  std::vector<float> values;
  std::vector<std::uint32_t> sources; ///< input index whose fields isopoints carry
};

/** \brief What stands for members that coincide. */
template <typename Value>
struct Representative {
  std::uint32_t source; ///< the first member that has the lower middle value
  Value value;          ///< the median
};

/** \brief The median of values at one place: that of an even number is the mean of the
 * two in the middle, as the lower one alone would draw surfaces to one side. The mean
 * of two numbers of classes is none of them, but lies on the border of both, as an
 * isosurface between them has to.
 * \param members in their order; come out sorted by value
 * \param value_of a member
 * \param conflicting gets one more if values differ */
template <typename ValueOf>
auto
findRepresentative(std::vector<std::uint32_t>& members,
                   const ValueOf& value_of,
                   std::uint64_t& conflicting)
{
  using Value = std::decay_t<decltype(value_of(members.front()))>;
  std::stable_sort(members.begin(), members.end(), [&](auto a, auto b) {
    return value_of(a) < value_of(b);
  });
  conflicting += value_of(members.front()) != value_of(members.back());
  const Value lower = value_of(members[(members.size() - 1) / 2]);
  const Value upper = value_of(members[members.size() / 2]);
  const std::uint32_t source =
      *std::find_if(members.begin(), members.end(), [&](auto member) {
        return value_of(member) == lower;
      });
  // Halves are added, as the sum may be beyond all numbers.
  const double mean =
      0.5 * static_cast<double>(lower) + 0.5 * static_cast<double>(upper);
  return Representative<Value>{source, static_cast<Value>(mean)};
}

/** \brief Bring values into leaf order; a merged sample takes the median of its
 * members' values, see findRepresentative.
 * \param report gets the count "conflicting_duplicates": merged samples of unequal
 * values; and a warning if there are many */
SampleValues
gatherValues(const SampleSet& samples,
             const std::vector<float>& input_values,
             unsigned threads,
             Report& report);

} // namespace pcl_uvol
