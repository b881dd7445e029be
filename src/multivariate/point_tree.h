// SPDX-License-Identifier: BSD-3-Clause
// A static kd-tree of points with many coordinates: nearest points, and nearest points
// of another component for minimum spanning trees. FLANN has the first search only, so
// that one tree of our own serves both.
#pragma once

#include <pcl_uvol/common/stage.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol {

/** \brief The nearest points of every place of a PointTree, nearest first. */
struct NearestPlaces {
  std::size_t per_place = 0;
  std::vector<std::uint32_t> places;
  std::vector<float> sq_dists;
};

/** \brief Points in an order in which those of a cell follow one another.
 *
 * A block is 16 items: of points on the lowest level, of the boxes of the blocks of the
 * level below on the others. Cells are split at the median of their widest axis, equal
 * coordinates by index, and sizes are such that all blocks are full but the last one.
 * Places are numbers of points in this order. */
class PointTree {
public:
  static constexpr std::size_t lanes = 16; ///< items of a block

  /** \brief Something of every item of a block. */
  template <typename T>
  using Lanes = std::array<T, lanes>;

  /** \param values finite numbers, row by row, whose squared differences are numbers in
   * float */
  PointTree(const std::vector<float>& values, std::size_t columns, unsigned threads);

  /** \brief Number of points. */
  std::size_t
  size() const
  {
    return points_.size();
  }

  /** \brief The row of values that lies at a place. */
  std::uint32_t
  getPoint(std::size_t place) const
  {
    return points_[place];
  }

  std::size_t
  levels() const
  {
    return levels_.size();
  }

  /** \brief Number of points, or of boxes, on a level. */
  std::size_t
  items(std::size_t level) const
  {
    return levels_[level].items;
  }

  /** \brief The nearest others of all points; those equally far are any of them, but
   * the same ones for any number of threads.
   * \param count less than the number of points */
  NearestPlaces
  findNearest(std::size_t count, unsigned threads, StepTimer& step) const;

  /** \brief A box to start from, or a point if low and high are the same array. */
  struct Query {
    const float *low, *high;
  };

  /** \brief Call visitor.accept(place, sq_dist) for the points in the order of the
   * nearest boxes, as long as visitor.reaches(level, item, sq_dist) for them and all
   * boxes they lie in; sq_dist is never more than that of what is in the box. */
  template <typename Visitor>
  void
  visit(const Query& query, Visitor& visitor) const
  {
    visitBlock(levels_.size() - 1, 0, query, visitor);
  }

  /** \brief The coordinates of a point, or of the low or high corner of a box. */
  void
  copyLow(std::size_t level, std::size_t item, float* coordinates) const
  {
    copyItem(levels_[level].low, item, coordinates);
  }
  void
  copyHigh(std::size_t level, std::size_t item, float* coordinates) const
  {
    copyItem(level == 0 ? levels_[0].low : levels_[level].high, item, coordinates);
  }

private:
  /** Block by block, axis by axis, lane by lane; lanes without an item are infinite. */
  struct Level {
    std::size_t items;
    std::vector<float> low, high; // high is empty for points
  };

  void
  addPoints(const std::vector<float>& rows);

  void
  addBoxes(unsigned threads);

  Lanes<float>
  measureBlock(std::size_t level, std::size_t block, const Query& query) const;

  void
  copyItem(const std::vector<float>& level, std::size_t item, float* coordinates) const;

  template <typename Visitor>
  void
  visitBlock(std::size_t level,
             std::size_t block,
             const Query& query,
             Visitor& visitor) const;

  std::size_t columns_;
  std::vector<std::uint32_t> points_;
  std::vector<Level> levels_;
};

/** \brief Finds points of other components, by mutual reachability distance. */
class OutsideSearch {
public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /** \brief A place, and the square of its mutual reachability distance. */
  struct Found {
    std::uint32_t place = none;
    float sq_weight = std::numeric_limits<float>::infinity();
  };

  /** \param sq_cores squared core distance of every place
   * The tree and the cores must outlive the search. */
  OutsideSearch(const PointTree& tree, const std::vector<float>& sq_cores);

  /** \brief Set the component of every place; they must outlive the next find. */
  void
  setComponents(const std::vector<std::uint32_t>& components);

  /** \brief The component of all points of a box, or none if they have several. */
  std::uint32_t
  sharedComponent(std::size_t level, std::size_t item) const
  {
    return shared_components_[level][item];
  }

  /** \brief The nearest point of another component.
   * \param query the point at the place
   * \param sq_bound nothing farther is looked for; lowered to what is found. Other
   * threads may lower it meanwhile
   * \return one of several equally near ones that depends on the components only, if it
   * is not farther than the bound is at the end */
  Found
  find(std::size_t place,
       const PointTree::Query& query,
       std::atomic<float>& sq_bound) const;

  /** \brief Whether a point of another component may be as near as the bound to one in
   * a box whose points share a component.
   * \param query the box */
  bool
  mayReach(std::size_t level,
           std::size_t item,
           const PointTree::Query& query,
           const std::atomic<float>& sq_bound) const;

private:
  struct FindVisitor;
  struct ReachVisitor;

  float
  leastCore(std::size_t level, std::size_t item) const
  {
    return level == 0 ? sq_cores_[item] : least_sq_cores_[level][item];
  }

  /** Whether all points are of that component. */
  bool
  isOf(std::uint32_t component, std::size_t level, std::size_t item) const
  {
    return component ==
           (level == 0 ? (*components_)[item] : shared_components_[level][item]);
  }

  const PointTree& tree_;
  const std::vector<float>& sq_cores_;
  const std::vector<std::uint32_t>* components_ = nullptr;
  /** For the boxes of the levels above 0: the least core, and the component if all
   * points share one. */
  std::vector<std::vector<float>> least_sq_cores_;
  std::vector<std::vector<std::uint32_t>> shared_components_;
};

/** \brief Lower an atomic number to another one. */
inline void
lowerTo(std::atomic<float>& number, float other)
{
  float current = number.load(std::memory_order_relaxed);
  while (other < current &&
         !number.compare_exchange_weak(current, other, std::memory_order_relaxed)) {
  }
}

} // namespace pcl_uvol
