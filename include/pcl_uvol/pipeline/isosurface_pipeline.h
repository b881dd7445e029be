// SPDX-License-Identifier: BSD-3-Clause
// From samples to an isosurface with normals and all fields: the one way that the
// tools, the viewer and the filters take, in one process or in many.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <Eigen/Core>
#include <pcl/pcl_base.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief How isopoints are oriented. */
enum class NormalMethod {
  Auto, ///< Pca with Interpolation::Linear; with Auto as IsoOrientation says, by what
        ///< the samples carry; else Fit (default)
  Fit,  ///< by the local fits, by principal components where none serves
  Pca,  ///< by principal components of the isopoints (thesis 4.1)
  Edge ///< as the extraction leaves them: by the fits, along the edge where none serves
};

/** \brief How an isopoint was placed: the field `method`. */
enum class IsoMethod : std::uint8_t {
  Linear = 1, ///< on its edge; a vertex of a mesh: where those around put it
  Fit = 2,    ///< on the zero level of a fit
  Kriging = 3 ///< on the isosurface of the kriged field, see GapFilling
};

/** \brief How an isopoint was oriented: the field `orientation`. */
enum class IsoOrientation : std::uint8_t {
  Edge = 1,     ///< along its edge; a vertex of a mesh: by those around
  Fit = 2,      ///< by the gradient of its fit
  Pca = 3,      ///< by principal components of the isopoints around
  Bisector = 4, ///< between its edge and the mean of the edges of the isopoints around
  Kriging = 5   ///< by the slope of the kriged field, see GapFilling
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<NormalMethod>, 4>
listWords(NormalMethod)
{
  return {{{NormalMethod::Auto, "auto"},
           {NormalMethod::Fit, "fit"},
           {NormalMethod::Pca, "pca"},
           {NormalMethod::Edge, "edge"}}};
}

/** \brief How samples are divided for a hold-out test; see Folds. */
enum class ValidateBy {
  Random, ///< every sample at random (default)
  Blocks, ///< compact blocks of space
  Field   ///< samples of one value of a field stay together
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<ValidateBy>, 3>
listWords(ValidateBy)
{
  return {{{ValidateBy::Random, "random"},
           {ValidateBy::Blocks, "blocks"},
           {ValidateBy::Field, "field"}}};
}

/** \brief What becomes of a mesh at the faces of a box that repeats. */
enum class PeriodicMesh {
  Cut, ///< it ends there in rims (default)
  Weld ///< rims in opposite faces have the same vertices, so that copies of the mesh
       ///< join
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<PeriodicMesh>, 2>
listWords(PeriodicMesh)
{
  return {{{PeriodicMesh::Cut, "cut"}, {PeriodicMesh::Weld, "weld"}}};
}

/** \brief A hold-out test of the surface, see ValidationScore. */
struct PCL_UVOL_EXPORTS ValidationParameters {
  /** Parts that are left out one after the other, at least 2; 0: no test. The
   * extraction runs once more for each. */
  std::size_t folds = 0;
  ValidateBy by = ValidateBy::Random;
  /** With ValidateBy::Field: a drill hole, a dive, a flight. */
  std::string field;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = ValidationParameters;
    return std::make_tuple(Member{"folds", &Own::folds},
                           Member{"by", &Own::by},
                           Member{"field", &Own::field});
  }
};

/** \brief Parameters of IsosurfacePipeline. */
struct PCL_UVOL_EXPORTS IsosurfacePipelineParameters {
  IsosurfacePipelineParameters()
  {
    isosurface.interpolation = Interpolation::Auto;
  }

  /** An empty field stands for `intensity`, else the only candidate, see
   * ScalarField::defaultName. The interpolation is Auto unless it is set: an isopoint
   * stays on its fit unless it reaches across a gap, or lies beside one and has no fit.
   */
  IsosurfaceParameters isosurface;
  /** Take the scale from the samples instead of isosurface.scale: from how fast the
   * field changes along each axis. */
  bool automatic_scale = false;
  /** Turns the axes that the factors of the scale belong to, see
   * InterpolationParameters::rotation. */
  Eigen::Array3d rotation{0.0, 0.0, 0.0};
  /** Smooth noisy or uneven samples by a level set first. */
  bool smooth = false;
  /** How; field, isovalue, scale, rotation and outside are those of the isosurface. */
  LevelSetParameters level_set;
  NormalMethod normals = NormalMethod::Auto;
  /** Isopoints that a normal by principal components is fitted to: at least 2. */
  std::size_t normal_neighbors = 30;
  /** Leave out isopoints of a larger estimated error, or without an estimate, in units
   * of length. None: no bound. */
  std::optional<double> max_error;
  /** Take the bound of the error from the samples instead: half the distance of the two
   * samples that an isopoint lies between, its `edge_length`. Crossings with lines or
   * sheets of samples stay, whose edges are short beside the gaps, and where samples
   * lie all around those between two values that many samples have; between predicted
   * samples the bound is half a gap, in the stretched space. */
  bool automatic_max_error = false;
  /** Leave out isopoints in gaps of the sampling, see IsoSupport::Bridged. */
  bool drop_bridged = false;
  /** Predict samples in gaps of the sampling, between lines of samples above all, and
   * extract from both, see GapFilling: best with an automatic scale, since what is
   * predicted lives on distances. The field is one of single numbers. */
  bool fill_gaps = false;
  ValidationParameters validation;
  /** Make a mesh, see SurfaceMesh, whose vertices are the isopoints. None: isopoints
   * that nothing joins. */
  std::optional<MeshingParameters> mesh;
  /** Sides of the box that the samples repeat in, in units of length; 0, the default:
   * they do not along that axis. Neighbours are seen across its faces. It lies where
   * the samples do, at 0, about 0, or at the lowest of them; isopoints lie in it, their
   * edges may join samples across its faces, and a mesh is cut there. */
  Eigen::Array3d periodic{0.0, 0.0, 0.0};
  /** With a mesh in a box that repeats. Weld adds the field `image_of`: the vertex in
   * the low face that one in a high face is the image of, else the vertex itself.
   * Pieces, their rims and handles are then those of the mesh whose images are one
   * vertex. */
  PeriodicMesh periodic_mesh = PeriodicMesh::Cut;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = IsosurfacePipelineParameters;
    return std::make_tuple(Member{"isosurface", &Own::isosurface},
                           Member{"automatic_scale", &Own::automatic_scale},
                           Member{"rotation", &Own::rotation},
                           Member{"smooth", &Own::smooth},
                           Member{"level_set", &Own::level_set},
                           Member{"normals", &Own::normals},
                           Member{"normal_neighbors", &Own::normal_neighbors},
                           Member{"max_error", &Own::max_error},
                           Member{"automatic_max_error", &Own::automatic_max_error},
                           Member{"drop_bridged", &Own::drop_bridged},
                           Member{"fill_gaps", &Own::fill_gaps},
                           Member{"validation", &Own::validation},
                           Member{"mesh", &Own::mesh},
                           Member{"periodic", &Own::periodic},
                           Member{"periodic_mesh", &Own::periodic_mesh});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static IsosurfacePipelineParameters
  fromJson(const std::string& text);
};

/** \throws InvalidArgument for what can be told without samples: see
 * checkParameters(IsosurfaceParameters); normals by fits with linear interpolation;
 * fewer than 2 neighbours of a normal; a bound of the error that is negative or no
 * number, or given beside an automatic one; a hold-out test of one fold, or in a box
 * that repeats; sides of such a box that are negative or not finite; welding without
 * such a box or a mesh; a mesh with a bound of the error, without bridged points, with
 * other normals than those of the fits, and as checkParameters(SurfaceMeshParameters)
 *
 * \param parameters to be checked before samples are there */
PCL_UVOL_EXPORTS void
checkParameters(const IsosurfacePipelineParameters& parameters);

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
  std::size_t tested = 0;  ///< samples with a value and a place
  std::size_t covered = 0; ///< of these, those near the surface
  ClassShares side{};      ///< of those: by the surface
  double side_error = 0; ///< standard error of side.predicted - side.nearest, which are
                         ///< shares of the same samples; NaN of none
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
 * spacing of predicted ones. They lie in the convex hull of the measured ones, or half
 * a gap outside of it, which is at most two spacings. Lengths are in units of the
 * stretched space; the variogram is that of the means, of mean roots of differences
 * (Cressie and Hawkins 1980), or of the samples where there was no gap.
 *
 * Isopoints that rest on them have IsoSupport::Predicted; their `error` is the standard
 * deviation of the kriging over the slope of the kriged field, and `confidence` the
 * part of the field's variance that the samples explain there: 1 - deviation^2 /
 * (nugget + partial sill), 1 for all other isopoints. Where they explain nothing of it
 * a prediction is no better than a mean of all samples: with Interpolation::Auto,
 * isopoints of confidence 0 are left out. */
struct GapFilling {
  std::size_t predicted = 0; ///< samples; 0: there was no gap, or it was not filled
  double spacing = 0.0;      ///< between them; 0: no gap, or none whose width is known
  std::string unfilled;      ///< why there are none: part of a sentence
  /** The range of the spherical variogram; no predicted sample is farther from a
   * measured one. */
  double range = 0.0;
  /** Nugget and partial sill (the sill without the nugget) of the variogram, in squared
   * units of the field. */
  double nugget = 0.0, sill = 0.0;
  /** The index of the measured sample next to each predicted one, which has the other
   * fields of it. */
  std::vector<std::uint32_t> sources;
};

namespace detail {
class FilledGaps;
}

/** \brief What comes out. */
struct PCL_UVOL_EXPORTS IsosurfaceResult {
  /** The isopoints: the fields of PointIso, then all fields of the samples that these
   * do not replace. `isovalue` is float64, behind these, where float holds one of the
   * isovalues as infinite or as zero. With Interpolation::Auto also `method` and
   * `orientation`, numbers of IsoMethod and IsoOrientation; after a level set and in a
   * mesh it takes a fit wherever there is one. With a mesh its vertices, and behind the
   * other fields `piece`, among pieces, and `cap`, 1 where a vertex closes the samples'
   * box. */
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
  /** What the samples are like in the stretched space; of several processes, those of
   * all of them. */
  std::optional<SamplingSummary> sampling;
  std::optional<GapFilling> gaps;          ///< if they were to be filled
  std::vector<ValidationScore> validation; ///< one per isovalue, if asked for
  /** Counts, times and warnings of IsosurfaceExtraction or SurfaceMesh,
   * LevelSetEvolution and SurfaceNormalEstimation, and "removed_by_error" and
   * "removed_bridged"; "bridged", "rim" and "predicted" count what is left. */
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

  /** \return The samples; null before they are set. */
  const std::shared_ptr<const Dataset>&
  getInput() const
  {
    return samples_;
  }

  /** \brief The samples to take; null, the default: all of them. */
  void
  setIndices(const pcl::IndicesPtr& indices);

  /** \return The samples to take; null: all of them. */
  const pcl::IndicesPtr&
  getIndices() const
  {
    return indices_;
  }

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
  runOnSamples(const IsosurfacePipelineParameters& parameters);

  /** Isopoints are vertices without triangles. */
  SurfaceTriangles
  extract(const IsosurfaceParameters& parameters, Report& report);

  /** \param sampling set if a level set has looked at it */
  SurfaceTriangles
  extractLevelSets(const IsosurfaceParameters& parameters,
                   std::vector<LevelSetSummary>& summaries,
                   std::optional<SamplingSummary>& sampling);

  /** The points to take. */
  pcl::Indices
  listPoints() const;

  /** Extracts from samples as they are and those that are predicted in their gaps.
   * \param parameters with the field and the scale that are taken */
  IsosurfaceResult
  runFilled(IsosurfacePipelineParameters parameters);

  /** Extracts along axes that are not those of the coordinates. */
  IsosurfaceResult
  runTurned();

  /** Extracts from samples that were made from the input.
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

/** \brief Extraction, filters and fields in one call, which all processes make.
 *
 * \code
 * pcl_uvol::MpiCommunicator communicator(*controller);
 * pcl_uvol::DistributedIsosurfacePipeline pipeline(communicator);
 * pipeline.setInput(part); // the samples of this process
 * pipeline.setParameters(parameters);
 * const pcl_uvol::IsosurfaceResult result = pipeline.run();
 * \endcode
 * The isopoints of all processes together are those of IsosurfacePipeline, byte for
 * byte, but for normals: an isopoint without a fit has that of its edge, since
 * neighbours may lie on other processes. That goes for samples in a box that repeats as
 * well: each process gives the samples that it holds images, for whoever has those on
 * the other side. Memory: about 130 bytes per sample; in such a box a copy of all
 * fields besides. */
class PCL_UVOL_EXPORTS DistributedIsosurfacePipeline
    : public ParameterStage<IsosurfacePipelineParameters> {
public:
  using Ptr = std::shared_ptr<DistributedIsosurfacePipeline>;
  using ConstPtr = std::shared_ptr<const DistributedIsosurfacePipeline>;

  /** \param communicator must outlive the pipeline */
  explicit DistributedIsosurfacePipeline(Communicator& communicator)
      : communicator_(communicator)
  {
  }

  /** \brief The samples of this process, of the same fields and the same origin on all
   * of them; there may be none. */
  void
  setInput(const std::shared_ptr<const Dataset>& part)
  {
    part_ = part;
  }

  /** \return The samples of this process; null before they are set. */
  const std::shared_ptr<const Dataset>&
  getInput() const
  {
    return part_;
  }

  /** \brief True: the first process gets the whole surface, in the order in which
   * IsosurfacePipeline gives it, and the others nothing. False, the default: each
   * process keeps the isopoints of its piece of space, ordered by their edges. */
  void
  setGathered(bool is_gathered)
  {
    is_gathered_ = is_gathered;
  }

  /** \return Whether the first process gets the whole surface. */
  bool
  isGathered() const
  {
    return is_gathered_;
  }

  /** \brief Run on all processes at once. Edges of the result are indices into what
   * they touch of the samples and their images, not into the input.
   * \throws InvalidArgument as IsosurfacePipeline, for an automatic scale, a level set
   * and normals other than those of fits and edges; on all processes if there is no
   * sample at all */
  IsosurfaceResult
  run();

private:
  Communicator& communicator_;
  std::shared_ptr<const Dataset> part_;
  bool is_gathered_ = false;
};

} // namespace pcl_uvol
