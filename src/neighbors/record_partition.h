// SPDX-License-Identifier: BSD-3-Clause
// Parting records at a cut by their coordinate along an axis, which is most of the work
// of building a tree.
#pragma once

#include "neighbors/kd_tree.h"
#include "neighbors/tree_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_uvol {

/** \brief The neighbours of a cut through records. */
struct RecordCut {
  const SampleRecord* below; ///< the last of the lower part in the total order
  float above;               ///< the least coordinate of the upper part
  bool is_among_equals;      ///< whether one position stands on both sides
};

/** \brief Parts records at cuts. */
class RecordPartition {
public:
  explicit RecordPartition(const TreeKernels& kernels)
      : kernels_(kernels)
  {
  }

  /** \brief Part records by the total order along an axis.
   * \param cut first of the upper part */
  RecordCut
  partAtCut(SampleRecord* first, SampleRecord* cut, SampleRecord* last, int axis) const
  {
    // All records before low are less than those between, all from high on are not.
    SampleRecord *low = first, *high = last;
    int by = axis; // that of the three coordinates which tells them apart
    while (true) {
      const float pivot = choosePivot(low, cut, high, by);
      SampleRecord* boundary = partition(low, high, [&](const SampleRecord& record) {
        return record.position[by] < pivot;
      });
      if (boundary == low) { // the pivot is the least
        boundary = partition(low, high, [&](const SampleRecord& record) {
          return !(pivot < record.position[by]);
        });
        if (boundary > cut) {
          // Equal coordinates on both sides of the cut: the next one decides.
          high = boundary;
          by = nextAxis(by);
          if (by == axis)
            return {cut, pivot, true}; // there will be no plane
          continue;
        }
      }
      if (boundary == cut)
        return {lastOf(low, cut, axis), leastOf(cut, high, axis), false};
      (boundary < cut ? low : high) = boundary;
    }
  }

private:
  /** A record in one register: piece by piece it would move at half the speed. */
  using RecordRegister =
      float __attribute__((vector_size(sizeof(SampleRecord)), aligned(4), may_alias));

  /** Bring low records to the front; returns the first of the others. Free of branches
   * that depend on the data: they would be mispredicted every other time. */
  template <typename IsLow>
  static SampleRecord*
  partition(SampleRecord* first, SampleRecord* last, const IsLow& is_low)
  {
    SampleRecord* boundary = first;
    for (SampleRecord* record = first; record != last; ++record) {
      const bool moves = is_low(*record);
      const RecordRegister moved = *reinterpret_cast<RecordRegister*>(record);
      *reinterpret_cast<RecordRegister*>(record) =
          *reinterpret_cast<RecordRegister*>(boundary);
      *reinterpret_cast<RecordRegister*>(boundary) = moved;
      boundary += static_cast<std::ptrdiff_t>(moves);
    }
    return boundary;
  }

  /** Of few records the coordinate at the cut. Of more a value that leaves the cut in
   * the smaller part: sampled at the cut's quantile, moved to the far side by twice the
   * standard error of a median of the sample (Floyd and Rivest 1975). */
  float
  choosePivot(const SampleRecord* first,
              const SampleRecord* cut,
              const SampleRecord* last,
              int axis) const
  {
    constexpr std::ptrdiff_t few = TreeKernels::most_values, many = 1 << 13;
    const std::ptrdiff_t count = last - first;
    if (count >= many)
      return sampleQuantile<256>(
          first, cut - first, count, axis, [](float* values, int size, int rank) {
            std::nth_element(values, values + rank, values + size);
            return values[rank];
          });
    if (count > few)
      return sampleQuantile<few>(first, cut - first, count, axis, kernels_.valueAtRank);
    float values[few] = {}; // whole registers are read
    for (std::ptrdiff_t i = 0; i < count; ++i)
      values[i] = first[i].position[axis];
    return kernels_.valueAtRank(
        values, static_cast<int>(count), static_cast<int>(cut - first));
  }

  template <std::ptrdiff_t size, typename ValueAtRank>
  static float
  sampleQuantile(const SampleRecord* first,
                 std::ptrdiff_t cut,
                 std::ptrdiff_t count,
                 int axis,
                 const ValueAtRank& value_at_rank)
  {
    const auto margin =
        static_cast<std::ptrdiff_t>(std::sqrt(static_cast<double>(size)));
    float values[size];
    for (std::ptrdiff_t i = 0; i < size; ++i)
      values[i] = first[i * count / size].position[axis];
    const std::ptrdiff_t quantile = cut * size / count;
    const std::ptrdiff_t rank = std::clamp<std::ptrdiff_t>(
        2 * cut < count ? quantile + margin : quantile - margin, 0, size - 1);
    return value_at_rank(values, static_cast<int>(size), static_cast<int>(rank));
  }

  static const SampleRecord*
  lastOf(const SampleRecord* first, const SampleRecord* end, int axis)
  {
    return std::max_element(
        first, end, [axis](const SampleRecord& a, const SampleRecord& b) {
          return lessAlong(axis, a.position, b.position);
        });
  }

  static float
  leastOf(const SampleRecord* first, const SampleRecord* end, int axis)
  {
    float least = first->position[axis];
    for (; first != end; ++first)
      least = std::min(least, first->position[axis]);
    return least;
  }

  const TreeKernels& kernels_;
};

} // namespace pcl_uvol
