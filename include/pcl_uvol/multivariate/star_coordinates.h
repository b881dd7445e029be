// SPDX-License-Identifier: BSD-3-Clause
// Star coordinates: linear maps from a space of many attributes to the space we see,
// with an axis per attribute (Kandogan 2000), chosen so that clusters stay apart
// (thesis 2.6; Linsen, Long, Rosenthal, Rosswog 2008).
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/multivariate/attributes.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A linear map from m attributes to 3-D: the sum of the axes of all attributes,
 * each times its value less the mean. */
struct PCL_UVOL_EXPORTS Projection {
  std::vector<std::string> names; ///< of the attributes
  std::vector<double> mean;       ///< per attribute
  /** x, y, z: each a row of m numbers, one per attribute. Rows are of length 1 and
   * perpendicular to each other; where there are fewer than 3 attributes, the last rows
   * are 0. */
  std::array<std::vector<double>, 3> rows;

  /** \brief Where a row of an AttributeTable with these columns comes to lie. */
  std::array<float, 3>
  project(const float* attributes) const;
};

/** \brief How a projection is optimised. */
struct StarCoordinateParameters {
  /** Added to the variance of each attribute in every cluster, as a part of its
   * variance over all clusters: in (0, 1], default 1e-9, far above what float rounds.
   * Flat clusters, such as single points, then have finite ratios. */
  double regularization = 1e-9;
  /** Steps per start and sharpness of the soft minimum; 0: the best start as it is. */
  unsigned steps = 40;
  /** 0 = all cores. The result does not depend on it. */
  unsigned threads = 0;
};

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
                Report& report);

/** \brief The smallest Fisher ratio of two clusters in the projected space:
 * (mu_a - mu_b)^T (S_a + S_b)^-1 (mu_a - mu_b) with centres mu and regularised
 * covariances S (sums divided by the number of rows), that is the squared distance of
 * the centres in units of the spread along it; infinite for fewer than two clusters.
 * \throws InvalidArgument as starCoordinates, and for a projection of other attributes
 */
PCL_UVOL_EXPORTS double
smallestFisherRatio(
    const AttributeTable& table,
    const std::vector<std::int32_t>& labels,
    const Projection& projection,
    const StarCoordinateParameters& parameters = StarCoordinateParameters());

} // namespace pcl_uvol
