// SPDX-License-Identifier: BSD-3-Clause
// One splat: its disc, grown across the neighbours of a point, and its field of normals
// (thesis 4.2.1).
#pragma once

#include "neighbors/nearest_finder.h"
#include "surface/footprints.h"
#include "surface/oriented_points.h"
#include <pcl_uvol/common/point_types.h>

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** What splats are grown over. */
struct SplatGround {
  const OrientedPoints& points;
  std::vector<std::uint8_t> on_rim;
  std::vector<NearestPoints> nearest;
  /** The least radius of a splat about every point: that of its Voronoi cell. */
  std::vector<float> least_radii;
  /** What ends a splat of that radius, in the axes that tangentAxes() gives. */
  std::vector<PackedRim> rims;
  double delta; ///< a length
  double lambda;
};

struct GrownSplat {
  PointSplat splat;
  bool widened = false; ///< it has its least radius, which delta or a rim forbids
  PackedRim rim = 0;    ///< what ends it, in its own axes
  /** Other points that need no splat of their own. */
  std::vector<std::uint32_t> passed_over;
};

/** Grows one splat after another; one object per thread. */
class SplatGrower {
public:
  /** \param ground must outlive the grower */
  explicit SplatGrower(const SplatGround& ground);

  /** Prepare for samples that lie close together. */
  void
  expect(const std::vector<std::uint32_t>& samples);

  /** The result depends on the sample, and by rounding on those grown before. */
  GrownSplat
  grow(std::uint32_t sample);

private:
  /** A neighbour in the axes of the splat. */
  struct Covered {
    std::uint32_t sample;
    float distance;              ///< in the plane
    Eigen::Vector3f offset;      ///< from the point: along u, v and the normal
    Eigen::Vector2f inclination; ///< of its normal: parts along u and v over the third
  };

  /** The finder of this level, which looks for four times as many as that below it. */
  NearestFinder&
  finder();

  void
  findNeighbors(std::uint32_t sample);

  /** Cover neighbours, nearest first, until one lies too far off, or on a rim. False if
   * there may be more of them than were found. */
  bool
  growAcross(std::uint32_t sample);

  /** The same for a range of them. True if all are covered. */
  bool
  coverNearest(std::size_t begin, std::size_t end);

  bool
  coverSorted(std::size_t begin, std::size_t end);

  /** Cover all of a range in any order, or none of it; false then. */
  bool
  coverAll(std::size_t begin, std::size_t end);

  /** Take a point into low_ and high_; true if it is too far off, or on a rim. */
  bool
  isLast(const Covered& point);

  /** A neighbour in the axes of the splat; false for one on another side of the
   * surface. */
  bool
  look(std::uint32_t sample, Covered& seen) const;

  /** Cover all points within a radius, and some of the nearest at least. */
  void
  coverWithin(std::uint32_t sample, float radius);

  void
  fitNormals(PointSplat& splat) const;

  /** What ends a splat: one that is larger than it must be reaches no rim. */
  PackedRim
  rimOf(std::uint32_t sample, const PointSplat& splat) const;

  const SplatGround& ground_;
  std::vector<std::unique_ptr<NearestFinder>> finders_; ///< for ever more neighbours
  std::size_t level_ = 0; ///< 0: the nearest points, which are known; else a finder

  // The splat that is grown.
  Eigen::Vector3f here_, axes_[3]; ///< u, v, normal
  std::vector<Position> expected_;
  std::vector<std::pair<float, std::uint32_t>> neighbors_;
  std::vector<Covered> covered_;
  bool has_all_neighbors_ = false; ///< no others are left to be found
  float low_ = 0.0f, high_ = 0.0f; ///< of the covered points along the normal
};

} // namespace pcl_uvol
