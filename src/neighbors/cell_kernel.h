// SPDX-License-Identifier: BSD-3-Clause
// Vector kernels of Voronoi cells: vertices over a plane, the first sample that a
// growing sphere meets, and the sample nearest to a vertex. Plain arrays, no library
// headers: the file is compiled once per instruction set; all give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** Kernels read whole registers: rows hold so many more numbers than there are points.
 */
constexpr std::size_t cell_padding = 8;

/** \brief One instruction set's versions. */
struct CellKernels {
  /** \brief Measure how far points lie over a plane.
   * \param points rows of x, y, z; the origin behind the last one, below the plane
   * \param plane its normal, of any length, and normal . x on it
   * \param margin heights up to it, and down to its negative, are no heights
   * \param heights room for count + cell_padding: normal . x less that on the plane
   * \return bits: 1 if a point is over the margin, 2 if one lies within it */
  unsigned (*measureHeights)(const double* const* points,
                             std::size_t count,
                             const double* plane,
                             double margin,
                             double* heights);

  /** \brief Find the sample that a sphere through three others meets first when its
   * centre moves along the normal of their plane.
   * \param points rows of x, y, z and half the squared length; infinite ones, with the
   * origin, behind the last one
   * \param plane see measureHeights: only samples over it count
   * \param sphere its centre, and half the squared length less centre . x of points on
   * it
   * \param corners three points that do not count
   * \param distances room for count + cell_padding
   * \param first its place; of equal ones the first one
   * \return how far the centre moves, in lengths of the normal; infinite: none is met
   */
  double (*findFirst)(const double* const* points,
                      std::size_t count,
                      const double* plane,
                      const double* sphere,
                      const std::uint16_t* corners,
                      double* distances,
                      std::size_t* first);

  /** \brief Find the sample nearest to a place.
   * \param points see findFirst
   * \param count >= 1
   * \return its row; of equally near ones the first one */
  std::size_t (*findNearest)(const double* const* points,
                             std::size_t count,
                             const double* place);
};

namespace baseline {
extern const CellKernels cell_kernels;
}
namespace avx2 {
extern const CellKernels cell_kernels;
}
namespace avx512 {
extern const CellKernels cell_kernels;
}

} // namespace pcl_uvol
