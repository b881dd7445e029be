// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cell of a place among samples.
#pragma once

#include "neighbors/cell_kernel.h"
#include "neighbors/cell_search.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A convex cell, three faces of which meet at each vertex, as they do for
 * samples in general position. It is kept as its dual: a vertex is the triangle of its
 * faces, counterclockwise from outside, as in Ray, Sokolov, Lefebvre and Levy, Meshless
 * Voronoi on the GPU (2018). Cutting it takes a tenth of the time that
 * VoronoiCellFinder's polygons take.
 *
 * Where more planes pass through one place, as among the nodes of structured grids, the
 * cell can have several vertices there, with edges without length between them. */
class SimpleCell {
public:
  static constexpr std::size_t most_faces = 0xffff; ///< numbers have 16 bits

  /** \brief The faces of a vertex. */
  using Corner = std::array<std::uint16_t, 3>;

  SimpleCell();

  /** \brief What happens if a vertex is on a plane, but for rounding. */
  enum class Ties {
    Refuse, ///< cut() is undecided
    Keep    ///< the plane does not cut off the vertex
  };

  enum class Cut {
    Nothing, ///< was cut off
    Part,
    Undecided ///< Ties::Refuse, and more than three planes meet; or too many faces
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
  start(double half_side, Ties ties = Ties::Refuse);

  /** \brief Keep what lies nearer to the origin than to a sample. After Undecided the
   * cell is undefined. */
  Cut
  cut(const Eigen::Vector3d& offset, std::uint32_t sample);

  /** \brief Keep the part where offset . x <= limit. */
  Cut
  cut(const Eigen::Vector3d& offset, double limit, std::uint32_t sample);

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
  const Corner&
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
    // Chains for cells of any size take a tenth more of Sibson's coordinates.
    if (faces_ <= usual_faces) {
      std::array<std::array<std::uint16_t, usual_faces>, usual_faces> vertex_of;
      for (std::size_t v = 0; v < vertices_; ++v)
        for (std::size_t k = 0; k < 3; ++k)
          vertex_of[corners_[v][k]][corners_[v][(k + 1) % 3]] =
              static_cast<std::uint16_t>(v);
      visitEdges(visit, [&](std::uint16_t a, std::uint16_t b) {
        return std::size_t{vertex_of[b][a]};
      });
      return;
    }
    // The vertices of each face are chained: a place in a chain is 4 v + k.
    for (std::size_t face = 0; face < faces_; ++face)
      chains_[face] = no_place;
    for (std::size_t v = 0; v < vertices_; ++v)
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& chain = chains_[corners_[v][k]];
        next_[4 * v + k] = chain;
        chain = static_cast<std::uint32_t>(4 * v + k);
      }
    visitEdges(visit,
               [&](std::uint16_t a, std::uint16_t b) { return findOtherEnd(a, b); });
  }

  /** \brief Find the farthest vertex that is not known to be final.
   * \param sq_limit those no farther than that are; >= -1
   * \return false if there is none */
  bool
  findOpenVertex(double sq_limit, std::size_t& found);

  /** \brief No sample cuts off that vertex. */
  void
  setFinal(std::size_t vertex);

  const CellKernels&
  getKernels() const
  {
    return *kernels_;
  }

  /** \brief Whether a vertex is on a face of a sample, or of the cube: no_sample. */
  bool
  isOnFaceOf(std::size_t vertex, std::uint32_t sample) const;

  /** \brief Measure the faces of a cell without empty faces.
   * \param ratios [face]: its area by the distance of its sample
   * \param moments [face]: the ratio times the face's centroid
   * \return false if rounding has left the cell open */
  bool
  measureFaces(double* ratios, Eigen::Vector3d* moments) const;

  double
  computeVolume() const;

private:
  static constexpr std::size_t usual_faces = 64; ///< those of random samples have 15.5
  static constexpr std::uint32_t no_place = 0xffffffffu;

  template <typename Visit, typename FindOtherEnd>
  void
  visitEdges(const Visit& visit, const FindOtherEnd& find) const
  {
    for (std::size_t v = 0; v < vertices_; ++v)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint16_t a = corners_[v][k], b = corners_[v][(k + 1) % 3];
        if (a < b)
          visit(a, b, v, find(a, b));
      }
  }

  struct Removed {
    Eigen::Vector3d place; ///< with Ties::Keep
    double height;         ///< over the plane that removes it
  };

  /** An edge of one removed vertex' triangle alone. */
  struct RimEdge {
    std::uint16_t a, b;
    std::uint32_t removed; ///< number among the removed vertices
  };

  Cut
  cut(const Eigen::Vector3d& offset,
      double limit,
      double sq_length,
      std::uint32_t sample);

  /** The vertex that has b before a in its corner. */
  std::size_t
  findOtherEnd(std::uint16_t a, std::uint16_t b) const
  {
    const bool is_a_shorter = uses_[a] <= uses_[b];
    const std::uint16_t other = is_a_shorter ? b : a;
    const std::uint32_t to_other = is_a_shorter ? 2 : 1;
    for (std::uint32_t place = chains_[is_a_shorter ? a : b]; place != no_place;
         place = next_[place]) {
      const std::uint32_t k = (place & 3u) + to_other;
      if (corners_[place / 4][k < 3 ? k : k - 3] == other)
        return place / 4;
    }
    return 0; // of no closed cell
  }

  /** Lower vertices on a plane, but for rounding, to it.
   * \param length of its normal
   * \param most higher ones are known to be no ties
   * \return false if none is left over it */
  bool
  keepTies(double length, double most);

  /** Put a face to the place of the vertices of positive height.
   * \return false if a vertex of it is undefined */
  bool
  replaceVertices(std::uint16_t face);

  /** Close the gaps of the vertices of positive height. */
  void
  dropVertices();

  /** List the vertices of positive height, and their rim, and stop counting them. */
  void
  takeVertices();

  /** Count them again. */
  void
  returnVertices();

  /** Whether the rim is one loop, as for a plane. */
  bool
  isRimSimple();

  /** Give all vertices but those that edges join to the highest one, on the plane's
   * upper side, and to the lowest one, on its lower side, to the other side: then the
   * rim is one loop. */
  void
  joinVertices();

  /** Make the place where three planes meet a vertex.
   * \return false if they are parallel to one line, but for rounding, or turn the other
   * way */
  bool
  addVertex(std::uint16_t a, std::uint16_t b, std::uint16_t c);

  void
  addVertex(const Eigen::Vector3d& place, const Corner& corner);

  /** Make a vertex where an edge crosses the plane of a face. */
  void
  addCrossing(const RimEdge& edge, std::uint16_t face);

  /** \return most_faces if there is none left */
  std::size_t
  findEmptyFace();

  /** Make room for twice as many faces. */
  void
  grow();

  void
  growVertices(std::size_t room);

  const CellKernels* kernels_;
  Ties ties_ = Ties::Refuse;
  std::size_t faces_ = 0; ///< some of them empty
  std::size_t vertices_ = 0;
  double sq_reach_ = 0.0;
  std::size_t words_ = 0; ///< room for 64 faces each
  std::vector<Face> face_;
  std::vector<std::uint32_t> uses_; ///< vertices of a face
  /** A bit for each edge of removed vertices, from face to face; 0 between cuts. */
  std::vector<std::uint64_t> removed_edges_;
  std::vector<double> x_, y_, z_, heights_;
  std::vector<double> sq_lengths_; ///< of vertices
  std::vector<double> open_;       ///< squared lengths of vertices that are not final
  Eigen::Vector3d final_place_;    ///< of the last final one: others can be there, too
  std::vector<Corner> corners_;
  std::size_t num_removed_ = 0, rim_size_ = 0;
  std::vector<Removed> removed_;
  std::vector<std::uint32_t> removed_numbers_; ///< ascending
  std::vector<Corner> removed_corners_;
  std::vector<RimEdge> rim_;
  std::vector<std::uint16_t> next_on_rim_;           ///< of faces
  mutable std::vector<std::uint32_t> chains_, next_; ///< of forEdges()
};

/** \brief Finds the cells of one place after another; one object per thread. */
class SimpleCellFinder {
public:
  /** \brief Find a cell.
   * \return false if the cell is not bounded or the samples around are not in general
   * position: VoronoiCellFinder finds it */
  bool
  find(const CellSearch& around);

  /** \brief Find the cell of any place among any samples.
   * \return false if the cell is not bounded: the place is outside of the convex hull
   * of the samples; getCell() is then the cell among the first samples and some others,
   * within a cube far outside */
  bool
  findAny(const CellSearch& around);

  /** \brief The cell, without empty faces. */
  const SimpleCell&
  getCell() const
  {
    return cell_;
  }

  /** \brief Samples whose bisectors findAny() tried, some of them without a face. */
  const std::vector<std::uint32_t>&
  getTried() const
  {
    return tried_;
  }

private:
  SimpleCell cell_;
  std::vector<std::uint32_t> tried_;
};

} // namespace pcl_uvol::detail
