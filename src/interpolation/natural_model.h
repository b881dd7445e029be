// SPDX-License-Identifier: BSD-3-Clause
// Natural-neighbour interpolation in three dimensions by exact Voronoi cells: Sibson's
// coordinates (1981) and Laplace's (Belikov et al. 1997).
#pragma once

#include "interpolation/field_model.h"
#include "neighbors/delaunay_cavity.h"
#include "neighbors/voronoi_cell.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Which coordinates natural neighbours get. */
enum class NaturalCoordinates {
  Sibson, ///< the volume that the place's cell takes from the sample's one
  Laplace ///< the area of the face between them by their distance
};

/** \brief Natural neighbours of one place after another, with their coordinates; one
 * object per thread. */
class NaturalNeighborFinder {
public:
  struct Neighbor {
    std::uint32_t sample;
    double weight;                  ///< before it is divided by the sum of all
    std::array<double, 3> gradient; ///< of it; NaN for Laplace's
  };

  /** \param samples must outlive the finder */
  NaturalNeighborFinder(const SampleSet& samples, NaturalCoordinates coordinates);

  /** \brief Find those of a place that is no sample.
   * \param near samples to begin with: the nearest ones, as many as it pleases, in any
   * order
   * \return false outside of the convex hull */
  bool
  find(const Query& place, const std::uint32_t* near, std::size_t count);

  /** \brief Neighbours by sample index. */
  const std::vector<Neighbor>&
  getNeighbors() const
  {
    return neighbors_;
  }

private:
  /** Take them from a simple cell.
   * \return false if rounding decides what their volumes are */
  bool
  takeSimpleCell();

  /** Take them from a cell of polygons. */
  void
  takePolygons();

  /** The volumes of the parts of the cell that each face's sample was nearest to. */
  void
  computeVolumes();

  /** Sort the samples of the other faces by their distance from one: the cells of
   * nearer samples leave nothing of most faces between two samples, and few of them are
   * needed to see that. A cell among stretched samples has hundreds of faces. */
  void
  sortByDistance(std::size_t i);

  /** The area, within the cell, of the face between the cells that two samples had;
   * after sortByDistance(i).
   * \return that times the height of its plane over the first one's side */
  double
  measureBetween(std::size_t i, std::size_t j);

  CellSearch search_;
  SimpleCellFinder simple_cells_;
  DelaunayCavity cavity_;
  VoronoiCellFinder cells_;
  NaturalCoordinates coordinates_;
  std::vector<Neighbor> neighbors_;
  std::vector<Eigen::Vector3d> offsets_; ///< of the samples of the faces
  std::vector<double> halves_;           ///< of their squared lengths
  std::vector<std::pair<double, std::size_t>> by_distance_; ///< from one of them
  ConvexPolygon part_;
};

/** \brief The mean of the natural neighbours' values by their coordinates: passes
 * through the samples, exact for linear functions, ends at their convex hull. The
 * standard error is the weighted standard deviation of the values. */
class NaturalModel : public FieldModel {
public:
  NaturalModel(const SampledFields& sampled, NaturalCoordinates coordinates);

  void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const override;

private:
  const SampledFields& sampled_;
  NaturalCoordinates coordinates_;
  std::vector<Position> sparse_;
};

} // namespace pcl_uvol::detail
