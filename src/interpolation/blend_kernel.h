// SPDX-License-Identifier: BSD-3-Clause
// Vector kernels of blended fits: which balls hold a place, and what cubics are there.
// Plain arrays, no library headers: the file is compiled once per instruction set; all
// give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** Kernels read whole registers: rows hold so many more numbers than there are balls.
 */
constexpr std::size_t ball_padding = 8;

/** The terms of a cubic, see PolynomialFit. */
constexpr std::size_t cubic_terms = 20;

/** \brief One instruction set's versions. */
struct BlendKernels {
  /** \brief Find the balls that hold a place in their interior, in their order.
   * \param centers rows of x, y, z
   * \param per_sq_radius the inverse of squared radii; infinite behind the last ball
   * \param place three coordinates
   * \param held room for count + ball_padding: indices of these balls
   * \param part as many: squared distances of the place to their centres in parts of
   * the squared radii, below 1
   * \return number of these balls */
  std::size_t (*findHolding)(const float* const* centers,
                             const double* per_sq_radius,
                             std::size_t count,
                             const double* place,
                             std::uint32_t* held,
                             double* part);

  /** \brief Find the balls that reach into a box; touching it does not count.
   * \param centers rows of x, y, z
   * \param sq_radius squared radii before they grow; 0 behind the last ball
   * \param sq_factor by which squared radii grow
   * \param low,high corners of the box
   * \param reaching room for count + ball_padding: indices of these balls
   * \return number of these balls */
  std::size_t (*findReaching)(const float* const* centers,
                              const double* sq_radius,
                              double sq_factor,
                              std::size_t count,
                              const double* low,
                              const double* high,
                              std::uint32_t* reaching);

  /** \brief Evaluate the cubics of several fields at one place.
   * \param coefficients [field][term]
   * \param place three coordinates, in the unit of the cubics
   * \param values [field]
   * \param gradients [field][axis]; null: not wanted */
  void (*evaluateCubics)(const double* coefficients,
                         std::size_t fields,
                         const double* place,
                         double* values,
                         double* gradients);
};

namespace baseline {
extern const BlendKernels blend_kernels;
}
namespace avx2 {
extern const BlendKernels blend_kernels;
}
namespace avx512 {
extern const BlendKernels blend_kernels;
}

} // namespace pcl_uvol
