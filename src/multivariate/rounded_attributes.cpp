// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/rounded_attributes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace pcl_uvol {

namespace {

/** An attribute of fewer values holds classes, or levels of an experiment. */
constexpr std::size_t fewest_values = 8;

/** Numbers of classes, of holes, of dives: rarely more than these, and each may be a
 * cluster. */
constexpr std::size_t most_classes = 32;

/** A column of the table. */
struct Column {
  const AttributeTable& table;
  std::size_t index;

  float
  at(std::size_t row) const
  {
    return table.row(row)[index];
  }
};

/** Values of those clusters that have a single one each. */
std::vector<float>
findSingleValues(const Column& column,
                 const std::vector<std::int32_t>& labels,
                 std::size_t clusters)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<float> lowest(clusters, infinity), highest(clusters, -infinity), singles;
  for (std::size_t row = 0; row < labels.size(); ++row) {
    if (labels[row] < 0)
      continue;
    const auto cluster = static_cast<std::size_t>(labels[row]);
    lowest[cluster] = std::min(lowest[cluster], column.at(row));
    highest[cluster] = std::max(highest[cluster], column.at(row));
  }
  for (std::size_t cluster = 0; cluster < clusters; ++cluster)
    if (lowest[cluster] == highest[cluster])
      singles.push_back(lowest[cluster]);
  return singles;
}

void
sortDistinct(std::vector<float>& values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<float>
findValues(const Column& column)
{
  std::vector<float> values(column.table.rows());
  for (std::size_t row = 0; row < values.size(); ++row)
    values[row] = column.at(row);
  sortDistinct(values);
  return values;
}

/** \param values two or more, sorted */
double
findStep(const std::vector<float>& values)
{
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i)
    step = std::min(step, static_cast<double>(values[i]) - values[i - 1]);
  return step;
}

/** Half or more of the neighbours are a step apart. */
bool
areStepsApart(const std::vector<float>& values, double step)
{
  constexpr double tolerance = 0.01; // floats of standardized values are rounded
  std::size_t apart = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    apart += static_cast<double>(values[i]) - values[i - 1] <= (1.0 + tolerance) * step;
  return 2 * apart + 1 >= values.size();
}

/** As the field had them, before they were standardized. */
bool
areWhole(const Column& column, const std::vector<float>& values)
{
  const double mean = column.table.means[column.index],
               unit = column.table.units[column.index];
  return std::all_of(values.begin(), values.end(), [&](float value) {
    const double scaled = unit * value, number = scaled + mean;
    const double rounding = std::numeric_limits<float>::epsilon() * std::abs(scaled) +
                            1e-12 * std::abs(number);
    return std::abs(number - std::round(number)) <= rounding;
  });
}

bool
mayBeClasses(const Column& column,
             const std::vector<float>& values,
             std::size_t clusters)
{
  return values.size() < fewest_values ||
         (values.size() <= std::max(most_classes, 2 * clusters) &&
          areWhole(column, values));
}

/** Half a sentence; empty where the attribute makes no clusters by rounding. */
std::string
tellSteps(const Column& column,
          const std::vector<std::int32_t>& labels,
          std::size_t clusters)
{
  std::vector<float> singles = findSingleValues(column, labels, clusters);
  const std::size_t single = singles.size();
  sortDistinct(singles);
  if (2 * single < clusters || singles.size() < 2)
    return "";
  const std::vector<float> values = findValues(column);
  const double step = findStep(values);
  if (!areStepsApart(singles, step) || mayBeClasses(column, values, clusters))
    return "";
  std::ostringstream text;
  text.precision(3);
  text << single << " of " << clusters << " clusters have a single value of "
       << column.table.names[column.index] << " each, mostly one step of "
       << step * column.table.units[column.index] << " apart";
  return text.str();
}

} // namespace

void
warnOfRounding(const AttributeTable& table,
               const std::vector<std::int32_t>& labels,
               Report& report)
{
  const std::int32_t last = *std::max_element(labels.begin(), labels.end());
  std::string told;
  for (std::size_t column = 0; column < table.columns() && last > 0; ++column) {
    const std::string text =
        tellSteps({table, column}, labels, static_cast<std::size_t>(last) + 1);
    if (!text.empty())
      told += (told.empty() ? "" : "; ") + text;
  }
  if (!told.empty())
    report.warnings.push_back(
        told + ": if values are rounded, these clusters are steps of rounding. Uniform "
               "noise of up to half a step, added to every rounded attribute, tells "
               "which clusters do not rest on it.");
}

} // namespace pcl_uvol
