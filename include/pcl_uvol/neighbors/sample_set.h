// SPDX-License-Identifier: BSD-3-Clause
// The samples in leaf order of a bit-indexed kd-tree: one immutable copy that every
// stage on the same cloud shares (thesis 2.2.1).
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/neighbors/kd_tree.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_uvol {

/** \brief Finite, distinct samples in leaf order with the tree over them.
 *
 * "Sample index" means leaf order, which depends on coordinates alone; getInputIndex
 * gives the index in the input cloud. Memory: 24 bytes per sample. */
class PCL_UVOL_EXPORTS SampleSet {
public:
  using ConstPtr = std::shared_ptr<const SampleSet>;

  /** \brief Build from count positions.
   * \param xyz first coordinate of point 0; point i starts stride floats further on
   * \param use indices of the points to take, in any order; those with a non-finite
   * coordinate are left out and counted as "non_finite"
   * \param scale factors per axis: distances are measured in the stretched space
   * \param report gets the counts "non_finite" and "duplicates" and the time of "tree"
   * Exact duplicates become one sample, see getMembers. */
  static ConstPtr
  build(const float* xyz,
        std::size_t stride,
        const std::vector<std::uint32_t>& use,
        const Position& scale,
        unsigned threads,
        Report& report);

  std::size_t
  size() const
  {
    return positions_.size();
  }

  /** \brief Positions in leaf order, stretched by the scale. */
  const std::vector<Position>&
  getPositions() const
  {
    return positions_;
  }

  const KdTree&
  getTree() const
  {
    return tree_;
  }

  /** \brief Factors per axis from the input's coordinates to those of the samples. */
  const Position&
  getScale() const
  {
    return scale_;
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
    std::vector<std::uint32_t> members; ///< input indices, ascending
  };

  /** \brief All samples that stand for several input points, by sample index. */
  const std::vector<Merged>&
  getMerged() const
  {
    return merged_;
  }

private:
  SampleSet() = default;

  Position scale_{{1.0f, 1.0f, 1.0f}};
  std::vector<Position> positions_;
  std::vector<std::uint32_t> input_indices_;
  std::vector<Merged> merged_;
  KdTree tree_;
};

} // namespace pcl_uvol
