// SPDX-License-Identifier: BSD-3-Clause
// The k nearest samples of points that lie anywhere, without an index of their own: the
// bit-indexed kd-tree hands out the samples of a box, which a run of close points
// shares.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/sample_set.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

struct NearestKernels;

/** \brief Nearest samples of one point after another; one object per thread.
 *
 * The answer depends on the point alone; the speed lives on points in spatial order.
 * Memory: some kilobytes. */
class PCL_UVOL_EXPORTS NearestFinder {
public:
  /** \brief Neighbours in leaf order. */
  struct Row {
    const std::uint32_t* samples;
    const float* sq_dists;
    std::size_t size;
  };

  /** \param samples must outlive the finder \param k >= 1 */
  NearestFinder(const SampleSet& samples, std::size_t k);

  /** \brief The k nearest, all samples where there are no more; of equally far ones
   * those of lower index. Valid until the next call. A sample at the point itself
   * counts. \param length about the distance of a neighbour, > 0; it only sets where
   * the first search starts */
  Row
  find(const Position& point, float length);

  /** \brief Those of the k nearest that are no farther than a radius, > 0; what else
   * the row holds is not known to be nearest. It may be empty. */
  Row
  findWithin(const Position& point, float radius);

  /** \brief Prepare for points that are looked up next: close ones then share one box.
   */
  void
  expect(const Position* points, std::size_t count);

private:
  /** Make the box; false, and no box, if too many samples lie in it. */
  bool
  gather(const Position& low, const Position& high, float margin);

  /** Make a box for a point, and for those expected with it where it is one of them. */
  bool
  gatherAround(const Position& point, float margin);

  bool
  gatherBelow(const KdTree& tree, const KdNode& node);

  /** Of the samples and their halo. */
  bool
  gatherFromAll();

  bool
  searchInBox(const Position& point, float length);

  /** Depth first through the tree, for any density. */
  void
  searchAlone(const Position& point);

  /** \param sq_bound least squared distance of the node's cell
   * \param offsets per axis, of the cell from the point */
  void
  descend(const Position& point,
          const KdTree& tree,
          const KdNode& node,
          float sq_bound,
          Position& offsets);

  /** Distance to the next face of the box: all samples within it are candidates. */
  float
  marginAt(const Position& point) const;

  void
  appendInside(std::uint32_t begin, std::uint32_t end);

  /** A squared distance that k candidates do not exceed, or more if the k-th has
   * equals.
   */
  float
  limitOfNearest();

  void
  select(const Position& point);

  Row
  found() const
  {
    return {found_samples_.data(), found_sq_dist_.data(), found_count_};
  }

  const SampleSet& samples_;
  std::size_t k_;
  const NearestKernels* kernels_;
  float reach_ = 0.0f; ///< distance of the farthest neighbour found last

  // A box around points to come, which a point outside of it ends.
  Position expected_low_{}, expected_high_{};
  bool is_expecting_ = false;

  // Candidates: all samples in a box. Arrays keep their greatest size.
  Position low_{}, high_{};
  static constexpr float no_box = -1.0f;
  float margin_ = no_box; ///< of the box around its points
  std::size_t candidate_count_ = 0, found_count_ = 0;
  std::vector<std::uint32_t> candidates_; ///< ascending
  std::vector<float> x_[3], sq_dist_, ordered_;
  std::vector<std::uint32_t> found_samples_;
  std::vector<float> found_sq_dist_;
  std::vector<std::pair<float, std::uint32_t>> nearest_; ///< heap of a search alone
};

} // namespace pcl_uvol
