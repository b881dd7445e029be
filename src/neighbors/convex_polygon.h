// SPDX-License-Identifier: BSD-3-Clause
// A convex polygon in a plane that is cut by half-planes, for faces of Voronoi cells.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Area of a polygon, and its centroid. */
struct PolygonMoments {
  double area;
  Eigen::Vector2d centroid;
};

/** \brief Vertices counterclockwise, of which some may coincide. */
class ConvexPolygon {
public:
  /** \brief Become a square about the origin. */
  void
  start(double half_side);

  /** \brief Keep what lies where a x + b y <= c.
   * \param tolerance heights up to it are none
   * \return false if that is all there was, but for rounding */
  bool
  cut(double a, double b, double c, double tolerance);

  /** \brief Number of vertices; 0: nothing is left. */
  std::size_t
  size() const
  {
    return count_;
  }

  Eigen::Vector2d
  operator[](std::size_t vertex) const
  {
    return {x_[vertex], y_[vertex]};
  }

  /** \brief Squared distance of the farthest vertex from the origin. */
  double
  getSqReach() const
  {
    return sq_reach_;
  }

  /** \brief The centroid of a polygon without area is one of its vertices. */
  PolygonMoments
  computeMoments() const;

private:
  void
  addCrossing(std::size_t from, std::size_t to, std::size_t& kept);

  /** Keep the vertices from one up to, but not, another one, and where the sides behind
   * the last and before the first one cross the line. */
  void
  keepRun(std::size_t first, std::size_t end);

  /** The same where rounding has made several runs. */
  void
  keepRuns(double tolerance);

  void
  finishCut(std::size_t kept);

  std::size_t count_ = 0;
  double sq_reach_ = 0.0;
  std::vector<double> x_, y_;                     // of vertices, with room behind them
  std::vector<double> heights_, next_x_, next_y_; // what cut() works with
};

} // namespace pcl_uvol::detail
