// SPDX-License-Identifier: BSD-3-Clause
// A fold's points, and those of the others that stand in for them.
#pragma once

#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <cstddef>

namespace pcl_uvol::detail {

/** \brief The points of a fold, and all others. */
struct PCL_UVOL_EXPORTS FoldSplit {
  pcl::Indices left_out, rest;

  /** \param indices points to take part
   * \param most points of the fold that are left out: random ones, the others are
   * nowhere; 0: all
   * \throws InvalidArgument where nothing is left */
  FoldSplit(const pcl::Indices& indices,
            const Folds& folds,
            std::size_t fold,
            std::size_t most);

  /** \brief The fields at the points left out, from those of the rest.
   * \param report gets the warnings of the model that it does not have yet
   * \throws InvalidArgument as FieldInterpolation::interpolate */
  InterpolatedFields
  interpolate(const CloudView& cloud,
              const InterpolationParameters& parameters,
              unsigned threads,
              Report& report) const;
};

} // namespace pcl_uvol::detail
