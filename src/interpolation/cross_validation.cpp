// SPDX-License-Identifier: BSD-3-Clause
#include "common/random.h"
#include "common/scalar_field.h"
#include "interpolation/fold_split.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/interpolation/cross_validation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t blocks_per_fold = 8;

void
checkFolds(std::size_t folds, std::size_t most, const char* what)
{
  if (folds < 2 || folds > most)
    throw InvalidArgument("folds_not_allowed",
                          {{"folds", folds}, {"most", most}, {"things", what}});
}

/** 0, 1, ... in an order that looks random. */
std::vector<std::uint32_t>
shuffled(std::size_t count)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [](std::uint32_t a, std::uint32_t b) {
    return mixBits(a) < mixBits(b);
  });
  return order;
}

/** Sums of one field's errors. */
struct Errors {
  std::size_t tested = 0, covered = 0, within = 0;
  bool has_errors = true;
  double sum = 0.0, squares = 0.0;

  void
  add(double measured, double interpolated, double error)
  {
    if (std::isnan(measured))
      return;
    ++tested;
    if (std::isnan(interpolated))
      return;
    ++covered;
    const double off = interpolated - measured;
    sum += off;
    squares += off * off;
    within += std::abs(off) <= error;
    has_errors = has_errors && !std::isnan(error);
  }

  FieldScore
  score(const std::string& field) const
  {
    const double count = static_cast<double>(covered);
    return {field,
            tested,
            covered,
            std::sqrt(squares / count),
            sum / count,
            has_errors ? static_cast<double>(within) / count
                       : std::numeric_limits<double>::quiet_NaN()};
  }
};

/** Warn where no field has a value at any held-out point: errors are not numbers then.
 */
void
warnOfNothingCovered(const std::vector<FieldScore>& scores, Report& report)
{
  std::size_t tested = 0;
  for (const FieldScore& score : scores) {
    if (score.covered > 0)
      return;
    tested = std::max(tested, score.tested);
  }
  if (tested > 0)
    report.warn("nothing_covered", {{"tested", tested}});
}

} // namespace

Folds::Folds(std::size_t folds, std::vector<std::uint32_t> fold_of)
    : folds_(folds)
    , fold_of_(std::move(fold_of))
{
}

Folds
Folds::byRandom(std::size_t count, std::size_t folds)
{
  checkFolds(folds, count, "points");
  std::vector<std::uint32_t> fold_of(count);
  const auto order = shuffled(count);
  for (std::size_t i = 0; i < count; ++i)
    fold_of[order[i]] = static_cast<std::uint32_t>(i % folds);
  return {folds, std::move(fold_of)};
}

Folds
Folds::byBlocks(const CloudView& cloud, std::size_t folds, unsigned threads)
{
  checkFolds(folds, cloud.count, "points");
  std::vector<std::uint32_t> use(cloud.count);
  std::iota(use.begin(), use.end(), 0u);
  Report report;
  const auto samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), use, Position{{1.0f, 1.0f, 1.0f}}, threads, report);
  // Runs of samples in the order of the tree are compact.
  const std::size_t blocks = std::min(blocks_per_fold * folds, samples->size());
  const auto order = shuffled(blocks);
  std::vector<std::uint32_t> fold_of(cloud.count, 0);
  for (std::size_t i = 0; i < samples->size(); ++i) {
    const std::size_t block = i * blocks / samples->size();
    fold_of[samples->getInputIndex(i)] =
        static_cast<std::uint32_t>(order[block] % folds);
  }
  for (const SampleSet::Merged& merged : samples->getMerged())
    for (const std::uint32_t member : merged.members)
      fold_of[member] = fold_of[samples->getInputIndex(merged.sample)];
  return {folds, std::move(fold_of)};
}

Folds
Folds::byField(const CloudView& cloud, const std::string& name, std::size_t folds)
{
  const ScalarField field(cloud.fields, name);
  std::map<double, std::size_t> points; // by value
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const double value = field.read(cloud.point(i)); std::isfinite(value))
      ++points[value];
  checkFolds(folds, points.size(), ("values of " + name).c_str());
  // The largest groups first, each into the smallest fold so far.
  std::vector<std::pair<std::size_t, double>> groups;
  groups.reserve(points.size());
  for (const auto& [value, count] : points)
    groups.emplace_back(count, value);
  std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::vector<std::size_t> sizes(folds, 0);
  std::map<double, std::uint32_t> fold_of_value;
  for (const auto& [count, value] : groups) {
    const auto smallest = std::min_element(sizes.begin(), sizes.end());
    *smallest += count;
    fold_of_value[value] = static_cast<std::uint32_t>(smallest - sizes.begin());
  }
  std::vector<std::uint32_t> fold_of(cloud.count, 0);
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const double value = field.read(cloud.point(i)); std::isfinite(value))
      fold_of[i] = fold_of_value[value];
  return {folds, std::move(fold_of)};
}

std::vector<FieldScore>
crossValidate(const CloudView& cloud,
              const pcl::Indices& indices,
              const InterpolationParameters& parameters,
              const Folds& folds,
              std::size_t most,
              unsigned threads,
              Report& report)
{
  detail::checkIndices(indices, cloud.count, "crossValidate");
  InterpolationParameters tested = parameters;
  tested.gradients = false;
  tested.errors = true;
  std::vector<Errors> errors;
  std::vector<std::string> names;
  for (std::size_t fold = 0; fold < folds.size(); ++fold) {
    const detail::FoldSplit split(indices, folds, fold, most);
    if (split.left_out.empty())
      continue;
    const auto result = split.interpolate(cloud, tested, threads, report);
    names = result.names;
    errors.resize(names.size());
    for (std::size_t f = 0; f < names.size(); ++f) {
      const ScalarField field(cloud.fields, names[f]);
      for (std::size_t i = 0; i < split.left_out.size(); ++i)
        errors[f].add(
            field.read(cloud.point(static_cast<std::size_t>(split.left_out[i]))),
            result.getValue(f, i),
            result.getError(f, i));
    }
  }
  std::vector<FieldScore> scores;
  for (std::size_t f = 0; f < names.size(); ++f)
    scores.push_back(errors[f].score(names[f]));
  warnOfNothingCovered(scores, report);
  return scores;
}

} // namespace pcl_uvol
