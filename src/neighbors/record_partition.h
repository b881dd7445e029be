// SPDX-License-Identifier: BSD-3-Clause
// Parting records at a cut by their coordinate along an axis, which is most of the work
// of building a tree.
#pragma once

#include "neighbors/kd_tree.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace pcl_uvol {

/** Below this many records a pivot is the median of three, above it comes from a sample
 * of 32, and of 256 among very many. */
constexpr std::ptrdiff_t sampled_pivot_records = 128,
                         well_sampled_pivot_records = 1 << 13;
constexpr std::ptrdiff_t small_sample = 32, large_sample = 256;
/** Ranges this short are sorted by counting. */
constexpr std::ptrdiff_t counted_records = 16;

template <int axis>
inline bool
lessRecord(const SampleRecord& a, const SampleRecord& b)
{
  return lessAlong(axis, a.position, b.position);
}

/** A record in one register: piece by piece it would move at half the speed. */
using RecordRegister =
    float __attribute__((vector_size(sizeof(SampleRecord)), aligned(4), may_alias));

/** Bring records below the pivot to the front; returns the first of the others. Free of
 * branches that depend on the data: they would be mispredicted every other time. */
template <int axis>
SampleRecord*
partitionBelow(SampleRecord* first, SampleRecord* last, float pivot)
{
  SampleRecord* boundary = first;
  for (SampleRecord* record = first; record != last; ++record) {
    const RecordRegister moved = *reinterpret_cast<RecordRegister*>(record);
    *reinterpret_cast<RecordRegister*>(record) =
        *reinterpret_cast<RecordRegister*>(boundary);
    *reinterpret_cast<RecordRegister*>(boundary) = moved;
    boundary += static_cast<std::ptrdiff_t>(moved[axis] < pivot);
  }
  return boundary;
}

/** A pivot that leaves the cut in the smaller part: sampled at the cut's quantile,
 * moved to the far side by twice the standard error of a median of the sample (Floyd
 * and Rivest 1975). */
template <int axis>
float
choosePivot(const SampleRecord* first,
            const SampleRecord* cut,
            const SampleRecord* last)
{
  const std::ptrdiff_t count = last - first;
  if (count < sampled_pivot_records) {
    const float a = first->position[axis], b = first[count / 2].position[axis],
                c = first[count - 1].position[axis];
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
  const bool many = count >= well_sampled_pivot_records;
  const std::ptrdiff_t size = many ? large_sample : small_sample;
  const std::ptrdiff_t margin = many ? 16 : 5; // root of the size
  float sample[large_sample];
  for (std::ptrdiff_t i = 0; i < size; ++i)
    sample[i] = first[i * count / size].position[axis];
  const std::ptrdiff_t quantile = (cut - first) * size / count;
  const std::ptrdiff_t rank = std::clamp<std::ptrdiff_t>(
      2 * (cut - first) < count ? quantile + margin : quantile - margin, 0, size - 1);
  std::nth_element(sample, sample + rank, sample + size);
  return sample[rank];
}

/** Sort at most that many records by coordinate: each goes to the place that the number
 * of lesser ones names. */
template <int axis, int most>
void
sortByCounting(SampleRecord* first, std::ptrdiff_t count)
{
  SampleRecord record[most];
  float key[most];
  std::fill(key, key + most, std::numeric_limits<float>::infinity());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    record[i] = first[i];
    key[i] = record[i].position[axis];
  }
  for (int i = 0; i < count; ++i) {
    int lesser = 0;
    for (int j = 0; j < most; ++j)
      lesser += static_cast<int>(key[j] < key[i]) |
                (static_cast<int>(key[j] == key[i]) & static_cast<int>(j < i));
    first[lesser] = record[i];
  }
}

template <int axis>
void
sortFew(SampleRecord* first, SampleRecord* last)
{
  const std::ptrdiff_t count = last - first;
  if (count == 2) {
    if (first[1].position[axis] < first[0].position[axis])
      std::swap(first[0], first[1]);
  }
  else if (count <= 4)
    sortByCounting<axis, 4>(first, count);
  else if (count <= 8)
    sortByCounting<axis, 8>(first, count);
  else
    sortByCounting<axis, counted_records>(first, count);
}

/** Part records by the total order along an axis: the cut is the first of the upper
 * part.
 * \return the last record of the lower part and the first of the upper one by that
 * order */
template <int axis>
std::pair<SampleRecord*, SampleRecord*>
partAtCut(SampleRecord* const first, SampleRecord* const cut, SampleRecord* const last)
{
  // All records before low are less, all from high on are not less than those between.
  SampleRecord *low = first, *high = last;
  while (high - low > counted_records) {
    SampleRecord* const boundary =
        partitionBelow<axis>(low, high, choosePivot<axis>(low, cut, high));
    if (boundary == cut)
      return {std::max_element(low, cut, lessRecord<axis>),
              std::min_element(cut, high, lessRecord<axis>)};
    if (boundary == low) // nothing below the pivot: many equal coordinates
      break;
    (boundary < cut ? low : high) = boundary;
  }
  if (high - low <= counted_records) {
    sortFew<axis>(low, high);
    SampleRecord* below = cut - 1;
    while (below > low && below[-1].position[axis] == cut[-1].position[axis])
      --below;
    if (cut[-1].position[axis] < cut->position[axis])
      return {std::max_element(below, cut, lessRecord<axis>),
              std::min_element(cut, high, lessRecord<axis>)};
  }
  // Equal coordinates on both sides of the cut: the other coordinates decide.
  std::nth_element(first, cut - 1, last, lessRecord<axis>);
  return {cut - 1, std::min_element(cut, last, lessRecord<axis>)};
}

} // namespace pcl_uvol
