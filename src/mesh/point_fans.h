// SPDX-License-Identifier: BSD-3-Clause
// The triangles around the points of a surface that has no mesh.
#pragma once

#include "mesh/curved_triangle.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The other two corners of a triangle, counter-clockwise behind its first one.
 */
using FanTriangle = std::array<std::uint32_t, 2>;

/** \brief For every point of a surface the triangles that it would have in a Delaunay
 * triangulation of the surface: those around its Voronoi cell in its tangent plane.
 *
 * Every point is looked at on its own, so that the four points of a quadrangle may
 * disagree about its diagonal: triangles are no mesh. Voronoi cells of the points, as
 * parts of the triangles, hardly depend on it: they disagree about next to nothing, as
 * such points lie on a circle. Points that look to the other side, or are of another
 * isovalue, are no neighbours. */
class PCL_UVOL_EXPORTS PointFans {
public:
  /** \param corners one per sample, in their order
   * \param isovalues one per sample, or none */
  PointFans(const SampleSet& samples,
            const std::vector<SurfaceCorner>& corners,
            const std::vector<double>& isovalues,
            unsigned threads);

  /** \brief The triangles of a point that do not cross a rim of the surface. */
  const std::vector<FanTriangle>&
  getFan(std::size_t point) const
  {
    return fans_[point];
  }

  /** \brief Whether they do not surround the point: the surface ends there. */
  bool
  isOnRim(std::size_t point) const
  {
    return on_rim_[point] != 0;
  }

  /** \brief How many points have a quarter or more of their nearest neighbours beside
   * them looking to the other side: these may belong to the same surface. */
  std::size_t
  countContrary() const
  {
    return contrary_;
  }

  /** \brief Whether all three corners know of a triangle of one of them. */
  bool
  isAgreedOn(std::uint32_t first, const FanTriangle& others) const;

private:
  std::vector<std::vector<FanTriangle>> fans_;
  std::vector<std::uint8_t> on_rim_;
  std::size_t contrary_ = 0;
};

} // namespace pcl_uvol::detail
