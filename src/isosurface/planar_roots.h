// SPDX-License-Identifier: BSD-3-Clause
// From linear isopoints of samples on a plane to the zero level of polynomials there.
#pragma once

#include "isosurface/fit_judgement.h"
#include "neighbors/nearest_finder.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Fits in planes, one isopoint after another; one object per thread. */
class PlanarRoots {
public:
  /** \param input must outlive this */
  PlanarRoots(const IsopointInput& input, float isovalue);

  /** \brief Fit where the samples around lie on a plane: what a fit in space says of
   * the way across it is made of rounding and noise.
   * \param center the linear root, in the stretched space
   * \param given the isopoint without a fit
   * \param point as a fit in space has left it; stays so where there is no plane
   * \param fit the same */
  void
  smooth(const Position& center,
         const IsoEdge& edge,
         const PointIso& given,
         PointIso& point,
         RootFit& fit);

private:
  /** Find the nearest samples, nearest first, and their plane. */
  bool
  findPlaneAround(const Surroundings& surroundings, PlaneAxes& axes);

  /** As many of them as a fit in a plane needs fill the first lane. */
  void
  fillLane(const IsoEdge& edge, Surroundings& surroundings);

  const IsopointInput& input_;
  float isovalue_;
  NearestFinder finder_;
  std::vector<std::pair<float, std::uint32_t>> nearest_; ///< squared distances, samples
  std::vector<std::uint32_t> neighbors_;                 ///< that are fitted
  std::vector<FitSample> samples_;
};

} // namespace pcl_uvol
