// SPDX-License-Identifier: BSD-3-Clause
// On which side of an isosurface the centres of cells lie, and how far from it.
#pragma once

#include "isosurface/isopoints.h"
#include "mesh/cell_tiling.h"
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A cell that a surface passes by. Lengths and places are those of the input.
 */
struct BandCell {
  Eigen::Vector3d center; ///< of its box
  /** There, minus the isovalue: that of a fit, or where there is none the sample's;
   * see RootFit. */
  double value;
  bool has_foot;          ///< else the members below are undefined
  Eigen::Vector3d foot;   ///< the point of the surface next to the centre
  Eigen::Vector3d normal; ///< of the surface there, towards lower values
  double mean_curvature;  ///< there, positive where higher values are convex
};

/** \brief The cells beside one isosurface.
 *
 * Samples lie anywhere in their cells. Joined where cells touch, they form tetrahedra a
 * sixth of which is turned inside out, and a surface between samples has handles that
 * the field has not; the centres of the boxes do not (0.2 % of the tetrahedra). The
 * side of a cell is therefore that of its centre, by the fit that isopoints are made by
 * as well, and that of the sample only where no fit serves. Fits are made where they
 * count: at cells that touch one of the other side, until no more are found. */
class CellValues {
public:
  /** \param tiling of the samples of the input
   * \param report gets the count "band_cells" and the time of "cells" */
  CellValues(const CellTiling& tiling,
             const IsopointInput& input,
             float isovalue,
             Report& report);

  /** \brief True where the value is not below the isovalue. No ghost. */
  bool
  isAbove(std::uint32_t cell) const
  {
    const std::uint32_t place = place_of_[cell];
    return place == none ? input_.values[cell] >= isovalue_
                         : cells_[place].value >= 0.0;
  }

  /** \brief Whether a cell touches one of the other side, or did for its sample. */
  bool
  isInBand(std::uint32_t cell) const
  {
    return place_of_[cell] != none;
  }

  const BandCell&
  getCell(std::uint32_t cell) const
  {
    return cells_[place_of_[cell]];
  }

  /** \brief Put cells of the band on the other side of the surface. */
  void
  turn(const std::vector<std::uint32_t>& cells, Report& report);

  /** \brief Number of a cell of the band, from 0 in the order in which they came. */
  std::uint32_t
  placeOf(std::uint32_t cell) const
  {
    return place_of_[cell];
  }

  /** \brief The cells of the band, ascending. */
  const std::vector<std::uint32_t>&
  getBand() const
  {
    return band_;
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /** A sample to be looked at, and a touching one on the other side. */
  struct Candidate {
    std::uint32_t sample, partner;
  };

  std::vector<Candidate>
  findPartners(const std::vector<std::uint32_t>& samples) const;

  /** The cells without a fit that touch one of these on the other side. */
  std::vector<Candidate>
  findOthers(const std::vector<Candidate>& fitted) const;

  /** Fit what is given, and what then turns out to touch the other side. */
  void
  fitAll(std::vector<Candidate> candidates, Report& report);

  void
  fit(const std::vector<Candidate>& candidates, StepTimer& step);

  const CellTiling& tiling_;
  const IsopointInput& input_;
  float isovalue_;
  std::vector<std::uint32_t> place_of_; // by sample, among cells_
  LargeArray<BandCell> cells_;
  std::vector<std::uint32_t> band_;
};

} // namespace pcl_uvol::detail
