// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/mu_choice.h"

#include "common/parallel.h"
#include "levelset/constants.h"
#include "levelset/evolver.h"
#include "levelset/parallel_kernels.h"
#include "levelset/quadratic_terms.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_uvol {

namespace {

/** 1 or -1 at random, by sample, so that the order of the input does not matter
 * (Steele, Lea, Flood 2014: SplitMix64). */
float
drawSign(std::uint32_t sample)
{
  std::uint64_t bits = sample + 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return ((bits >> 31) & 1u) != 0 ? 1.0f : -1.0f;
}

/** The value of a fit at a centre as a weighted sum over samples around it. */
struct FitWeights {
  std::uint32_t center;
  std::vector<std::uint32_t> places;
  std::vector<float> weights;

  double
  apply(const std::vector<float>& values) const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i)
      sum += static_cast<double>(weights[i]) * values[places[i]];
    return sum;
  }
};

/** The place of a sample, if it has one in the band. */
std::optional<std::uint32_t>
findPlace(const Band& band, std::uint32_t sample)
{
  const auto find = [&](const std::vector<std::uint32_t>& samples,
                        std::size_t first) -> std::optional<std::uint32_t> {
    const auto found = std::lower_bound(samples.begin(), samples.end(), sample);
    if (found == samples.end() || *found != sample)
      return std::nullopt;
    return static_cast<std::uint32_t>(first) +
           static_cast<std::uint32_t>(found - samples.begin());
  };
  const auto center = find(band.centers, 0);
  return center ? center : find(band.others, band.centerPlaces());
}

/** Quadratic, weighted by (1 - d^2 / h^2)^2, as that of an isopoint. */
FitWeights
fitAt(const Band& band,
      const SampleSet& samples,
      std::uint32_t center,
      const NearestFinder::Row& row)
{
  constexpr double beyond = 1.05, ridge = 1e-9;
  const Position& x = samples.getPositions()[band.centers[center]];
  const double reach =
      beyond * std::sqrt(*std::max_element(row.sq_dists, row.sq_dists + row.size));
  const auto count = static_cast<Eigen::Index>(row.size);
  Eigen::Matrix<double, Eigen::Dynamic, quadratic_terms> terms(count, quadratic_terms);
  Eigen::VectorXd weights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    terms.row(i) = quadraticTerms(x, samples.getPositions()[row.samples[i]], reach);
    const double rest = 1.0 - row.sq_dists[i] / (reach * reach);
    weights[i] = rest * rest;
  }
  // Samples in a plane leave terms open: the ridge takes the smallest.
  Eigen::Matrix<double, quadratic_terms, quadratic_terms> normal =
      terms.transpose() * weights.asDiagonal() * terms;
  normal.diagonal().array() += ridge * normal.trace();
  using Terms = Eigen::Matrix<double, quadratic_terms, 1>;
  const Terms value = normal.ldlt().solve(Terms::Unit(0));
  const Eigen::VectorXd of_samples = weights.asDiagonal() * (terms * value);
  FitWeights fit{center, {}, {}};
  for (Eigen::Index i = 0; i < count; ++i)
    if (const auto place = findPlace(band, row.samples[i])) {
      fit.places.push_back(*place);
      fit.weights.push_back(static_cast<float>(of_samples[i]));
    }
  return fit;
}

/** Fits at some of the centres next to the zero level.
 * \param size samples in each */
std::vector<FitWeights>
fitNear(const Band& band,
        const SampleSet& samples,
        const std::vector<float>& phi,
        double spacing,
        std::size_t size,
        unsigned threads)
{
  std::vector<std::uint32_t> near;
  for (std::size_t i = 0; i < band.centers.size(); ++i)
    if (std::abs(phi[i]) < level_set.look_distance * spacing)
      near.push_back(static_cast<std::uint32_t>(i));
  const std::size_t count = std::min(level_set.most_looked_at, near.size());
  std::vector<FitWeights> fits(count);
  parallelBlocks(count, block_fits, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, std::min(size, samples.size()));
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t center = near[i * near.size() / count];
      const auto row = finder.find(samples.getPositions()[band.centers[center]],
                                   band.stencils.getReach()[center]);
      fits[i] = fitAt(band, samples, center, row);
    }
  });
  return fits;
}

/** Weights that a search tries at most. */
std::uint64_t
countWeights()
{
  std::uint64_t count = 0;
  double mu = level_set.mu_ratio;
  while (mu > level_set.least_mu) {
    mu *= level_set.mu_ratio;
    ++count;
  }
  return count;
}

/** Steps of all weights, of which each may take long. */
class MuProgress {
public:
  MuProgress(Report& report, const std::string& step, std::size_t total)
      : timer_(report, step, total)
      , reminder_(report.progress, step)
      , total_(total)
  {
  }

  void
  advance(std::size_t steps)
  {
    timer_.advance(steps);
    done_ += steps;
    reminder_.setDone(static_cast<double>(done_) / static_cast<double>(total_));
  }

  ProgressReminder&
  getReminder()
  {
    return reminder_;
  }

private:
  StepTimer timer_;
  ProgressReminder reminder_;
  std::size_t total_, done_ = 0;
};

/** What fits at samples near the surface tell of a smoothed function. Means of squares
 * are in squared lengths. */
struct Residuals {
  double removed; ///< of what the data have besides it
  double left;    ///< share of the known noise
  double kept;    ///< square of that share, by fit

  /** The variance of the noise if the function is the true one but for what is left. */
  double
  noiseVariance() const
  {
    return removed / (1.0 - 2.0 * left + kept);
  }

  /** Stein's estimate of the mean square deviation. */
  double
  risk(double variance) const
  {
    // In this order what is not a number stays so.
    return std::max(removed + variance * (2.0 * left - 1.0),
                    level_set.least_risk * variance);
  }
};

/** The data and a copy with known noise on it, smoothed alike. */
class Search {
public:
  Search(const Band& band,
         const SampleSet& samples,
         const DataTerm& term,
         const LevelSetParameters& parameters,
         double spacing,
         unsigned threads,
         MuProgress& progress)
      : band_(band)
      , samples_(samples)
      , term_(term)
      , probe_(term)
      , parameters_(parameters)
      , spacing_(spacing)
      , threads_(threads)
      , progress_(progress)
      , shift_(static_cast<float>(level_set.probe_part * term.noise))
      , variance_(term.noise * term.noise)
  {
    parameters_.integration = Integration::Asynchronous;
    for (std::size_t i = 0; i < band.centers.size(); ++i)
      probe_.target[i] += shift_ * drawSign(band.centers[i]);
    phi_ = term.target;
    probed_ = probe_.target;
  }

  MuChoice
  run()
  {
    for (double mu = level_set.mu_ratio;
         mu > level_set.least_mu && stages_.size() - best_stages_ < level_set.patience;
         mu *= level_set.mu_ratio)
      tryWeight(mu, level_set.patience);
    stages_.resize(best_stages_);
    if (!stages_.empty())
      stages_.back().time = best_time_;
    const double direct_risk =
        findResiduals(term_.target, probe_.target).risk(variance_);
    if (!best_ || !(best_->risk(variance_) < level_set.worthwhile * direct_risk))
      return {};
    return {stages_, best_shares_};
  }

  NoiseShares
  measure(double mu)
  {
    tryWeight(mu, level_set.steps_of_weight);
    return measureShares(phi_, probed_);
  }

private:
  /** \param patience looks without a better one that end it */
  void
  tryWeight(double mu, std::size_t patience)
  {
    Evolver evolver(band_, parameters_, threads_, spacing_, mu, phi_, term_);
    Evolver other(band_, parameters_, threads_, spacing_, mu, probed_, probe_);
    stages_.push_back({mu, 0.0});
    bool is_calm = false;
    misses_ = 0;
    std::size_t step = 1;
    for (; !is_calm && misses_ < patience; ++step) {
      progress_.advance(1);
      const double change = evolver.advance(&progress_.getReminder()).change;
      other.advance(&progress_.getReminder());
      stages_.back().time += evolver.getStep();
      // Not a number is no calm either, and ends the search.
      is_calm = !(change >= level_set.calm) || step == level_set.steps_of_weight;
      if (step % level_set.look_steps != 0 && !is_calm)
        continue;
      if (fits_.empty())
        start(evolver.getPhi());
      look(evolver.getPhi(), other.getPhi());
    }
    progress_.advance(level_set.steps_of_weight + 1 - step);
    correctNoise();
    phi_ = evolver.getPhi();
    probed_ = other.getPhi();
  }

  /** Where to look is told by what is a little smoother than the data: these would
   * choose those of their samples whose noise brings them near the surface. */
  void
  start(const std::vector<float>& smoother)
  {
    const auto fit = [&](std::size_t size) {
      return fitNear(band_, samples_, smoother, spacing_, size, threads_);
    };
    fits_ = fit(level_set.look_samples);
    wide_fits_ = fit(level_set.share_samples);
  }

  void
  look(const std::vector<float>& phi, const std::vector<float>& probed)
  {
    last_ = findResiduals(phi, probed);
    ++misses_;
    const double least =
        best_ ? best_->risk(variance_) : std::numeric_limits<double>::infinity();
    if (!(last_.risk(variance_) < least))
      return;
    misses_ = 0;
    best_ = last_;
    best_stages_ = stages_.size();
    best_time_ = stages_.back().time;
    best_shares_ = measureShares(phi, probed);
  }

  /** How the known noise shows. */
  NoiseShares
  measureShares(const std::vector<float>& phi, const std::vector<float>& probed) const
  {
    double left = 0.0, taken = 0.0;
    for (const FitWeights& fit : wide_fits_) {
      left += std::pow((fit.apply(probed) - fit.apply(phi)) / shift_, 2);
      const double moved =
          (static_cast<double>(probed[fit.center]) - phi[fit.center]) / shift_;
      taken += std::pow(drawSign(band_.centers[fit.center]) - moved, 2);
    }
    const auto count = static_cast<double>(wide_fits_.size());
    return {std::sqrt(left / count), std::sqrt(taken / count)};
  }

  /** Less deviation than none is expected where the noise is told too large, as between
   * two surfaces. Then what is removed tells the same smaller noise whatever the
   * weight. What takes a thin sheet away removes less and less. */
  void
  correctNoise()
  {
    const double noise = last_.noiseVariance();
    const bool is_none = last_.risk(variance_) <= level_set.least_risk * variance_;
    if (is_none &&
        std::abs(noise - noise_before_) < level_set.same_variance * noise_before_)
      variance_ = std::min(variance_, noise);
    noise_before_ = noise;
  }

  Residuals
  findResiduals(const std::vector<float>& phi, const std::vector<float>& probed) const
  {
    Residuals sums{};
    for (const FitWeights& fit : fits_) {
      const double value = fit.apply(phi);
      const double answer = (fit.apply(probed) - value) / shift_;
      sums.removed += std::pow(term_.target[fit.center] - value, 2);
      sums.left += drawSign(band_.centers[fit.center]) * answer;
      sums.kept += answer * answer;
    }
    const auto count = static_cast<double>(fits_.size());
    return {sums.removed / count, sums.left / count, sums.kept / count};
  }

  const Band& band_;
  const SampleSet& samples_;
  const DataTerm& term_;
  DataTerm probe_;
  LevelSetParameters parameters_;
  double spacing_;
  unsigned threads_;
  MuProgress& progress_;
  float shift_;
  std::vector<float> phi_, probed_;
  std::vector<FitWeights> fits_, wide_fits_; ///< that look, and that tell shares
  std::vector<MuStage> stages_;              ///< all that were tried
  double variance_;                          ///< of the noise
  double noise_before_ = 0.0;                ///< that by what the weight before removed
  Residuals last_{};
  std::optional<Residuals> best_;
  double best_time_ = 0.0;
  NoiseShares best_shares_;
  std::size_t best_stages_ = 0;
  std::size_t misses_ = 0; ///< looks at this weight since the best one
};

} // namespace

MuChoice
chooseMu(const Band& band,
         const SampleSet& samples,
         const DataTerm& term,
         const LevelSetParameters& parameters,
         double spacing,
         unsigned threads,
         Report& report)
{
  MuProgress progress(report, "mu", countWeights() * level_set.steps_of_weight);
  if (term.noise < level_set.invisible_noise * spacing)
    return {};
  return Search(band, samples, term, parameters, spacing, threads, progress).run();
}

NoiseShares
measureShares(const Band& band,
              const SampleSet& samples,
              const DataTerm& term,
              const LevelSetParameters& parameters,
              double spacing,
              double mu,
              unsigned threads,
              Report& report)
{
  MuProgress progress(report, "shares", level_set.steps_of_weight);
  if (term.noise < level_set.invisible_noise * spacing)
    return {};
  return Search(band, samples, term, parameters, spacing, threads, progress)
      .measure(mu);
}

} // namespace pcl_uvol
