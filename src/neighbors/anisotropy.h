// SPDX-License-Identifier: BSD-3-Clause
// Stretching for samples that lie denser along one axis than along others: slices of an
// image, profiles of an ocean.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Factors per axis that make the spacing of the samples equal along all of
 * them.
 *
 * The spacing is the median of what samples in all parts of the cloud have to their
 * natural neighbours. The axis of the largest one has factor 1. Samples on a plane or a
 * line have no spacing across; their spread is made equal instead, between the 5th and
 * the 95th percentile of the finite coordinates, and an axis without spread has factor
 * 1. Takes the time of a tree.
 * \throws InvalidArgument if no sample has finite coordinates */
PCL_UVOL_EXPORTS Eigen::Array3f
equalizingScale(const CloudView& cloud);

/** \brief Extent of samples along each axis, between the 5th and the 95th percentile of
 * their coordinates, so that a few outliers do not decide.
 * \param use samples, with finite coordinates */
PCL_UVOL_EXPORTS Eigen::Array3f
findSpread(const CloudView& cloud, const std::vector<std::uint32_t>& use);

/** \brief Factors per axis that make a spread equal. The axis of the largest one has
 * factor 1, and so has one without spread. */
Eigen::Array3f
equalizeSpread(const Eigen::Array3f& spread);

} // namespace pcl_uvol
