// SPDX-License-Identifier: BSD-3-Clause
// Membership in a cluster as a field on the points: its isosurface of value 0.5 parts
// the cluster from the rest (thesis 2.6).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief Parameters of ClusterMembership. */
struct PCL_UVOL_EXPORTS MembershipParameters {
  int cluster = 0; ///< one of the labels, that of noise as well
  /** Field with the probability, in [0, 1], that a point belongs to its cluster:
   * members have it instead of 1. Empty: no field. */
  std::string probability;
  /** Field of smoothing lengths, in units of the coordinates: membership is smoothed by
   * the kernel of smoothed particle hydrodynamics. Empty: it is not. */
  std::string smoothing_length;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = MembershipParameters;
    return std::make_tuple(Member{"cluster", &Own::cluster},
                           Member{"probability", &Own::probability},
                           Member{"smoothing_length", &Own::smoothing_length});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static MembershipParameters
  fromJson(const std::string& text);
};

namespace detail {

/** \brief The kernel of ClusterMembership for any cloud.
 * \return one per index */
PCL_UVOL_EXPORTS std::vector<float>
computeMembership(const CloudView& cloud,
                  const pcl::Indices& indices,
                  const std::vector<int>& labels,
                  const MembershipParameters& parameters,
                  unsigned threads,
                  Report& report);

} // namespace detail

/** \brief Membership of every point in a cluster.
 *
 * \code
 * pcl_uvol::ClusterMembership<pcl::PCLPointCloud2> membership;
 * membership.setInputCloud(cloud);
 * membership.setLabels(labels); // of DensityClustering, say
 * membership.setCluster(2);
 * std::vector<float> values;
 * membership.compute(values);
 * \endcode
 * It is 1 for the points of the cluster, 0 for all others. Smoothed, it is at every
 * particle i
 *
 *   sum_j m_j V_j W(|x_i - x_j|, h_j) / sum_j V_j W(|x_i - x_j|, h_j)
 *
 * with the cubic spline W of support 2 h (Monaghan 1992). h_j is the smoothing length
 * of the particle that contributes, and V_j = h_j^3 its volume. In a simulation with a
 * fixed number of neighbours, this is the volume of all particles, up to a factor.
 * (Shepard 1968; the result is in [0, 1].) Particles whose position is not finite, or
 * whose smoothing length is not a number above 0, keep their membership and do not
 * contribute. Memory: 60 bytes per particle if smoothed.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class ClusterMembership : public CloudStage<PointT>,
                          public ParameterStage<MembershipParameters> {
public:
  using Ptr = std::shared_ptr<ClusterMembership<PointT>>;
  using ConstPtr = std::shared_ptr<const ClusterMembership<PointT>>;

  /** \brief The cluster of every point of the input cloud, negative for noise. */
  void
  setLabels(const std::vector<int>& labels)
  {
    labels_ = labels;
  }

  /** \return The cluster of every point, negative for noise. */
  const std::vector<int>&
  getLabels() const
  {
    return labels_;
  }

  /** \brief One of the labels, that of noise as well; default 0. */
  void
  setCluster(int cluster)
  {
    parameters_.cluster = cluster;
  }

  /** \return The label of the cluster whose membership is computed. */
  int
  getCluster() const
  {
    return parameters_.cluster;
  }

  /** \brief Compute the membership of the points of the indices, in their order.
   *
   * Counts of the report: cluster_points, and if smoothed not_smoothed.
   * \param values from 0 to 1, one for each point of the indices
   * \throws InvalidArgument without an input cloud, for another number of labels than
   * of points, a label that no point has, unknown fields, probabilities outside [0, 1];
   * values are then untouched */
  void
  compute(std::vector<float>& values);

private:
  std::vector<int> labels_;
};

template <typename PointT>
void
ClusterMembership<PointT>::compute(std::vector<float>& values)
{
  this->withInput("ClusterMembership",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    values = detail::computeMembership(
                        cloud, indices, labels_, parameters_, threads_, report_);
                  });
}

} // namespace pcl_uvol
