// SPDX-License-Identifier: BSD-3-Clause
// Draws the cones of all sites into one layer of a grid (Table 2.1).
#pragma once

#include "gl/cone_mesh.h"
#include "gl/objects.h"
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

class ConePainter {
public:
  /** \param sites as NearestSites::find() has them
   * \throws GlError if a layer is too large */
  ConePainter(const GlFunctions& gl,
              const GridShape& shape,
              const std::vector<GridCell>& sites);

  /** \brief What is drawn from now on. */
  void
  setMesh(const ConeMesh& mesh);

  /** \brief The site of every cell of a layer; no_site where no cone of the mesh is. */
  void
  draw(std::uint32_t layer, std::uint32_t* nearest) const;

private:
  void
  clear() const;

  void
  drawPlane(std::uint32_t plane, const ConeMesh::Section& section) const;

  const GlFunctions& gl_;
  GLsizei width_, height_;
  std::vector<std::uint32_t> plane_begins_; // of the sites of every plane, and the end
  std::vector<ConeMesh::Section> sections_;
  float radius_depth_ = 1.0f;
  Program program_;
  GlName nearest_, depth_, framebuffer_;
  GlName vertices_, indices_, cells_; // buffers; cells of the sites
  GlName array_;
};

} // namespace pcl_uvol
