// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams drawn layer by layer, nearest by the depth test
// (thesis 2.1).
#pragma once

#include "gl/context.h"
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <memory>

namespace pcl_uvol {

/** \brief Draws a section through the cone of distances of every site (Table 2.1).
 *
 * Triangles lie above the cones: of two nearly equally far sites the farther one may
 * win. With n triangles in a first ring of radius r, it is farther by at most 2 % and
 * r max(1 - cos(pi / n), 0.14), which is 0.28 cells by default; the thesis's (2, 4) has
 * 0.59. Cones end where all of a layer is covered, so that the cost grows with the
 * number of sites and with the distances to them. Memory: 4 bytes per cell; in the
 * context 12 bytes per cell of a layer, 4 per site, and the triangles. */
class PCL_UVOL_EXPORTS ConicSections : public NearestSites {
public:
  static constexpr double largest_inner_radius = 1024.0;
  static constexpr unsigned most_first_triangles = 64;

  /** \param inner_radius of the first ring of triangles, in cells (the shorter side of
   * x and y), in [1, largest_inner_radius]; every further ring ends at twice the radius
   * \param first_triangles in the first ring, in [3, most_first_triangles]; circles
   * have twice the corners of the next one inside, up to 512
   * \throws InvalidArgument without a context, or for other numbers */
  explicit ConicSections(const std::shared_ptr<GlContext>& context,
                         double inner_radius = 2.0,
                         unsigned first_triangles = 6);

  /** \param threads of no effect: those of the driver are used
   * \param report gets the time and progress of "conic_sections"
   * \throws GlError if a layer is too large for the driver, or the driver fails */
  std::vector<std::uint32_t>
  find(const GridShape& shape,
       const std::vector<GridCell>& sites,
       unsigned threads,
       Report& report) override;

private:
  std::shared_ptr<GlContext> context_;
  double inner_radius_;
  unsigned first_triangles_;
};

} // namespace pcl_uvol
