// SPDX-License-Identifier: BSD-3-Clause
// The exact Voronoi cell that a place would have among samples, without a
// triangulation.
#pragma once

#include "neighbors/convex_cell.h"
#include "neighbors/query.h"
#include "neighbors/sample_set.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Cells of one place after another; one object per thread.
 *
 * A cell is cut by the bisectors of near samples first. A vertex of it is one of the
 * final cell if no sample lies in the ball around it that the place lies on; where one
 * does, its bisector cuts the vertex off. */
class VoronoiCellFinder {
public:
  /** \param samples must outlive the finder */
  explicit VoronoiCellFinder(const SampleSet& samples);

  /** \brief Find the cell of a place that is no sample.
   * \param near samples to begin with: the nearest ones, as many as it pleases, in any
   * order
   * \return false if the cell is not bounded: the place lies outside of the convex hull
   * of the samples; what is found then is the cell among the first ones and some
   * others, within a cube far outside */
  bool
  find(const Query& place, const std::uint32_t* near, std::size_t count);

  /** \brief Find the cell of a sample, to its end also where it is not bounded: then
   * within a cube of some hundred diagonals of the samples' box.
   * \param near other samples to begin with, at least one */
  void
  findWhole(std::uint32_t sample, const std::uint32_t* near, std::size_t count);

  /** \brief Relative to the place; the tags of its faces are places in getNeighbors().
   */
  const ConvexCell&
  getCell() const
  {
    return cell_;
  }

  /** \brief Samples whose bisectors were tried, some of them without a face. */
  const std::vector<std::uint32_t>&
  getNeighbors() const
  {
    return neighbors_;
  }

  /** \brief A sample seen from the place. */
  Eigen::Vector3d
  offsetOf(std::uint32_t sample) const;

private:
  static constexpr std::uint32_t no_sample = 0xffffffffu;

  struct Vertex {
    double sq_length; ///< from the place
    Eigen::Vector3d place;

    bool
    operator<(double other) const
    {
      return sq_length < other;
    }
  };

  /** Cut with the first samples. */
  void
  start(const Query& place, const std::uint32_t* near, std::size_t count);

  /** Look at the farthest vertex that may not be final: cut it off if it is not.
   * \return false if all are */
  bool
  improve();

  bool
  isKnown(const Eigen::Vector3d& vertex) const;

  /** The sample nearest to a vertex, if one is nearer than the place. */
  bool
  findInBall(const Eigen::Vector3d& vertex, std::uint32_t& found) const;

  const SampleSet& samples_;
  Query place_{};
  std::uint32_t own_ = no_sample; ///< at the place
  ConvexCell cell_;
  std::vector<std::uint32_t> neighbors_;
  std::vector<Vertex> final_; ///< ascending
  bool is_bounded_ = true;
  double sq_reach_ = 0.0; ///< all samples nearer to the place are tried
};

} // namespace pcl_uvol::detail
