// SPDX-License-Identifier: BSD-3-Clause
// Where local fits tell more of the surface across gaps than kriging does: cells of CFD
// that are stretched look like lines, and what lies between them is known.
#pragma once

#include "neighbors/sample_set.h"
#include "pipeline/kriged_slopes.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Tells of places whether the fits around them are the more certain ones:
 * whether most of the isopoints around the nearest one have smaller errors than the
 * kriged surface there, and whether that runs elsewhere at most of these.
 *
 * Where it does not it does no harm: predicted samples lie denser than edges across
 * gaps and tell more of the surface between these. Among samples all around nothing is
 * gained by that. */
class PCL_UVOL_EXPORTS ReliableFits {
public:
  /** \param crossings isopoints of fits, on edges across gaps or among samples all
   * around, and their errors; infinite without a fit
   * \param are_supported one per crossing: samples lie all around
   * \param kriged the kriged field there
   * \param scale of the stretched space, in which the nearest ones are found
   * \param spacing of predicted samples there */
  ReliableFits(const pcl::PointCloud<PointIso>& crossings,
               const std::vector<std::uint8_t>& are_supported,
               const std::vector<KrigedSlope>& kriged,
               const Eigen::Array3f& scale,
               double spacing,
               unsigned threads);

  /** \return one per place: 1 where fits are more certain; 0 everywhere without
   * crossings */
  std::vector<std::uint8_t>
  find(const std::vector<std::array<double, 3>>& places, unsigned threads) const;

private:
  SampleSet::ConstPtr crossings_;          ///< null without any
  std::vector<std::uint8_t> are_reliable_; ///< fits around each crossing
};

} // namespace pcl_uvol::detail
