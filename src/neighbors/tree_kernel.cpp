// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/tree_kernel.h"

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

constexpr float infinity = __builtin_inff();

template <int registers>
float
valueAmong(const float* values, int count, int rank)
{
  Floats value[registers];
  Ints lesser[registers];
  for (int r = 0; r < registers; ++r) {
    value[r] = load<Floats>(values + r * lanes);
    value[r] = laneNumbers() + r * lanes < count ? value[r] : fill(infinity);
    lesser[r] = Ints{};
  }
  for (int i = 0; i < count; ++i)
    for (int r = 0; r < registers; ++r)
      lesser[r] -= fill(values[i]) < value[r];
  Floats largest = fill(-infinity);
  for (int r = 0; r < registers; ++r)
    largest = maximum(largest, lesser[r] <= rank ? value[r] : fill(-infinity));
  float found = largest[0];
  for (int lane = 1; lane < lanes; ++lane)
    found = found > largest[lane] ? found : largest[lane];
  return found;
}

/** In as few registers as hold the numbers. */
float
valueAtRank(const float* values, int count, int rank)
{
  constexpr int all = TreeKernels::most_values / lanes;
  if (count <= lanes)
    return valueAmong<1>(values, count, rank);
  if (all > 2 && count <= 2 * lanes)
    return valueAmong<2>(values, count, rank);
  return valueAmong<all>(values, count, rank);
}

#if defined(__AVX2__)

constexpr int records_per_register = lanes / 4;

/** As many records as a register holds; those from count on, which may be negative,
 * are 0. */
Floats
loadRecords(const float* records, int count)
{
  if (count >= records_per_register)
    return load<Floats>(records);
  Floats loaded{};
  if (count > 0)
    __builtin_memcpy(
        &loaded, records, 4 * sizeof(float) * static_cast<unsigned>(count));
  return loaded;
}

/** Every lane of a register from another lane of it. */
Ints
shuffled(const Ints& numbers, const Ints& from)
{
#if defined(__AVX512F__)
  return bitCast<Ints>(_mm512_maskz_permutexvar_epi32(
      0xffff, bitCast<__m512i>(from), bitCast<__m512i>(numbers)));
#else
  return bitCast<Ints>(
      _mm256_permutevar8x32_epi32(bitCast<__m256i>(numbers), bitCast<__m256i>(from)));
#endif
}

Floats
shuffled(const Floats& numbers, const Ints& from)
{
  return fromBits(shuffled(bitsOf(numbers), from));
}

/** Every lane from a lane of two registers. */
Floats
shuffled(const Floats& first, const Floats& second, const Ints& from)
{
  return from < lanes ? shuffled(first, from) : shuffled(second, from - lanes);
}

/** Samples of a subtree, one per lane. The samples of a node fill a group of lanes from
 * its first one on; what is left of a group has infinite coordinates. */
class SubtreeBuilder {
public:
  explicit SubtreeBuilder(const Subtree& subtree)
      : size_(fill(subtree.count))
      , subtree_(subtree)
  {
    const int count = subtree.count;
    Floats loaded[4];
    for (int r = 0; r < 4; ++r)
      loaded[r] =
          loadRecords(subtree.records + r * lanes, count - r * records_per_register);
    const Ints lane = laneNumbers();
    constexpr int half = lanes / 2;
    const Ints both = lane < half ? lane : lane + half;
    const auto column = [&](int number) {
      const Ints every_fourth = (4 * lane + number) & (2 * lanes - 1);
      return shuffled(shuffled(loaded[0], loaded[1], every_fourth),
                      shuffled(loaded[2], loaded[3], every_fourth),
                      both);
    };
    for (int axis = 0; axis < 3; ++axis)
      position_[axis] = lane < count ? column(axis) : fill(infinity);
    index_ = bitsOf(column(3));
    if (subtree.low != nullptr)
      for (int axis = 0; axis < 3; ++axis) {
        low_[axis] = fill(subtree.low[axis]);
        high_[axis] = fill(subtree.high[axis]);
      }
  }

  /** Part the nodes of a level and of those below.
   * \tparam group lanes per node
   * \tparam by_cell whether splits run across the longest sides of cells
   * \param number of the level's first node */
  template <int group, bool by_cell>
  void
  partFrom(std::uint64_t number, const std::int8_t* cycle)
  {
    if constexpr (group > 1) {
      part<group, by_cell>(by_cell ? 0 : *cycle, number);
      partFrom<group / 2, by_cell>(2 * number, by_cell ? nullptr : cycle + 1);
    }
  }

  /** True once samples of one node were found at one position. */
  bool
  hasEquals() const
  {
    return laneBits(is_equal_) != 0;
  }

  /** The records in leaf order. */
  void
  write() const
  {
    float coordinate[3][lanes];
    std::int32_t index[lanes], size[lanes];
    for (int axis = 0; axis < 3; ++axis)
      store(coordinate[axis], position_[axis]);
    store(index, index_);
    store(size, size_);
    float* record = subtree_.records;
    for (int lane = 0; lane < lanes; ++lane)
      if (size[lane] > 0) {
        for (int axis = 0; axis < 3; ++axis)
          record[axis] = coordinate[axis][lane];
        __builtin_memcpy(record + 3, index + lane, sizeof index[lane]);
        record += 4;
      }
  }

private:
  /** Part the nodes of a level.
   * \param axis of the splits unless they run by cells */
  template <int group, bool by_cell>
  void
  part(int axis, std::uint64_t number)
  {
    const Ints axis_of = by_cell ? findLongestSides() : fill(axis);
    const Ints lane = laneNumbers(), within = lane & (group - 1);
    const Ints lower_half = (size_ + 1) >> 1;
    const Ints rank = rankWithin<group>(axis_of);
    // Lower halves to the first lanes of a group, upper ones to the middle.
    const Ints to =
        lane - within + (rank < lower_half ? rank : rank - lower_half + group / 2);
    Ints from = lane;
    for (int step = 0; step < group; ++step) {
      const Ints other = lane - within + ((lane + step) & (group - 1));
      from = shuffled(to, other) == lane ? other : from;
    }
    const Ints sizes = size_;
    size_ = within >= group / 2 ? size_ - lower_half : lower_half;
    const Ints is_filled = (lane & (group / 2 - 1)) < size_;
    for (Floats& coordinate : position_)
      coordinate = is_filled ? shuffled(coordinate, from) : fill(infinity);
    index_ = shuffled(index_, from);
    writePlanes<group, by_cell>(axis_of, sizes, number);
  }

  static Floats
  choose(const Ints& axis, const Floats (&numbers)[3])
  {
    return axis == 0 ? numbers[0] : axis == 1 ? numbers[1] : numbers[2];
  }

  Ints
  findLongestSides() const
  {
    const Floats side[3] = {high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]};
    Ints longest = side[1] > side[0] ? fill(1) : fill(0);
    return side[2] > maximum(side[0], side[1]) ? fill(2) : longest;
  }

  /** Of every sample the number of those of its group before it in the total order. */
  template <int group>
  Ints
  rankWithin(const Ints& axis)
  {
    const Ints lane = laneNumbers(), within = lane & (group - 1);
    const Floats x = choose(axis, position_);
    Ints rank{}, is_tied{};
    for (int step = 1; step < group; ++step) {
      const Ints other = lane - within + ((lane + step) & (group - 1));
      const Floats other_x = shuffled(x, other);
      rank -= (other_x < x) | ((other_x == x) & (other < lane));
      is_tied |= other_x == x;
    }
    if (laneBits(is_tied & (within < size_)) == 0)
      return rank;
    // Samples of equal coordinates: the other two decide.
    const Ints second = axis == 2 ? fill(0) : axis + 1;
    const Floats y = choose(second, position_),
                 z = choose(second == 2 ? fill(0) : second + 1, position_);
    rank = Ints{};
    for (int step = 1; step < group; ++step) {
      const Ints other = lane - within + ((lane + step) & (group - 1));
      const Floats other_x = shuffled(x, other), other_y = shuffled(y, other),
                   other_z = shuffled(z, other);
      const Ints by_z = (other_z < z) | ((other_z == z) & (other < lane));
      const Ints by_y = (other_y < y) | ((other_y == y) & by_z);
      rank -= (other_x < x) | ((other_x == x) & by_y);
      is_equal_ |= (other_x == x) & (other_y == y) & (other_z == z) & (within < size_);
    }
    return rank;
  }

  template <int group, bool by_cell>
  void
  writePlanes(const Ints& axis, const Ints& sizes, std::uint64_t number)
  {
    float coordinate[lanes], plane_of[lanes];
    std::int32_t index[lanes], size[lanes], axis_of[lanes];
    store(coordinate, choose(axis, position_));
    store(index, index_);
    store(size, sizes);
    store(axis_of, axis);
    for (int begin = 0; begin < lanes; begin += group) {
      float plane = 0.0f;
      if (size[begin] > 1) {
        const int below = begin + (size[begin] + 1) / 2 - 1;
        plane = midway(coordinate[below], coordinate[begin + group / 2]);
        const std::uint64_t node = number + static_cast<std::uint64_t>(begin / group);
        subtree_.planes[node] = {plane, static_cast<std::uint32_t>(index[below])};
        if (by_cell)
          subtree_.axes[node] = static_cast<std::int8_t>(axis_of[begin]);
      }
      for (int lane = begin; by_cell && lane < begin + group; ++lane)
        plane_of[lane] = plane;
    }
    if (by_cell)
      cutCells(axis, load<Floats>(plane_of), laneNumbers() & (group / 2));
  }

  void
  cutCells(const Ints& axis, const Floats& plane, const Ints& is_above)
  {
    for (int a = 0; a < 3; ++a) {
      const Ints is_cut = axis == a;
      low_[a] = (is_cut & (is_above != 0)) ? plane : low_[a];
      high_[a] = (is_cut & (is_above == 0)) ? plane : high_[a];
    }
  }

  Floats position_[3], low_[3], high_[3];
  Ints index_, size_; // samples of the node that a lane belongs to
  Ints is_equal_{};   // to another one of its node
  const Subtree& subtree_;
};

bool
build(const Subtree& subtree)
{
  SubtreeBuilder builder(subtree);
  if (subtree.low != nullptr)
    builder.partFrom<lanes, true>(subtree.number, nullptr);
  else
    builder.partFrom<lanes, false>(subtree.number, subtree.cycle);
  builder.write();
  return !builder.hasEquals();
}

constexpr std::uint32_t most_in_registers = lanes;
#else
constexpr std::uint32_t most_in_registers = 1; // lanes cannot be shuffled freely
constexpr decltype(TreeKernels::build) build = nullptr;
#endif

} // namespace

const TreeKernels tree_kernels{valueAtRank, most_in_registers, build};

} // namespace pcl_uvol::PCL_UVOL_SIMD
