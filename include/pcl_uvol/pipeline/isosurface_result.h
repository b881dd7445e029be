// SPDX-License-Identifier: BSD-3-Clause
// The surface that IsosurfacePipeline makes, and what is known of it.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

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

/** \brief The estimated errors of isopoints, in units of length. */
struct ErrorSummary {
  float median, percentile_95, largest;
};

/** \brief Proportions of samples whose class (at or above the isovalue, or below) is
 * predicted correctly. NaN without samples. */
struct ClassShares {
  double predicted; ///< by what is tested
  double base;      ///< by the majority class
  double nearest;   ///< by the class of the nearest sample
};

/** \brief The cross-validation of one isovalue. Samples are held out, fold by fold, the
 * surface is extracted from the others, and predicts the class of the held-out ones.
 *
 * Near the surface, no farther from it than 2 local spacings, the side of the nearest
 * isopoint's normal predicts the class. A local spacing is the mean distance of the 6
 * nearest remaining samples, in the stretched space. Everywhere, the field between the
 * samples predicts the class, kriged from 16 samples of all octants; where it has no
 * value, the nearest sample does. */
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
  /** The samples near the surface that are farther from the plane of the nearest
   * isopoint than its `error`, and the proportion of these on the correct side of it:
   * most, if the estimate is right. @{ */
  std::size_t beyond_error = 0;
  double side_beyond_error = 0;
  /** @} */
};

/** \brief How gaps of the sampling were filled: around the isosurfaces, by samples that
 * ordinary kriging predicts from the means of measured ones in cells as long as the
 * spacing of predicted ones. They lie in the convex hull of the measured ones, or at
 * most half of the width of a gap outside of it. Lengths are in units of the
 * stretched space; the variogram is that of the means, of mean roots of differences
 * (Cressie and Hawkins 1980), or of the samples where there was no gap.
 *
 * Isopoints that rest on them have IsoSupport::Predicted; their `error` is the standard
 * deviation of the kriging over the slope of the kriged field, and `confidence` the
 * part of the field's variance that the samples explain there: 1 - deviation^2 /
 * (nugget + partial sill), 1 for all other isopoints. Where they explain nothing of it,
 * a prediction is not more accurate than the mean of all samples: with
 * Interpolation::Auto, isopoints of confidence 0 are left out. */
struct GapFilling {
  std::size_t predicted = 0; ///< samples; 0: there was no gap, or it was not filled
  double width = 0.0;        ///< of a gap; 0: no gap, or none whose width is known
  double spacing = 0.0; ///< between samples: a quarter of the width, or more if these
                        ///< were too many
  std::string unfilled; ///< why no gap was filled: part of a sentence
  /** The range of the spherical variogram; no predicted sample is farther from a
   * measured one. */
  double range = 0.0;
  /** Nugget and partial sill (the sill without the nugget) of the variogram, in squared
   * units of the field. */
  double nugget = 0.0, psill = 0.0;
  /** The index of the measured sample next to each predicted one, which has the other
   * fields of it. */
  std::vector<std::uint32_t> sources;
};

/** \brief A box that samples repeat in: along an axis with a side of 0 they do not, and
 * the corner is 0 there. */
struct SampleBox {
  std::array<double, 3> low{}, sides{};
};

/** \brief Result of a pipeline. */
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
  std::vector<SurfacePiece> pieces;   ///< with a mesh: see SurfaceTriangles
  double smallest_angle = 0.0;        ///< with a mesh: of all triangles, in degrees
  IsoEdges edges;                     ///< one per isopoint, indices into the samples;
                                      ///< those beyond the last one are predicted or of
                                      ///< IsosurfacePipelineParameters::outside_value
  std::vector<std::size_t> isopoints; ///< how many of each isovalue the surface has
  std::string field;                  ///< that was taken
  Eigen::Array3f scale;               ///< that was taken
  Interpolation interpolation = Interpolation::Auto; ///< that was taken
  std::optional<SampleBox> box; ///< that the samples repeat in, if one was asked for
  /** With an automatic scale: how it was found. */
  std::optional<ScaleChoice> scale_choice;
  /** With `smooth`: one per isovalue; spacing 0 where there was no surface to smooth.
   */
  std::vector<LevelSetSummary> level_sets;
  std::optional<ErrorSummary> errors; ///< none where no error is estimated
  /** The sampling in the stretched space; of several processes, of all samples. */
  std::optional<SamplingSummary> sampling;
  std::optional<GapFilling> gaps;          ///< if they were to be filled
  std::vector<ValidationScore> validation; ///< one per isovalue, if asked for
  /** Counts, times and warnings of IsosurfaceExtraction or SurfaceMesh,
   * LevelSetEvolution and SurfaceNormalEstimation, and "unlocated",
   * "removed_by_error" and "removed_bridged"; "bridged", "rim" and "predicted" count
   * what is left. */
  Report report;
};

} // namespace pcl_uvol
