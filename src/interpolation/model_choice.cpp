// SPDX-License-Identifier: BSD-3-Clause
// The model that is nearest to samples left out.
#include "common/scalar_field.h"
#include "interpolation/fold_split.h"
#include "neighbors/sampling.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr std::size_t folds_in_all = 10, folds_tested = 3, most_of_a_fold = 2000;

/** What a model says at the samples that were left out of all folds tested. */
struct Candidate {
  InterpolationModel model;
  bool is_possible = true;
  std::size_t covered = 0;
  std::vector<std::vector<double>> values; ///< [field][sample]
};

/** In the order of preference where models are as good. */
std::vector<Candidate>
listCandidates(const SphParameters& sph)
{
  std::vector<Candidate> candidates;
  const auto add = [&](InterpolationModel model) {
    candidates.push_back({model, true, 0, {}});
  };
  for (const InterpolationModel model : {InterpolationModel::Fit,
                                         InterpolationModel::Sibson,
                                         InterpolationModel::Kriging})
    add(model);
  if (!sph.length_field.empty() || !sph.mass_field.empty() ||
      !sph.density_field.empty())
    add(InterpolationModel::Sph);
  for (const InterpolationModel model :
       {InterpolationModel::Shepard, InterpolationModel::Nearest})
    add(model);
  return candidates;
}

/** What a candidate says at the samples that a fold leaves out, behind what it said at
 * those of others. */
void
test(Candidate& candidate,
     const detail::FoldSplit& split,
     const CloudView& cloud,
     InterpolationParameters parameters,
     unsigned threads,
     Report& report)
{
  parameters.model = candidate.model;
  const InterpolatedFields answers =
      split.interpolate(cloud, parameters, threads, report);
  candidate.values.resize(answers.names.size());
  for (std::size_t f = 0; f < answers.names.size(); ++f)
    for (std::size_t i = 0; i < answers.size; ++i) {
      candidate.values[f].push_back(answers.getValue(f, i));
      candidate.covered += !std::isnan(answers.getValue(f, i));
    }
}

/** Measured values of the fields at samples. */
std::vector<std::vector<double>>
readValues(const CloudView& cloud,
           const std::vector<std::string>& names,
           const pcl::Indices& samples)
{
  std::vector<std::vector<double>> values;
  for (const std::string& name : names) {
    const ScalarField field(cloud.fields, name);
    auto& column = values.emplace_back();
    for (const int sample : samples)
      column.push_back(field.read(cloud.point(static_cast<std::size_t>(sample))));
  }
  return values;
}

/** True where a field was measured and all models have a value of it. */
std::vector<bool>
findCommon(const std::vector<Candidate>& candidates,
           const std::vector<double>& measured,
           std::size_t field)
{
  std::vector<bool> is_common(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i)
    is_common[i] =
        std::isfinite(measured[i]) &&
        std::all_of(candidates.begin(), candidates.end(), [&](const auto& c) {
          return std::isfinite(c.values[field][i]);
        });
  return is_common;
}

/** Squared errors of a model by the variance of the values measured, where all models
 * have values; 0 for a constant field that a model knows. */
double
relativeSquares(const std::vector<double>& values,
                const std::vector<double>& measured,
                const std::vector<bool>& is_common)
{
  double count = 0.0, mean = 0.0, squares = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (is_common[i]) {
      count += 1.0;
      mean += (measured[i] - mean) / count;
    }
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (is_common[i]) {
      squares += (values[i] - measured[i]) * (values[i] - measured[i]);
      variance += (measured[i] - mean) * (measured[i] - mean);
    }
  return squares > 0.0 ? squares / variance : 0.0;
}

/** Random folds, or blocks where samples lie on lines or sheets. */
Folds
makeFolds(const CloudView& cloud,
          const pcl::Indices& indices,
          const InterpolationParameters& parameters,
          unsigned threads,
          const ProgressCallback& progress)
{
  Report own; // models count samples for themselves
  own.progress = progress;
  const std::vector<std::uint32_t> use(indices.begin(), indices.end());
  const auto samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), use, toPosition(parameters.scale), threads, own);
  const SamplingSummary sampling = summarizeSampling(*samples, threads);
  return sampling.most == LocalDimension::Line || sampling.most == LocalDimension::Sheet
             ? Folds::byBlocks(cloud, folds_in_all, threads)
             : Folds::byRandom(cloud.count, folds_in_all);
}

} // namespace

ModelChoice
chooseModel(const CloudView& cloud,
            const pcl::Indices& indices,
            const InterpolationParameters& parameters,
            unsigned threads,
            Report& report)
{
  checkParameters(parameters);
  detail::checkIndices(indices, cloud.count, "chooseModel");
  if (indices.size() < folds_in_all) {
    report.warn("few_samples_for_choice");
    return {{{InterpolationModel::Fit, 0.0}}, 0};
  }
  return chooseModel(cloud,
                     indices,
                     parameters,
                     makeFolds(cloud, indices, parameters, threads, report.progress),
                     threads,
                     report);
}

ModelChoice
chooseModel(const CloudView& cloud,
            const pcl::Indices& indices,
            const InterpolationParameters& parameters,
            const Folds& folds,
            unsigned threads,
            Report& report)
{
  checkParameters(parameters);
  detail::checkIndices(indices, cloud.count, "chooseModel");
  InterpolationParameters tested = parameters;
  tested.gradients = tested.errors = false;
  if (tested.fields.empty())
    tested.fields.push_back(ScalarField::defaultName(cloud.fields));

  Report own; // what models would warn of is no matter of those that are not chosen
  own.progress = report.progress;
  std::vector<Candidate> candidates = listCandidates(parameters.sph);
  pcl::Indices samples;
  Message error("no_model_has_values", {});
  for (std::size_t fold = 0; fold < std::min(folds_tested, folds.size()); ++fold) {
    const detail::FoldSplit split(indices, folds, fold, most_of_a_fold);
    if (split.left_out.empty())
      continue;
    samples.insert(samples.end(), split.left_out.begin(), split.left_out.end());
    for (Candidate& candidate : candidates)
      try {
        if (candidate.is_possible)
          test(candidate, split, cloud, tested, threads, own);
      }
      catch (const InvalidArgument& exception) {
        candidate.is_possible = false;
        error = exception.asMessage();
      }
  }
  const std::size_t half = samples.size() * tested.fields.size() / 2;
  candidates.erase(std::remove_if(candidates.begin(),
                                  candidates.end(),
                                  [&](const Candidate& candidate) {
                                    return !candidate.is_possible ||
                                           candidate.covered < half;
                                  }),
                   candidates.end());
  if (candidates.empty() || samples.empty())
    throw InvalidArgument(error);

  const auto measured = readValues(cloud, tested.fields, samples);
  ModelChoice choice;
  for (const Candidate& candidate : candidates)
    choice.scores.push_back({candidate.model, 0.0});
  for (std::size_t f = 0; f < measured.size(); ++f) {
    const auto is_common = findCommon(candidates, measured[f], f);
    choice.tested +=
        static_cast<std::size_t>(std::count(is_common.begin(), is_common.end(), true));
    for (std::size_t i = 0; i < candidates.size(); ++i)
      choice.scores[i].error +=
          relativeSquares(candidates[i].values[f], measured[f], is_common);
  }
  for (ModelScore& score : choice.scores)
    score.error = std::sqrt(score.error / static_cast<double>(measured.size()));
  std::stable_sort(
      choice.scores.begin(),
      choice.scores.end(),
      [](const ModelScore& a, const ModelScore& b) { return a.error < b.error; });
  return choice;
}

} // namespace pcl_uvol
