// SPDX-License-Identifier: BSD-3-Clause
// Sums of smoothing kernels over particles, as smoothed particle hydrodynamics has them
// (Price 2012).
#pragma once

#include "interpolation/ball_tree.h"
#include "interpolation/field_model.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <optional>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A kernel W(r, h) = value(r / h) / h^3 whose integral over space is 1. */
struct SmoothingKernel {
  double reach; ///< of r / h: the kernel ends there
  double (*value)(double q);
  double (*slope)(double q); ///< derivative by q
};

/** \brief The kernel of a name. */
const SmoothingKernel&
smoothingKernel(SphKernel kernel);

/** \brief What particles have besides a place, by sample; empty where no field gives
 * it. */
struct Particles {
  std::vector<double> lengths; ///< smoothing lengths in the samples' unit
  std::vector<double> masses, densities;
};

/** \brief Read the fields that the parameters name; of coinciding particles the first
 * counts.
 * \throws InvalidArgument for an unknown field */
Particles
readParticles(const CloudView& cloud,
              const SampleSet& samples,
              const SphParameters& parameters);

/** \brief The sum over particles j of V_j f_j W(|x - x_j|, h_j), V_j = m_j / rho_j; by
 * default divided by the same sum of ones. The standard error is the weighted standard
 * deviation of the values. Beyond all kernels the sum is 0, and a quotient the value of
 * the nearest particle. Memory: 40 bytes per particle. The time and progress of making
 * it are those of "density". */
class KernelSums : public FieldModel {
public:
  KernelSums(const SampledFields& sampled,
             const SphParameters& parameters,
             Particles particles,
             unsigned threads,
             Report& report);

  void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const override;

  /** \brief V of every particle, in the samples' unit. */
  const std::vector<double>&
  getVolumes() const
  {
    return volumes_;
  }

private:
  void
  completeLengths(unsigned threads, StepTimer& step);

  void
  setVolumes(const Particles& particles, unsigned threads, StepTimer& step);

  const SampledFields& sampled_;
  SphParameters parameters_;
  const SmoothingKernel& kernel_;
  std::vector<Position> sparse_;
  std::vector<double> lengths_, volumes_;
  std::optional<BallTree> balls_;
};

} // namespace pcl_uvol::detail
