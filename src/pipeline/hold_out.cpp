// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/hold_out.h"

#include "common/parallel.h"
#include "common/progress_reminder.h"
#include "common/scalar_field.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/sample_values.h"
#include "pipeline/gap_filling.h"
#include "pipeline/weak_support.h"

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace pcl_uvol {

namespace {

/** Samples to a block of work. */
constexpr std::size_t fold_block = 256;

/** Samples that remained whose mean distance is the local spacing: of uniform random
 * samples of density 1 it is 0.87. */
constexpr std::size_t spacing_samples = 6;

/** Local spacings from the surface up to which a sample has a side of it. */
constexpr double covered_spacings = 2.0;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/** The isopoints of one isovalue with a search among them. */
class Sides {
public:
  /** \param isopoints must outlive the object */
  Sides(const pcl::PointCloud<PointIso>& isopoints,
        const Position& scale,
        Outside outside,
        unsigned threads)
      : isopoints_(isopoints)
      , inside_is_above_(outside == Outside::Lower)
  {
    if (isopoints.empty())
      return;
    std::vector<std::uint32_t> all(isopoints.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = static_cast<std::uint32_t>(i);
    Report report;
    const CloudView view = viewOf(isopoints);
    search_ = SampleSet::build(view.xyz(0), view.stride(), all, scale, threads, report);
  }

  /** \brief Tell the side of the nearest isopoint in the stretched space. A place is
   * covered where that one lies within a distance. */
  void
  findSide(NearestFinder& finder,
           const Position& place,
           double farthest,
           HeldOutSample& sample) const
  {
    const LengthUnit& unit = search_->getUnit();
    const auto row = finder.find(unit.apply(place), 1.0f);
    sample.is_covered = unit.toInput(std::sqrt(row.sq_dists[0])) <= farthest;
    const PointIso& nearest = isopoints_[search_->getInputIndex(row.samples[0])];
    double height = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      height += static_cast<double>(nearest.data_n[axis]) *
                (static_cast<double>(place[axis]) - nearest.data[axis]);
    sample.is_side_above = (height <= 0.0) == inside_is_above_;
    sample.distance = static_cast<float>(std::abs(height));
    sample.error = nearest.error;
  }

  const SampleSet*
  getSearch() const
  {
    return search_.get();
  }

private:
  const pcl::PointCloud<PointIso>& isopoints_;
  bool inside_is_above_;
  SampleSet::ConstPtr search_; ///< null without isopoints
};

/** The isopoints of a result, apart by isovalue. */
std::vector<pcl::PointCloud<PointIso>>
splitSurface(const IsosurfaceResult& result)
{
  pcl::PointCloud<PointIso> all;
  pcl::fromPCLPointCloud2(result.surface.cloud, all);
  std::vector<pcl::PointCloud<PointIso>> surfaces;
  auto begin = all.begin();
  for (const std::size_t count : result.isopoints) {
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    surfaces.emplace_back();
    surfaces.back().assign(begin, end);
    begin = end;
  }
  return surfaces;
}

/** One division of the samples. */
struct Division {
  pcl::Indices rest, left_out;
};

Division
divide(const pcl::Indices& use, const Folds& folds, std::size_t fold)
{
  Division division;
  for (const int index : use)
    (folds[static_cast<std::size_t>(index)] == fold ? division.left_out : division.rest)
        .push_back(index);
  if (division.rest.empty())
    throw InvalidArgument("single_fold", {});
  return division;
}

/** The field at the samples that were left out. */
std::vector<double>
interpolateLeftOut(const CloudView& cloud,
                   const Division& division,
                   const IsosurfaceParameters& isosurface,
                   unsigned threads,
                   const ProgressCallback& progress)
{
  std::vector<std::array<double, 3>> places;
  for (const int index : division.left_out) {
    const float* const xyz = cloud.xyz(static_cast<std::size_t>(index));
    places.push_back({xyz[0], xyz[1], xyz[2]});
  }
  Report report;
  report.progress = progress;
  return detail::FieldInterpolator(
             cloud, division.rest, detail::gapKriging(isosurface), threads, report)
      .interpolate(places, threads, report)
      .values;
}

/** What the samples of a division that remained say of places. */
class Remaining {
public:
  Remaining(const CloudView& cloud,
            const Division& division,
            const Position& scale,
            unsigned threads,
            const ProgressCallback& progress)
  {
    Report report;
    report.progress = progress;
    samples_ = SampleSet::build(cloud.xyz(0),
                                cloud.stride(),
                                {division.rest.begin(), division.rest.end()},
                                scale,
                                threads,
                                report);
  }

  const SampleSet&
  getSamples() const
  {
    return *samples_;
  }

  /** \brief The nearest sample, and the local spacing. */
  std::pair<std::uint32_t, double>
  look(NearestFinder& finder, const Position& place) const
  {
    const auto row = finder.find(samples_->getUnit().apply(place), 1.0f);
    double sum = 0.0;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < row.size; ++i) {
      sum += std::sqrt(static_cast<double>(row.sq_dists[i]));
      if (row.sq_dists[i] < row.sq_dists[nearest])
        nearest = i;
    }
    return {samples_->getInputIndex(row.samples[nearest]),
            samples_->getUnit().toInput(sum / static_cast<double>(row.size))};
  }

private:
  SampleSet::ConstPtr samples_;
};

/** Everything that is needed to ask for the class of one sample after another. */
struct Question {
  const CloudView& cloud;
  const std::vector<float>& values; ///< in a frame
  const Division& division;
  const Remaining& remaining;
  const Sides& sides;
  const std::vector<double>& interpolated;
  float isovalue; ///< in the frame
  double isovalue_of_field;
};

void
askFor(const Question& question,
       std::size_t begin,
       std::size_t end,
       HeldOutSample* answers)
{
  NearestFinder samples(question.remaining.getSamples(), spacing_samples);
  std::optional<NearestFinder> isopoints;
  if (question.sides.getSearch() != nullptr)
    isopoints.emplace(*question.sides.getSearch(), 1);
  for (std::size_t i = begin; i < end; ++i) {
    HeldOutSample& answer = answers[i];
    answer.point = static_cast<std::uint32_t>(question.division.left_out[i]);
    const float* const xyz = question.cloud.xyz(answer.point);
    const Position place{{xyz[0], xyz[1], xyz[2]}};
    const auto [nearest, spacing] = question.remaining.look(samples, place);
    answer.is_above = question.values[answer.point] >= question.isovalue;
    answer.is_nearest_above = question.values[nearest] >= question.isovalue;
    answer.is_field_above =
        std::isnan(question.interpolated[i])
            ? answer.is_nearest_above
            : question.interpolated[i] >= question.isovalue_of_field;
    answer.is_side_above = answer.is_nearest_above;
    if (isopoints)
      question.sides.findSide(*isopoints, place, covered_spacings * spacing, answer);
  }
}

/** Those with a value and a place. */
pcl::Indices
selectMeasured(const CloudView& cloud,
               const std::vector<float>& values,
               const pcl::Indices& use)
{
  pcl::Indices measured;
  for (const int index : use) {
    const auto i = static_cast<std::size_t>(index);
    const float* const xyz = cloud.xyz(i);
    if (!std::isnan(values[i]) && isFinite({{xyz[0], xyz[1], xyz[2]}}))
      measured.push_back(index);
  }
  return measured;
}

} // namespace

std::vector<std::vector<HeldOutSample>>
holdOut(const PipelineInput& input,
        const Folds& folds,
        const ExtractPart& extract,
        unsigned threads,
        Report& report)
{
  const CloudView cloud = viewOf(input.samples->cloud);
  const IsosurfaceParameters& isosurface = input.parameters.isosurface;
  const ScalarField field(cloud.fields, isosurface.field);
  const ValueFrame frame = findValueRange(cloud, field, threads).findFrame();
  const std::vector<float> values = readValues(cloud, field, frame, threads);
  const pcl::Indices measured = selectMeasured(cloud, values, listPoints(input));
  const Position scale = toPosition(isosurface.scale);
  IsosurfacePipelineParameters of_rest = input.parameters;
  of_rest.automatic_scale = false;
  of_rest.validation = {};
  of_rest.mesh.reset();
  std::vector<std::vector<HeldOutSample>> held_out(isosurface.isovalues.size());
  StepTimer step(report, "validation", folds.size());
  ProgressCallback remind; // steps of a fold count as none of their own
  ProgressReminder reminder(report.progress, "validation");
  if (report.progress)
    remind = [&](const std::string&, double) { reminder.remind(); };
  for (std::size_t fold = 0; fold < folds.size(); ++fold) {
    const Division division = divide(measured, folds, fold);
    if (division.left_out.empty())
      continue;
    const auto surfaces = splitSurface(
        extract(of_rest, std::make_shared<pcl::Indices>(division.rest), remind));
    const auto interpolated =
        interpolateLeftOut(cloud, division, isosurface, threads, remind);
    const Remaining remaining(cloud, division, scale, threads, remind);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const double isovalue = isosurface.isovalues[i];
      const Sides sides(surfaces[i], scale, isosurface.outside, threads);
      const Question question{cloud,
                              values,
                              division,
                              remaining,
                              sides,
                              interpolated,
                              static_cast<float>(frame.apply(isovalue)),
                              isovalue};
      const std::size_t first = held_out[i].size();
      held_out[i].resize(first + division.left_out.size());
      parallelBlocks(division.left_out.size(),
                     fold_block,
                     threads,
                     [&](std::size_t begin, std::size_t end) {
                       askFor(question, begin, end, &held_out[i][first]);
                     });
    }
    step.advance(1);
    reminder.setDone(static_cast<double>(fold + 1) / static_cast<double>(folds.size()));
  }
  return held_out;
}

ValidationScore
scoreHeldOut(const std::vector<HeldOutSample>& samples)
{
  ValidationScore score;
  score.tested = samples.size();
  std::size_t above = 0, nearest = 0, field = 0, side_everywhere = 0;
  std::size_t side = 0, differ = 0, above_near = 0, nearest_near = 0, field_near = 0,
              sure = 0;
  for (const HeldOutSample& sample : samples) {
    above += sample.is_above;
    nearest += sample.is_nearest_above == sample.is_above;
    field += sample.is_field_above == sample.is_above;
    const bool is_right = sample.is_side_above == sample.is_above;
    side_everywhere += is_right;
    if (!sample.is_covered)
      continue;
    ++score.covered;
    side += is_right;
    differ += sample.is_side_above != sample.is_nearest_above;
    above_near += sample.is_above;
    nearest_near += sample.is_nearest_above == sample.is_above;
    field_near += sample.is_field_above == sample.is_above;
    if (sample.distance > sample.error) {
      ++score.beyond_error;
      sure += is_right;
    }
  }
  const auto share = [](std::size_t part, std::size_t all) {
    return all == 0 ? nan : static_cast<double>(part) / static_cast<double>(all);
  };
  const auto base = [&](std::size_t part, std::size_t all) {
    return share(std::max(part, all - part), all);
  };
  score.side = {share(side, score.covered),
                base(above_near, score.covered),
                share(nearest_near, score.covered)};
  // Only samples that one of them tells wrongly speak for the other.
  const double gain = score.side.predicted - score.side.nearest;
  score.side_error = std::sqrt(share(differ, score.covered) - gain * gain) /
                     std::sqrt(static_cast<double>(score.covered));
  score.side_of_field = share(field_near, score.covered);
  score.field = {share(field, score.tested),
                 base(above, score.tested),
                 share(nearest, score.tested)};
  score.side_everywhere = share(side_everywhere, score.tested);
  score.side_beyond_error = share(sure, score.beyond_error);
  return score;
}

/** Samples beyond the error, and their share on the right side, below which errors
 * cannot be trusted: of dense samples it is 0.98 and more. @{ */
constexpr std::size_t least_beyond_error = 30;
constexpr double trusted_side = 0.8;
/** @} */

namespace {

/** The score of which a number is largest, null where none is above 0. */
template <typename Excess>
const ValidationScore*
findWorst(const std::vector<ValidationScore>& scores, const Excess& excess)
{
  const ValidationScore* worst = nullptr;
  for (const ValidationScore& score : scores)
    if (excess(score) > (worst != nullptr ? excess(*worst) : 0.0))
      worst = &score;
  return worst;
}

} // namespace

void
warnOfScores(const std::vector<ValidationScore>& scores,
             const IsosurfacePipelineParameters& parameters,
             const std::optional<SamplingSummary>& sampling,
             Report& report)
{
  const auto percent = [](double share) { return std::round(100.0 * share); };
  const auto list_shares = [&](const ValidationScore& score) {
    return std::vector<MessageValue>{{"surface", percent(score.side.predicted)},
                                     {"samples", score.covered},
                                     {"baseline", percent(score.side.base)},
                                     {"nearest", percent(score.side.nearest)}};
  };
  if (const auto* const score = findWorst(scores, [](const ValidationScore& tested) {
        return tested.side.base - tested.side.predicted;
      }))
    report.warn("worse_than_baseline", list_shares(*score));
  if (const auto* const score = findWorst(scores, [](const ValidationScore& tested) {
        return tested.side.nearest - tested.side.predicted - tested.side_error;
      })) {
    const bool lie_all_around = sampling && sampling->most == LocalDimension::Volume;
    Message better(lie_all_around ? "worse_than_nearest_sample"
                                  : "worse_than_nearest_on_lines",
                   list_shares(*score));
    if (!lie_all_around)
      for (MessageValue& remedy : listRemedies(parameters))
        better.values.push_back(std::move(remedy));
    report.warn({std::move(better)});
  }
  if (const auto* const score = findWorst(scores, [](const ValidationScore& tested) {
        return tested.beyond_error < least_beyond_error
                   ? 0.0
                   : trusted_side - tested.side_beyond_error;
      }))
    report.warn("small_errors",
                {{"samples", score->beyond_error},
                 {"percent", percent(1.0 - score->side_beyond_error)}});
}

Folds
makeFolds(const CloudView& cloud,
          const ValidationParameters& parameters,
          unsigned threads)
{
  switch (parameters.by) {
  case ValidateBy::Blocks:
    return Folds::byBlocks(cloud, parameters.folds, threads);
  case ValidateBy::Field:
    return Folds::byField(cloud, parameters.field, parameters.folds);
  default:
    return Folds::byRandom(cloud.count, parameters.folds);
  }
}

HoldOutTest::HoldOutTest(const PipelineInput& input, unsigned threads)
    : input_(input)
    , folds_(
          makeFolds(viewOf(input.samples->cloud), input.parameters.validation, threads))
    , threads_(threads)
{
}

void
HoldOutTest::leave(const ExtractPart& extract, IsosurfaceResult& result) const
{
  for (const auto& samples : holdOut(input_, folds_, extract, threads_, result.report))
    result.validation.push_back(scoreHeldOut(samples));
  warnOfScores(result.validation, input_.parameters, result.sampling, result.report);
}

} // namespace pcl_uvol
