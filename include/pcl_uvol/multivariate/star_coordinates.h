// SPDX-License-Identifier: BSD-3-Clause
// Star coordinates: linear maps from a space of many attributes to the space we see,
// with an axis per attribute (Kandogan 2000), chosen so that clusters stay apart
// (thesis 2.6; Linsen, Long, Rosenthal, Rosswog 2008).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>

#include <pcl/point_types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief A linear map from m attributes to 3-D: the sum of the axes of all attributes,
 * each times its value less the mean. An attribute is a field of the cloud, less its
 * offset and divided by its unit. */
struct PCL_UVOL_EXPORTS Projection {
  std::vector<std::string> names;         ///< of the attributes
  std::vector<double> offsets{}, units{}; ///< per attribute, of its field
  std::vector<double> mean;               ///< per attribute
  /** x, y, z: each a row of m numbers, one per attribute. Rows are of length 1 and
   * perpendicular to each other; where there are fewer than 3 attributes, the last rows
   * are 0. */
  std::array<std::vector<double>, 3> rows;

  /** \brief Where m attributes come to lie.
   * \param attributes m values, in the order of the attributes */
  std::array<float, 3>
  project(const float* attributes) const;
};

/** \brief How axes are chosen. */
enum class ProjectionMethod {
  Star, ///< the two clusters that are hardest to separate are as far apart as possible
  PrincipalAxes ///< the directions of largest variance
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<ProjectionMethod>, 2>
listWords(ProjectionMethod)
{
  return {{{ProjectionMethod::Star, "star"}, {ProjectionMethod::PrincipalAxes, "pca"}}};
}

/** \brief Parameters of StarCoordinates. */
struct PCL_UVOL_EXPORTS StarCoordinateParameters {
  /** Fields that span the space: `rho`, `vel[1]`, `|vel|`; x, y, z may be among them.
   */
  std::vector<std::string> attributes;
  /** Divide attributes by their standard deviations, so that units do not count. */
  bool is_standardized = true;
  ProjectionMethod method = ProjectionMethod::Star;
  /** Added to the variance of each attribute in every cluster, as a part of its
   * variance over all clusters: in (0, 1], default 1e-9, far above what float rounds.
   * Flat clusters, such as single points, then have finite ratios. */
  double regularization = 1e-9;
  /** Steps per start and sharpness of the soft minimum; 0: the best start as it is. */
  unsigned steps = 40;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = StarCoordinateParameters;
    return std::make_tuple(Member{"attributes", &Own::attributes},
                           Member{"is_standardized", &Own::is_standardized},
                           Member{"method", &Own::method},
                           Member{"regularization", &Own::regularization},
                           Member{"steps", &Own::steps});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static StarCoordinateParameters
  fromJson(const std::string& text);
};

/** \brief What StarCoordinates finds: one entry per point that has all attributes. */
struct ProjectedPoints {
  std::vector<std::array<float, 3>> places;
  pcl::Indices sources;    ///< points of the input cloud
  std::vector<int> labels; ///< of their clusters, negative for noise
  Projection projection;
  /** The smallest Fisher ratio of two clusters in the projected space. It is (mu_a -
   * mu_b)^T (S_a + S_b)^-1 (mu_a - mu_b). Here mu are the centres, S the regularised
   * covariances (sums divided by the number of points). This is the squared distance of
   * the centres in units of the spread along it. Infinite for fewer than two clusters.
   */
  double smallest_ratio;
};

namespace detail {

/** \brief The kernel of StarCoordinates for any cloud.
 * \param labels one per point of the cloud; none: clusters are found */
PCL_UVOL_EXPORTS ProjectedPoints
projectPoints(const CloudView& cloud,
              const pcl::Indices& indices,
              const std::vector<int>& labels,
              const StarCoordinateParameters& parameters,
              unsigned threads,
              Report& report);

} // namespace detail

/** \brief Projects points of many attributes into space so that their clusters lie
 * apart.
 *
 * \code
 * pcl_uvol::StarCoordinates<pcl::PCLPointCloud2> star;
 * star.setInputCloud(cloud);
 * star.setAttributes({"temperature", "density", "|velocity|"});
 * pcl::PointCloud<pcl::PointXYZ> projected;
 * star.compute(projected);
 * \endcode
 * The projection maximises the smallest Fisher ratio of two clusters by gradient ascent
 * on a soft minimum of increasing sharpness from several starts; it is no worse than
 * the best start, the principal axes among them. x carries most of the variance of the
 * cluster centres, then y; the largest component of each row is positive. With three
 * attributes or fewer, or fewer than two clusters, it is the principal axes.
 * Memory: 4 bytes per attribute of a point, 16 m^2 per cluster and 8 m^2 per 4096
 * points. The time grows with points m^2, and with clusters m^2 + clusters^2 per step.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class StarCoordinates : public CloudStage<PointT>,
                        public ParameterStage<StarCoordinateParameters> {
public:
  using Ptr = std::shared_ptr<StarCoordinates<PointT>>;
  using ConstPtr = std::shared_ptr<const StarCoordinates<PointT>>;

  /** \brief Fields that span the space; no default. */
  void
  setAttributes(const std::vector<std::string>& names)
  {
    parameters_.attributes = names;
  }

  /** \return The fields that are projected. */
  const std::vector<std::string>&
  getAttributes() const
  {
    return parameters_.attributes;
  }

  /** \brief Default: ProjectionMethod::Star. */
  void
  setMethod(ProjectionMethod method)
  {
    parameters_.method = method;
  }

  /** \return How they are projected. */
  ProjectionMethod
  getMethod() const
  {
    return parameters_.method;
  }

  /** \brief The cluster of every point of the input cloud, negative for noise. None,
   * the default: clusters are found by their density in the attributes, with the
   * defaults of DensityClustering. */
  void
  setLabels(const std::vector<int>& labels)
  {
    labels_ = labels;
  }

  /** \return The clusters that were set; empty: they are found. */
  const std::vector<int>&
  getLabels() const
  {
    return labels_;
  }

  /** \brief Find the projection and project the points that have all attributes.
   *
   * Counts of the report: missing_values, and with several clusters inseparable_pairs:
   * those with equal centres, which nothing keeps apart. Fewer than two clusters give a
   * warning.
   * \param points where they come to lie
   * \throws InvalidArgument without an input cloud, without attributes or for unknown
   * or repeated ones, and if no point has all of them. Also for a number of labels that
   * is not that of points, and a regularization out of range. points are then untouched
   */
  void
  compute(pcl::PointCloud<pcl::PointXYZ>& points);

  /** \brief All that the last compute() found. */
  const ProjectedPoints&
  getResult() const
  {
    return result_;
  }

private:
  std::vector<int> labels_;
  ProjectedPoints result_;
};

template <typename PointT>
void
StarCoordinates<PointT>::compute(pcl::PointCloud<pcl::PointXYZ>& points)
{
  this->withInput("StarCoordinates",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    result_ = detail::projectPoints(
                        cloud, indices, labels_, parameters_, threads_, report_);
                    points.clear();
                    for (const auto& place : result_.places)
                      points.push_back({place[0], place[1], place[2]});
                    points.header = this->input_->header;
                  });
}

} // namespace pcl_uvol
