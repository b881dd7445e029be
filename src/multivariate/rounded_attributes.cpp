// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/rounded_attributes.h"

#include "multivariate/cluster_moments.h"

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

/** A cluster of which a column has one value. */
struct Single {
  float value;
  std::size_t cluster;
};

/** Sorted by value. */
std::vector<Single>
findSingles(const Column& column,
            const std::vector<std::int32_t>& labels,
            std::size_t clusters)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<float> lowest(clusters, infinity), highest(clusters, -infinity);
  for (std::size_t row = 0; row < labels.size(); ++row) {
    if (labels[row] < 0)
      continue;
    const auto cluster = static_cast<std::size_t>(labels[row]);
    lowest[cluster] = std::min(lowest[cluster], column.at(row));
    highest[cluster] = std::max(highest[cluster], column.at(row));
  }
  std::vector<Single> singles;
  for (std::size_t cluster = 0; cluster < clusters; ++cluster)
    if (lowest[cluster] == highest[cluster])
      singles.push_back({lowest[cluster], cluster});
  std::sort(singles.begin(), singles.end(), [](const Single& a, const Single& b) {
    return a.value != b.value ? a.value < b.value : a.cluster < b.cluster;
  });
  return singles;
}

std::vector<float>
findValues(const Column& column)
{
  std::vector<float> values(column.table.rows());
  for (std::size_t row = 0; row < values.size(); ++row)
    values[row] = column.at(row);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
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

/** Whether clusters overlap in all columns but one: within two standard deviations. */
bool
overlap(const Moments& a, const Moments& b, std::size_t but)
{
  constexpr double deviations = 2.0;
  constexpr double rounding = 1e-6; // where all members have the same value
  const auto deviation = [](const Moments& moments, Eigen::Index column) {
    return std::sqrt(moments.scatter(column, column) / moments.count);
  };
  for (Eigen::Index column = 0; column < a.mean.size(); ++column) {
    const double reach = deviations * (deviation(a, column) + deviation(b, column)) +
                         rounding * std::abs(a.mean[column]);
    if (column != static_cast<Eigen::Index>(but) &&
        std::abs(a.mean[column] - b.mean[column]) > reach)
      return false;
  }
  return true;
}

/** Clusters of one value, and the next value that clusters have. */
struct Neighbors {
  std::vector<Single>::const_iterator begin, middle, end;

  double
  gap() const
  {
    return static_cast<double>(middle->value) - begin->value;
  }
};

std::vector<Neighbors>
pairNeighbors(const std::vector<Single>& singles)
{
  const auto skip = [&](auto single) {
    return std::find_if(single, singles.end(), [&](const Single& other) {
      return other.value != single->value;
    });
  };
  std::vector<Neighbors> pairs;
  auto begin = singles.begin();
  for (auto middle = skip(begin); middle != singles.end();) {
    const auto end = skip(middle);
    pairs.push_back({begin, middle, end});
    begin = middle;
    middle = end;
  }
  return pairs;
}

/** Whether some clusters of neighbours differ in this attribute alone. */
bool
differInNothingElse(const Neighbors& pair,
                    const std::vector<Moments>& moments,
                    std::size_t column)
{
  return std::any_of(pair.begin, pair.middle, [&](const Single& a) {
    return std::any_of(pair.middle, pair.end, [&](const Single& b) {
      return overlap(moments[a.cluster + 1], moments[b.cluster + 1], column);
    });
  });
}

/** Half or more of the neighbours are a step apart, and in no other attribute. */
bool
areStepsApart(const std::vector<Neighbors>& pairs,
              double step,
              const std::vector<Moments>& moments,
              std::size_t column)
{
  constexpr double tolerance = 0.01; // floats of standardized values are rounded
  const auto apart =
      std::count_if(pairs.begin(), pairs.end(), [&](const Neighbors& pair) {
        return pair.gap() <= (1.0 + tolerance) * step &&
               differInNothingElse(pair, moments, column);
      });
  return 2 * static_cast<std::size_t>(apart) >= pairs.size();
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
describeSteps(const Column& column,
              const std::vector<std::int32_t>& labels,
              std::size_t clusters,
              unsigned threads)
{
  const std::vector<Single> singles = findSingles(column, labels, clusters);
  if (2 * singles.size() < clusters || singles.front().value == singles.back().value)
    return "";
  const std::vector<float> values = findValues(column);
  const double step = findStep(values);
  if (mayBeClasses(column, values, clusters) ||
      !areStepsApart(pairNeighbors(singles),
                     step,
                     momentsPerCluster(column.table, labels, threads),
                     column.index))
    return "";
  std::ostringstream text;
  text.precision(3);
  text << singles.size() << " of " << clusters << " clusters have a single value of "
       << column.table.names[column.index] << " each, mostly one step of "
       << step * column.table.units[column.index] << " apart";
  return text.str();
}

} // namespace

void
warnOfRounding(const AttributeTable& table,
               const std::vector<std::int32_t>& labels,
               unsigned threads,
               Report& report)
{
  const std::int32_t last = *std::max_element(labels.begin(), labels.end());
  std::string listed;
  for (std::size_t column = 0; column < table.columns() && last > 0; ++column) {
    const std::string text = describeSteps(
        {table, column}, labels, static_cast<std::size_t>(last) + 1, threads);
    if (!text.empty())
      listed += (listed.empty() ? "" : "; ") + text;
  }
  if (!listed.empty())
    report.warn("clusters_of_rounding", {{"steps", listed}});
}

} // namespace pcl_uvol
