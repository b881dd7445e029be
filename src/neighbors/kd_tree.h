// SPDX-License-Identifier: BSD-3-Clause
// The bit-indexed kd-tree of thesis 2.2.1: every sample has a leaf cell of its own,
// nodes are numbered so that family relations are bit operations, touching cells are
// found from the numbers (2.2.2 - 2.2.4).
#pragma once

#include "common/large_array.h"
#include "neighbors/tree_kernel.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Three coordinates without PCL's padding. */
struct Position {
  float x[3];

  float
  operator[](int axis) const
  {
    return x[axis];
  }
  float&
  operator[](int axis)
  {
    return x[axis];
  }
};

/** \brief Three numbers that come with an index operator, as a position. */
template <typename T>
Position
toPosition(const T& numbers)
{
  return {{numbers[0], numbers[1], numbers[2]}};
}

/** \brief A position times factors per axis. Adding zero turns -0 into 0, which compare
 * as equal. */
inline Position
stretched(const Position& position, const Position& scale)
{
  return {{position[0] * scale[0] + 0.0f,
           position[1] * scale[1] + 0.0f,
           position[2] * scale[2] + 0.0f}};
}

/** \brief A position and where it comes from: what the tree is built from. */
struct SampleRecord {
  Position position;
  std::uint32_t input_index;
};

using SampleRecords = LargeArray<SampleRecord>;

/** \brief The next axis: y after x, z after y, x after z. */
constexpr int
nextAxis(int axis)
{
  return axis == 2 ? 0 : axis + 1;
}

/** \brief Total order along an axis: by that coordinate, then the other two in cyclic
 * order. It tells distinct positions apart, so that samples with equal coordinates give
 * one tree whatever their order in the input. */
inline bool
lessAlong(int axis, const Position& a, const Position& b)
{
  if (a[axis] != b[axis])
    return a[axis] < b[axis];
  const int second = nextAxis(axis);
  if (a[second] != b[second])
    return a[second] < b[second];
  const int third = nextAxis(second);
  return a[third] < b[third];
}

/** \brief A node and the samples below it, which are consecutive in leaf order. */
struct KdNode {
  std::uint64_t number; ///< root 1, children 2j and 2j+1
  std::uint32_t begin;  ///< first sample
  std::uint32_t count;  ///< samples; 1 for a leaf
  int depth;            ///< root 0

  bool
  isLeaf() const
  {
    return count == 1;
  }
  /** \brief The left half takes the odd sample. */
  KdNode
  left() const
  {
    return {number << 1, begin, (count + 1) / 2, depth + 1};
  }
  KdNode
  right() const
  {
    const std::uint32_t half = (count + 1) / 2;
    return {(number << 1) | 1, begin + half, count - half, depth + 1};
  }
};

/** \brief The cell of a node: per axis the planes that bound it, infinite at the border
 * of the domain. */
struct KdCell {
  std::array<SplitPlane, 3> low, high;
};

/** \brief The smallest box around samples. A cell reaches across the gap beside it, a
 * box does not. */
struct KdBox {
  Position low, high;
};

/** \brief Axis of the splits at each depth. */
using AxisCycle = std::array<std::int8_t, 64>;

/** \brief Which axis a node is split along. */
enum class SplitRule {
  Cycle,      ///< thesis 2.2.1: in turn over the axes along which the samples differ
  LongestSide ///< that of the cell's longest side within the samples' box, which keeps
              ///< cells compact where the density of samples varies along one axis
};

/** \brief Smallest and largest value of a scalar below every node, by node number;
 * leaves are the values themselves. */
struct PCL_UVOL_EXPORTS NodeRanges {
  struct Range {
    float min, max;

    /** \brief The range that holds both. */
    Range
    joined(const Range& other) const
    {
      return {std::min(min, other.min), std::max(max, other.max)};
    }
  };
  LargeArray<Range> inner;       ///< by node number
  const float* values = nullptr; ///< by sample, kept by the caller

  Range
  operator[](const KdNode& node) const
  {
    return node.isLeaf() ? Range{values[node.begin], values[node.begin]}
                         : inner[node.number];
  }
};

/** \brief The tree: by node number splitting planes, and boxes down to buckets. Memory:
 * 8 to 16 bytes per sample for planes, 1.5 to 3 for boxes, 1 to 2 for axes unless they
 * are a cycle. It refers to positions in
 * leaf order, which its owner (SampleSet) keeps. */
class PCL_UVOL_EXPORTS KdTree {
public:
  /** \brief A subtree of so many samples is a bucket: looking at all of them costs less
   * than looking for those that count (bench_nearest). */
  static constexpr std::uint32_t bucket_samples = 32;

  /** \brief Sort the records into leaf order and set the planes.
   * \param records at least one; finite positions, without -0
   * \return false if some records have equal positions: those then stand side by side,
   * and there is no tree, since their cells could not be told apart
   * \param step is advanced by the number of records */
  bool
  build(SampleRecords& records,
        unsigned threads,
        StepTimer& step,
        SplitRule rule = SplitRule::Cycle);

  /** \brief The same for a subtree of a larger tree, whose cycle of axes decides.
   * \param depth of the subtree's root in that tree */
  bool
  build(SampleRecords& records,
        const AxisCycle& axes,
        int depth,
        unsigned threads,
        StepTimer& step);

  /** \brief A cycle over some axes; over none, all zeros. */
  static AxisCycle
  cycleOver(const std::array<bool, 3>& axes);

  /** \brief Give the root of a subtree its cell, and its samples their place among
   * positions that hold other samples as well.
   * \param begin of the first one
   * \param cell planes whose samples are among the same positions */
  void
  place(std::uint32_t begin, const KdCell& cell);

  KdNode
  getRoot() const
  {
    return root_;
  }

  /** \brief The whole space, unless the root was given another cell. */
  const KdCell&
  getCell() const
  {
    return cell_;
  }

  /** \brief Axis at a depth of the cycle over the axes along which the samples differ,
   * which SplitRule::Cycle splits along. */
  int
  getAxis(int depth) const
  {
    return axis_at_depth_[static_cast<std::size_t>(depth)];
  }

  /** \brief Axis that a node, no leaf, is split along. */
  int
  getAxis(const KdNode& node) const
  {
    return axes_.empty() ? getAxis(node.depth) : axes_[node.number];
  }

  const SplitPlane&
  getPlane(const KdNode& node) const
  {
    return planes_[node.number];
  }

  static bool
  isBucket(const KdNode& node)
  {
    return node.count <= bucket_samples;
  }

  /** \brief The box around the samples of the root, or of a child of a node that is no
   * bucket. */
  const KdBox&
  getBox(const KdNode& node) const
  {
    return boxes_[node.number];
  }

  /** \brief The whole space. */
  static KdCell
  unboundedCell();

  /** \brief The cell of a sample. */
  KdCell
  findCell(std::uint32_t sample) const;

  /** \brief True if plane a lies below plane b in the total order along the axis
   * (ranks, not coordinates: cells of samples with equal coordinates have a thickness
   * of rank). */
  static bool
  isBelow(const std::vector<Position>& positions,
          int axis,
          const SplitPlane& a,
          const SplitPlane& b)
  {
    if (a.coordinate != b.coordinate)
      return a.coordinate < b.coordinate;
    return lessAlong(axis, positions[a.below_sample], positions[b.below_sample]);
  }

  /** \brief All samples whose closed cell shares a point with the cell of a sample
   * (Definition 2.4), each once, in no particular order.
   * \param touching cleared first */
  void
  findTouching(const std::vector<Position>& positions,
               std::uint32_t sample,
               std::vector<std::uint32_t>& touching) const;

  /** \brief Append all samples whose closed cell shares a point with a cell that lies
   * outside of the root's. */
  void
  findTouching(const std::vector<Position>& positions,
               const KdCell& cell,
               std::vector<std::uint32_t>& touching) const;

  /** \brief Range of the values below every node.
   * \param values in leaf order; must outlive the result */
  NodeRanges
  computeRanges(const std::vector<float>& values, unsigned threads) const;

  /** \brief The samples that touch a sample on the other side of an isovalue (a value
   * equal to it counts as above), ascending. Descends only pairs of touching nodes
   * whose common range holds the isovalue: the cost is that of the surface, not of the
   * data. */
  std::vector<std::uint32_t>
  findCrossing(const std::vector<Position>& positions,
               const NodeRanges& ranges,
               float isovalue,
               unsigned threads) const;

  /** \brief Append the samples that touch one of another tree, beside this one, on the
   * other side of an isovalue.
   * \param ranges of this tree; their values are those of the other one as well */
  void
  findCrossing(const std::vector<Position>& positions,
               const NodeRanges& ranges,
               float isovalue,
               const KdTree& other,
               std::vector<std::uint32_t>& crossing) const;

  /** \brief True if two closed cells share a point. */
  static bool
  touch(const std::vector<Position>& positions, const KdCell& a, const KdCell& b);

private:
  void
  searchSubtree(const std::vector<Position>& positions,
                const KdNode& subtree,
                int separating_axis,
                bool subtree_is_above,
                const KdCell& cell,
                std::vector<std::uint32_t>& touching) const;

  bool
  buildBy(SplitRule rule,
          SampleRecords& records,
          const AxisCycle& axes,
          int depth,
          unsigned threads,
          StepTimer& step);

  KdNode root_{1, 0, 0, 0};
  KdCell cell_ = unboundedCell();
  AxisCycle axis_at_depth_{};
  LargeArray<std::int8_t> axes_; // by node number; empty: those of the cycle
  LargeArray<SplitPlane> planes_;
  LargeArray<KdBox> boxes_;
};

} // namespace pcl_uvol
