// SPDX-License-Identifier: BSD-3-Clause
// What a cloud holds: ranges, histograms, spacing, isovalues worth a look.
#pragma once

#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Finite values of a scalar. */
struct ValueStatistics {
  std::uint64_t finite = 0, missing = 0;
  double min = 0.0, max = 0.0, mean = 0.0;   ///< 0 if nothing is finite
  std::array<std::uint64_t, 16> histogram{}; ///< equal bins from min to max
  /** Quantiles 0.25, 0.5, 0.75 and 0.95 of the values strictly between min and max,
   * without repetition: every one has samples on both sides. What -iso may start with.
   */
  std::vector<double> isovalues;
};

/** \brief Statistics of finite numbers; NaN and infinities count as missing. */
PCL_UVOL_EXPORTS ValueStatistics
describeValues(const std::vector<double>& values);

/** \brief Values of a scalar field, one per point. */
PCL_UVOL_EXPORTS std::vector<double>
readFieldValues(const Dataset& dataset, const ScalarField& field);

/** \brief Positions of a cloud. */
struct PositionStatistics {
  std::uint64_t non_finite = 0;
  std::uint64_t duplicates = 0;           ///< points at a position that came before
  std::array<double, 3> lower{}, upper{}; ///< with the origin added, 0 without points
  /** Distance to the nearest other position: smallest, median, largest; 0 for fewer
   * than two positions. */
  double spacing_min = 0.0, spacing_median = 0.0, spacing_max = 0.0;
  SamplingSummary sampling; ///< of the stretched space; of 0 samples below two
  /** Of positions so far out that the others do not count them. */
  std::vector<Message> warnings;
};

/** \brief Bounds, duplicates and spacing; nothing but the count where no position is
 * finite.
 *
 * \param stretch of the space that spacings are measured in
 *
 * \param progress told of "tree" and "spacing"; empty: nobody is told */
PCL_UVOL_EXPORTS PositionStatistics
describePositions(const Dataset& dataset,
                  const detail::Stretch& stretch,
                  unsigned threads,
                  const ProgressCallback& progress);

/** \brief Add what the sampling is like around each point, see LocalSampling, to a
 * dataset with coordinates: the labels `local_dimension` (isolated, line, sheet,
 * volume) and the lengths `spacing_along` and `spacing_across`, NaN where nothing lies
 * beside, and without finite coordinates.
 *
 * \param stretch of the space that lengths are measured in
 * \param progress told of "tree" and "sampling"; empty: nobody is told */
PCL_UVOL_EXPORTS void
addSamplingFields(Dataset& dataset,
                  const detail::Stretch& stretch,
                  unsigned threads,
                  const ProgressCallback& progress);

} // namespace pcl_uvol
