// SPDX-License-Identifier: BSD-3-Clause
// Points whose clusters are known, and how well labels agree with them.
#pragma once

#include "common/random.h"
#include "multivariate/attributes.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace uvol_test {

/** \brief Points, and the cluster of each; -1: noise. */
struct PlantedClusters {
  std::size_t columns;
  std::vector<float> values;
  std::vector<int> labels;
};

/** \brief Normal clusters about corners of a cube of side 12, of standard deviation
 * 0.2, 0.4, 0.6, 0.8 and 700, 600, 500, 400 points, or so many times these, and uniform
 * noise over [-10, 10]. */
inline PlantedClusters
plantClusters(std::size_t columns,
              std::size_t noise,
              std::uint64_t seed,
              std::size_t times = 1)
{
  PlantedClusters planted{columns, {}, {}};
  std::uint64_t index = 0;
  for (int cluster = 0; cluster < 4; ++cluster)
    for (std::size_t i = 0; i < times * (700 - 100 * static_cast<std::size_t>(cluster));
         ++i, ++index) {
      for (std::size_t axis = 0; axis < columns; ++axis) {
        const bool is_up = axis % 3 == 2 ? cluster == 3 : (cluster >> axis % 3) & 1;
        const double number = pcl_uvol::normalAt(seed, index, axis);
        planted.values.push_back(
            static_cast<float>((is_up ? 6.0 : -6.0) + 0.2 * (cluster + 1) * number));
      }
      planted.labels.push_back(cluster);
    }
  for (std::size_t i = 0; i < noise; ++i, ++index) {
    for (std::size_t axis = 0; axis < columns; ++axis)
      planted.values.push_back(
          static_cast<float>(20.0 * pcl_uvol::uniformAt(seed, index, axis) - 10.0));
    planted.labels.push_back(-1);
  }
  return planted;
}

/** \brief All rows as a table. */
inline pcl_uvol::AttributeTable
tableOf(std::size_t columns, const std::vector<float>& values)
{
  pcl_uvol::AttributeTable table;
  for (std::size_t column = 0; column < columns; ++column)
    table.names.push_back("a" + std::to_string(column));
  table.means.assign(columns, 0.0);
  table.units.assign(columns, 1.0);
  table.values = values;
  table.points.resize(values.size() / columns);
  std::iota(table.points.begin(), table.points.end(), 0u);
  return table;
}

/** \brief Adjusted Rand index (Hubert and Arabie 1985) over the points that belong to a
 * true cluster: 1 for the same partition, about 0 for chance. A found label -1 is a
 * class of its own, of one point. */
template <typename Label>
double
adjustedRandIndex(const std::vector<int>& truth, const std::vector<Label>& found)
{
  std::map<int, double> rows, columns;
  std::map<std::pair<int, int>, double> cells;
  int next_class = static_cast<int>(found.size());
  double count = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] < 0)
      continue;
    const int label = found[i] < 0 ? next_class++ : static_cast<int>(found[i]);
    ++rows[truth[i]];
    ++columns[label];
    ++cells[{truth[i], label}];
    ++count;
  }
  const auto pairs_of = [](const auto& sizes) {
    double pairs = 0.0;
    for (const auto& entry : sizes)
      pairs += entry.second * (entry.second - 1.0) / 2.0;
    return pairs;
  };
  const double in_rows = pairs_of(rows), in_columns = pairs_of(columns);
  const double expected = in_rows * in_columns / (count * (count - 1.0) / 2.0);
  return (pairs_of(cells) - expected) / ((in_rows + in_columns) / 2.0 - expected);
}

} // namespace uvol_test
