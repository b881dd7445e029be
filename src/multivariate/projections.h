// SPDX-License-Identifier: BSD-3-Clause
// Projections of tables of attributes: principal axes, and those that keep clusters
// apart.
#pragma once

#include "multivariate/attributes.h"
#include <pcl_uvol/multivariate/star_coordinates.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The first three principal components: the directions of largest variance, in
 * descending order. The largest component of each is positive.
 * \throws InvalidArgument for a table without rows or columns, or whose arrays disagree
 * in size */
PCL_UVOL_EXPORTS Projection
principalAxes(const AttributeTable& table, unsigned threads = 0);

/** \brief The projection that keeps apart the two clusters that are hardest to tell: it
 * maximises the smallest Fisher ratio, see smallestFisherRatio.
 *
 * The ratios do not change under linear maps of the 3-D space, so the rows can be
 * orthonormal: x carries most of the variance of the cluster centres, then y; the
 * largest component of each row is positive. The maximum is looked for by gradient
 * ascent on a soft minimum of increasing sharpness from several starts, so it may be a
 * local one, but it is no worse than the best start, the principal axes among them.
 * Two clusters get their best projection: x holds their discriminant, the rest is
 * principal axes of what is left. With three attributes or fewer, where nothing is to
 * be chosen, or fewer than two clusters, it is principalAxes; the latter gives a
 * warning. Clusters with equal centres, which nothing keeps apart, are counted as
 * "inseparable_pairs" and left alone.
 *
 * Memory: 4 bytes per row, 16 m^2 per cluster and 8 m^2 per 4096 rows. The time grows
 * with rows m^2, and with clusters m^2 + clusters^2 per step.
 * \param labels cluster of every row; negative ones are noise, which no ratio looks at
 * \param report gets the count "inseparable_pairs" and times
 * \throws InvalidArgument as principalAxes, for another number of labels than of rows,
 * for a regularization out of range */
PCL_UVOL_EXPORTS Projection
starCoordinates(const AttributeTable& table,
                const std::vector<std::int32_t>& labels,
                const StarCoordinateParameters& parameters,
                unsigned threads,
                Report& report);

/** \brief The smallest Fisher ratio of two clusters in the projected space:
 * (mu_a - mu_b)^T (S_a + S_b)^-1 (mu_a - mu_b) with centres mu and regularised
 * covariances S (sums divided by the number of rows), that is the squared distance of
 * the centres in units of the spread along it; infinite for fewer than two clusters.
 * \throws InvalidArgument as starCoordinates, and for a projection of other attributes
 */
PCL_UVOL_EXPORTS double
smallestFisherRatio(const AttributeTable& table,
                    const std::vector<std::int32_t>& labels,
                    const Projection& projection,
                    const StarCoordinateParameters& parameters = {},
                    unsigned threads = 0);

} // namespace pcl_uvol
