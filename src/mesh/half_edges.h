// SPDX-License-Identifier: BSD-3-Clause
// Which triangles of a mesh are beside one another, and whether it is a manifold.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Number of a directed edge: three times its triangle plus its place there; it
 * begins in the triangle's vertex of that place. */
using HalfEdge = std::uint32_t;

inline HalfEdge
nextOf(HalfEdge edge)
{
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}

inline HalfEdge
previousOf(HalfEdge edge)
{
  return edge % 3 == 0 ? edge + 2 : edge - 1;
}

/** \brief What keeps triangles from being an oriented manifold; all 0 for one. */
struct ManifoldDefects {
  std::size_t edges = 0;    ///< half edges that more than one triangle walks, or of
                            ///< length zero in vertices
  std::size_t vertices = 0; ///< whose triangles are more than one round or fan
};

/** \brief Half edges of triangles. An edge that two triangles walk in one direction has
 * no twin, so that wrong orientation shows as a rim. */
class PCL_UVOL_EXPORTS HalfEdges {
public:
  static constexpr HalfEdge none = std::numeric_limits<HalfEdge>::max();

  /** \param triangles must outlive this, and may be changed as long as edges and twins
   * are kept in step */
  HalfEdges(std::vector<Triangle>& triangles, std::size_t vertices);

  std::uint32_t
  originOf(HalfEdge edge) const
  {
    return triangles_[edge / 3][edge % 3];
  }

  std::uint32_t
  targetOf(HalfEdge edge) const
  {
    return originOf(nextOf(edge));
  }

  /** \brief The same edge in the other direction; none at a rim. */
  HalfEdge
  twinOf(HalfEdge edge) const
  {
    return twins_[edge];
  }

  /** \brief An edge that begins in a vertex, at a rim the one that has no twin; none
   * for a vertex without triangles. */
  HalfEdge
  firstOf(std::uint32_t vertex) const
  {
    return firsts_[vertex];
  }

  bool
  isAtRim(std::uint32_t vertex) const
  {
    return twins_[firsts_[vertex]] == none;
  }

  /** \brief Call visit(edge) for all half edges that begin in a vertex, in their round;
   * at a rim the last neighbour, which is the origin of the last triangle's previous
   * edge, begins no such edge. */
  template <typename Visit>
  void
  forEachAround(std::uint32_t vertex, const Visit& visit) const
  {
    const HalfEdge first = firsts_[vertex];
    HalfEdge edge = first;
    do {
      const HalfEdge next = twins_[previousOf(edge)];
      visit(edge);
      edge = next;
    } while (edge != first && edge != none);
  }

  /** \brief The vertices that share an edge with one.
   * \param around cleared first */
  void
  findAround(std::uint32_t vertex, std::vector<std::uint32_t>& around) const;

  const ManifoldDefects&
  getDefects() const
  {
    return defects_;
  }

  /** \brief Edges without a twin. */
  std::size_t
  countRimEdges() const;

  /** \brief Merge the target of an edge into its origin, both inside: its two triangles
   * go, and have no meaning from then on. */
  void
  collapse(HalfEdge edge);

  /** \brief Turn an edge with two triangles to the other diagonal of these. */
  void
  flip(HalfEdge edge);

private:
  void
  join(HalfEdge a, HalfEdge b);

  std::vector<Triangle>& triangles_;
  std::vector<HalfEdge> twins_, firsts_;
  ManifoldDefects defects_;
};

} // namespace pcl_uvol::detail
