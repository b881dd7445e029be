// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/level_set_input.h"

#include "common/number_range.h"
#include "levelset/band.h"
#include "levelset/constants.h"
#include "levelset/robust_values.h"
#include "levelset/value_scale.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_uvol {

namespace {

/** The isovalue and the range of the values, as the caller counts them. */
[[noreturn]] void
refuseIsovalue(const LevelSetParameters& parameters,
               const ValueFrame& frame,
               float low,
               float high)
{
  const auto texts =
      describeNumbers({parameters.isovalue, frame.toInput(low), frame.toInput(high)});
  throw NoLevelSet("isovalue_beyond_values",
                   {{"isovalue", texts[0]},
                    {"field", parameters.field},
                    {"low", texts[1]},
                    {"high", texts[2]}});
}

std::vector<float>
readField(const CloudView& cloud, const LevelSetInput& input, const std::string& name)
{
  const ScalarField field(cloud.fields, name);
  const double unit = input.samples->getUnit().factor;
  std::vector<float> values;
  values.reserve(input.sources.size());
  for (const std::uint32_t source : input.sources) {
    const double value = field.read(cloud.point(source));
    if (!std::isfinite(value))
      throw InvalidArgument("initial_field_not_finite", {{"field", field.getName()}});
    values.push_back(static_cast<float>(unit * value));
  }
  return values;
}

std::vector<float>
measureShape(const CloudView& cloud,
             const LevelSetInput& input,
             const LevelSetParameters& parameters)
{
  const double side = parameters.outside == Outside::Lower ? 1.0 : -1.0;
  const double unit = side * input.samples->getUnit().factor;
  const Eigen::Array3d scale = parameters.scale.cast<double>();
  std::vector<float> values;
  values.reserve(input.sources.size());
  for (std::size_t i = 0; i < input.sources.size(); ++i) {
    const Eigen::Vector3d x =
        Eigen::Vector3f(cloud.xyz(input.samples->getInputIndex(i))).cast<double>();
    values.push_back(
        static_cast<float>(unit * parameters.initial.computeDistance(x, scale)));
  }
  return values;
}

} // namespace

InitialFunction
moveShape(InitialFunction initial, const Eigen::Array3d& origin)
{
  initial.first -= origin;
  if (initial.kind == InitialKind::Box)
    initial.second -= origin;
  return initial;
}

InitialFunction
turnShape(const InitialFunction& initial, const detail::StretchAxes& axes)
{
  InitialFunction turned = initial;
  if (!axes.areTurned() || !initial.isShape())
    return turned;
  if (initial.kind == InitialKind::Box)
    throw InvalidArgument("initial_box_turned", {});
  turned.first = (axes.getRows() * initial.first.matrix()).array();
  if (initial.kind == InitialKind::Plane)
    turned.second = (axes.getRows() * initial.second.matrix()).array();
  return turned;
}

void
checkParameters(const LevelSetParameters& parameters)
{
  if (!std::isfinite(parameters.isovalue))
    throw InvalidArgument("level_set_without_isovalue", {});
  if (parameters.mu && !(*parameters.mu >= 0.0 && *parameters.mu <= 1.0))
    throw InvalidArgument("mu_out_of_range", {{"mu", *parameters.mu}});
  parameters.initial.check();
  turnShape(parameters.initial, detail::StretchAxes(parameters.rotation));
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(parameters.scale[axis]) || parameters.scale[axis] <= 0.0f)
      throw InvalidArgument("level_set_scale_not_positive",
                            {{"scale", parameters.scale[axis]}});
  const std::size_t least = derivativesOf(parameters.scheme);
  if (parameters.k < least)
    throw InvalidArgument("few_neighbors_for_scheme",
                          {{"neighbors", parameters.k}, {"least", least}});
  if (parameters.max_steps == 0)
    throw InvalidArgument("no_level_set_steps", {});
  if (!(parameters.tolerance > 0.0))
    throw InvalidArgument("level_set_tolerance_not_positive",
                          {{"tolerance", parameters.tolerance}});
  if (parameters.band_width != 0.0 &&
      !(parameters.band_width >= 1.5 * level_set.band_margin))
    throw InvalidArgument("narrow_band", {{"width", parameters.band_width}});
}

LevelSetInput
readInput(const CloudView& cloud,
          const pcl::Indices& indices,
          const LevelSetParameters& parameters,
          unsigned threads,
          Report& report)
{
  detail::checkIndices(indices, cloud.count, "LevelSetEvolution");
  const ScalarField field(cloud.fields, parameters.field);
  const ValueFrame frame = findValueRange(cloud, field, threads).findFrame();
  const auto values = readValues(cloud, field, frame, threads);
  const auto use = pointsWithValue(values, indices, field);
  LevelSetInput input;
  input.samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), use, toPosition(parameters.scale), threads, report);
  report.countSamples("no_value", indices.size() - use.size());
  report.countSamples("samples", input.samples->size());
  if (input.samples->size() <= parameters.k)
    throw InvalidArgument(
        "few_samples_for_stencil",
        {{"samples", input.samples->size()}, {"neighbors", parameters.k}});
  SampleValues scalar = gatherValues(*input.samples, values, threads, report);
  input.f = std::move(scalar.values);
  input.sources = std::move(scalar.sources);
  const auto [low, high] = std::minmax_element(input.f.begin(), input.f.end());
  const double threshold = frame.apply(parameters.isovalue);
  if (!(*low < threshold && threshold <= *high))
    refuseIsovalue(parameters, frame, *low, *high);
  std::vector<float> logarithms;
  if (parameters.isovalue != 0.0) // whose logarithm is beyond all numbers
    logarithms = takeLogarithms(input.f, frame, parameters.isovalue);
  for (float& value : input.f)
    value = static_cast<float>(static_cast<double>(value) - threshold);
  input.is_logarithmic =
      !logarithms.empty() &&
      areLogarithmsSmoother(*input.samples,
                            findCrossing(*input.samples, input.f, threads),
                            input.f,
                            logarithms,
                            threads);
  if (input.is_logarithmic)
    input.f = std::move(logarithms);
  TamedValues tamed =
      tameValues(*input.samples, input.f, parameters.k, threads, report);
  input.crossing = std::move(tamed.crossing);
  input.had_spikes = tamed.had_spikes;
  if (input.crossing.empty())
    throw InvalidArgument("only_outliers_beyond_isovalue",
                          {{"isovalue", describeNumbers({parameters.isovalue})[0]}});
  input.spacing = medianSpacing(*input.samples, input.crossing, parameters.k, threads);
  if (!(input.spacing > 0.0))
    throw InvalidArgument("surface_samples_without_extent", {});
  return input;
}

std::vector<float>
readInitialValues(const CloudView& cloud,
                  const LevelSetInput& input,
                  const LevelSetParameters& parameters)
{
  if (parameters.initial.kind == InitialKind::Field)
    return readField(cloud, input, parameters.initial.field_name);
  if (parameters.initial.isShape())
    return measureShape(cloud, input, parameters);
  return {};
}

} // namespace pcl_uvol
