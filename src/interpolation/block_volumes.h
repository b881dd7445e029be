// SPDX-License-Identifier: BSD-3-Clause
// How much of a volume is beyond a value, from block kriging: tonnage and grade above a
// cutoff, without a surface.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief What is asked of blocks. */
struct BlockParameters {
  std::string field;
  std::vector<double> isovalues;
  bool is_lower_outside = true; ///< false: what is below an isovalue is beyond it
  Eigen::Array3f sides{0.0f, 0.0f, 0.0f}; ///< of the blocks, in units of length, > 0
  /** Of the metric, as those of InterpolationParameters. @{ */
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  Eigen::Array3d rotation{0.0, 0.0, 0.0};
  /** @} */
};

/** \brief What is beyond one isovalue. */
struct BlockVolume {
  double isovalue;
  double volume, volume_error;     ///< in units of length, cubed, with standard errors
  double mean, mean_error;         ///< of the field there; NaN without any volume
  double integral, integral_error; ///< volume times mean
  Eigen::Vector3d centroid;        ///< NaN without any volume
};

/** \brief Blocks over the box of the samples, and what is beyond isovalues in them. */
struct BlockVolumes {
  std::array<std::size_t, 3> blocks{}; ///< along each axis
  std::size_t estimated = 0;           ///< blocks whose mean is estimated
  std::vector<BlockVolume> isovalues;
};

/** \brief Estimate what is beyond isovalues.
 *
 * The mean of every block is kriged from 32 samples of all octants. It is taken as
 * normal about its estimate with the standard deviation of block kriging, so a block
 * counts with its probability to be beyond the isovalue (Chiles and Delfiner,
 * Geostatistics, section 6.2): volumes never rise with a cutoff, and are never
 * negative. Blocks outside of the data, and those whose estimate is no more certain
 * than the mean of all samples, are left out. Errors of blocks are taken as correlated
 * as values of the field are, which is more than they are: standard errors are upper
 * estimates. The error of the variogram is not among them.
 *
 * \throws InvalidArgument for sides that are not positive or make more than 2^24
 * blocks, where the samples tell of no block, and as FieldInterpolation */
PCL_UVOL_EXPORTS BlockVolumes
estimateBlockVolumes(const CloudView& samples,
                     const BlockParameters& parameters,
                     unsigned threads,
                     Report& report);

} // namespace pcl_uvol::detail
