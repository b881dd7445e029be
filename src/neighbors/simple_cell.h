// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of a place among samples in general position.
#pragma once

#include "neighbors/cell_kernel.h"
#include "neighbors/cell_search.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl_uvol::detail {

/** \brief A convex cell around the origin, three faces of which meet at each vertex, as
 * they do for samples in general position. It is kept as its dual: a vertex is the
 * triangle of its faces, counterclockwise from outside, as in Ray, Sokolov, Lefebvre
 * and Levy, Meshless Voronoi on the GPU (2018). Cutting it takes a tenth of the time
 * that VoronoiCellFinder's polygons take, which know no such condition. */
class SimpleCell {
public:
  static constexpr std::size_t most_faces = 64; ///< those of random samples have 15.5
  static constexpr std::size_t most_vertices = 2 * most_faces; // Euler: 2 f - 4

  SimpleCell();

  enum class Cut {
    Nothing, ///< was cut off
    Part,
    Unsure ///< a vertex lies on the plane, but for rounding, or there are too many
  };

  /** \brief A plane: offset . x = limit, with the cell on the side of smaller ones. */
  struct Face {
    Eigen::Vector3d offset; ///< of the sample beyond it; a cube's side: its normal
    double limit;
    double length; ///< of the offset
    std::uint32_t sample;
  };

  /** \brief Become a cube about the origin, whose faces have no sample. */
  void
  start(double half_side);

  /** \brief Keep what lies nearer to the origin than to a sample. After Unsure the cell
   * is undefined. */
  Cut
  cut(const Eigen::Vector3d& offset, std::uint32_t sample);

  /** \brief Number the faces that are left without gaps: after the last cut. */
  void
  dropEmptyFaces();

  std::size_t
  getNumFaces() const
  {
    return faces_;
  }

  const Face&
  getFace(std::size_t face) const
  {
    return face_[face];
  }

  std::size_t
  getNumVertices() const
  {
    return vertices_;
  }

  Eigen::Vector3d
  getVertex(std::size_t vertex) const
  {
    return {x_[vertex], y_[vertex], z_[vertex]};
  }

  /** \brief The three faces of a vertex, counterclockwise from outside. */
  const std::array<std::uint8_t, 3>&
  getCorner(std::size_t vertex) const
  {
    return corners_[vertex];
  }

  /** \brief Squared distance of the farthest vertex from the origin. */
  double
  getSqReach() const
  {
    return sq_reach_;
  }

  /** \brief Call visit(a, b, from, to) for each edge: between the faces a and b, from
   * the vertex that has a before b in its corner to the other one. */
  template <typename Visit>
  void
  forEdges(const Visit& visit) const
  {
    std::array<std::array<std::uint8_t, most_faces>, most_faces> vertex_of;
    for (std::size_t v = 0; v < vertices_; ++v)
      for (std::size_t k = 0; k < 3; ++k)
        vertex_of[corners_[v][k]][corners_[v][(k + 1) % 3]] =
            static_cast<std::uint8_t>(v);
    for (std::size_t v = 0; v < vertices_; ++v)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint8_t a = corners_[v][k], b = corners_[v][(k + 1) % 3];
        if (a < b)
          visit(a, b, v, static_cast<std::size_t>(vertex_of[b][a]));
      }
  }

  /** \brief Find the farthest vertex that is not known to be final.
   * \param sq_limit those no farther than that are
   * \return false if there is none */
  bool
  findOpenVertex(double sq_limit, std::size_t& found) const;

  /** \brief No sample cuts off that vertex. */
  void
  setFinal(std::size_t vertex)
  {
    is_final_[vertex] = true;
  }

  const CellKernels&
  getKernels() const
  {
    return *kernels_;
  }

  /** \brief Whether a face of a vertex is one of the cube's. */
  bool
  isOfCube(std::size_t vertex) const;

  /** \brief Measure the faces of a cell without empty faces.
   * \param ratios [face]: its area by the distance of its sample
   * \param moments [face]: the ratio times the face's centroid
   * \return false if rounding has left the cell open */
  bool
  measureFaces(double* ratios, Eigen::Vector3d* moments) const;

private:
  /** Put a face to the place of the vertices of positive height.
   * \return false if a vertex of it is undefined */
  bool
  replaceVertices(std::uint8_t face);

  /** Make the place where three planes meet a vertex.
   * \return false if they are parallel to one line, but for rounding, or turn the other
   * way */
  bool
  addVertex(std::uint8_t a, std::uint8_t b, std::uint8_t c);

  /** \return most_faces if there is none left */
  std::size_t
  findEmptyFace();

  const CellKernels* kernels_;
  std::size_t faces_ = 0; ///< some of them empty
  std::size_t vertices_ = 0;
  double sq_reach_ = 0.0;
  std::array<Face, most_faces> face_;
  std::array<std::uint8_t, most_faces> uses_; ///< vertices of a face
  /** A bit for each edge of removed vertices, from face to face; 0 between cuts. */
  std::array<std::uint64_t, most_faces> removed_edges_{};
  std::array<double, most_vertices + cell_padding> x_, y_, z_, heights_;
  std::array<bool, most_vertices> is_final_;
  std::array<std::array<std::uint8_t, 3>, most_vertices> corners_;
};

/** \brief Finds the cells of one place after another; one object per thread. */
class SimpleCellFinder {
public:
  /** \brief Find a cell.
   * \return false if the cell is not bounded or the samples around are not in general
   * position: VoronoiCellFinder finds it */
  bool
  find(const CellSearch& around);

  /** \brief The cell, without empty faces. */
  const SimpleCell&
  getCell() const
  {
    return cell_;
  }

private:
  SimpleCell cell_;
};

} // namespace pcl_uvol::detail
