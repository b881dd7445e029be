// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/parallel.h"
#include "common/parameter_json.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "common/value_frame.h"
#include "interpolation/blended_fits.h"
#include "interpolation/field_model.h"
#include "interpolation/kernel_sums.h"
#include "interpolation/kriging_model.h"
#include "interpolation/memory_need.h"
#include "interpolation/natural_model.h"
#include "interpolation/query_order.h"
#include "interpolation/sample_cells.h"
#include "interpolation/simple_models.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace detail {

namespace {

constexpr std::size_t block_points = 1u << 14;
constexpr std::size_t block_queries = 512;

/** Few queries are divided into about so many blocks, since they can differ much in
 * work. */
constexpr std::size_t usual_blocks = 32;
constexpr std::size_t fewest_queries = 64;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::unique_ptr<FieldModel>
makeModel(const SampledFields& sampled,
          const InterpolationParameters& parameters,
          const Eigen::Matrix3d& turn,
          const std::vector<ValueFrame>& frames,
          const std::vector<std::string>& names,
          const CloudView& cloud,
          unsigned threads,
          Report& report)
{
  switch (parameters.model) {
  case InterpolationModel::Nearest:
    return std::make_unique<NearestModel>(sampled);
  case InterpolationModel::Shepard:
    return std::make_unique<ShepardModel>(sampled, parameters.shepard);
  case InterpolationModel::Sibson:
    return std::make_unique<NaturalModel>(sampled, NaturalCoordinates::Sibson);
  case InterpolationModel::Laplace:
    return std::make_unique<NaturalModel>(sampled, NaturalCoordinates::Laplace);
  case InterpolationModel::Kriging:
    return std::make_unique<KrigingModel>(
        sampled, parameters.kriging, turn, frames, names);
  case InterpolationModel::Sph:
    return std::make_unique<KernelSums>(
        sampled,
        parameters.sph,
        readParticles(cloud, *sampled.samples, parameters.sph),
        threads,
        report);
  default:
    return std::make_unique<BlendedFits>(sampled, frames, names, threads);
  }
}

/** The finite values of a field in its frame, NaN elsewhere. */
std::vector<double>
readExactValues(const CloudView& cloud,
                const ScalarField& field,
                const ValueFrame& frame,
                unsigned threads)
{
  std::vector<double> values(cloud.count);
  parallelBlocks(cloud.count, block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      // Adding zero turns -0 into 0, so that medians do not depend on its sign.
      const double value = frame.apply(field.read(cloud.point(i))) + 0.0;
      values[i] = std::isfinite(value) ? value : none;
    }
  });
  return values;
}

/** The weaker of two, for fields with different samples. */
FieldSupport
weaker(FieldSupport a, FieldSupport b)
{
  constexpr FieldSupport ranked[] = {FieldSupport::Measured,
                                     FieldSupport::Reduced,
                                     FieldSupport::Bridged,
                                     FieldSupport::Rim,
                                     FieldSupport::Outside,
                                     FieldSupport::Invalid};
  const auto rank = [&](FieldSupport support) {
    return std::find(std::begin(ranked), std::end(ranked), support);
  };
  return rank(a) < rank(b) ? b : a;
}

KdBox
boxOf(const SampleSet& samples)
{
  return samples.getTree().getBox(samples.getTree().getRoot());
}

} // namespace

/** Fields with the same samples, and their model. */
struct FieldInterpolator::Group {
  std::vector<std::uint32_t> use; ///< input indices
  std::size_t all = 0;            ///< points of the input
  std::vector<std::size_t> fields;
  std::vector<ValueFrame> frames;           ///< of each of them
  std::vector<std::vector<double>> columns; ///< of each of them, by input index; empty
                                            ///< once the model is made
  Eigen::Matrix3d turn;                     ///< to the axes of the samples
  SampledFields sampled;
  std::unique_ptr<FieldModel> model;

  /** \return how many values are the median of different ones */
  std::uint64_t
  build(const CloudView& cloud,
        const InterpolationParameters& parameters,
        const std::vector<std::string>& names,
        unsigned threads,
        Report& report)
  {
    sampled.samples = SampleSet::build(cloud.xyz(0),
                                       cloud.stride(),
                                       use,
                                       toPosition(parameters.scale),
                                       threads,
                                       report);
    const std::uint64_t conflicting = gatherValues(threads, report);
    columns.clear();
    std::vector<std::string> own_names;
    for (const std::size_t field : fields)
      own_names.push_back(names[field]);
    model =
        makeModel(sampled, parameters, turn, frames, own_names, cloud, threads, report);
    return conflicting;
  }

  /** Values into leaf order; a merged sample takes the median of its members'.
   * \return how many of these differ */
  std::uint64_t
  gatherValues(unsigned threads, Report& report)
  {
    const SampleSet& samples = *sampled.samples;
    sampled.fields = fields.size();
    sampled.values.resize(samples.size() * fields.size());
    parallelBlocks(samples.size(), block_points, threads, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t f = 0; f < fields.size(); ++f)
          sampled.values[i * fields.size() + f] = columns[f][samples.getInputIndex(i)];
    });
    std::uint64_t conflicting = 0;
    std::vector<std::uint32_t> members;
    for (const SampleSet::Merged& merged : samples.getMerged())
      for (std::size_t f = 0; f < fields.size(); ++f) {
        members.assign(merged.members.begin(), merged.members.end());
        sampled.values[merged.sample * fields.size() + f] =
            findRepresentative(
                members, [&](auto member) { return columns[f][member]; }, conflicting)
                .value;
      }
    report.count("conflicting_duplicates", conflicting);
    return conflicting;
  }

  /** Which queries are inside of cells whose samples have the fields: 1, others 0. */
  std::vector<std::uint8_t>
  findInside(const SampleCells& cells,
             const std::vector<std::array<double, 3>>& queries,
             unsigned threads) const
  {
    std::vector<bool> used(all);
    for (const std::uint32_t sample : use)
      used[sample] = true;
    std::vector<std::uint8_t> inside(queries.size());
    parallelBlocks(queries.size(), block_queries, threads, [&](auto begin, auto end) {
      cells.findInside(&queries[begin], end - begin, used, &inside[begin]);
    });
    return inside;
  }

  /** A query's place among the samples; false if it has none. */
  bool
  locate(const std::array<double, 3>& asked, Query& query) const
  {
    const LengthUnit& unit = sampled.samples->getUnit();
    const std::array<double, 3> at = toAxes(asked);
    const Position rounded{{static_cast<float>(at[0]),
                            static_cast<float>(at[1]),
                            static_cast<float>(at[2])}};
    if (!isFinite(rounded) || !LengthUnit::isWithin(unit.apply(rounded)))
      return false;
    // A place in float is stretched as samples are, so that it may be that of one.
    const Position stretched = unit.apply(rounded);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t i = static_cast<std::size_t>(axis);
      query.x[axis] = static_cast<double>(rounded[axis]) == at[i]
                          ? static_cast<double>(stretched[axis])
                          : at[i] * static_cast<double>(unit.scale[axis]);
    }
    return true;
  }

  /** A place as it is seen along the axes; rounded to float, as samples are, where it
   * is given in float. */
  std::array<double, 3>
  toAxes(const std::array<double, 3>& at) const
  {
    if (turn.isIdentity(0.0))
      return at;
    const Eigen::Vector3d place(at.data());
    const bool is_float = place == place.cast<float>().cast<double>();
    Eigen::Vector3d seen = turn * place;
    if (is_float)
      seen = seen.cast<float>().cast<double>().eval();
    return {seen[0], seen[1], seen[2]};
  }

  /** Bring the answer to a query of a block to its place, in units of the fields.
   * \param to index of the query */
  void
  scatter(const Estimates& answers,
          std::size_t from,
          std::size_t to,
          InterpolatedFields& result) const
  {
    result.support[to] = weaker(result.support[to], answers.support[from]);
    if (answers.support[from] == FieldSupport::Outside && !answers.extrapolate)
      return;
    const Position& scale = sampled.samples->getUnit().scale;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const std::size_t source = from * fields.size() + f;
      const std::size_t target = fields[f] * result.size + to;
      result.values[target] = frames[f].toInput(answers.values[source]);
      if (answers.errors)
        result.errors[target] = answers.errors[source] / frames[f].factor;
      if (!answers.gradients)
        continue;
      Eigen::Map<Eigen::Vector3d> gradient(&result.gradients[3 * target]);
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        gradient[axis] =
            answers.gradients[3 * source + static_cast<std::size_t>(axis)] /
            frames[f].factor * static_cast<double>(scale[static_cast<int>(axis)]);
      if (!turn.isIdentity(0.0))
        gradient = (turn.transpose() * gradient).eval();
    }
  }
};

namespace {

/** Answers of a group of fields, a block of queries after the other. */
class BlockAnswers {
public:
  BlockAnswers(std::size_t fields,
               const InterpolationParameters& parameters,
               bool extrapolate)
      : extrapolate_(extrapolate)
      , values_(block_queries * fields, none)
      , gradients_(parameters.gradients ? 3 * block_queries * fields : 0, none)
      , errors_(parameters.errors ? block_queries * fields : 0, none)
      , support_(block_queries, FieldSupport::Invalid)
  {
  }

  Estimates
  arrays()
  {
    return {values_.data(),
            gradients_.empty() ? nullptr : gradients_.data(),
            errors_.empty() ? nullptr : errors_.data(),
            support_.data(),
            extrapolate_};
  }

  /** Cells know more of where the data are than samples: what these say of how far a
   * place is from them stays. */
  void
  takeFromCells(std::size_t query, bool is_inside)
  {
    if (!is_inside)
      support_[query] = FieldSupport::Outside;
    else if (support_[query] == FieldSupport::Outside)
      support_[query] = FieldSupport::Bridged;
  }

private:
  bool extrapolate_;
  std::vector<double> values_, gradients_, errors_;
  std::vector<FieldSupport> support_;
};

void
countSupport(const std::vector<FieldSupport>& support, Report& report)
{
  report.count("queries", support.size());
  constexpr std::pair<const char*, FieldSupport> names[] = {
      {"measured", FieldSupport::Measured},
      {"bridged", FieldSupport::Bridged},
      {"rim", FieldSupport::Rim},
      {"outside", FieldSupport::Outside},
      {"reduced", FieldSupport::Reduced},
      {"invalid", FieldSupport::Invalid}};
  for (const auto& [name, kind] : names)
    report.count(
        name,
        static_cast<std::uint64_t>(std::count(support.begin(), support.end(), kind)));
}

} // namespace

FieldInterpolator::FieldInterpolator(const CloudView& input,
                                     const pcl::Indices& indices,
                                     const InterpolationParameters& parameters,
                                     unsigned threads,
                                     Report& report,
                                     const ExpectedQueries& expected)
    : parameters_(parameters)
    , names_(parameters.fields)
{
  checkParameters(parameters);
  checkIndices(indices, input.count, "FieldInterpolation");
  checkMemoryOf("Interpolation",
                indices.size(),
                interpolationBytes(static_cast<double>(indices.size()),
                                   std::max(1.0, static_cast<double>(names_.size())),
                                   parameters,
                                   expected));
  if (parameters.model == InterpolationModel::Auto)
    parameters_.model =
        chooseModel(input, indices, parameters, threads, report).scores.front().model;
  const StretchAxes axes(parameters.rotation);
  const CloudView cloud = axes.turn(input);
  if (names_.empty())
    names_.push_back(ScalarField::defaultName(cloud.fields));
  for (std::size_t f = 0; f < names_.size(); ++f) {
    const ScalarField field(cloud.fields, names_[f]);
    const ValueFrame frame = findValueRange(cloud, field, threads).findFrame();
    auto values = readExactValues(cloud, field, frame, threads);
    auto use = pointsWithValue(values, indices, field);
    const auto same =
        std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
          return group.use == use;
        });
    Group& group = same == groups_.end() ? groups_.emplace_back() : *same;
    group.use = std::move(use);
    group.all = cloud.count;
    group.turn = axes.getRows();
    group.fields.push_back(f);
    group.frames.push_back(frame);
    group.columns.push_back(std::move(values));
  }
  std::uint64_t conflicting = 0, values = 0;
  for (Group& group : groups_) {
    conflicting += group.build(cloud, parameters_, names_, threads, report);
    values += group.sampled.values.size();
  }
  warnOfConflicts(conflicting, values, report);
}

FieldInterpolator::~FieldInterpolator() = default;

InterpolatedFields
FieldInterpolator::answer(const std::vector<std::array<double, 3>>& queries,
                          unsigned threads,
                          StepTimer& step) const
{
  const auto asked = static_cast<double>(queries.size());
  checkMemoryOf("Interpolation at the positions",
                queries.size(),
                answerBytes(asked, static_cast<double>(names_.size()), parameters_));
  InterpolatedFields result;
  result.names = names_;
  result.size = queries.size();
  result.values.assign(names_.size() * queries.size(), none);
  result.errors.assign(parameters_.errors ? result.values.size() : 0, none);
  result.gradients.assign(parameters_.gradients ? 3 * result.values.size() : 0, none);
  result.support.assign(queries.size(), FieldSupport::Measured);
  for (const Group& group : groups_) {
    std::vector<Query> places(queries.size());
    std::vector<std::uint32_t> sources;
    std::vector<std::uint8_t> inside;
    if (cells_)
      inside = group.findInside(*cells_, queries, threads);
    for (std::size_t i = 0; i < queries.size(); ++i)
      if (!group.locate(queries[i], places[sources.size()]))
        result.support[i] = FieldSupport::Invalid;
      else if (cells_ && inside[i] == 0 && !parameters_.extrapolate)
        result.support[i] = weaker(result.support[i], FieldSupport::Outside);
      else
        sources.push_back(static_cast<std::uint32_t>(i));
    places.resize(sources.size());
    const auto order = orderInSpace(places, boxOf(*group.sampled.samples), threads);
    const std::size_t size =
        std::clamp(order.size() / usual_blocks, fewest_queries, block_queries);
    parallelBlocks(order.size(), size, threads, [&](auto begin, auto end) {
      std::vector<Query> block;
      for (std::size_t i = begin; i < end; ++i)
        block.push_back(places[order[i]]);
      BlockAnswers answers(
          group.fields.size(), parameters_, parameters_.extrapolate || cells_);
      group.model->evaluate(block.data(), block.size(), answers.arrays());
      for (std::size_t i = begin; i < end; ++i) {
        if (cells_)
          answers.takeFromCells(i - begin, inside[sources[order[i]]] != 0);
        group.scatter(answers.arrays(), i - begin, sources[order[i]], result);
      }
      step.advance(end - begin);
    });
  }
  return result;
}

InterpolatedFields
FieldInterpolator::interpolate(const std::vector<std::array<double, 3>>& queries,
                               unsigned threads,
                               Report& report) const
{
  StepTimer step(report, "interpolation", groups_.size() * queries.size());
  InterpolatedFields result = answer(queries, threads, step);
  for (const Group& group : groups_)
    group.model->addTo(report);
  countSupport(result.support, report);
  return result;
}

void
FieldInterpolator::interpolate(std::size_t queries,
                               const PlaceOf& place_of,
                               unsigned threads,
                               Report& report,
                               const TakeAnswers& take) const
{
  StepTimer step(report, "interpolation", groups_.size() * queries);
  std::vector<std::array<double, 3>> places;
  for (std::size_t first = 0; first < queries; first += lattice_block) {
    places.resize(std::min(lattice_block, queries - first));
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] = place_of(first + i);
    const InterpolatedFields result = answer(places, threads, step);
    countSupport(result.support, report);
    take(first, result);
  }
  for (const Group& group : groups_)
    group.model->addTo(report);
}

std::optional<FittedVariogram>
FieldInterpolator::findVariogram(std::size_t field) const
{
  for (const Group& group : groups_)
    for (std::size_t f = 0; f < group.fields.size(); ++f)
      if (group.fields[f] == field) {
        const FittedVariogram* const found = group.model->findVariogram(f);
        if (!found)
          break;
        const double factor = group.frames[f].factor * group.frames[f].factor;
        const LengthUnit& unit = group.sampled.samples->getUnit();
        FittedVariogram result = *found;
        result.model.nugget /= factor;
        result.model.psill /= factor;
        result.model.range = unit.toInput(result.model.range);
        const auto toInput = [&](EmpiricalVariogram& empirical) {
          for (double& distance : empirical.distance)
            distance = unit.toInput(distance);
          for (double& value : empirical.value)
            value /= factor;
        };
        toInput(result.empirical.all);
        for (EmpiricalVariogram& empirical : result.empirical.along)
          toInput(empirical);
        return result;
      }
  return std::nullopt;
}

std::vector<std::array<double, 3>>
readPlaces(const CloudView& cloud)
{
  std::vector<std::array<double, 3>> places(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const float* const xyz = cloud.xyz(i);
    places[i] = {xyz[0], xyz[1], xyz[2]};
  }
  return places;
}

} // namespace detail

} // namespace pcl_uvol
