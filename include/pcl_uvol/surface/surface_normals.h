// SPDX-License-Identifier: BSD-3-Clause
// Normals of a surface given as points: principal component analysis of the nearest
// neighbours, oriented by an outside vector (thesis 4.1); never by a spanning tree.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>
#include <pcl/search/search.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief Unit normal and surface variation (smallest eigenvalue of the covariance over
 * the sum of all, 0 for a plane, at most 1/3); NaN for a point with a non-finite
 * coordinate. */
struct SurfaceNormal {
  float normal[3];
  float curvature;
};

/** \brief Parameters of SurfaceNormalEstimation. */
struct PCL_UVOL_EXPORTS SurfaceNormalParameters {
  std::size_t k = 30; ///< nearest neighbours besides the point: at least 2
  /** Factors per axis, finite and positive: neighbours and covariance belong to the
   * stretched space, normals to the original one. */
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  /** Turns the axes that these factors belong to, see
   * InterpolationParameters::rotation. */
  Eigen::Array3d rotation{0.0, 0.0, 0.0};
  /** Position towards which the normals of points without a given normal point. Not set
   * (default): 0, 0, 0, with a warning if the points have no normals. */
  std::optional<Eigen::Array3d> view_point;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = SurfaceNormalParameters;
    return std::make_tuple(
        Member{"k", &Own::k, {"nearest neighbours besides the point", 2, 10000}},
        Member{"scale", &Own::scale},
        Member{"rotation", &Own::rotation},
        Member{"view_point", &Own::view_point});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static SurfaceNormalParameters
  fromJson(const std::string& text);
};

namespace detail {

/** \brief Warn if normals point to 0, 0, 0 only because nothing else is known. */
PCL_UVOL_EXPORTS void
warnOfUnsetViewPoint(const CloudView& cloud,
                     const SurfaceNormalParameters& parameters,
                     Report& report);

/** \brief The kernel of SurfaceNormalEstimation for any cloud.
 * \param indices points to take part, as neighbours and in the result
 * \param search null: FLANN
 * \return one normal per index
 * \param report gets "non_finite", "duplicates", "degenerate_normals" and times
 * \throws InvalidArgument as SurfaceNormalEstimation::compute */
PCL_UVOL_EXPORTS std::vector<SurfaceNormal>
estimateSurfaceNormals(const CloudView& cloud,
                       const std::vector<std::uint32_t>& indices,
                       const SurfaceNormalParameters& parameters,
                       const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
                       unsigned threads,
                       Report& report);

/** \brief Replace the outside vectors of isopoints by normals that they orient. Every
 * run of equal isovalues is a separate surface: normals of one surface do not use
 * points of another. */
PCL_UVOL_EXPORTS void
replaceNormals(pcl::PointCloud<PointIso>& isopoints,
               const SurfaceNormalParameters& parameters,
               unsigned threads,
               Report& report);

/** \brief The same for those isopoints only that no fit gave a normal, which are those
 * without a mean curvature. */
PCL_UVOL_EXPORTS void
replaceMissingNormals(pcl::PointCloud<PointIso>& isopoints,
                      const SurfaceNormalParameters& parameters,
                      unsigned threads,
                      Report& report);

} // namespace detail

/** \brief Normals of a point cloud in the manner of pcl::NormalEstimation.
 *
 * The normal is the eigenvector to the smallest eigenvalue of the covariance of the
 * point and its k nearest neighbours about their centroid. It points to the side of the
 * point's normal, the outside vector, if the point type has one that is not zero, else
 * towards the view point. If the neighbours are on one line or fewer than two, the
 * outside vector itself is used, and counted as "degenerate_normals". Exact duplicates
 * count as one neighbour.
 * \tparam PointInT with x, y, z
 * \tparam PointOutT with normal_x/y/z and curvature */
template <typename PointInT, typename PointOutT = pcl::Normal>
class SurfaceNormalEstimation : public CloudStage<PointInT>,
                                public ParameterStage<SurfaceNormalParameters> {
public:
  using Ptr = std::shared_ptr<SurfaceNormalEstimation<PointInT, PointOutT>>;
  using ConstPtr = std::shared_ptr<const SurfaceNormalEstimation<PointInT, PointOutT>>;

  /** \brief Nearest neighbours besides the point: at least 2, default 30. */
  void
  setKSearch(std::size_t k)
  {
    parameters_.k = k;
  }

  /** \return The number of nearest neighbours besides the point. */
  std::size_t
  getKSearch() const
  {
    return parameters_.k;
  }

  /** \brief How neighbours are found. The search gets the distinct finite points,
   * stretched by the scale, as its input cloud and is called from several threads.
   * Default: null, which is FLANN's exact search. */
  void
  setSearchMethod(const pcl::search::Search<pcl::PointXYZ>::Ptr& search)
  {
    search_ = search;
  }

  /** \return What finds neighbours; null: FLANN's exact search. */
  const pcl::search::Search<pcl::PointXYZ>::Ptr&
  getSearchMethod() const
  {
    return search_;
  }

  /** \brief Factors per axis, finite and positive: neighbours and covariance belong to
   * the stretched space, normals to the original one. Default 1, 1, 1. */
  void
  setScale(const Eigen::Array3f& scale)
  {
    parameters_.scale = scale;
  }

  /** \return The factors of the stretched space. */
  const Eigen::Array3f&
  getScale() const
  {
    return parameters_.scale;
  }

  /** \brief Position towards which the normals of points without a given normal point.
   * Default: not set, which is 0, 0, 0 with a warning.
   * \param x in the coordinates of the cloud
   * \param y as x
   * \param z as x */
  void
  setViewPoint(double x, double y, double z)
  {
    parameters_.view_point = Eigen::Array3d(x, y, z);
  }

  /** \return Where points without a normal are seen from; empty if it was not set. */
  const std::optional<Eigen::Array3d>&
  getViewPoint() const
  {
    return parameters_.view_point;
  }

  /** \brief One output point per input point or index. A point with a non-finite
   * coordinate gets NaN, and the output is then not dense.
   * \param output a normal for each point; its width is that of the indices
   * \throws InvalidArgument without an input cloud, without a finite point, for k < 2
   * or a bad scale; the output is then untouched */
  void
  compute(pcl::PointCloud<PointOutT>& output);

private:
  pcl::search::Search<pcl::PointXYZ>::Ptr search_;
};

template <typename PointInT, typename PointOutT>
void
SurfaceNormalEstimation<PointInT, PointOutT>::compute(
    pcl::PointCloud<PointOutT>& output)
{
  std::vector<SurfaceNormal> normals;
  this->withInput("SurfaceNormalEstimation",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    const std::vector<std::uint32_t> use(indices.begin(),
                                                         indices.end());
                    normals = detail::estimateSurfaceNormals(
                        cloud, use, parameters_, search_, threads_, report_);
                  });
  output.resize(normals.size());
  const bool organized =
      normals.size() == std::size_t(this->input_->width) * this->input_->height;
  output.width =
      organized ? this->input_->width : static_cast<std::uint32_t>(normals.size());
  output.height = organized ? this->input_->height : 1;
  output.header = this->input_->header;
  output.is_dense = true;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    output[i].normal_x = normals[i].normal[0];
    output[i].normal_y = normals[i].normal[1];
    output[i].normal_z = normals[i].normal[2];
    output.is_dense = output.is_dense && std::isfinite(normals[i].normal[0]);
    output[i].curvature = normals[i].curvature;
  }
}

} // namespace pcl_uvol
