// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of a scattered field at a sample, as fixed weights of the differences to
// its nearest neighbours (thesis 3.2): a least-squares polynomial, solved once.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief First and, with the quadratic scheme, second derivatives: x y z, then xx xy
 * xz yy yz zz. */
constexpr std::size_t
derivativesOf(FitScheme scheme)
{
  return scheme == FitScheme::Linear ? 3 : 9;
}

/** \brief How far a fit got. */
enum class FitOutcome {
  Full,
  Reduced, ///< too few neighbours, or neighbours on a surface of second degree: a plane
           ///< instead of a quadratic
  Singular ///< neighbours on a plane or a line, where the derivatives across it are 0;
           ///< or no neighbours
};

/** \brief Fits of one sample after another; one object per thread.
 *
 * The derivative d of any field f is the sum over the neighbours j of getWeights(d)[j]
 * * (f_j - f). Exact for linear functions, with the quadratic scheme for those of
 * second degree. */
class PCL_UVOL_EXPORTS LocalFit {
public:
  explicit LocalFit(FitScheme scheme)
      : scheme_(scheme)
  {
  }

  /** \brief Compute the weights at a sample.
   * \param positions of all samples
   * \param neighbors indices of the others that are used */
  FitOutcome
  fit(const std::vector<Position>& positions,
      std::uint32_t sample,
      const std::uint32_t* neighbors,
      std::size_t count);

  /** \brief After a fit that is not full: a quadratic in the plane that the neighbours
   * lie on, the derivatives across which are 0. Quadratic scheme only.
   * \return false, and the weights as they were, for neighbours that lie on no plane,
   * on a curve of second degree in it, or are fewer than 5 */
  bool
  fitInPlane();

  /** \brief Trade the quadratic for a plane with one second derivative, the same along
   * all axes: for smoothing, where the quadratic's curvature would grow with the
   * sample's own deviation instead of against it, as beside the rim of a cloud. Exact
   * for linear functions; curvature across the gradient is right on average for
   * functions that are straight along it, as distances are. Quadratic scheme only. */
  void
  makeIsotropic();

  /** \brief One weight per neighbour, in 1 / length, for second derivatives 1 /
   * length^2. */
  const double*
  getWeights(std::size_t derivative) const
  {
    return &weights_[derivative * count_];
  }

  /** \brief Distance of the farthest neighbour. */
  double
  getReach() const
  {
    return reach_;
  }

private:
  bool
  fitQuadratic();

  /** False if the neighbours extend less across some direction, the derivative along
   * which is then 0. */
  bool
  fitPlane(double least_eigenvalue);

  FitScheme scheme_;
  std::size_t count_ = 0;
  double reach_ = 0.0;
  std::vector<double> offsets_; ///< x y z of the neighbours, divided by the reach
  std::vector<double> weights_; ///< by derivative, then neighbour
};

} // namespace pcl_uvol
