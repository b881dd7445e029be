// SPDX-License-Identifier: BSD-3-Clause
// Membership in a cluster as a field on the points: its isosurface of value 0.5 parts
// the cluster from the rest (thesis 2.6).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/report.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief 1 for the points of a cluster, 0 for all others.
 * \param cluster one of the labels, that of noise as well
 * \throws InvalidArgument for a label that no point has, naming those that there are */
PCL_UVOL_EXPORTS std::vector<float>
membership(const std::vector<std::int32_t>& labels, std::int32_t cluster);

/** \brief Membership smoothed by the kernel of smoothed particle hydrodynamics: at
 * every particle i
 *
 *   sum_j m_j V_j W(|x_i - x_j|, h_j) / sum_j V_j W(|x_i - x_j|, h_j)
 *
 * with the cubic spline W of support 2 h (Monaghan 1992), the smoothing length h_j of
 * the particle that contributes, and its volume V_j = h_j^3, which is the one that all
 * particles of a simulation with a fixed number of neighbours have, up to a factor.
 * (Shepard 1968; the result lies in [0, 1].)
 *
 * Particles whose position is not finite, or whose smoothing length is not a number
 * above 0, keep their membership and do not contribute; they are counted as
 * "not_smoothed". Memory: 60 bytes per particle.
 * \param values membership per particle, in [0, 1]
 * \param smoothing_lengths per particle, in units of the coordinates; they may vary by
 * orders of magnitude
 * \param threads 0 = all cores; the result does not depend on it
 * \param report gets the count above and times
 * \throws InvalidArgument for another number of values or lengths than of points, and
 * values out of range */
PCL_UVOL_EXPORTS std::vector<float>
smoothMembership(const CloudView& cloud,
                 const std::vector<float>& values,
                 const std::vector<float>& smoothing_lengths,
                 unsigned threads,
                 Report& report);

} // namespace pcl_uvol
