// SPDX-License-Identifier: BSD-3-Clause
// Fits of logarithms around isopoints: densities and concentrations vary by factors,
// and no cubic follows these as far as it follows their logarithms.
#pragma once

#include "derivatives/fit_kernel.h"
#include "isosurface/fit_judgement.h"

#include <vector>

namespace pcl_uvol {

/** \brief Second fits where values are steep; one object per thread. */
class LogarithmicFits {
public:
  LogarithmicFits(FitKernel fit, float isovalue);

  /** \brief Fit f_iso log(f / f_iso) as well, which has the zero level of f - f_iso and
   * its slope there, where all values around have the sign of the isovalue and vary by
   * a factor; what then has the smaller error takes the place of the fit. Where the fit
   * stays, the value at the centre is that of the one that is more certain of its side.
   * \param weighted neighbours with a weight, per lane
   * \param surroundings of the lanes with a weight; their values become logarithms
   * where these are taken
   * \param samples the same
   * \param result of the fit of the values */
  void
  improve(const int* weighted,
          Surroundings* surroundings,
          std::vector<FitSample>& samples,
          FitResult& result);

private:
  bool
  isSteep(const Surroundings& surroundings) const;

  double
  takeLogarithm(double above_isovalue) const;

  /** Whether logarithms that have not been taken are more certain of the side of the
   * centre, where the samples tell of no surface nearby, or do not reach: a polynomial
   * of values that fall by factors rises there again. Logarithms rise without bound,
   * and a rise that both tell of stays that of the values. */
  bool
  isMoreCertainOfSide(const FitResult& fit,
                      const FitResult& of_values,
                      const Surroundings& surroundings,
                      std::size_t lane) const;

  /** Tell the logarithm at the centre; infinite where float holds no such value. */
  void
  takeValue(const FitResult& fit, std::size_t lane, FitResult& result) const;

  void
  accept(const FitResult& fit,
         std::size_t lane,
         Surroundings& surroundings,
         std::vector<FitSample>& samples,
         FitResult& result) const;

  FitKernel fit_;
  double isovalue_;
  std::vector<FitSample> logarithms_;
};

} // namespace pcl_uvol
