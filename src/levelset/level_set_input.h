// SPDX-License-Identifier: BSD-3-Clause
// What a level set is made from: samples, values near 1, a function to start from.
#pragma once

#include "common/stretch_axes.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <pcl/types.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The samples of a cloud and their values. */
struct LevelSetInput {
  SampleSet::ConstPtr samples;
  std::vector<float> f; ///< minus the isovalue or in logarithms, by sample, see
                        ///< areLogarithmsSmoother() and tameValues()
  std::vector<std::uint32_t> sources;  ///< by sample, the points that they are of
  std::vector<std::uint32_t> crossing; ///< samples next to the zero level of f
  bool is_logarithmic;                 ///< see areLogarithmsSmoother()
  bool had_spikes;                     ///< see TamedValues
  double spacing; ///< the median one of these, in the unit of the samples
};

/** \brief The function that a level set starts from, as it is seen along axes.
 * \throws InvalidArgument for a box, whose sides lie along x, y and z */
InitialFunction
turnShape(const InitialFunction& initial, const detail::StretchAxes& axes);

/** \brief The same function where coordinates count from an origin. */
InitialFunction
moveShape(InitialFunction initial, const Eigen::Array3d& origin);

/** \throws InvalidArgument for parameters out of range */
void
checkParameters(const LevelSetParameters& parameters);

/** \brief Read what LevelSetEvolution::evolve() takes.
 * \throws InvalidArgument as that */
LevelSetInput
readInput(const CloudView& cloud,
          const pcl::Indices& indices,
          const LevelSetParameters& parameters,
          unsigned threads,
          Report& report);

/** \brief The function at the start where it is a shape or a field, by sample and in
 * the unit of the samples; empty where f itself is.
 * \throws InvalidArgument for a field that is not finite everywhere */
std::vector<float>
readInitialValues(const CloudView& cloud,
                  const LevelSetInput& input,
                  const LevelSetParameters& parameters);

} // namespace pcl_uvol
