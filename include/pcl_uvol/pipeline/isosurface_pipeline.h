// SPDX-License-Identifier: BSD-3-Clause
// From samples to an isosurface with normals and all fields: the one way that the
// tools, the viewer and the filters take.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/neighbors/sampling_summary.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <Eigen/Core>
#include <pcl/pcl_base.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The estimated errors of isopoints, in units of length. */
struct ErrorSummary {
  float median, percentile_95, largest;
};

/** \brief Shares of samples whose class, at the isovalue or above it or below, is
 * predicted rightly. NaN of no samples. */
struct ClassShares {
  double predicted; ///< by what is tested
  double base;      ///< by always saying what is more frequent
  double nearest;   ///< by the class of the nearest sample
};

/** \brief The hold-out test of one isovalue: samples are left out, fold by fold, the
 * surface is extracted from the others, and asked for the class of those left out.
 *
 * Near the surface, no farther from it than 2 local spacings, the class is told by the
 * side of the nearest isopoint's normal; a local spacing is the mean distance of the 6
 * nearest samples that remained, in the stretched space. Everywhere it is told by the
 * field between the samples, kriged from 16 samples of all octants, and where that has
 * no value by the nearest sample. */
struct ValidationScore {
  std::size_t tested = 0;     ///< samples with a value and a place
  std::size_t covered = 0;    ///< of these, those near the surface
  ClassShares side{};         ///< of those: by the surface
  double side_of_field = 0;   ///< of those: by the field
  ClassShares field{};        ///< of all: by the field
  double side_everywhere = 0; ///< of all: by the side of the nearest isopoint, however
                              ///< far
  /** The samples near the surface that lie farther from the plane of the nearest
   * isopoint than its `error`, and how many of these lie on the right side of it: most,
   * where the estimate holds. @{ */
  std::size_t beyond_error = 0;
  double side_beyond_error = 0;
  /** @} */
};

/** \brief How gaps of the sampling were filled: around the isosurfaces, by samples that
 * ordinary kriging predicts from the means of measured ones in cells as long as the
 * spacing of predicted ones. Lengths are in units of the stretched space; the variogram
 * is that of the means, or of the samples where there was no gap.
 *
 * Isopoints that rest on them have IsoSupport::Predicted; their `error` is the standard
 * deviation of the kriging over the slope of the kriged field, and `confidence` the
 * part of the field's variance that the samples explain there: 1 - deviation^2 /
 * (nugget + sill), 1 for all other isopoints. */
struct GapFilling {
  std::size_t predicted = 0; ///< samples; 0: there was no gap
  double spacing = 0.0;      ///< between them
  /** The range of the spherical variogram; no predicted sample is farther from a
   * measured one. */
  double range = 0.0;
  double nugget = 0.0, sill = 0.0; ///< of the variogram, in squared units of the field
  /** Of each predicted sample, the index of the nearest measured one, whose other
   * fields it has. */
  std::vector<std::uint32_t> sources;
};

namespace detail {
class FilledGaps;
}

/** \brief What comes out. */
struct PCL_UVOL_EXPORTS IsosurfaceResult {
  /** The isopoints: the fields of PointIso, then all fields of the samples that these
   * do not replace. `isovalue` is float64, behind these, where float holds one of the
   * isovalues as infinite or as zero. With Interpolation::Auto, unless there is a level
   * set or a mesh, also `method` and `orientation`, numbers of IsoMethod and
   * IsoOrientation. With a mesh its vertices, and behind the other fields `piece`,
   * among pieces, and `cap`, 1 where a vertex closes the samples' box. */
  Dataset surface;
  std::vector<Triangle> triangles; ///< with a mesh: counter-clockwise seen from outside
  std::vector<SurfacePiece> pieces; ///< with a mesh: see SurfaceTriangles
  double smallest_angle = 0.0;      ///< with a mesh: of all triangles, in degrees
  IsoEdges edges;                   ///< one per isopoint, indices into the samples;
                                    ///< those beyond the last one are predicted samples
  std::vector<std::size_t> isopoints; ///< how many of each isovalue the surface has
  std::string field;                  ///< that was taken
  Eigen::Array3f scale;               ///< that was taken
  /** With an automatic scale: how it was found. */
  std::optional<ScaleChoice> scale_choice;
  /** With `smooth`: one per isovalue; spacing 0 where there was no surface to smooth.
   */
  std::vector<LevelSetSummary> level_sets;
  std::optional<ErrorSummary> errors; ///< none where no error is estimated
  /** What the samples are like in the stretched space; none with a level set or a mesh,
   * and where they are not in memory all at once. */
  std::optional<SamplingSummary> sampling;
  std::optional<GapFilling> gaps;          ///< if they were to be filled
  std::vector<ValidationScore> validation; ///< one per isovalue, if asked for
  /** Counts, times and warnings of IsosurfaceExtraction or SurfaceMesh,
   * LevelSetEvolution and SurfaceNormalEstimation, and "removed_by_error" and
   * "removed_bridged". */
  Report report;
};

/** \brief Extraction, level set, normals, filters and fields in one call.
 *
 * \code
 * pcl_uvol::IsosurfacePipeline pipeline;
 * pipeline.setInput(dataset); // a std::shared_ptr<const pcl_uvol::Dataset>
 * pcl_uvol::IsosurfacePipelineParameters parameters;
 * parameters.isosurface.isovalues = {0.5};
 * parameters.smooth = true;
 * pipeline.setParameters(parameters);
 * const pcl_uvol::IsosurfaceResult result = pipeline.run();
 * \endcode
 * Without `smooth` the tree is built once per input: further isovalues and fields reuse
 * it. */
class PCL_UVOL_EXPORTS IsosurfacePipeline
    : public ParameterStage<IsosurfacePipelineParameters> {
public:
  using Ptr = std::shared_ptr<IsosurfacePipeline>;
  using ConstPtr = std::shared_ptr<const IsosurfacePipeline>;

  /** \brief The samples. Values and tree are kept until the samples change, in place or
   * by another call: see IsosurfaceExtraction::setInputCloud. */
  void
  setInput(const std::shared_ptr<const Dataset>& samples);

  /** \brief The samples to take; null, the default: all of them. */
  void
  setIndices(const pcl::IndicesPtr& indices);

  /** \brief Run from the samples to the surface; getReport() is that of the result.
   * \throws InvalidArgument without an input, as checkParameters, and as the stages do
   * \throws Diverged as LevelSetEvolution */
  IsosurfaceResult
  run();

  /** \brief The field and the scale that run() takes: those of the parameters, with the
   * automatic ones filled in.
   * \param choice where it is not null, how an automatic scale was found; else as it is
   * \throws InvalidArgument without an input, where the samples do not tell which field
   * is meant, and as chooseScale */
  IsosurfaceParameters
  resolveParameters(std::optional<ScaleChoice>* choice = nullptr) const;

  /** \brief Bytes that run() will take at most besides its input, about, from some of
   * the samples.
   * \throws as resolveParameters() */
  double
  estimateMemory() const;

private:
  /** Extracts from samples in a box that repeats. */
  IsosurfaceResult
  runInBox(IsosurfacePipelineParameters parameters);

  /** Extracts from samples as they are, all that belong to them among them.
   * \param parameters with the field and the scale that are taken */
  IsosurfaceResult
  runOnSamples(IsosurfacePipelineParameters parameters);

  /** Isopoints are vertices without triangles. */
  SurfaceTriangles
  extract(const IsosurfaceParameters& parameters, Report& report);

  SurfaceTriangles
  extractLevelSets(const IsosurfaceParameters& parameters,
                   std::vector<LevelSetSummary>& summaries);

  /** The points to take. */
  pcl::Indices
  listPoints() const;

  /** Of samples as they are and those that are predicted in their gaps.
   * \param parameters with the field and the scale that are taken */
  IsosurfaceResult
  runFilled(IsosurfacePipelineParameters parameters);

  /** Along axes that are not those of the coordinates. */
  IsosurfaceResult
  runTurned();

  /** Of samples that were made from the input.
   * \param gaps that were filled in them; null: none */
  IsosurfaceResult
  runOther(const std::shared_ptr<const Dataset>& samples,
           const pcl::IndicesPtr& indices,
           const IsosurfacePipelineParameters& parameters,
           const detail::FilledGaps* gaps) const;

  std::vector<ValidationScore>
  validate(const IsosurfacePipelineParameters& parameters, Report& report) const;

  std::shared_ptr<const Dataset> samples_;
  pcl::IndicesPtr indices_;
  IsosurfaceExtraction<pcl::PCLPointCloud2> extraction_;
  const detail::FilledGaps* gaps_ = nullptr; ///< of the input, which has them filled
};

/** \brief The second half of the way, for isopoints that were extracted elsewhere, out
 * of core or by another process: normals, filters, fields and warnings.
 * \param samples between which the edges lie; with a box that repeats they count from
 * its low corner, and isopoints outside of it are left out
 * \param parameters with the field and the scale that were taken
 * \param report continued
 * \param isopoints that were extracted
 * \param edges one per isopoint
 * \param threads 0: all cores */
PCL_UVOL_EXPORTS IsosurfaceResult
finishIsosurface(const Dataset& samples,
                 pcl::PointCloud<PointIso>&& isopoints,
                 IsoEdges&& edges,
                 const IsosurfacePipelineParameters& parameters,
                 unsigned threads,
                 Report&& report);

/** \brief The zero level of a level-set function of samples.
 * \param phi one per point of the cloud, see LevelSetEvolution
 * \param deviations one per point, see LevelSetEvolution::getDeviations(); without any,
 * errors are NaN: fits to phi know nothing of what became of the samples' noise
 * \param parameters of the isosurface that phi stands for; isopoints have its first
 * isovalue
 * \param report gets the counts and times of IsosurfaceExtraction
 * \param samples as LevelSetEvolution got them
 * \param threads 0: all cores
 * \param isopoints what is found
 * \param edges one per isopoint */
PCL_UVOL_EXPORTS void
extractZeroLevel(const CloudView& samples,
                 const std::vector<float>& phi,
                 const std::vector<float>& deviations,
                 const IsosurfaceParameters& parameters,
                 unsigned threads,
                 pcl::PointCloud<PointIso>& isopoints,
                 IsoEdges& edges,
                 Report& report);

} // namespace pcl_uvol
