// SPDX-License-Identifier: BSD-3-Clause
// Hierarchical density-based clustering of the attributes of samples (thesis 2.6):
// HDBSCAN* of Campello, Moulavi and Sander 2013.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

/** \brief Parameters of DensityClustering. */
struct PCL_UVOL_EXPORTS ClusteringParameters {
  std::vector<std::string>
      attributes; ///< fields that span the space, see readAttributes
  /** Divide attributes by their standard deviations, so that units do not count. */
  bool is_standardized = true;
  /** Nearest other points that the core distance of a point reaches to, up to 1000. 0:
   * plain distances, single linkage. */
  std::size_t neighbors = 10;
  /** Smallest number of points of a cluster; 0: the larger one of 10 and the square
   * root of the number of points. */
  std::size_t min_cluster_size = 0;
  bool allow_single_cluster = false; ///< all points together may be the one chosen
  /** In units of the attributes or, if standardized, of standard deviations; 0:
   * clusters are chosen by persistence. */
  double cut_distance = 0.0;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = ClusteringParameters;
    return std::make_tuple(Member{"attributes", &Own::attributes},
                           Member{"is_standardized", &Own::is_standardized},
                           Member{"neighbors", &Own::neighbors},
                           Member{"min_cluster_size", &Own::min_cluster_size},
                           Member{"allow_single_cluster", &Own::allow_single_cluster},
                           Member{"cut_distance", &Own::cut_distance});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static ClusteringParameters
  fromJson(const std::string& text);
};

/** \brief A cluster at some level of density, 1 / distance. It is born where a larger
 * one splits and dies where it splits itself or its last point leaves it. */
struct ClusterNode {
  std::int32_t parent;  ///< index in the tree, less than the own one; -1: the root
  double birth_density; ///< 0 of the root
  double death_density;
  std::uint32_t size; ///< points at its birth
  double stability;   ///< excess of mass: sum over its points of the density where they
                      ///< leave it or it dies, less that of its birth
  std::int32_t label; ///< of the chosen cluster that it is; -1: it is not chosen
};

/** \brief Clusters of points. */
struct Clustering {
  std::vector<std::int32_t> labels; ///< per point: by decreasing size of the clusters,
                                    ///< zero-based, equal sizes by their first members;
                                    ///< -1: noise
  std::vector<float> probabilities; ///< of membership, in [0, 1]; 0 for noise
  std::vector<ClusterNode> tree;    ///< the root first, parents before children
};

namespace detail {

/** \brief Clustering with labels and probabilities per point of a cloud: those
 * that lack an attribute have label -1 and probability 0. */
PCL_UVOL_EXPORTS Clustering
clusterCloud(const CloudView& cloud,
             const pcl::Indices& indices,
             const ClusteringParameters& parameters,
             unsigned threads,
             Report& report);

} // namespace detail

/** \brief Finds clusters of samples by the density of their attributes.
 *
 * \code
 * pcl_uvol::DensityClustering<pcl::PCLPointCloud2> clustering;
 * clustering.setInputCloud(cloud);
 * clustering.setAttributes({"temperature", "density", "|velocity|"});
 * std::vector<int> labels;
 * clustering.compute(labels);
 * \endcode
 * At a distance d, points are connected if a chain of steps with mutual reachability
 * distances up to d leads from one to the other. From large to small d the points split
 * into ever denser clusters, a tree, while points in sparse surroundings leave them as
 * noise. The result has those clusters of the tree that do not overlap and whose
 * stabilities have the largest sum. You do not give a number of clusters; their shapes
 * and densities may differ. The result does not depend on threads; equal distances part
 * all at once, so that it does not depend on the order of the input either. Points at
 * distance 0 count as if half the smallest distance there is were between them. Memory:
 * about 230 bytes per point besides the cloud, with 6 attributes and 10 neighbours.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class DensityClustering : public CloudStage<PointT>,
                          public ParameterStage<ClusteringParameters> {
public:
  using Ptr = std::shared_ptr<DensityClustering<PointT>>;
  using ConstPtr = std::shared_ptr<const DensityClustering<PointT>>;

  /** \brief Fields that span the space, see readAttributes; no default. */
  void
  setAttributes(const std::vector<std::string>& names)
  {
    parameters_.attributes = names;
  }

  /** \return The fields that span the space. */
  const std::vector<std::string>&
  getAttributes() const
  {
    return parameters_.attributes;
  }

  /** \brief Divide attributes by their standard deviations, so that units do not count;
   * default true. */
  void
  setStandardized(bool is_standardized)
  {
    parameters_.is_standardized = is_standardized;
  }

  /** \return Whether attributes are divided by their standard deviations. */
  bool
  isStandardized() const
  {
    return parameters_.is_standardized;
  }

  /** \brief Nearest other points that the core distance of a point reaches to, up to
   * 1000, default 10: more of them smooth the density. 0: plain distances, single
   * linkage. */
  void
  setKSearch(std::size_t neighbors)
  {
    parameters_.neighbors = neighbors;
  }

  /** \return The neighbour whose distance estimates the density; 0: plain distances. */
  std::size_t
  getKSearch() const
  {
    return parameters_.neighbors;
  }

  /** \brief Smallest number of points of a cluster, 2 or more; 0, the default: the
   * larger one of 10 and the square root of the number of points. */
  void
  setMinClusterSize(std::size_t size)
  {
    parameters_.min_cluster_size = size;
  }

  /** \return The least number of points of a cluster; 0: chosen by their number. */
  std::size_t
  getMinClusterSize() const
  {
    return parameters_.min_cluster_size;
  }

  /** \brief Whether all points together may be the one cluster chosen; default false.
   */
  void
  setAllowSingleCluster(bool allow_single_cluster)
  {
    parameters_.allow_single_cluster = allow_single_cluster;
  }

  /** \return Whether all points together may be one cluster. */
  bool
  getAllowSingleCluster() const
  {
    return parameters_.allow_single_cluster;
  }

  /** \brief Choose the clusters at one distance instead, > 0, in units of the
   * attributes or, if standardized, of standard deviations. 0, the default: by
   * persistence. */
  void
  setCutDistance(double distance)
  {
    parameters_.cut_distance = distance;
  }

  /** \return The distance that clusters are cut at; 0: persistence decides. */
  double
  getCutDistance() const
  {
    return parameters_.cut_distance;
  }

  /** \brief Find clusters.
   * \param labels per point of the input cloud: zero-based clusters by decreasing size;
   * -1 for noise, points with missing values and those not in the indices
   *
   * Counts of the report: points (those clustered), missing_values, clusters, noise. If
   * no cluster is found, a warning says what to change.
   * \throws InvalidArgument without an input cloud, for parameters out of range, and as
   * readAttributes; labels are then untouched */
  void
  compute(std::vector<int>& labels);

  /** \brief Probability that each point of the input cloud belongs to its cluster, in
   * [0, 1]: the density at which it leaves, in parts of the one at which the cluster
   * dies; 0 where the label is -1. */
  const std::vector<float>&
  getProbabilities() const
  {
    return probabilities_;
  }

  /** \brief All clusters at all densities. */
  const std::vector<ClusterNode>&
  getTree() const
  {
    return tree_;
  }

private:
  std::vector<float> probabilities_;
  std::vector<ClusterNode> tree_;
};

template <typename PointT>
void
DensityClustering<PointT>::compute(std::vector<int>& labels)
{
  this->withInput(
      "DensityClustering", [&](const CloudView& cloud, const pcl::Indices& indices) {
        startReport();
        Clustering clustering =
            detail::clusterCloud(cloud, indices, parameters_, threads_, report_);
        labels.assign(clustering.labels.begin(), clustering.labels.end());
        probabilities_ = std::move(clustering.probabilities);
        tree_ = std::move(clustering.tree);
      });
}

} // namespace pcl_uvol
