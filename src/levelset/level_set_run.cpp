// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/number_range.h"
#include "levelset/band.h"
#include "levelset/constants.h"
#include "levelset/data_term.h"
#include "levelset/deviation.h"
#include "levelset/evolver.h"
#include "levelset/level_set_input.h"
#include "levelset/memory_need.h"
#include "levelset/mu_choice.h"
#include "levelset/reinitialization.h"
#include "levelset/robust_values.h"
#include "levelset/surface_examination.h"
#include "levelset/value_ties.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace pcl_uvol {

namespace {

/** Parts of a whole run that its progress counts. */
constexpr std::uint64_t progress_parts = 1000;

/** Beyond it a function of some samples has diverged. */
double
findLargestPhi(const SampleSet& samples)
{
  Position low = samples.getPositions()[0], high = low;
  for (const Position& x : samples.getPositions())
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], x[axis]);
      high[axis] = std::max(high[axis], x[axis]);
    }
  return level_set.most_extents *
         std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

/** What helps against divergence, of the parameters that are not the stable ones. */
std::string
adviseStability(const LevelSetParameters& parameters)
{
  if (parameters.scheme == FitScheme::Linear)
    return "use the quadratic scheme";
  if (parameters.bound == StepBound::Cfl)
    return "bound the steps by the stencils";
  if (parameters.reinitialization == Reinitialization::Diffusion)
    return "reinitialise by distance";
  if (parameters.initial.kind != InitialKind::Values)
    return "start from the values";
  return "give a larger mu, or extract the isosurface without smoothing";
}

/** One run, from the samples to phi. */
class LevelSetRun {
public:
  LevelSetRun(const CloudView& cloud,
              LevelSetInput&& input,
              const LevelSetParameters& parameters,
              std::size_t snapshot_steps,
              const SnapshotCallback& snapshot,
              unsigned threads,
              Report& report)
      : parameters_(parameters)
      , snapshot_steps_(snapshot_steps)
      , snapshot_(snapshot)
      , threads_(threads)
      , report_(report)
      , cloud_size_(cloud.count)
      , input_(std::move(input))
      , samples_(*input_.samples)
      , spacing_(input_.spacing)
      , largest_phi_(findLargestPhi(samples_))
  {
    summary_.spacing = samples_.getUnit().toInput(spacing_);
    summary_.logarithmic = input_.is_logarithmic;
    start(readInitialValues(cloud, input_, parameters));
  }

  LevelSet
  run()
  {
    {
      StepTimer timer(report_, "evolution", progress_parts);
      ProgressReminder reminder(report_.progress, "evolution");
      std::uint64_t reported = 0;
      for (std::size_t i = 0; i < parameters_.max_steps && !summary_.converged; ++i) {
        advance(reminder);
        const std::uint64_t done = std::max(reported, partsDone());
        timer.advance(done - reported);
        reported = done;
        reminder.setDone(static_cast<double>(reported) / progress_parts);
        if (snapshot_steps_ > 0 && summary_.steps.size() % snapshot_steps_ == 0)
          snapshot_(summary_, expandToCloud(current()));
      }
      timer.advance(progress_parts - reported);
    }
    finish();
    report_.count("steps", summary_.steps.size());
    report_.count("band_samples", band_->centers.size());
    LevelSet level_set{expandToCloud(phi_), computeDeviations(), {}, summary_, {}, {}};
    level_set.sources = std::move(input_.sources);
    return level_set;
  }

private:
  /** Gives phi by input index, in the input's unit of length: in stretched spaces that
   * is more than a float can be, where the sign is what counts.
   * \param phi by sample */
  std::vector<float>
  expandToCloud(std::vector<float> values) const
  {
    constexpr double largest = std::numeric_limits<float>::max();
    for (float& value : values)
      value = static_cast<float>(
          std::clamp(samples_.getUnit().toInput(value), -largest, largest));
    std::vector<float> phi(cloud_size_, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < samples_.size(); ++i)
      phi[samples_.getInputIndex(i)] = values[i];
    for (const SampleSet::Merged& merged : samples_.getMerged())
      for (const std::uint32_t member : merged.members)
        phi[member] = values[merged.sample];
    return phi;
  }

  std::vector<float>
  computeDeviations() const
  {
    std::vector<float> deviations(samples_.size(),
                                  std::numeric_limits<float>::quiet_NaN());
    const std::vector<float> of_band =
        findDeviations(*band_, gatherPhi(), term_, shares_, threads_);
    for (std::size_t i = 0; i < of_band.size(); ++i)
      deviations[band_->centers[i]] = of_band[i];
    return expandToCloud(std::move(deviations));
  }

  /** The band, its data term, the weights and the values it starts with. */
  void
  start(std::vector<float>&& initial)
  {
    const bool has_own_start = !initial.empty();
    if (!has_own_start || !parameters_.mu)
      makeBand(input_.crossing);
    chooseStages(has_own_start);
    if (has_own_start) {
      phi_ = std::move(initial);
      const auto crossing = findCrossing(samples_, phi_, threads_);
      if (crossing.empty())
        throw InvalidArgument("start_without_zero_level", {});
      makeBand(crossing);
      if (parameters_.mu)
        summary_.noise = term_.noise / spacing_;
      makeDistance(level_set.most_slope_error, [&] { return makeDistanceOfBand(); });
    }
    else {
      // Far from the surface the sign is all that counts.
      phi_ = input_.f;
      for (float& value : phi_)
        value = static_cast<float>(value / term_.slope);
      if (!stages_.empty())
        band_->forPlaces([&](std::size_t place, std::uint32_t sample) {
          phi_[sample] = term_.target[place];
        });
    }
    makeEvolver();
  }

  /** \param has_own_start it starts somewhere else: there is no way from the data */
  void
  chooseStages(bool has_own_start)
  {
    constexpr double ever = std::numeric_limits<double>::infinity();
    if (parameters_.mu) {
      if (!has_own_start)
        summary_.noise = term_.noise / spacing_;
      stages_ = {{*parameters_.mu, ever}};
    }
    else {
      summary_.noise = term_.noise / spacing_;
      MuChoice choice =
          chooseMu(*band_, samples_, term_, parameters_, spacing_, threads_, report_);
      stages_ = std::move(choice.stages);
      shares_ = choice.shares;
      if (stages_.empty())
        warnOfTies();
      if (has_own_start)
        stages_ = {{stages_.empty() ? 1.0 : stages_.back().mu, ever}};
    }
    summary_.smoothed = !stages_.empty() || input_.had_spikes;
    summary_.converged = stages_.empty();
    summary_.mu = stages_.empty() ? 1.0 : stages_.front().mu;
  }

  std::string
  describeIsovalue() const
  {
    return describeNumbers({parameters_.isovalue})[0];
  }

  /** Values that are alike told an automatic mu nothing. */
  void
  warnOfTies()
  {
    const double share = shareOfCommonest(input_.f, crossing_);
    if (share > level_set.most_ties)
      report_.warn("tied_values",
                   {{"isovalue", describeIsovalue()}, {"percent", 100.0 * share}});
  }

  bool
  isLastStage() const
  {
    return stage_ + 1 == stages_.size();
  }

  /** Whether a weight acts until the surface rests. */
  bool
  isOpenStage() const
  {
    return std::isinf(stages_[stage_].time);
  }

  void
  makeBand(const std::vector<std::uint32_t>& crossing)
  {
    // A band takes what the one before leaves.
    const auto need = [&](const std::vector<std::uint32_t>& around) {
      return bandBytes(static_cast<double>(samples_.size()),
                       static_cast<double>(around.size()),
                       parameters_);
    };
    checkMemoryOf("A level set", samples_.size(), need(crossing) - need(crossing_));
    evolver_.reset();
    band_.reset(); // before the new one takes as much again
    relaxation_band_.reset();
    band_ = makeBandOf(parameters_.scheme, crossing, report_);
    crossing_ = crossing;
    term_ = makeDataTerm(*band_, samples_, input_.f, threads_, report_);
    if (!(term_.slope > 0.0))
      throw InvalidArgument("no_slope_at_isovalue", {{"isovalue", describeIsovalue()}});
  }

  Band
  makeBandOf(FitScheme scheme,
             const std::vector<std::uint32_t>& crossing,
             Report& report) const
  {
    return pcl_uvol::makeBand(samples_,
                              crossing,
                              parameters_.band_width * spacing_,
                              scheme,
                              parameters_.k,
                              threads_,
                              report);
  }

  /** The function by place of the band. */
  std::vector<float>
  gatherPhi() const
  {
    std::vector<float> phi(band_->places(), 0.0f);
    band_->forPlaces(
        [&](std::size_t place, std::uint32_t sample) { phi[place] = phi_[sample]; });
    return phi;
  }

  void
  makeEvolver()
  {
    evolver_.emplace(
        *band_, parameters_, threads_, spacing_, summary_.mu, gatherPhi(), term_);
  }

  void
  advance(ProgressReminder& reminder)
  {
    LevelSetStep step = evolver_->advance(&reminder);
    report_.count("updates", evolver_->getUpdates());
    const double before = summary_.steps.empty() ? 0.0 : summary_.steps.back().time;
    step.time = before + evolver_->getStep();
    checkDivergence(step);
    summary_.steps.push_back(step);
    stage_time_ += evolver_->getStep();
    const bool is_over = isOpenStage() ? step.change < parameters_.tolerance
                                       : stage_time_ >= stages_[stage_].time;
    summary_.converged = is_over && isLastStage();
    if (summary_.converged)
      return;
    if (is_over)
      startNextStage();
    const std::size_t count = summary_.steps.size();
    if (count % level_set.reinitialization_steps == 0 && isOpenStage() &&
        step.slope_error > level_set.most_slope_error + term_.slope_error)
      reinitializeUnlessUndone();
    if (!band_->distance.empty() && count % level_set.band_steps == 0)
      followZeroLevel();
  }

  void
  startNextStage()
  {
    ++stage_;
    stage_time_ = 0.0;
    summary_.mu = stages_[stage_].mu;
    phi_ = current();
    makeEvolver();
  }

  /** How far the run is: changes fall about exponentially. */
  std::uint64_t
  partsDone() const
  {
    const auto& steps = summary_.steps;
    const double by_steps =
        static_cast<double>(steps.size()) / static_cast<double>(parameters_.max_steps);
    const double to_go = std::log(steps.back().change / parameters_.tolerance),
                 all = std::log(steps.front().change / parameters_.tolerance);
    const double by_change = all > 0.0 ? 1.0 - to_go / all : 0.0;
    return static_cast<std::uint64_t>(
        progress_parts * std::clamp(std::max(by_steps, by_change), 0.0, 1.0));
  }

  void
  checkDivergence(const LevelSetStep& step) const
  {
    if (evolver_->isBounded(largest_phi_) && std::isfinite(step.change))
      return;
    throw Diverged("level_set_diverged",
                   {{"step", summary_.steps.size() + 1},
                    {"advice", adviseStability(parameters_)}});
  }

  /** Where the data bring their own slope back at once, distances and data would undo
   * each other for ever. */
  void
  reinitializeUnlessUndone()
  {
    const std::size_t count = summary_.steps.size();
    if (summary_.mu > 0.0 && last_reinitialization_ > 0 &&
        count - last_reinitialization_ <= level_set.reinitialization_steps)
      is_undone_ = true;
    if (is_undone_ || parameters_.reinitialization == Reinitialization::None ||
        parameters_.reinitialization == Reinitialization::Diffusion)
      return;
    phi_ = current();
    evolver_->setPhi(makeDistanceOfBand());
    summary_.steps.back().reinitialized = true;
    last_reinitialization_ = count;
  }

  /** The distance to the zero level, by place, that phi becomes. */
  std::vector<float>
  makeDistanceOfBand()
  {
    report_.count("reinitializations", 1);
    return measureDistance();
  }

  std::vector<float>
  measureDistance()
  {
    if (parameters_.reinitialization != Reinitialization::Eikonal)
      return distanceToZeroLevel(*band_, samples_, phi_, spacing_, threads_, report_);
    if (parameters_.scheme == FitScheme::Quadratic)
      return relaxToDistance(*band_, gatherPhi(), spacing_, threads_);
    // Its viscosity needs second derivatives, of the same samples at the same places.
    if (!relaxation_band_) {
      Report ignored;
      relaxation_band_ = makeBandOf(FitScheme::Quadratic, crossing_, ignored);
    }
    return relaxToDistance(*relaxation_band_, gatherPhi(), spacing_, threads_);
  }

  /** Where the slope of phi_ is off by more, take another function with its zero level.
   * \param make_distance by place */
  template <typename MakeDistance>
  void
  makeDistance(double most_slope_error, const MakeDistance& make_distance)
  {
    if (parameters_.reinitialization == Reinitialization::None ||
        measureSlopeError(*band_, gatherPhi(), threads_) <= most_slope_error)
      return;
    setInBand(make_distance());
  }

  /** A new band where the zero level has come near the border of the old one: a sample
   * there has changed its side. */
  void
  followZeroLevel()
  {
    const double border = (parameters_.band_width - level_set.band_margin) * spacing_;
    const std::vector<float>& phi = evolver_->getPhi();
    bool is_near = false;
    for (std::size_t i = 0; i < band_->centers.size() && !is_near; ++i)
      is_near = band_->distance[i] > border &&
                (phi[i] < 0.0f) != (phi_[band_->centers[i]] < 0.0f);
    if (!is_near)
      return;
    phi_ = current();
    const std::vector<std::uint32_t> crossing = findCrossing(samples_, phi_, threads_);
    if (crossing.empty())
      return;
    const std::vector<std::uint32_t> old = std::move(band_->centers);
    makeBand(crossing);
    // What has not been advanced yet is no farther away than the crossing samples.
    for (std::size_t i = 0; i < band_->centers.size(); ++i) {
      const std::uint32_t sample = band_->centers[i];
      if (!std::binary_search(old.begin(), old.end(), sample))
        phi_[sample] = std::copysign(
            std::min(std::abs(phi_[sample]), band_->distance[i]), phi_[sample]);
    }
    makeEvolver();
    report_.count("band_updates", 1);
  }

  /** Gives numbers by sample. */
  std::vector<float>
  current() const
  {
    std::vector<float> values = phi_;
    for (std::size_t i = 0; i < band_->centers.size(); ++i)
      values[band_->centers[i]] = evolver_->getPhi()[i];
    return values;
  }

  /** What is left to do and to say after the last step. */
  void
  finish()
  {
    phi_ = current();
    evolver_.reset(); // before others take as much
    if (parameters_.mu)
      shares_ = measureSharesOfPatch();
    if (parameters_.initial.kind == InitialKind::Values && !stages_.empty())
      reportLostFeatures();
    if (findCrossing(samples_, phi_, threads_).empty()) {
      summary_.converged = false;
      report_.warn(
          "vanished",
          {{"field", parameters_.field},
           {"isovalue", describeIsovalue()},
           {"starts_from_values", parameters_.initial.kind == InitialKind::Values}});
      return;
    }
    if (!summary_.converged)
      report_.warn("not_converged",
                   {{"isovalue", describeIsovalue()},
                    {"steps", summary_.steps.size()},
                    {"change", summary_.steps.back().change},
                    {"is_last_stage", isLastStage()},
                    {"mu", summary_.mu},
                    {"chosen_mu", stages_.back().mu}});
    if (!summary_.smoothed) // the surface is that of the field itself, whatever phi is
      makeDistance(level_set.final_slope_error, [&] { return makeDistanceOfBand(); });
    if (stages_.empty())
      return;
    // Isopoints would move the surface by what fits of them leave.
    makeDistance(level_set.final_slope_error,
                 [&] { return scaleToDistance(*band_, gatherPhi(), threads_); });
    if (parameters_.reinitialization != Reinitialization::None)
      makeDistanceAwayFromSurface();
  }

  /** Slopes at the surface are not those farther out, where no isopoint's fit reaches.
   */
  void
  makeDistanceAwayFromSurface()
  {
    std::vector<float> phi = gatherPhi();
    const std::vector<float> distance = measureDistance();
    for (std::size_t place = 0; place < phi.size(); ++place) {
      const double length = std::abs(distance[place]) / spacing_;
      const auto part =
          static_cast<float>(std::clamp(length - level_set.kept_distance, 0.0, 1.0));
      phi[place] += part * (distance[place] - phi[place]);
    }
    setInBand(phi);
  }

  /** \param phi by place */
  void
  setInBand(const std::vector<float>& phi)
  {
    band_->forPlaces(
        [&](std::size_t place, std::uint32_t sample) { phi_[sample] = phi[place]; });
  }

  /** What the weight that was given leaves of the noise, where some of the samples next
   * to the surface are: consecutive ones, which lie side by side. */
  NoiseShares
  measureSharesOfPatch()
  {
    const std::size_t count = std::min(level_set.patch_samples, crossing_.size());
    const auto first =
        crossing_.begin() + static_cast<std::ptrdiff_t>((crossing_.size() - count) / 2);
    Report ignored;
    const Band patch = makeBandOf(parameters_.scheme,
                                  {first, first + static_cast<std::ptrdiff_t>(count)},
                                  ignored);
    return measureShares(patch,
                         samples_,
                         makeDataTerm(patch, samples_, input_.f, threads_, ignored),
                         parameters_,
                         spacing_,
                         summary_.mu,
                         threads_,
                         ignored);
  }

  /** Samples that the data put clearly on one side, and that are on the other one. */
  void
  reportLostFeatures()
  {
    const double least = std::max(level_set.feature_length * spacing_,
                                  level_set.feature_noise * term_.noise);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < band_->centers.size(); ++i)
      lost += std::abs(term_.target[i]) > least &&
              (term_.target[i] < 0.0f) != (phi_[band_->centers[i]] < 0.0f);
    report_.count("lost_samples", lost);
    if (static_cast<double>(lost) >=
        level_set.lost_share * static_cast<double>(input_.crossing.size()))
      report_.warn(
          "lost_features",
          {{"lost", lost}, {"isovalue", describeIsovalue()}, {"mu", summary_.mu}});
  }

  const LevelSetParameters& parameters_;
  std::size_t snapshot_steps_;
  const SnapshotCallback& snapshot_;
  unsigned threads_;
  LevelSetSummary summary_;
  Report& report_;
  std::size_t cloud_size_;
  LevelSetInput input_;
  const SampleSet& samples_;
  double spacing_; ///< in the samples' unit, as all that follows
  double largest_phi_;
  std::vector<float> phi_; ///< by sample; in the band as it was when that was made
  std::vector<std::uint32_t> crossing_; ///< that the band was made around
  std::optional<Band> band_, relaxation_band_;
  DataTerm term_;
  NoiseShares shares_;
  std::vector<MuStage> stages_;
  std::size_t stage_ = 0;
  double stage_time_ = 0.0;
  std::size_t last_reinitialization_ = 0; ///< step
  bool is_undone_ = false;
  std::optional<Evolver> evolver_;
};

} // namespace

LevelSet
detail::evolveLevelSet(const CloudView& cloud,
                       const pcl::Indices& indices,
                       const LevelSetParameters& parameters,
                       std::size_t snapshot_steps,
                       const SnapshotCallback& snapshot,
                       bool is_examined,
                       unsigned threads,
                       Report& report)
{
  checkParameters(parameters);
  checkMemoryOf(
      "A level set", indices.size(), orderedBytes(static_cast<double>(indices.size())));
  const StretchAxes axes(parameters.rotation);
  const CloudView turned = axes.turn(cloud);
  LevelSetParameters along_axes = parameters;
  along_axes.initial = turnShape(parameters.initial, axes);
  LevelSetInput input = readInput(turned, indices, along_axes, threads, report);
  SurfaceTally tally;
  const SamplingSummary sampling =
      examineSurface(input, is_examined, threads, tally, report);
  LevelSet level_set = LevelSetRun(turned,
                                   std::move(input),
                                   along_axes,
                                   snapshot_steps,
                                   snapshot,
                                   threads,
                                   report)
                           .run();
  level_set.sampling = sampling;
  level_set.tally = tally;
  return level_set;
}

} // namespace pcl_uvol
