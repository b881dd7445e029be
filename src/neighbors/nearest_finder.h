// SPDX-License-Identifier: BSD-3-Clause
// The k nearest samples of points that lie anywhere, without an index of their own: the
// boxes of the bit-indexed kd-tree tell where they may be, and points close to one
// another share a copy of the samples around them.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

struct NearestKernels;

/** \brief Nearest samples of one point after another; one object per thread.
 *
 * A point goes down the tree, the nearer half first, and leaves out what cannot hold
 * one of its k nearest: right for any layout of the samples. Points close to one
 * another would meet the same samples again and again: such a group shares a copy of
 * all samples within some distance of it, from which each point selects its own. The
 * answer depends on the point alone; the speed lives on points in spatial order.
 * Memory: some kilobytes. */
class PCL_UVOL_EXPORTS NearestFinder {
public:
  /** \brief Neighbours in leaf order. */
  struct Row {
    const std::uint32_t* samples;
    const float* sq_dists;
    std::size_t size;
  };

  /** \param samples must outlive the finder
   * \param k >= 1 */
  NearestFinder(const SampleSet& samples, std::size_t k);

  /** \brief The k nearest, all samples where there are no more; of equally far ones
   * those of lower index. Valid until the next call. A sample at the point itself
   * counts.
   * \param length about the distance of a neighbour, > 0; it only sets where the first
   * copy ends */
  Row
  find(const Position& point, float length);

  /** \brief Those of the k nearest that are no farther than a radius, > 0; what else
   * the row holds is not known to be nearest. It may be empty. */
  Row
  findWithin(const Position& point, float radius);

  /** \brief Tell cheaply that a point lies in a gap: that none of its k nearest is
   * nearer than a part of the distance of the farthest of them.
   * \param first, second samples on both sides of it, the nearer the better
   * \return a distance that k samples do not exceed, while none is nearer than the part
   * of it; 0 if this cannot be told, or if there are fewer than k */
  float
  findGap(const Position& point, std::uint32_t first, std::uint32_t second, float part);

  /** \brief Prepare for points that are looked up next: close ones then share one copy.
   */
  void
  expect(const Position* points, std::size_t count);

private:
  /** A sample on its way to the row: of equally far ones the lower index comes first.
   */
  using Candidate = std::pair<float, std::uint32_t>;

  /** What the points of a group share. */
  enum class Copy {
    None,       ///< not tried
    Usual,      ///< samples within a distance that is mostly enough
    TooLarge,   ///< they are too many
    Enough,     ///< all samples that one of the points needs
    NotPossible ///< these are too many as well: each point has its own search
  };

  void
  startGroup(const KdBox& box);

  bool
  isInGroup(const Position& point) const;

  /** Make the point one of the group, and the copy, if there is none, reach for a
   * distance. */
  void
  prepare(const Position& point, float distance);

  /** Copy what lies within a squared distance of the group; false if that is too much.
   */
  bool
  copyWithin(float sq_limit);

  bool
  copyBelow(const KdTree& tree, const KdNode& node);

  void
  appendNear(std::uint32_t begin, std::uint32_t end);

  /** Copy all that the points of the group need, by the neighbours found of one of
   * them; false if that is too much, or there are no others. */
  bool
  copyForOthers();

  /** The k nearest of the copy become the row; false if others may be nearer. */
  bool
  selectFromCopy(const Position& point);

  /** A squared distance that k samples of the copy do not exceed, or more if the k-th
   * has equals. */
  float
  limitOfNearest();

  /** The k nearest up to a squared distance become the row. */
  void
  search(const Position& point, float sq_limit);

  /** \param point as a box */
  void
  searchBelow(const KdBox& point, const KdTree& tree, const KdNode& node);

  void
  measureBucket(const Position& point, const KdNode& bucket);

  /** Squared distance that k samples do not exceed: those around one in the tree. */
  float
  sqSearchRadius(const Position& point, std::uint32_t sample);

  /** Whether no sample below a node lies within a squared distance of a point. */
  bool
  isEmpty(const KdBox& point, const KdTree& tree, const KdNode& node, float sq_limit);

  /** Whether a sample may come before the last of the k. */
  bool
  mayHold(float sq_bound, const KdNode& node) const
  {
    return Candidate(sq_bound, node.begin) < last_;
  }

  void
  makeRoom(std::size_t rows);

  Row
  found() const
  {
    return {found_samples_.data(), found_sq_dist_.data(), found_count_};
  }

  const SampleSet& samples_;
  std::size_t k_;
  const NearestKernels* kernels_;
  float reach_ = 0.0f; ///< distance of the farthest neighbour found last

  KdBox group_{};
  Copy copy_ = Copy::None;
  float sq_limit_ = 0.0f; ///< all samples within it are in the copy

  // Arrays keep their greatest size.
  std::size_t copied_count_ = 0, found_count_ = 0;
  std::vector<std::uint32_t> copied_; ///< ascending
  std::vector<float> x_[3], sq_dist_;
  std::vector<std::uint32_t> found_samples_;
  std::vector<float> found_sq_dist_;

  std::vector<Candidate> nearest_; ///< of a search: a heap
  Candidate last_;                 ///< what a sample must come before
};

} // namespace pcl_uvol
