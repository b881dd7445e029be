// SPDX-License-Identifier: BSD-3-Clause
// How a level set is evolved, and what is told of it.
#pragma once

#include <pcl_uvol/derivatives/local_fit.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/initial_function.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief The smoothing term of thesis (3.7). */
enum class CurvatureFlow {
  Mean,    ///< the mean curvature, which shrinks what it smooths (thesis)
  Relative ///< the mean curvature less its mean over the surroundings, in units of the
           ///< local spacing instead of the median one: smooths as much and keeps the
           ///< radius (default)
};

/** \brief What bounds the time step. */
enum class StepBound {
  Cfl,    ///< thesis 3.5.1, by the distance to the nearest neighbour
  Stencil ///< by the stencil's own weights: sharper on random samples (default)
};

/** \brief Whose step is taken. */
enum class Integration {
  Synchronous, ///< all samples take the smallest step that any of them allows
  Asynchronous ///< thesis 3.5.2: every sample takes its own, in classes of powers of
               ///< two; neighbours are interpolated linearly in time (default)
};

/** \brief What makes the level-set function a distance again when its slope has left 1
 * by too much. */
enum class Reinitialization {
  None,
  Distance, ///< distance to the extracted isopoints (Rosenthal, Molchanov, Linsen
            ///< 2010; default)
  Eikonal,  ///< thesis 3.4, after Peng et al. 1999
  Diffusion ///< thesis 3.4, after Li et al. 2005: a term of the evolution itself; slow,
            ///< moves the surface, and is unstable where the slope is below 1
};

/** \brief One step of an evolution. Lengths are in units of the spacing, times in its
 * square; figures are those of the samples within one spacing of the zero level. */
struct LevelSetStep {
  double time;      ///< after the step
  double change;    ///< root mean square of the motion of the zero level, per unit of
                    ///< time
  double min_slope; ///< of |grad phi|
  double max_slope;
  double slope_error; ///< mean of | |grad phi| - 1 |
  double energy;      ///< mean of mu (f - f_iso - phi)^2 / 2 + (1 - mu) |grad phi|
  bool reinitialized; ///< after it
};

/** \brief What an evolution found out. */
struct LevelSetSummary {
  double spacing = 0.0; ///< median spacing of the samples near the surface: the unit of
                        ///< length
  double noise = 0.0;   ///< standard deviation of f over its slope, in spacings, as the
                        ///< residuals of local fits tell it
  double mu = 0.0;      ///< as given, or chosen by the noise and, if smoothing takes
                        ///< more away than that, raised on the way
  bool converged = false;
  std::vector<LevelSetStep> steps;
};

/** \brief Told after every so many steps: what was found out so far, and phi, in units
 * of length, by index of the input cloud. */
using SnapshotCallback =
    std::function<void(const LevelSetSummary& summary, const std::vector<float>& phi)>;

/** \brief The setters of LevelSetEvolution tell more. */
struct LevelSetParameters {
  static constexpr double automatic = -1.0;

  double mu = automatic;
  FitScheme scheme = FitScheme::Quadratic;
  CurvatureFlow flow = CurvatureFlow::Relative;
  StepBound bound = StepBound::Stencil;
  Integration integration = Integration::Asynchronous;
  Reinitialization reinitialization = Reinitialization::Distance;
  InitialFunction initial;
  Outside outside = Outside::Lower;
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  std::size_t k = 26;
  std::size_t max_steps = 400;
  double tolerance = 0.002;
  double band_width = 5.0; ///< 0: no band
  SnapshotCallback snapshot;
  std::size_t snapshot_steps = 0; ///< 0: nobody is told
  unsigned threads = 0;
};

/** \brief What an evolution leaves. */
struct LevelSet {
  std::vector<float> phi; ///< by input index, in units of length; NaN where a point has
                          ///< no coordinates or no value
  LevelSetSummary summary;
};

} // namespace pcl_uvol
