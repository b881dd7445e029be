// SPDX-License-Identifier: BSD-3-Clause
// Natural-neighbour interpolation in three dimensions by exact Voronoi cells: Sibson's
// coordinates (1981) and Laplace's (Belikov et al. 1997).
#pragma once

#include "interpolation/field_model.h"
#include "neighbors/cell_parts.h"
#include "neighbors/delaunay_cavity.h"

#include <array>
#include <cstdint>
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
  /** Take them from the faces of the cell.
   * \param needs_check refuse cells that rounding has left open, and parts in which it
   * decides where samples are not in general position
   * \return false if they are refused */
  bool
  takeCell(bool needs_check);

  CellSearch search_;
  SimpleCellFinder cells_;
  DelaunayCavity cavity_;
  CellParts parts_;
  NaturalCoordinates coordinates_;
  std::vector<Neighbor> neighbors_;
  std::vector<double> ratios_, volumes_; ///< of the faces
  std::vector<Eigen::Vector3d> moments_;
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
