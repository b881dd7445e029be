// SPDX-License-Identifier: BSD-3-Clause
// Direct isosurface extraction from scattered samples (thesis chapter 2): an oriented
// point cloud, no grid, no mesh.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/iso_edges.h>
#include <pcl_uvol/neighbors/angle_criterion.h>
#include <pcl_uvol/neighbors/neighbor_candidates.h>
#include <pcl_uvol/neighbors/sample_set.h>

#include <Eigen/Core>
#include <pcl/pcl_base.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

/** \brief The side that the normals of an isosurface point to. */
enum class Outside {
  Lower, ///< where values are lower, as for densities (default)
  Higher ///< where values are higher: the thesis's v = (f(x) - f(y)) (x - y)
};

/** \brief How isopoints are found between two samples. */
enum class Interpolation {
  Linear, ///< thesis 2.4: along the edge, normal along the edge
  Smooth  ///< the zero level of a local cubic or quadratic fit (default)
};

/** \brief Parameters and the kernel of IsosurfaceExtraction, for any point type. */
class PCL_UVOL_EXPORTS IsosurfaceExtractionBase : public Stage {
public:
  /** \brief Any field of the cloud: `density`, `vel[1]`, `|vel|`, `|vx,vy,vz|`; default
   * `intensity`. See ScalarField. */
  void
  setScalarField(const std::string& field)
  {
    field_ = field;
  }

  /** \brief One isovalue, in units of the field. */
  void
  setIsoValue(double isovalue)
  {
    isovalues_ = {isovalue};
  }

  /** \brief Several isovalues; their isopoints follow one another in this order. */
  void
  setIsoValues(const std::vector<double>& isovalues)
  {
    isovalues_ = isovalues;
  }

  /** \brief Default: Outside::Lower. */
  void
  setOutside(Outside outside)
  {
    outside_ = outside;
  }

  /** \brief Default: Interpolation::Smooth. */
  void
  setInterpolation(Interpolation interpolation)
  {
    interpolation_ = interpolation;
  }

  /** \brief Default: AngleCriterion::Kept. */
  void
  setAngleCriterion(AngleCriterion criterion)
  {
    criterion_ = criterion;
  }

  /** \brief Look for neighbours in a discrete Voronoi diagram (thesis 2.1); default: in
   * the kd-tree (2.2), which is faster and never sees more than some tens. */
  void
  setVoronoiGrid(const VoronoiCandidateSettings& settings)
  {
    voronoi_ = settings;
    candidates_.reset();
  }

  /** \brief Factors per axis, finite and positive: neighbours are found in the
   * stretched space, isopoints lie in the original one. Default 1, 1, 1. */
  void
  setScale(const Eigen::Array3f& scale)
  {
    scale_ = scale;
  }

  /** \brief The edge of each isopoint of the last extract(): indices into the input
   * cloud.
   */
  const IsoEdges&
  getEdges() const
  {
    return edges_;
  }

  /** \brief Samples and tree of the last extract(), for other stages on the same cloud.
   */
  const SampleSet::ConstPtr&
  getSamples() const
  {
    return samples_;
  }

protected:
  IsosurfaceExtractionBase() = default;
  ~IsosurfaceExtractionBase() = default;

  void
  extractFrom(const CloudView& cloud,
              const std::vector<int>& indices,
              pcl::PointCloud<PointIso>& isopoints);

  /** \brief The next extraction reads the cloud anew. */
  void
  forgetSamples();

private:
  void
  updateSamples(const CloudView& cloud, std::vector<std::uint32_t>&& use);

  void
  updateScalar(const CloudView& cloud, const std::vector<int>& indices);

  std::string field_ = "intensity";
  std::vector<double> isovalues_;
  Outside outside_ = Outside::Lower;
  Interpolation interpolation_ = Interpolation::Smooth;
  AngleCriterion criterion_ = AngleCriterion::Kept;
  std::optional<VoronoiCandidateSettings> voronoi_;
  Eigen::Array3f scale_{1.0f, 1.0f, 1.0f};

  /** The scalar in leaf order and its range per node, and what they were read from. */
  struct Scalar;

  std::shared_ptr<const Scalar> scalar_;
  SampleSet::ConstPtr samples_;
  NeighborCandidates::ConstPtr candidates_;        // of samples_
  std::vector<std::uint32_t> sampled_;             // input points behind samples_
  Eigen::Array3f sampled_scale_{1.0f, 1.0f, 1.0f}; // scale behind samples_
  Report sampled_report_;                          // what building samples_ counted
  IsoEdges edges_;
};

/** \brief Isosurface of a scalar field given at scattered points.
 *
 * \code
 * pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
 * extraction.setInputCloud(cloud);
 * extraction.setIsoValue(0.5);
 * pcl::PointCloud<PointIso> surface;
 * extraction.extract(surface);
 * \endcode
 * Neighbours are approximate natural neighbours (thesis 2.2, 2.3), an isopoint belongs
 * to every edge whose ends lie on different sides of the isovalue (2.4). By default it
 * lies on the zero level of a polynomial of degree 3 or 2 fitted to its 40 nearest
 * samples, which also gives normal, mean curvature and error; where a fit does not
 * serve it stays where linear interpolation along the edge puts it, with the edge's
 * outside vector. A value equal to the isovalue counts as above. Linear isopoints that
 * fall together are merged. The tree is built once per cloud: further isovalues and
 * fields reuse it. Memory: about 60 bytes per sample besides the cloud. \tparam PointT
 * any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class IsosurfaceExtraction : public pcl::PCLBase<PointT>,
                             public IsosurfaceExtractionBase {
public:
  using Cloud = std::conditional_t<std::is_same_v<PointT, pcl::PCLPointCloud2>,
                                   pcl::PCLPointCloud2,
                                   pcl::PointCloud<PointT>>;

  /** \brief The cloud must not change until the next call: values and tree are kept.
   */
  void
  // NOLINTNEXTLINE: PCLBase<PCLPointCloud2> has it, but not as a virtual function
  setInputCloud(const typename Cloud::ConstPtr& cloud)
  {
    pcl::PCLBase<PointT>::setInputCloud(cloud);
    forgetSamples();
  }

  /** \brief Extract the isopoints of all isovalues.
   *
   * Samples with a non-finite coordinate or scalar are left out, exact duplicates
   * merged (to the lower median of their values); both are counted. An isovalue outside
   * the range of the values gives no points and a warning in the report. \throws
   * InvalidArgument for a missing or empty cloud, an unknown field, no or a non-finite
   * isovalue, a bad scale, or no usable sample; isopoints are then untouched
   *
   * Counts of the report: samples, no_value, non_finite, duplicates,
   * conflicting_duplicates, crossing_samples, edges, coincident, isopoints; with smooth
   * interpolation cubic_roots, quadratic_roots, and linear_singular, linear_step,
   * linear_far for isopoints whose linear root stayed because the fit is singular or
   * fails, the values step, or the fit leaves the edge's surroundings; bridged and rim
   * by support. */
  void
  extract(pcl::PointCloud<PointIso>& isopoints);
};

} // namespace pcl_uvol
