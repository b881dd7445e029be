// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/evolver.h"

#include "common/parallel.h"
#include "levelset/constants.h"
#include "levelset/parallel_kernels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t evolver_block = 16384;

/** The rate of the longest steps with which steps of powers of two below take the least
 * work in all.
 * \param rates ascending */
double
leastWork(const std::vector<double>& rates)
{
  constexpr std::size_t candidates = 64;
  double best = rates.back(), best_work = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i <= candidates; ++i) {
    const double slowest = rates[i * (rates.size() - 1) / candidates];
    double work = 0.0;
    for (const double rate : rates)
      work += slowest * std::exp2(std::ceil(std::log2(std::max(1.0, rate / slowest))));
    if (work < best_work) {
      best_work = work;
      best = slowest;
    }
  }
  return best;
}

} // namespace

Evolver::Evolver(const Band& band,
                 const LevelSetParameters& parameters,
                 unsigned threads,
                 double spacing,
                 double mu,
                 std::vector<float> phi,
                 const DataTerm& term)
    : band_(band)
    , term_(term)
    , parameters_(parameters)
    , threads_(threads)
    , spacing_(spacing)
    , mu_(mu)
    , kernels_(*evolution_kernel_table.get())
    , centers_(band.centerPlaces())
    , phi_(std::move(phi))
    , rate_(phi_.size(), 0.0f)
    , start_(centers_)
    , next_(centers_)
    , curvature_(centers_)
    , slope_(centers_)
    , sq_length_(centers_, static_cast<float>(spacing * spacing))
    , sums_{std::vector<float>(centers_), std::vector<float>(centers_)}
{
  if (parameters.scheme == FitScheme::Linear)
    for (auto& coordinate : normals_)
      coordinate.resize(centers_);
  if (parameters.flow == CurvatureFlow::Relative) {
    reference_.resize(centers_);
    const double neighbors = static_cast<double>(band.stencils.view().neighbors);
    for (std::size_t i = 0; i < band.centers.size(); ++i)
      // A stencil without curvature has no part in what its neighbours' is.
      sq_length_[i] =
          parameters.scheme == FitScheme::Quadratic &&
                  band.stencils.getStiffness()[i] == 0.0f
              ? 0.0f
              : static_cast<float>(
                    std::pow(std::min(spacingOf(band.stencils.getReach()[i], neighbors),
                                      level_set.longest_spacing * spacing),
                             2));
  }
  chooseSteps();
}

template <typename Visit>
void
Evolver::forCenters(const Visit& visit) const
{
  parallelBlocks(centers_, evolver_block, threads_, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      visit(i);
  });
}

void
Evolver::chooseSteps()
{
  // The reciprocal of the step that each sample allows; lengths in spacings.
  const std::size_t groups = band_.stencils.groups();
  std::vector<double> rate(groups, 0.0);
  for (std::size_t i = 0; i < band_.centers.size(); ++i) {
    const double nearest = band_.stencils.getNearest()[i] / spacing_;
    const bool is_linear = parameters_.scheme == FitScheme::Linear;
    // A plane has no second derivatives whose weights would tell.
    const double gap = std::abs(term_.target[i] - phi_[i]) / spacing_;
    const double attraction =
        parameters_.bound == StepBound::Cfl
            // The thesis's condition forgets that the pull fades on the way.
            ? std::max(1.0, std::sqrt(3.0) * gap / nearest)
            : level_set.steepest *
                  (1.0 + level_set.travel_factor * std::min(1.0, gap * gap));
    const double smoothing =
        parameters_.bound == StepBound::Cfl
            ? 6.0 / (nearest * nearest)
            : sq_length_[i] * (is_linear
                                   ? 26.0 / std::pow(band_.stencils.getReach()[i], 2)
                                   : band_.stencils.getStiffness()[i]);
    const double diffusion = parameters_.reinitialization == Reinitialization::Diffusion
                                 ? level_set.diffusion_weight
                                 : 0.0;
    rate[i / stencil_lanes] =
        std::max(rate[i / stencil_lanes],
                 mu_ * attraction + (1.0 - mu_ + 2.0 * diffusion) * smoothing);
  }
  weakness_.assign(groups, 1.0f);
  class_of_.assign(groups, 0);
  std::vector<double> sorted = rate;
  std::sort(sorted.begin(), sorted.end());
  double slowest = sorted.back();
  if (parameters_.integration == Integration::Asynchronous) {
    const double most = sorted[static_cast<std::size_t>(
                            level_set.long_steps * static_cast<double>(groups - 1))] /
                        level_set.shortest_step;
    for (double& one : sorted)
      one = std::min(one, most);
    slowest = leastWork(sorted);
    for (std::size_t group = 0; group < groups; ++group) {
      weakness_[group] = static_cast<float>(std::min(1.0, most / rate[group]));
      while (weakness_[group] * rate[group] > slowest * std::exp2(class_of_[group]))
        ++class_of_[group];
    }
  }
  step_ = level_set.safety / slowest;
  const std::size_t count = *std::max_element(class_of_.begin(), class_of_.end()) + 1u;
  classes_.resize(count);
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t c = 0; c <= class_of_[group]; ++c)
      classes_[c].groups.push_back(static_cast<std::uint32_t>(group));
    updates_ += std::min(stencil_lanes, band_.centers.size() - group * stencil_lanes)
                << class_of_[group];
  }
}

double
Evolver::periodOf(std::size_t group) const
{
  return std::exp2(-static_cast<double>(class_of_[group]));
}

void
Evolver::evaluate(const std::vector<std::uint32_t>& groups,
                  float time,
                  double step_scale)
{
  const bool is_linear = parameters_.scheme == FitScheme::Linear;
  const StencilView stencils = band_.stencils.view();
  const TimeLines lines{phi_.data(), rate_.data(), time};
  if (is_linear) {
    // Neighbours' normals at this time, whatever their class.
    const NormalStep step{stencils,
                          lines,
                          {normals_[0].data(), normals_[1].data(), normals_[2].data()},
                          slope_.data()};
    parallelBlocks(
        band_.stencils.groups(), block_groups, threads_, [&](auto begin, auto end) {
          kernels_.findNormals(step, begin, end);
        });
  }
  const float* const normals[3] = {
      normals_[0].data(), normals_[1].data(), normals_[2].data()};
  const double to_distance = parameters_.reinitialization == Reinitialization::Diffusion
                                 ? level_set.diffusion_weight
                                 : 0.0;
  parallelBlocks(groups.size(), block_groups, threads_, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double dt = step_scale * step_ * periodOf(groups[i]) * weakness_[groups[i]];
      const EvolutionStep step{stencils,
                               lines,
                               term_.target.data(),
                               term_.trust.data(),
                               reference_.empty() ? nullptr : reference_.data(),
                               sq_length_.data(),
                               static_cast<float>(level_set.most_pull * spacing_),
                               static_cast<float>(level_set.steepest),
                               static_cast<float>(mu_ * dt),
                               static_cast<float>((1.0 - mu_) * dt),
                               static_cast<float>(to_distance * dt),
                               next_.data(),
                               curvature_.data(),
                               slope_.data()};
      if (is_linear)
        kernels_.evolveByNormals(
            step, normals, band_.centers.size(), groups[i], groups[i] + 1);
      else
        kernels_.evolve(step, groups[i], groups[i] + 1);
    }
  });
}

void
Evolver::commit(const std::vector<std::uint32_t>& groups, float time)
{
  parallelBlocks(groups.size(), block_groups, threads_, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto per_period = static_cast<float>(1.0 / periodOf(groups[i]));
      const std::size_t first = groups[i] * stencil_lanes;
      for (std::size_t j = first; j < first + stencil_lanes; ++j) {
        const float now = phi_[j] + rate_[j] * time;
        rate_[j] = (next_[j] - now) * per_period;
        phi_[j] = now - rate_[j] * time;
      }
    }
  });
}

void
Evolver::updateReference()
{
  if (reference_.empty() || steps_ % level_set.reference_steps != 0)
    return;
  if (steps_ == 0)
    evaluate(classes_.front().groups, 0.0f, 0.0);
  // Curvature times slope is compared: where the function is flat, its curvature is
  // anything.
  averageTwice(curvature_, slope_, level_set.least_mean_slope, reference_);
}

void
Evolver::averageTwice(const std::vector<float>& values,
                      const std::vector<float>& weights,
                      float least_weight,
                      std::vector<float>& means)
{
  const auto average = [&](const AverageStep& step) {
    parallelBlocks(band_.stencils.groups(),
                   block_groups,
                   threads_,
                   [&](auto begin, auto end) { kernels_.average(step, begin, end); });
  };
  const StencilView stencils = band_.stencils.view();
  const std::size_t centers = band_.centers.size();
  average({stencils,
           centers,
           2,
           {values.data(), weights.data()},
           {sums_[0].data(), sums_[1].data()}});
  forCenters(
      [&](std::size_t i) { sums_[0][i] /= std::max(sums_[1][i], least_weight); });
  average({stencils, centers, 1, {sums_[0].data()}, {means.data()}});
}

void
Evolver::advanceByClasses(ProgressReminder* reminder)
{
  forCenters([&](std::size_t i) { start_[i] = phi_[i]; });
  const std::size_t ticks = std::size_t{1} << (classes_.size() - 1);
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    // At every second tick the finest class alone, at every fourth the next one too...
    std::size_t coarsest = 0;
    while (tick % (ticks >> coarsest) != 0)
      ++coarsest;
    const auto& groups = classes_[coarsest].groups;
    const auto time = static_cast<float>(tick) / static_cast<float>(ticks);
    evaluate(groups, time, 1.0);
    commit(groups, time);
    if (reminder)
      reminder->remind();
  }
  forCenters([&](std::size_t i) {
    phi_[i] += rate_[i];
    rate_[i] = 0.0f;
  });
}

LevelSetStep
Evolver::advance(ProgressReminder* reminder)
{
  updateReference();
  if (parameters_.reinitialization == Reinitialization::Diffusion)
    band_.extrapolate(phi_);
  if (classes_.size() == 1) {
    evaluate(classes_.front().groups, 0.0f, 1.0);
    forCenters([&](std::size_t i) {
      start_[i] = phi_[i];
      phi_[i] = next_[i];
    });
  }
  else
    advanceByClasses(reminder);
  ++steps_;
  return summarize();
}

void
Evolver::setPhi(const std::vector<float>& phi)
{
  phi_ = phi;
  steps_ = 0;
}

bool
Evolver::isBounded(double largest) const
{
  std::atomic<bool> bounded{true};
  parallelBlocks(centers_, evolver_block, threads_, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      if (!(std::abs(phi_[i]) <= largest))
        bounded = false;
  });
  return bounded;
}

LevelSetStep
Evolver::summarize() const
{
  struct Sums {
    double sq_change = 0.0, slope_error = 0.0, energy = 0.0,
           min_slope = std::numeric_limits<double>::infinity(), max_slope = 0.0;
    std::size_t near = 0;
  };
  const auto add = [&](std::size_t i, Sums& sums) {
    const double slope = slope_[i];
    const double change =
        (static_cast<double>(phi_[i]) - start_[i]) / spacing_ / std::max(slope, 0.1);
    const double pull = (static_cast<double>(term_.target[i]) - phi_[i]) / spacing_;
    sums.sq_change += change * change;
    sums.slope_error += std::abs(slope - 1.0);
    sums.energy += 0.5 * mu_ * pull * pull + (1.0 - mu_) * slope;
    sums.min_slope = std::min(sums.min_slope, slope);
    sums.max_slope = std::max(sums.max_slope, slope);
    ++sums.near;
  };
  // Block by block, in one order for any number of threads.
  const auto parts =
      parallelGather<Sums>(band_.centers.size(),
                           evolver_block,
                           threads_,
                           [&](auto begin, auto end, auto& found) {
                             Sums sums;
                             for (std::size_t i = begin; i < end; ++i)
                               // Not a number counts as near.
                               if (!(std::abs(phi_[i]) > spacing_ * slope_[i]))
                                 add(i, sums);
                             found.push_back(sums);
                           });
  LevelSetStep step{};
  step.min_slope = std::numeric_limits<double>::infinity();
  std::size_t near = 0;
  for (const Sums& part : parts) {
    step.change += part.sq_change;
    step.slope_error += part.slope_error;
    step.energy += part.energy;
    step.min_slope = std::min(step.min_slope, part.min_slope);
    step.max_slope = std::max(step.max_slope, part.max_slope);
    near += part.near;
  }
  if (near == 0)
    return step;
  const auto count = static_cast<double>(near);
  step.change = std::sqrt(step.change / count) / step_;
  step.slope_error /= count;
  step.energy /= count;
  return step;
}

} // namespace pcl_uvol
