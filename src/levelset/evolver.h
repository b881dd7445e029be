// SPDX-License-Identifier: BSD-3-Clause
// Time integration of the level-set equation on a band (thesis 3.5).
#pragma once

#include "common/progress_reminder.h"
#include "levelset/band.h"
#include "levelset/data_term.h"
#include "levelset/evolution_kernel.h"
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The level-set function on a band, and how it is advanced.
 *
 * Groups of samples take steps of their own, each half as long as those of the class
 * before it (thesis 3.5.2, with steps rounded down to powers of two, so that a class
 * advances in parallel and in a fixed order). With synchronous integration all are in
 * one class. */
class Evolver {
public:
  /** \param band, term must outlive the evolver
   * \param spacing the unit of length
   * \param mu in [0, 1]
   * \param phi by place */
  Evolver(const Band& band,
          const LevelSetParameters& parameters,
          unsigned threads,
          double spacing,
          double mu,
          std::vector<float> phi,
          const DataTerm& term);

  /** \brief The longest step of all classes, in squared spacings. */
  double
  getStep() const
  {
    return step_;
  }

  /** \brief Times that a sample is advanced in such a step, in all. */
  std::size_t
  getUpdates() const
  {
    return updates_;
  }

  /** \brief Advance all samples by getStep(). Returns what changed; time and
   * reinitialized are the caller's.
   * \param reminder of the step that this is a part of; null: there is none */
  LevelSetStep
  advance(ProgressReminder* reminder = nullptr);

  /** \brief phi by place. */
  const std::vector<float>&
  getPhi() const
  {
    return phi_;
  }

  /** \brief Whether all values at the centres are numbers up to that. */
  bool
  isBounded(double largest) const;

  /** \brief Replace all values. */
  void
  setPhi(const std::vector<float>& phi);

private:
  /** Groups that are advanced at the same ticks. */
  struct Class {
    std::vector<std::uint32_t> groups; ///< ascending, of this class and all finer ones
  };

  void
  chooseSteps();

  void
  updateReference();

  void
  advanceByClasses(ProgressReminder* reminder);

  /** Weighted means over the neighbours of the neighbours: about three spacings. More
   * would flatten what lies a few spacings from something else.
   * \param values already times their weights
   * \param least_weight mean weights count as no smaller */
  void
  averageTwice(const std::vector<float>& values,
               const std::vector<float>& weights,
               float least_weight,
               std::vector<float>& means);

  /** Call visit(place) for all places of centres, in parallel. */
  template <typename Visit>
  void
  forCenters(const Visit& visit) const;

  /** Curvature and slope at a time, and phi after the steps of the classes. */
  void
  evaluate(const std::vector<std::uint32_t>& groups, float time, double step_scale);

  void
  commit(const std::vector<std::uint32_t>& groups, float time);

  double
  periodOf(std::size_t group) const;

  LevelSetStep
  summarize() const;

  const Band& band_;
  const DataTerm& term_;
  const LevelSetParameters& parameters_;
  unsigned threads_;
  double spacing_, mu_, step_ = 0.0;
  const EvolutionKernels& kernels_;
  std::size_t centers_; ///< places of centres
  std::vector<float> phi_, rate_;
  std::vector<float> start_, next_, curvature_, slope_, sq_length_, reference_;
  std::vector<float> sums_[2]; ///< weighted values and weights
  std::vector<float> normals_[3];
  std::vector<std::uint8_t> class_of_; ///< by group
  std::vector<float> weakness_; ///< by group: part of the flow, see shortest_step
  std::vector<Class> classes_;  ///< longest steps first
  std::size_t steps_ = 0, updates_ = 0;
};

} // namespace pcl_uvol
