// SPDX-License-Identifier: BSD-3-Clause
// The lattice that gaps between samples are filled on, and means of samples over its
// cells.
#pragma once

#include "neighbors/sample_set.h"
#include "pipeline/lattice_band.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

using Place = std::array<double, 3>;

/** \brief Where nodes lie; lengths are those of the stretched space. */
class Lattice {
public:
  /** \param samples whose box it begins at */
  Lattice(double spacing, const Eigen::Array3f& scale, const SampleSet& samples);

  /** \brief In the original space, rounded to float as positions are. */
  Place
  placeOf(const LatticeNode& node) const;

  /** \brief The cell that a place is in, by its lowest node. */
  LatticeNode
  cellOf(const Place& place) const;

private:
  double
  factor(std::size_t axis) const
  {
    return static_cast<double>(scale_[static_cast<Eigen::Index>(axis)]);
  }

  double spacing_;
  Eigen::Array3f scale_;
  Place origin_{};
};

/** \brief What is averaged in one cell of a lattice. */
struct Composite {
  LatticeNode cell;
  Place place;
  double value;
};

/** \brief The mean places and values of samples in the same cells, in the order of
 * these, whatever that of the samples. */
std::vector<Composite>
averageInCells(std::vector<Composite> samples);

} // namespace pcl_uvol::detail
