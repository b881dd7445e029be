// SPDX-License-Identifier: BSD-3-Clause
// Where discs end that reach beyond the rim of a surface, in four bytes.
#pragma once

#include "surface/rim_scale.h"
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol {

/** \brief A line in the plane of a disc, in the axes that tangentAxes() gives: the
 * surface does not go on beyond it. */
struct RimLine {
  Eigen::Vector2f outwards = Eigen::Vector2f::UnitX();     ///< of length 1
  float distance = std::numeric_limits<float>::infinity(); ///< from the centre
};

/** \brief Those that cut most off a disc, the nearest first. */
using RimLines = std::array<RimLine, 2>;

/** \brief The lines of a disc as parts of its radius, 16 bits each. 0: none. */
using PackedRim = std::uint32_t;

/** \brief Pack lines, those left out that do not cut a disc of that radius. */
PCL_UVOL_EXPORTS PackedRim
packRim(const RimLines& lines, float radius);

/** \brief Lines whose distances are parts of the radius. */
PCL_UVOL_EXPORTS RimLines
unpackRim(PackedRim rim);

/** \brief The same lines in other axes, their directions rounded once more.
 * \param axes the new ones in the old ones, as columns */
PCL_UVOL_EXPORTS PackedRim
turnRim(PackedRim rim, const Eigen::Matrix2f& axes);

/** \brief Finds the rim lines of one disc after another. These are sides of the convex
 * hull of the points about the disc, moved outwards, if no other points lie beyond. */
class PCL_UVOL_EXPORTS RimFinder {
public:
  /** \brief So far from a disc of a radius all points have to be known. */
  static float
  reachOf(float radius);

  /** \brief Lines that cut a disc.
   * \param places of points in the plane of the disc, whose centre is the origin */
  RimLines
  find(const std::vector<Eigen::Vector2f>& places, float radius);

private:
  /** Of the centre and the places within a distance, counter-clockwise. */
  void
  makeHull(const std::vector<Eigen::Vector2f>& places, float distance);

  std::vector<Eigen::Vector2f> near_, hull_;
};

} // namespace pcl_uvol
