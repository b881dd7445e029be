// SPDX-License-Identifier: BSD-3-Clause
// The numbers that the level set was tuned by, each with its reason: what was measured
// stands in tests/benchmarks/README.md under "Noise and level sets", and what half and
// twice of each does under "What its constants do".
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** \brief Lengths are in spacings and times in their squares unless told otherwise. */
struct LevelSetConstants {
  // What values of the field count (robust_values.cpp)

  /** Values count as no farther from the isovalue than so many medians of those next to
   * the surface. Densities over ten decades diverged without a limit; this one leaves
   * values alone where slopes differ along the surface by less. */
  float farthest_value = 30.0f;
  /** A sample is a spike where its value lies farther from the median of its neighbours
   * than so many of their median deviations: 4 standard deviations of noise. */
  float spike_deviations = 6.0f;
  /** ... and no more than so many of 26 neighbours have values of its kind: 1 % of
   * spikes at random puts more than two side by side once in 500 times. */
  std::size_t most_companions = 2;

  /** Spikes, as a share of the samples next to the surface, that are worth a warning:
   * Gaussian noise makes one in 10,000. */
  double warned_outliers = 0.001;

  /** Samples that tell whether logarithms lie nearer to quadratics, at most: the median
   * over so many is known to 4 %. */
  std::size_t scale_fits = 512;

  // The data as a distance (data_term.cpp)

  /** Slopes count as no smaller than that part of their median at the surface: flat
   * places would pull from anywhere. */
  float least_slope = 0.1f;
  /** Neighbour by neighbour, slopes of the surface reach as far as the band of 5. */
  int spreading_passes = 5;
  /** Samples whose neighbourhoods tell the noise, at most: 2 % of it at random. */
  std::size_t noise_fits = 4096;
  /** Samples in such a neighbourhood: 17 degrees of freedom beside a quadratic. */
  std::size_t noise_samples = 27;
  /** Where close pairs of samples agree better than that part of what fits leave, the
   * fits do not follow the field, as at the ridge of a sheet 4 thick: pairs count. */
  double misfit_part = 0.7;

  /** Share of the samples next to the surface that have one value: more of them do not
   * tell the noise. */
  double most_ties = 0.25;

  // How much is smoothed (mu_choice.cpp)

  /** From weight to weight: the deviation changes by less than 5 % between them. */
  double mu_ratio = 0.7;
  /** Large smooth surfaces take what there is: of spheres and tori of radius 22, 0.01
   * left 7 to 12 % more, and saved 4 of 60 to 150 steps. */
  double least_mu = 0.003;
  /** Each weight acts until the surface moves by less per unit of time, or for so many
   * steps: what moves on afterwards shrinks, as small spheres do. */
  double calm = 0.01;
  std::size_t steps_of_weight = 60;
  /** Steps between two looks at the expected deviation. */
  std::size_t look_steps = 4;
  /** Looks without a better one that end a weight, and weights that end the search: the
   * estimate fluctuates, by more where surfaces are small. */
  std::size_t patience = 2;
  /** How near samples are that are looked at. Up to 1, the ridge of a sheet 4 thick
   * counted, whose loss does not move the surface: mu 1.5 times as large as the best.
   */
  double look_distance = 0.5;
  /** The most of these that are looked at. */
  std::size_t most_looked_at = 2048;
  /** Samples in the fits that look. Quadratics through 30 see the ridge of a sheet: 4
   * and 6 thick they were left 1.4 times as far off as the best weight has them. */
  std::size_t look_samples = 20;
  /** Samples in the fits that tell what is left of the noise: they reach as far as
   * those of isopoints, 40 by cubics. */
  std::size_t share_samples = 30;
  /** A share of the noise that is added to tell how much of the noise is left: small,
   * so that the flow answers it linearly. */
  double probe_part = 0.1;
  /** Mean square deviations are expected to be no smaller, over that of the noise: it
   * is known no better, and where it is told too large they fell below 0 while sheets
   * and cylinders went. */
  double least_risk = 0.005;
  /** Variances of the noise that two weights tell count as the same when they differ by
   * less, as a share: two spheres 4 apart, whose noise was told 1.2 times too large,
   * tell 0.84 to 0.83 of it from mu 0.34 on, sheets 4 thick 0.93, 0.92, 0.88 and so on.
   * With 0.03 sheets go. */
  double same_variance = 0.005;
  /** The share of the expected mean square deviation: smoothing has to take away the
   * rest. These fits leave more noise than isopoints have, so that with 0.78 waves 6
   * long with noise of 0.1 were smoothed and got worse by 8 %; with 0.7 one of two
   * sheets 4 thick with noise of 0.3 was left as it was. */
  double worthwhile = 0.75;
  /** Samples next to the surface that tell what a given weight leaves of the noise. */
  std::size_t patch_samples = 1024;
  /** Noise that nobody sees: fits of isopoints leave less. */
  double invisible_noise = 0.005;

  // Time integration (evolver.cpp)

  /** A share of the step that the stencil's weights allow: 1.3 diverges. */
  double safety = 0.9;
  /** The data pull no more than from that far away. It bounds the speed of a surface
   * that is not where it belongs yet, and the pull of outliers. */
  double most_pull = 1.0;
  /** Steps are so many times shorter where the surface travels at that speed: central
   * differences let its waves grow by as little. */
  double travel_factor = 6.0;
  /** Slopes count as no greater for the pull of the data: where samples lie nearly on a
   * line or a plane, they are anything. */
  double steepest = 1.5;
  /** Samples that lie farther apart are not smoothed over more. */
  double longest_spacing = 2.0;
  /** Samples with shorter steps than that part of most others' take steps that are too
   * long for them, of a flow that is as much weaker: they end at the same, and later.
   */
  double shortest_step = 1.0 / 64.0;
  /** The share of the samples whose steps are the longest. */
  double long_steps = 0.1;
  /** Mean slopes count as no smaller: where the function is flat, its curvature is
   * anything. */
  float least_mean_slope = 0.1f;
  /** Steps until the mean curvature, which changes slowly, is taken anew. */
  std::size_t reference_steps = 4;
  /** The weight of the term that keeps the slope at 1 (thesis 3.4), against the
   * others' 1. */
  double diffusion_weight = 0.5;

  // What is told of the result (deviation.cpp)

  /** Share of the noise: where less was taken away, residuals do not tell how much
   * there is. */
  double least_residual = 0.2;

  // The band and its function (level_set_run.cpp)

  /** The zero level keeps that far from the border of the band, and how many steps
   * until it is looked whether it does: it moves by less between. */
  double band_margin = 2.0;
  std::size_t band_steps = 5;
  /** Mean of | |grad phi| - 1 | that asks for a reinitialisation, beyond that of the
   * data term, and steps between two: a function that starts noisy is smoothed before.
   */
  double most_slope_error = 0.3;
  std::size_t reinitialization_steps = 10;
  /** What of it phi may have in the end: smoothed noise leaves 0.05 to 0.1. */
  double final_slope_error = 0.15;
  /** So far from the surface, where fits of isopoints reach, it is left as it is, and
   * over one spacing more it becomes the distance to isopoints: of the density of a
   * star it was 1.4 off where that is 3. With 1.5 estimated errors grew by a third. */
  double kept_distance = 2.5;
  /** Values beyond so many times the extent of the samples are a divergence. */
  double most_extents = 100.0;
  /** Samples that lie farther from the surface than that, and than so many times the
   * noise, and change their side all the same were part of a feature: noise does it to
   * one sample in 30,000. */
  double feature_noise = 4.0, feature_length = 0.5;
  /** The share of the samples next to the surface that has to be lost for a warning. */
  double lost_share = 0.01;

  // Reinitialisation (reinitialization.cpp)

  /** Nearer isopoints stand for the paraboloid through them. */
  double planar_distance = 1.5;
  /** Part of the step that the viscosity allows, its viscosity, and the time until what
   * starts at the zero level has crossed a stencil. */
  double relaxation_safety = 0.5, viscosity = 0.3, relaxation_time = 6.0;
  /** Slopes count as no greater than so many times those to the neighbours on one side:
   * 2 where these are symmetric. */
  float most_upwind = 3.0f;
};

constexpr LevelSetConstants level_set;

} // namespace pcl_uvol
