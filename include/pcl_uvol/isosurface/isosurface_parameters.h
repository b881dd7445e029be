// SPDX-License-Identifier: BSD-3-Clause
// What an isosurface is extracted from, and how.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/neighbors/natural_neighbor_parameters.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
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
  Fit,    ///< the zero level of a local cubic or quadratic fit (default)
  Auto ///< IsosurfacePipeline decides for each isopoint, its default; as Fit elsewhere
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

} // namespace pcl_uvol
