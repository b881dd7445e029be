// SPDX-License-Identifier: BSD-3-Clause
// The samples in leaf order of a bit-indexed kd-tree: one immutable copy that every
// stage on the same cloud shares (thesis 2.2.1).
#pragma once

#include "neighbors/kd_tree.h"
#include "neighbors/length_unit.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Finite, distinct samples in leaf order with the tree over them.
 *
 * Samples are kept in a unit of length of their own, a power of two near their median
 * distance from the origin: nothing inside needs to care for the unit of the input.
 * getScale() and getUnit() lead back to it, exactly.
 *
 * "Sample index" means leaf order, which depends on coordinates alone; getInputIndex
 * gives the index in the input cloud. Memory: 26 to 36 bytes per sample.
 *
 * A set may be a piece of a larger one: it then holds, besides its own samples, some of
 * other pieces around them, its halo, each block of which has a tree of its own.
 * Indices follow the leaf order of the whole; see Piece. */
class PCL_UVOL_EXPORTS SampleSet {
public:
  using ConstPtr = std::shared_ptr<const SampleSet>;

  /** \brief What a piece of a larger set is made of. */
  struct Parts {
    std::vector<Position> positions; ///< samples, behind them those that planes name
    std::size_t size = 0;            ///< samples
    std::vector<KdTree> trees;       ///< placed, ascending
    std::size_t own = 0;             ///< the tree of the piece; the others are its halo
    LengthUnit unit;
  };

  SampleSet(const SampleSet&) = delete;
  SampleSet&
  operator=(const SampleSet&) = delete;

  /** \brief A piece; it knows no input indices. */
  explicit SampleSet(Parts&& parts)
      : parts_(std::move(parts))
  {
  }

  /** \brief The parts back, to add to them. */
  Parts
  take() &&
  {
    return std::move(parts_);
  }

  /** \brief Build from count positions.
   * \param xyz first coordinate of point 0; point i starts stride floats further on
   * \param use indices of the points to take, in any order; those with a non-finite
   * coordinate are left out and counted as "non_finite"
   * \param scale factors per axis: distances are measured in the stretched space
   * \param report gets the counts "non_finite" and "duplicates" and the time of "tree";
   * points so far out that float cannot measure distances to them are left out, with
   * the count "far_points" and a warning.
   * Exact duplicates become one sample, see getMerged.
   * \throws InvalidArgument if no sample is left, and for factors that take
   * coordinates out of the range of float */
  static ConstPtr
  build(const float* xyz,
        std::size_t stride,
        const std::vector<std::uint32_t>& use,
        const Position& scale,
        unsigned threads,
        Report& report,
        SplitRule rule = SplitRule::Cycle);

  /** \brief The same in a unit that is known, that of other samples, say. */
  static ConstPtr
  buildInUnit(const float* xyz,
              std::size_t stride,
              const std::vector<std::uint32_t>& use,
              const LengthUnit& unit,
              unsigned threads,
              Report& report,
              SplitRule rule = SplitRule::Cycle);

  std::size_t
  size() const
  {
    return parts_.size;
  }

  /** \brief Positions in leaf order, stretched by getScale(); there may be more of them
   * than samples. */
  const std::vector<Position>&
  getPositions() const
  {
    return parts_.positions;
  }

  /** \brief The tree over all samples but the halo. */
  const KdTree&
  getTree() const
  {
    return parts_.trees[parts_.own];
  }

  /** \brief That tree and those of the halo, ascending by their samples. */
  const std::vector<KdTree>&
  getTrees() const
  {
    return parts_.trees;
  }

  /** \brief Factors per axis from the input's coordinates to those of the samples. */
  const Position&
  getScale() const
  {
    return parts_.unit.scale;
  }

  /** \brief The same, with the power of two among them that is not the caller's. */
  const LengthUnit&
  getUnit() const
  {
    return parts_.unit;
  }

  /** \brief Index in the input cloud of a sample: of several merged points the lowest.
   */
  std::uint32_t
  getInputIndex(std::size_t sample) const
  {
    return input_indices_[sample];
  }

  /** \brief A sample that stands for several input points. */
  struct Merged {
    std::uint32_t sample;
    NeighborGraph::Row members; ///< input indices, ascending; they live in the set
  };

  /** \brief All samples that stand for several input points, by sample index. */
  const std::vector<Merged>&
  getMerged() const
  {
    return merged_;
  }

private:
  SampleSet() = default;

  Parts parts_;
  std::vector<std::uint32_t> input_indices_;
  std::vector<Merged> merged_;
  std::vector<std::uint32_t> members_; ///< of all merged samples
};

} // namespace pcl_uvol
