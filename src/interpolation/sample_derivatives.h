// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of scattered fields at their own samples: those of the polynomials that
// FieldInterpolation blends.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Derivatives of a field at a point, per unit of length of the cloud. */
struct PointDerivatives {
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;
};

/** \brief Takes the derivatives of all fields at a point. */
using TakeDerivatives =
    std::function<void(std::size_t point, const PointDerivatives* fields)>;

/** \brief Derive fields given at the points of a cloud.
 *
 * Per sample a least-squares cubic or quadratic through its 40 nearest samples:
 * gradients are exact for cubics, of third order otherwise, and second derivatives of
 * second order. Where samples are stretched, or a cubic does not follow the values, a
 * quadratic through the 26 nearest ones in the metric of the sampling. Where samples
 * lie on few planes or lines, derivatives across them are 0. Where the standard error
 * of a gradient is larger than the differences between values, derivatives are NaN.
 * Points at one place count as one sample, with the median of their values, and get the
 * same derivatives.
 *
 * \param columns [field][point] values, none of which a point takes
 * part in that has no finite value of one of them
 *
 * \param take called once, from any
 * thread, for every point that takes part
 *
 * \param report gets the counts "non_finite",
 * "duplicates", "conflicting_duplicates", "reduced_fits", of samples that lie on few
 * planes or lines, and "unknown_derivatives", of samples with a field whose derivatives
 * are NaN
 *
 * \return samples that lie on few planes or lines
 *
 * \throws InvalidArgument for fewer than four distinct samples with values
 *
 * Memory: about 50 bytes per sample, and 8 per sample and field. */
PCL_UVOL_EXPORTS std::uint64_t
computeDerivatives(const CloudView& cloud,
                   const std::vector<std::vector<double>>& columns,
                   unsigned threads,
                   const TakeDerivatives& take,
                   Report& report);

} // namespace pcl_uvol::detail
