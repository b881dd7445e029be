// SPDX-License-Identifier: BSD-3-Clause
#include "common/numbers.h"
#include "common/printable.h"
#include "common/records.h"
#include "expressions/derived_source.h"
#include "expressions/evaluation.h"
#include "expressions/operand_names.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/expressions/derived_fields.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace pcl_uvol {

namespace {

/** True if stages know that name without help. */
bool
isScalarField(const Fields& fields, const std::string& name)
{
  try {
    const ScalarField field(fields, name);
    return true;
  }
  catch (const InvalidArgument&) {
    return false;
  }
}

bool
areSame(const Formula& a, const Formula& b)
{
  const auto is_same = [](const Operand& one, const Operand& other) {
    const auto starts_at_same_place = [](const FieldComponent& c,
                                         const FieldComponent& d) {
      return c.offset == d.offset && c.datatype == d.datatype;
    };
    return one.kind == other.kind && one.derivative == other.derivative &&
           one.component == other.component &&
           std::equal(one.components.begin(),
                      one.components.end(),
                      other.components.begin(),
                      other.components.end(),
                      starts_at_same_place) &&
           std::equal(one.arguments.begin(),
                      one.arguments.end(),
                      other.arguments.begin(),
                      other.arguments.end(),
                      areSame);
  };
  return a.program == b.program && std::equal(a.operands.begin(),
                                              a.operands.end(),
                                              b.operands.begin(),
                                              b.operands.end(),
                                              is_same);
}

/** What titles and arrays are called: quotes stay only where the expression means
 * something else without them. */
std::string
nameWithoutQuotes(const Dataset& header, const Formula& formula)
{
  std::string name = formula.text;
  name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
  if (name == formula.text || findField(header.cloud.fields, name))
    return formula.text;
  try {
    return areSame(formula, parseFormula(header, name)) ? name : formula.text;
  }
  catch (const InvalidArgument&) { // it means nothing
    return formula.text;
  }
}

void
checkDerivatives(const Formula& formula, const DerivedFieldOptions& options)
{
  if (!options.no_derivatives.empty() && formula.hasDerivative())
    throw InvalidArgument(
        "no_derivatives",
        {{"field", shortenText(formula.text)}, {"reason", options.no_derivatives}});
}

/** The points with images. */
PeriodicSamples
findImages(const Dataset& dataset,
           const Formula& formula,
           const DerivedFieldOptions& options,
           const ProgressCallback& progress)
{
  Report own; // whoever uses the box tells of it
  own.progress = progress;
  const PeriodicBox box = findPeriodicBox(dataset, options.periodic, own);
  if (!formula.hasCoordinate())
    return addPeriodicImages(dataset,
                             cutAtWidestGap(dataset, box, options.threads),
                             {},
                             options.threads,
                             own);
  // Coordinates are those of the points, and go on beyond the faces.
  PeriodicSamples images = addPeriodicImages(dataset, box, {}, options.threads, own);
  pcl::PCLPointCloud2& cloud = images.samples.cloud;
  const CloudView places = viewOf(cloud);
  for (std::size_t i = 0; i < places.count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      putCoordinate(static_cast<double>(places.xyz(i)[axis]) + box.low[axis],
                    axis,
                    &cloud.data[i * cloud.point_step]);
  return images;
}

std::vector<double>
computeColumn(const Dataset& dataset,
              const Formula& formula,
              Missing missing,
              const DerivedFieldOptions& options,
              std::uint64_t& undefined,
              Report& report)
{
  checkDerivatives(formula, options);
  if (formula.hasDerivative() && !dataset.has_coordinates)
    throw InvalidArgument("derivatives_without_coordinates",
                          {{"field", shortenText(formula.text)}});
  checkPeriodic(options.periodic);
  FormulaPoints points;
  points.own = viewOf(dataset.cloud);
  points.with_images = points.own;
  PeriodicSamples images;
  if (formula.hasDerivative() && isPeriodic(options.periodic)) {
    images = findImages(dataset, formula, options, report.progress);
    points.with_images = viewOf(images.samples.cloud);
    points.image_of = std::move(images.image_of);
  }
  return evaluateFormula(formula, points, missing, options.threads, undefined, report)
      .front();
}

/** Remove the points whose number is 0 or none. */
std::size_t
keepRows(pcl::PCLPointCloud2& cloud, const std::vector<double>& holds)
{
  const std::size_t step = cloud.point_step;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (!(holds[i] != 0.0 && holds[i] == holds[i]))
      continue;
    if (kept != i)
      std::memcpy(&cloud.data[kept * step], &cloud.data[i * step], step);
    ++kept;
  }
  cloud.data.resize(kept * step);
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(kept);
  cloud.row_step = static_cast<pcl::uindex_t>(kept * step);
  return holds.size() - kept;
}

} // namespace

std::optional<Formula>
findFormula(const Dataset& header,
            const std::string& expression,
            const DerivedFieldOptions& options)
{
  const Fields& fields = header.cloud.fields;
  if (expression.empty() || isScalarField(fields, expression))
    return std::nullopt;
  const std::string text(trimmed(expression));
  const bool is_name = !text.empty() && findNameEnd(text, 0) == text.size();
  if (is_name && findComponents(fields, text).empty())
    throw InvalidArgument("unknown_lone_field", valuesOfUnknown(header, text));
  Formula formula = parseFormula(header, text);
  if (const std::size_t width = formula.width(); width > 1)
    throw ExpressionError(
        "several_components", valuesOfComponents(formula.operands.front()), text, 0);
  checkDerivatives(formula, options);
  formula.text = nameWithoutQuotes(header, formula);
  return formula;
}

void
warnOfUndefined(const std::string& expression,
                std::uint64_t undefined,
                std::uint64_t points,
                Report& report)
{
  if (undefined > 0)
    report.warn("undefined_field",
                {{"field", shortenText(expression)},
                 {"undefined", undefined},
                 {"points", points}});
}

std::string
addDerivedField(Dataset& dataset,
                const std::string& expression,
                const DerivedFieldOptions& options,
                Report& report)
{
  const std::string plain = withoutQuotes(dataset.cloud.fields, expression);
  const auto formula = findFormula(dataset, plain, options);
  if (!formula)
    return plain;
  const StepTimer timer(report, "derived_fields");
  std::uint64_t undefined = 0;
  setField(dataset,
           formula->text,
           computeColumn(
               dataset, *formula, Missing::Everything, options, undefined, report));
  warnOfUndefined(formula->text, undefined, dataset.cloud.width, report);
  return formula->text;
}

std::size_t
selectRows(Dataset& dataset,
           const std::string& where,
           const DerivedFieldOptions& options,
           Report& report)
{
  const std::string text(trimmed(where));
  const Formula formula = parseFormula(dataset, text);
  if (!formula.compares)
    throw InvalidArgument("no_comparison", {{"where", shortenText(text)}});
  std::uint64_t undefined = 0;
  return keepRows(
      dataset.cloud,
      computeColumn(
          dataset, formula, Missing::Comparisons, options, undefined, report));
}

} // namespace pcl_uvol
