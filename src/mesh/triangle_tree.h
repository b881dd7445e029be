// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a mesh that are nearest to a place, or beside a segment.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A point of a triangle. */
struct TrianglePoint {
  Eigen::Vector3d place;
  std::array<double, 3> lambda; ///< weights of the corners, which add up to 1
};

/** \brief The point of a triangle nearest to a place (Ericson, Real-Time Collision
 * Detection, 2005, 5.1.5); of one without area, that of one of its edges. */
PCL_UVOL_EXPORTS TrianglePoint
nearestOfTriangle(const std::array<Eigen::Vector3d, 3>& corners,
                  const Eigen::Vector3d& place);

/** \brief A tree of boxes around triangles; it knows the corners that all of a box
 * share, since many triangles may meet in one. */
class PCL_UVOL_EXPORTS TriangleTree {
public:
  /** \brief What is nearest. */
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
    TrianglePoint point;
  };

  /** \param places of the vertices; they and the triangles, at least one, must outlive
   * this */
  TriangleTree(const std::vector<Eigen::Vector3d>& places,
               const std::vector<Triangle>& triangles);

  /** \brief The nearest point of all triangles. */
  Nearest
  find(const Eigen::Vector3d& place) const;

  /** \brief The triangles whose boxes the segment between two vertices meets, but
   * those that have one of these as a corner, in no order.
   * \param found gets them behind what it holds */
  void
  findMet(std::uint32_t from,
          std::uint32_t to,
          std::vector<std::uint32_t>& found) const;

private:
  /** Triangles from begin to end; the first child follows, unless it is a leaf. */
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t begin, end;
    std::uint32_t second = 0; ///< child; 0: a leaf
    Triangle corners{};       ///< that all its triangles have; others are no_vertex
  };

  class Segment;

  Triangle
  findCommonCorners(std::uint32_t begin, std::uint32_t end) const;

  std::uint32_t
  build(const std::vector<Eigen::Vector3d>& centers,
        std::uint32_t begin,
        std::uint32_t end);

  void
  find(std::uint32_t node, const Eigen::Vector3d& place, Nearest& nearest) const;

  void
  findMet(std::uint32_t node,
          const Segment& segment,
          std::vector<std::uint32_t>& found) const;

  std::array<Eigen::Vector3d, 3>
  cornersOf(std::uint32_t triangle) const;

  const std::vector<Eigen::Vector3d>& places_;
  const std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t> order_; // of triangles
  std::vector<Node> nodes_;
};

} // namespace pcl_uvol::detail
