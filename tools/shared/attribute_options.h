// SPDX-License-Identifier: BSD-3-Clause
// Attributes and labels on the command line: what uvol_cluster and uvol_project share.
#pragma once

#include "shared/options.h"
#include "shared/point_files.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/multivariate/star_coordinates.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief -attributes, -position and -raw. */
class AttributeOptions {
public:
  void
  declare(Options& options);

  /** \brief True if there are any. */
  bool
  areGiven() const
  {
    return !text_.empty() || has_position_;
  }

  /** \brief The fields that are asked for.
   * \throws UsageError if there are none */
  std::vector<std::string>
  required() const;

  /** \brief Compute those that are expressions, see addDerivedField. */
  void
  addFields(const Options& options,
            pcl_uvol::Dataset& dataset,
            pcl_uvol::Report& report);

  /** \brief Clusters of these attributes, per point.
   * \throws as DensityClustering, and InvalidArgument for the position of data that
   * have none */
  pcl_uvol::Clustering
  cluster(const Options& options,
          const pcl_uvol::Dataset& dataset,
          const pcl_uvol::ClusteringParameters& parameters,
          pcl_uvol::Report& report) const;

  /** \brief Points of these attributes in space.
   * \param label field of the clusters; empty: the field "label", else they are found
   * \throws as StarCoordinates, and as cluster() */
  pcl_uvol::ProjectedPoints
  project(const Options& options,
          const pcl_uvol::Dataset& dataset,
          const std::string& label,
          pcl_uvol::ProjectionMethod method,
          pcl_uvol::Report& report) const;

private:
  void
  checkPosition(const pcl_uvol::Dataset& dataset) const;

  std::string text_;
  std::vector<std::string> names_; ///< that text_ lists, as stages call them
  bool has_position_ = false, is_standardized_ = true;
};

/** \brief How files of attributes are read: they need no coordinates. */
pcl_uvol::LoadOptions
withoutPositions(const InputOptions& reading);

/** \brief The field of labels: the one that is asked for, else "label" if there is one,
 * else "". */
std::string
labelField(const pcl_uvol::CloudView& cloud, const std::string& asked_for);

/** \brief Labels of all points; -1 where there is none.
 * \throws InvalidArgument for an unknown field, or values that are no whole numbers */
std::vector<std::int32_t>
readLabels(const pcl_uvol::CloudView& cloud, const std::string& field);

/** \brief Some points of a dataset. */
pcl_uvol::Dataset
takePoints(const pcl_uvol::Dataset& dataset, const std::vector<std::uint32_t>& points);

/** \brief The same at other places. */
pcl_uvol::Dataset
takePoints(const pcl_uvol::Dataset& dataset,
           const std::vector<std::uint32_t>& points,
           const std::vector<std::array<float, 3>>& places);

} // namespace uvol_tools
