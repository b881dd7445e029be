// SPDX-License-Identifier: BSD-3-Clause
// Queries in rows at equal distances: lines, slices and grids.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

using Place = std::array<double, 3>;

/** \brief Places at equal distances along up to three axes; the first axis runs
 * fastest. */
struct PCL_UVOL_EXPORTS QueryLattice {
  Place origin{};                               ///< the first place
  std::array<Place, 3> steps{};                 ///< to the next one along each axis
  std::array<std::size_t, 3> counts{{1, 1, 1}}; ///< places along each axis

  std::size_t
  size() const
  {
    return counts[0] * counts[1] * counts[2];
  }

  Place
  at(std::size_t index) const;

  /** \brief The length of a step. */
  double
  spacing(std::size_t axis) const;
};

/** \brief A box that holds points. */
struct Bounds {
  Place low{}, high{};
};

/** \brief The box of the points with finite coordinates.
 * \throws InvalidArgument if there are none */
PCL_UVOL_EXPORTS Bounds
findBounds(const CloudView& cloud);

/** \brief Places from one point to another, both included.
 * \param count at least 2
 * \throws InvalidArgument for points that are not finite or the same */
PCL_UVOL_EXPORTS QueryLattice
makeLine(const Place& from, const Place& to, std::size_t count);

/** \brief A grid of cubes over a box: so many places along its longest side, along the
 * others as many as fit, in their middle.
 * \param count at least 2
 * \throws InvalidArgument for an empty or infinite box */
PCL_UVOL_EXPORTS QueryLattice
makeCubicGrid(const Bounds& box, std::size_t count);

/** \brief Exactly so many places from face to face of a box; 1 is in the middle.
 * \throws InvalidArgument as makeCubicGrid */
PCL_UVOL_EXPORTS QueryLattice
makeGrid(const Bounds& box, const std::array<std::size_t, 3>& counts);

/** \brief A plane through a point. */
struct Plane {
  Place point{}, normal{};
};

/** \brief A rectangle of places in a plane. */
struct Slice {
  QueryLattice lattice;
  std::size_t horizontal, vertical; ///< axes of the lattice, as in a picture
};

/** \brief The rectangle of a plane about its cut through a box, seen from where the
 * normal points, z upwards, or y in a plane that z is perpendicular to; one that y is
 * perpendicular to is seen with x to the right. Slices along the axes of the
 * coordinates are lattices along these axes.
 * \param counts places along the picture's width and height: a bound, of which one is
 * met; squares between them
 * \throws InvalidArgument for a plane that misses the box, a normal of no direction */
PCL_UVOL_EXPORTS Slice
makeSlice(const Plane& plane,
          const Bounds& box,
          const std::array<std::size_t, 2>& counts);

/** \brief The type that interpolated values of a field have in files of lattices: that
 * of the samples, if it is floating.
 * \param fields of the samples
 * \param name a scalar field, as in ScalarField
 * \return pcl::PCLPointField::FLOAT32 or FLOAT64 */
PCL_UVOL_EXPORTS std::uint8_t
findFileType(const std::vector<pcl::PCLPointField>& fields, const std::string& name);

} // namespace pcl_uvol::detail
