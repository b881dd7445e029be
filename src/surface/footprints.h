// SPDX-License-Identifier: BSD-3-Clause
// How large the disc of a point must be so that the discs of all points leave no hole.
#pragma once

#include "surface/oriented_points.h"
#include "surface/rim_lines.h"
#include "surface/surface_bend.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Indices of the nearest other points, nearest first; the point itself for
 * those that are not there. */
using NearestPoints = std::array<std::uint32_t, 32>;

/** \brief Radii of the discs of every point, in leaf order. */
struct Footprints {
  /** Distance to the farthest corner of the point's Voronoi cell among its neighbours
   * in its tangent plane: discs of that size, and no smaller ones, cover a plane. 0 for
   * isolated points. */
  std::vector<float> radii;
  /** The same for those corners only for which the point is the first of the three
   * points around: each hole has one such disc, which leaves a part of it open. */
  std::vector<float> fillers;
  /** 1 for points at the rim of the surface: no points bound their cell. */
  std::vector<std::uint8_t> on_rim;
  std::vector<PackedBend> bends; ///< times the radii
  std::vector<PackedRim> rims;   ///< as parts of the radii
  std::vector<NearestPoints> nearest;
};

/** \brief Corners at infinity or beyond the rim of a surface do not count, and outliers
 * get at most three times what their nearest neighbour has. Of a surface with two sides
 * (normals with a meaningful sign) points that look to the other side are no
 * neighbours, nor are points of another isovalue.
 *
 * No point knows more of the surface than the samples about it do: radii are at most
 * about the length that edges of isopoints have there, or twice that on a surface that
 * goes on all around, and the distance of the 16th neighbour on whatever side. Points
 * that have far fewer points about them than those have, and points whose disc would
 * meet hardly another one, are isolated. Isopoints in gaps of the sampling get discs of
 * radius 0, and the others do without them: nothing is known between them.
 */
PCL_UVOL_EXPORTS Footprints
computeFootprints(const OrientedPoints& points, unsigned threads, Report& report);

} // namespace pcl_uvol
