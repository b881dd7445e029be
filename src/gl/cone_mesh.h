// SPDX-License-Identifier: BSD-3-Clause
// Sections through a cone of distances, as triangles (thesis 2.1, Figures 2.5 and 2.6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief How a section is divided: circles of twice the radius and twice the corners
 * each, around a point. */
struct ConeRings {
  double inner_radius; ///< of the first circle, in units of the coordinates
  unsigned corners;    ///< of the first circle
};

/** \brief The sections of a site in the layers t = 0, 1, 2, ... from it. They end where
 * the distance reaches the radius, and cover all that is nearer. */
class ConeMesh {
public:
  /** \brief What is drawn of one section. */
  struct Section {
    std::int32_t first_vertex, indices;
  };
  /** \brief From the site, in cells, and what the depth test compares: distances
   * divided by the largest one. */
  struct Vertex {
    float x, y, depth;
  };

  /** \param spacing of the cells
   * \param radius > 0, in units of the coordinates
   * \param layers most sections */
  ConeMesh(const ConeRings& rings,
           const std::array<double, 3>& spacing,
           double radius,
           std::uint32_t layers);

  const std::vector<Section>&
  getSections() const
  {
    return sections_;
  }

  /** \brief The vertices of all sections, one section after the other. */
  const std::vector<Vertex>&
  getVertices() const
  {
    return vertices_;
  }

  /** \brief Triangles from the inside out: a section takes as many as it has. */
  const std::vector<std::uint32_t>&
  getIndices() const
  {
    return indices_;
  }

  /** \brief Depth of the radius. */
  float
  getRadiusDepth() const
  {
    return radius_depth_;
  }

private:
  struct Circle {
    double radius;
    std::uint32_t corners;
  };

  /** Circles whose polygons cover a disc, none in vain. */
  static std::vector<Circle>
  coverDisc(const ConeRings& rings, double disc_radius);

  void
  addTriangles(const std::vector<Circle>& circles);

  void
  addSection(const std::vector<Circle>& circles,
             const std::array<double, 3>& spacing,
             double height);

  std::vector<Section> sections_;
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::int32_t> indices_within_; // per circle
  float radius_depth_ = 1.0f;
};

} // namespace pcl_uvol
