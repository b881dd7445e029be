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
#include <sstream>
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
  throw NoLevelSet("The isovalue " + texts[0] + " does not part the values of " +
                   parameters.field + ", which are in [" + texts[1] + ", " + texts[2] +
                   "]: there is no surface to evolve.");
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
      throw InvalidArgument("The field " + field.getName() +
                            " that the level set starts from is not finite "
                            "everywhere.");
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
turnShape(const InitialFunction& initial, const detail::StretchAxes& axes)
{
  InitialFunction turned = initial;
  if (!axes.areTurned() || !initial.isShape())
    return turned;
  if (initial.kind == InitialKind::Box)
    throw InvalidArgument("A level set that starts from a box goes without a rotation: "
                          "its sides lie along x, y and z.");
  turned.first = (axes.getRows() * initial.first.matrix()).array();
  if (initial.kind == InitialKind::Plane)
    turned.second = (axes.getRows() * initial.second.matrix()).array();
  return turned;
}

void
checkParameters(const LevelSetParameters& parameters)
{
  const auto fail =
      [](const std::string& what, auto given, const std::string& allowed) {
        std::ostringstream text;
        text << what << " is " << given << ": it must be " << allowed << ".";
        throw InvalidArgument(text.str());
      };
  if (!std::isfinite(parameters.isovalue))
    throw InvalidArgument(
        "LevelSetEvolution has no finite isovalue: call setIsoValue.");
  if (parameters.mu && !(*parameters.mu >= 0.0 && *parameters.mu <= 1.0))
    fail("The weight mu", *parameters.mu, "in [0, 1]");
  parameters.initial.check();
  turnShape(parameters.initial, detail::StretchAxes(parameters.rotation));
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(parameters.scale[axis]) || parameters.scale[axis] <= 0.0f)
      fail("The scale", parameters.scale[axis], "finite and positive");
  const std::size_t least = derivativesOf(parameters.scheme);
  if (parameters.k < least)
    fail("The number of neighbours",
         parameters.k,
         "at least " + std::to_string(least) + " with this scheme");
  if (parameters.max_steps == 0)
    fail("The number of steps", parameters.max_steps, "at least 1");
  if (!(parameters.tolerance > 0.0))
    fail("The tolerance", parameters.tolerance, "above 0");
  if (parameters.band_width != 0.0 &&
      !(parameters.band_width >= 1.5 * level_set.band_margin))
    fail("The width of the band",
         parameters.band_width,
         "at least 3 spacings, or 0 for none");
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
  report.count("no_value", indices.size() - use.size());
  report.count("samples", input.samples->size());
  if (input.samples->size() <= parameters.k)
    throw InvalidArgument("There are " + std::to_string(input.samples->size()) +
                          " distinct samples: a stencil of " +
                          std::to_string(parameters.k) +
                          " neighbours needs at least one more than that.");
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
    throw InvalidArgument("Only outliers lie beyond the isovalue " +
                          describeNumbers({parameters.isovalue})[0] +
                          ", samples unlike all their neighbours: there is no surface "
                          "to evolve. Extract it without smoothing.");
  input.spacing = medianSpacing(*input.samples, input.crossing, parameters.k, threads);
  if (!(input.spacing > 0.0))
    throw InvalidArgument("The samples at the surface have no extent.");
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
