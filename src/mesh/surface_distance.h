// SPDX-License-Identifier: BSD-3-Clause
// How far one surface is from another one, and how much their fields differ.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Flat triangles, or points where there are none. */
struct ComparedSurface {
  const Dataset& vertices;
  const std::vector<Triangle>& triangles;
};

/** \brief How much a field differs between two surfaces. */
struct FieldDifference {
  std::string name;
  double mean;    ///< of the absolute difference, by area
  double largest; ///< of the absolute differences
};

/** \brief Distances of all points of a surface to another one, units of length. */
struct SurfaceDistances {
  double mean, root_mean_square; ///< by area, or by points where there are no triangles
  double permille; ///< all but a thousandth of the surface lies no farther away
  double largest;
  Eigen::Vector3d farthest;            ///< the place that is so far away
  std::vector<FieldDifference> fields; ///< of fields that both have
  std::vector<float> at_vertices;      ///< negative inside, where triangles tell
};

/** \brief Distances from one surface to another one (Cignoni et al., Metro, 1998):
 * weighted means at the six points of a quadrature rule in every triangle, and at the
 * vertices.
 * \param progress told of "distances"; empty: nobody is told
 * \throws InvalidArgument for a surface without points, vertices that are not finite
 * and triangles whose vertices are not there */
PCL_UVOL_EXPORTS SurfaceDistances
measureDistances(const ComparedSurface& from,
                 const ComparedSurface& to,
                 unsigned threads,
                 const ProgressCallback& progress = nullptr);

/** \brief Distances between two surfaces both ways. */
struct SurfaceComparison {
  SurfaceDistances there; ///< from the first one to the second one
  SurfaceDistances back;
};

/** \brief Measure the distances between two surfaces.
 * \param names of both, for warnings
 * \param report gets the time of "distances", and a warning for each surface without
 * triangles: distances to its points are limited by their spacing
 * \throws InvalidArgument as measureDistances() */
PCL_UVOL_EXPORTS SurfaceComparison
compareSurfaces(const ComparedSurface& first,
                const ComparedSurface& second,
                const std::array<std::string, 2>& names,
                unsigned threads,
                Report& report);

} // namespace pcl_uvol::detail
