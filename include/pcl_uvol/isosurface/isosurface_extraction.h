// SPDX-License-Identifier: BSD-3-Clause
// Direct isosurface extraction from scattered samples (thesis chapter 2): an oriented
// point cloud, no grid, no mesh.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>

#include <Eigen/Core>
#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

/** \brief The side that the normals of an isosurface point to. */
enum class Outside {
  Lower, ///< where values are lower, as for densities (default)
  Higher ///< where values are higher: the thesis's v = (f(x) - f(y)) (x - y)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<Outside>, 2>
listWords(Outside)
{
  return {{{Outside::Lower, "lower"}, {Outside::Higher, "higher"}}};
}

/** \brief How isopoints are found between two samples. */
enum class Interpolation {
  Linear, ///< thesis 2.4: along the edge, normal along the edge
  Fit,    ///< the zero level of a local cubic or quadratic fit: the default of
          ///< IsosurfaceExtraction
  Auto ///< as Fit, without isopoints that the nearest samples contradict; the default
       ///< of IsosurfacePipeline, of the tools and of Python, which also choose between
       ///< Fit and Linear for each isopoint
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<Interpolation>, 4>
listWords(Interpolation)
{
  return {{{Interpolation::Fit, "fit"},
           {Interpolation::Linear, "linear"},
           {Interpolation::Auto, "auto"},
           {Interpolation::Fit, "smooth"}}};
}

/** \brief Parameters of IsosurfaceExtraction. */
struct PCL_UVOL_EXPORTS IsosurfaceParameters {
  /** Any field of the cloud: `density`, `vel[1]`, `|vel|`, `|vx,vy,vz|`, see
   * ScalarField. */
  std::string field = "intensity";
  /** In units of the field, at least one; their isopoints follow one another in this
   * order. */
  std::vector<double> isovalues;
  Outside outside = Outside::Lower;
  Interpolation interpolation = Interpolation::Fit;
  /** Fits only give errors, and their isopoints go back to the edges:
   * IsosurfacePipeline sets it. What kinds of fits there are is then not counted. */
  bool errors_only = false;
  /** Where neighbours are looked for: in the kd-tree (thesis 2.2), which is faster and
   * never sees more than some tens, in a discrete Voronoi diagram (2.1), or in exact
   * cells. */
  NeighborSource neighbors = NeighborSource::KdTree;
  /** Cells of the diagram along the longest side; 0: 4 samples to a cell. */
  std::uint32_t voronoi_cells = 0;
  AngleCriterion criterion = AngleCriterion::Kept;
  /** Factors per axis, finite and positive: neighbours are found in the stretched
   * space, isopoints lie in the original one. */
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = IsosurfaceParameters;
    return std::make_tuple(Member{"field", &Own::field},
                           Member{"isovalues", &Own::isovalues},
                           Member{"outside", &Own::outside},
                           Member{"interpolation", &Own::interpolation},
                           Member{"neighbors", &Own::neighbors},
                           Member{"voronoi_cells", &Own::voronoi_cells},
                           Member{"criterion", &Own::criterion},
                           Member{"scale", &Own::scale});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static IsosurfaceParameters
  fromJson(const std::string& text);
};

/** \throws InvalidArgument without an isovalue, for one that is not finite in float and
 * for factors that are not finite and positive
 * \param parameters to be checked before samples are there */
PCL_UVOL_EXPORTS void
checkParameters(const IsosurfaceParameters& parameters);

/** \brief The edge of one isopoint: two points of the input cloud and the place between
 * them where the scalar, interpolated linearly, has the isovalue: 0 at the first, 1 at
 * the second. A smooth isopoint lies beside it, but all fields that are carried along
 * agree there, the scalar with its isovalue among them. */
struct IsoEdge {
  std::uint32_t first, second; ///< indices into the input cloud
  float t;                     ///< in [0, 1]
};

/** \brief One edge per isopoint, in the order of the isopoints. */
using IsoEdges = std::vector<IsoEdge>;

/** \brief Counts that show how far to trust a surface, over all of its isovalues. The
 * counts of pieces or processes are added. */
struct PCL_UVOL_EXPORTS SurfaceTally {
  std::uint64_t crossing = 0; ///< samples that touch one on the other side
  std::uint64_t spikes = 0;   ///< of these, those whose values stand alone
  /** Isopoints that Interpolation::Auto removed, as the samples around are all on one
   * side. */
  std::uint64_t contradicted = 0;
  /** Linear isopoints whose support was found from fits, at most 1024 of an isovalue,
   * and those of support Bridged and Rim. @{ */
  std::uint64_t examined = 0, examined_bridged = 0, examined_rim = 0;
  /** @} */

  /** \brief Add those of another part.
   * \param other part of the same surface */
  void
  add(const SurfaceTally& other);
};

/** \brief Add to a cloud of isopoints every field of the samples' cloud that it lacks,
 * under its own name, type and count.
 *
 * Floating-point fields are interpolated linearly, NaN where a sample that counts is
 * NaN; integers, labels and packed colours come from the nearer sample.
 * \param isopoints as many points as edges; comes out without padding fields, and so
 * that viewOf() takes it
 * \param threads 0 (default) = all cores
 * \param samples that the edges join
 * \param edges one per isopoint
 * \throws InvalidArgument if sizes disagree or an edge points outside the samples */
PCL_UVOL_EXPORTS void
interpolateFields(const CloudView& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints,
                  unsigned threads = 0);

/** \brief The same for a cloud, which needs no positions.
 * \param samples that the edges join
 * \param edges one per isopoint
 * \param isopoints as many points as edges
 * \param threads 0 (default) = all cores */
PCL_UVOL_EXPORTS void
interpolateFields(const pcl::PCLPointCloud2& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints,
                  unsigned threads = 0);

/** \brief The same for points each of which corresponds to one point of another cloud:
 * missing fields are copied.
 * \param sources index of the other point, one per point
 * \param cloud that has the fields
 * \param points get them
 * \param threads 0 (default) = all cores
 * \throws InvalidArgument as interpolateFields */
PCL_UVOL_EXPORTS void
copyFields(const pcl::PCLPointCloud2& cloud,
           const std::vector<std::uint32_t>& sources,
           pcl::PCLPointCloud2& points,
           unsigned threads = 0);

class NeighborCandidates;
class SampleSet;

/** \brief Setters and the kernel of IsosurfaceExtraction, for any point type. */
class PCL_UVOL_EXPORTS IsosurfaceExtractionBase
    : public ParameterStage<IsosurfaceParameters> {
public:
  /** \brief Any field of the cloud: `density`, `vel[1]`, `|vel|`, `|vx,vy,vz|`; default
   * `intensity`. See ScalarField. */
  void
  setScalarField(const std::string& field)
  {
    parameters_.field = field;
  }

  /** \return The field that has the isovalues. */
  const std::string&
  getScalarField() const
  {
    return parameters_.field;
  }

  /** \brief One isovalue, in units of the field. */
  void
  setIsoValue(double isovalue)
  {
    parameters_.isovalues = {isovalue};
  }

  /** \brief Several isovalues; their isopoints follow one another in this order. */
  void
  setIsoValues(const std::vector<double>& isovalues)
  {
    parameters_.isovalues = isovalues;
  }

  /** \return The isovalues, in units of the field; empty before one is set. */
  const std::vector<double>&
  getIsoValues() const
  {
    return parameters_.isovalues;
  }

  /** \brief Default: Outside::Lower. */
  void
  setOutside(Outside outside)
  {
    parameters_.outside = outside;
  }

  /** \return The side that normals point to. */
  Outside
  getOutside() const
  {
    return parameters_.outside;
  }

  /** \brief Default: Interpolation::Fit. */
  void
  setInterpolation(Interpolation interpolation)
  {
    parameters_.interpolation = interpolation;
  }

  /** \return How isopoints are found on edges. */
  Interpolation
  getInterpolation() const
  {
    return parameters_.interpolation;
  }

  /** \brief Default: AngleCriterion::Kept. */
  void
  setAngleCriterion(AngleCriterion criterion)
  {
    parameters_.criterion = criterion;
  }

  /** \return Which closer candidates remove a farther one. */
  AngleCriterion
  getAngleCriterion() const
  {
    return parameters_.criterion;
  }

  /** \brief Where neighbours are looked for. Default: NeighborSource::KdTree.
   * \param voronoi_cells of a diagram along its longest side; 0: 4 samples to a cell
   * \param source a tree of the samples or a discrete Voronoi diagram */
  void
  setNeighborSource(NeighborSource source, std::uint32_t voronoi_cells = 0)
  {
    parameters_.neighbors = source;
    parameters_.voronoi_cells = voronoi_cells;
  }

  /** \return Where neighbours are looked for. */
  NeighborSource
  getNeighborSource() const
  {
    return parameters_.neighbors;
  }

  /** \brief Factors per axis, finite and positive: neighbours are found in the
   * stretched space, isopoints lie in the original one. Default 1, 1, 1. */
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

  /** \brief The edge of each isopoint of the last extract(): indices into the input
   * cloud.
   */
  const IsoEdges&
  getEdges() const
  {
    return edges_;
  }

  /** \brief Spikes, contradicted and examined isopoints of the last extract(). */
  const SurfaceTally&
  getTally() const
  {
    return tally_;
  }

  /** \brief Samples and tree of the last extract(). */
  const std::shared_ptr<const SampleSet>&
  getSamples() const
  {
    return samples_;
  }

protected:
  IsosurfaceExtractionBase() = default;
  ~IsosurfaceExtractionBase() = default;

  /** \brief The kernel of extract().
   * \param cloud the samples
   * \param indices of those to take
   * \param isopoints what is found */
  void
  extractFrom(const CloudView& cloud,
              const pcl::Indices& indices,
              pcl::PointCloud<PointIso>& isopoints);

  /** \brief As a cloud with all fields of the samples.
   * \param cloud the samples
   * \param indices of those to take
   * \param isopoints what is found */
  void
  extractFrom(const CloudView& cloud,
              const pcl::Indices& indices,
              pcl::PCLPointCloud2& isopoints);

  /** \brief The next extraction reads the cloud anew. */
  void
  forgetSamples();

private:
  void
  updateSamples(const CloudView& cloud, const std::vector<std::uint32_t>& use);

  void
  updateScalar(const CloudView& cloud, const pcl::Indices& indices);

  void
  updateCandidates();

  /** The scalar in leaf order, its range per node, and their source. */
  struct Scalar;

  std::shared_ptr<const Scalar> scalar_;
  std::shared_ptr<const SampleSet> samples_;
  std::shared_ptr<const NeighborCandidates>
      candidates_; // of samples_, as these parameters ask:
  NeighborSource candidate_source_ = NeighborSource::KdTree;
  std::uint32_t candidate_cells_ = 0;
  std::uint64_t sampled_ = 0;                      // fingerprint of the input points
  std::uint64_t sampled_fingerprint_ = 0;          // of all input positions
  Eigen::Array3f sampled_scale_{1.0f, 1.0f, 1.0f}; // scale behind samples_
  Report sampled_report_;                          // what building samples_ counted
  SurfaceTally tally_;
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
 * Neighbours are approximate natural neighbours (thesis 2.2, 2.3). Every edge whose
 * ends are on different sides of the isovalue has an isopoint (2.4). By default it is
 * on the zero level of a polynomial of degree 3 or 2 fitted to its 40 nearest samples.
 * If these are in layers or lines, the fit is to the 40 nearest in a local metric. The
 * fit also gives normal, mean curvature and error. If no fit is usable, the isopoint
 * stays at the linear root on the edge, with the edge's outside vector. A value equal
 * to the isovalue counts as above. Linear isopoints that coincide are merged. The tree
 * is built once per cloud: further isovalues, fields, and values that were changed in
 * place reuse it. Memory: about 60 bytes per sample besides the cloud.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class IsosurfaceExtraction : public CloudStage<PointT>,
                             public IsosurfaceExtractionBase {
public:
  using Ptr = std::shared_ptr<IsosurfaceExtraction<PointT>>;
  using ConstPtr = std::shared_ptr<const IsosurfaceExtraction<PointT>>;
  using Cloud = typename CloudStage<PointT>::Cloud;

  /** \brief Extract the isopoints of all isovalues.
   *
   * Samples with a non-finite coordinate or scalar are left out, and exact duplicates
   * are merged. Their value is the median, of an even number the mean of the two
   * central values, which can be between two classes. The fields of isopoints, this one
   * as well, come from the first point that has the lower of these. Both are counted.
   * An isovalue outside the range of the values gives no points and a warning in the
   * report.
   * \param isopoints what is found; its points replace those that were there
   * \throws InvalidArgument for a missing or empty cloud, an unknown field, no or a
   * non-finite isovalue, a bad scale, or no usable sample; isopoints are then untouched
   *
   * Counts of the report: samples, no_value, non_finite, duplicates,
   * conflicting_duplicates, spikes (samples whose values are unlike those of all around
   * them), crossing_samples, edges, coincident, isopoints; bridged and rim by support.
   * With Interpolation::Fit also cubic_roots, quadratic_roots, and isopoints that stay
   * at their linear root: linear_singular (the fit is singular or fails), linear_step
   * (the values jump), linear_far (the root is far from the edge). With
   * Interpolation::Auto also contradicted: isopoints that were removed, if there are
   * any. */
  void
  extract(pcl::PointCloud<PointIso>& isopoints);

  /** \brief The same with every field of the samples, see interpolateFields: the fields
   * of PointIso come first.
   * \param isopoints what is found */
  void
  extract(pcl::PCLPointCloud2& isopoints);

private:
  void
  forgetInput() override
  {
    forgetSamples();
  }

  template <typename OutputT>
  void
  extractAs(OutputT& isopoints);

  /** The cloud of the last extraction: PCLBase can be given another cloud past
   * setInputCloud. */
  typename Cloud::ConstPtr extracted_;
};

template <typename PointT>
template <typename OutputT>
void
IsosurfaceExtraction<PointT>::extractAs(OutputT& isopoints)
{
  this->withInput("IsosurfaceExtraction",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    if (this->input_ != extracted_)
                      forgetSamples();
                    extracted_ = this->input_;
                    extractFrom(cloud, indices, isopoints);
                    isopoints.header = this->input_->header;
                  });
}

template <typename PointT>
void
IsosurfaceExtraction<PointT>::extract(pcl::PointCloud<PointIso>& isopoints)
{
  extractAs(isopoints);
}

template <typename PointT>
void
IsosurfaceExtraction<PointT>::extract(pcl::PCLPointCloud2& isopoints)
{
  extractAs(isopoints);
}

} // namespace pcl_uvol
