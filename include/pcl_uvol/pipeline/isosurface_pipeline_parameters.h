// SPDX-License-Identifier: BSD-3-Clause
// The parameters of IsosurfacePipeline.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>

namespace pcl_uvol {

/** \brief How isopoints are oriented. */
enum class NormalMethod {
  Auto, ///< Pca with Interpolation::Linear; with Auto as IsoOrientation says, chosen
        ///< from the sampling; else Fit (default)
  Fit,  ///< by the local fits, by principal components where none serves
  Pca,  ///< by principal components of the isopoints (thesis 4.1)
  Edge ///< as the extraction leaves them: by the fits, along the edge where none serves
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

/** \brief How a mesh ends at the faces of a periodic box. */
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

  /** An empty field means `intensity`, else the only candidate, see
   * ScalarField::defaultName. The interpolation is Auto unless it is set: an isopoint
   * stays on its fit unless it reaches across a gap, or lies beside one and has no fit.
   */
  IsosurfaceParameters isosurface;
  /** Take the scale from the samples instead of isosurface.scale: from how fast the
   * field changes along each axis. Not given: see takesAutomaticScale(). */
  std::optional<bool> automatic_scale;
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
  /** Where the field is known to end outside of the data, as the density of a liquid
   * does: its value there, in units of the field. Samples of that value are added about
   * one spacing outside of the others, see addOuterLayer. Interpolation::Auto is then
   * Linear, but in a mesh, since fits oscillate at the jump. None: nothing is known. */
  std::optional<double> outside_value;
  ValidationParameters validation;
  /** Make a mesh, see SurfaceMesh, whose vertices are the isopoints. None: isopoints
   * that nothing joins. */
  std::optional<MeshingParameters> mesh;
  /** Sides of the box that the samples repeat in, in units of length; 0, the default:
   * they do not along that axis. Neighbours are seen across its faces. It lies where
   * the samples do, at 0, about 0, or at the lowest of them; isopoints lie in it, their
   * edges may join samples across its faces, and a mesh is cut there. */
  Eigen::Array3d periodic{0.0, 0.0, 0.0};
  /** With a mesh in a periodic box. Weld adds the field `image_of`: the vertex in the
   * low face that one in a high face is the image of, else the vertex itself. Pieces,
   * their rims and handles are then those of the mesh whose images are one vertex. */
  PeriodicMesh periodic_mesh = PeriodicMesh::Cut;

  /** \return The interpolation that is taken: Auto is Linear where samples of a value
   * outside are added, but in a mesh. */
  Interpolation
  takenInterpolation() const;

  /** \return automatic_scale; not given, true if gaps are filled and the factors of the
   * scale are 1: what kriging predicts between lines depends on distances that mean
   * something. */
  bool
  takesAutomaticScale() const
  {
    return automatic_scale.value_or(fill_gaps && (isosurface.scale == 1.0f).all());
  }

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
                           Member{"outside_value", &Own::outside_value},
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

/** \brief Check everything that needs no samples.
 *
 * \throws InvalidArgument as checkParameters(IsosurfaceParameters) and
 * checkParameters(SurfaceMeshParameters), and for
 * - normals by fits with linear interpolation; fewer than 2 neighbours of a normal;
 * - a bound of the error that is negative or not a number, or combined with an
 * automatic one;
 * - a value outside that is not finite, or with filled gaps;
 * - cross-validation with one fold;
 * - cross-validation, filled gaps or a value outside in a periodic box; sides of the
 * box that are negative or not finite; welding without a periodic box or a mesh;
 * - a mesh with a bound of the error, without bridged points, or with other normals
 * than those of the fits
 *
 * \param parameters to be checked before samples are there */
PCL_UVOL_EXPORTS void
checkParameters(const IsosurfacePipelineParameters& parameters);

} // namespace pcl_uvol
