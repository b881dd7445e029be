// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/attributes.h"

#include "common/parallel.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** Values of a block of a parallel loop: sums are made block by block. */
constexpr std::size_t block_points = 1u << 12;

/** A column on its way to the table. */
struct Attribute {
  std::string name;
  std::vector<double> values; // per point to be used
};

/** Rows of points with a finite value of every attribute. */
using Rows = std::vector<std::uint32_t>;

bool
areSame(const ScalarField& a, const ScalarField& b)
{
  const auto& of_a = a.getComponents();
  const auto& of_b = b.getComponents();
  return a.isLength() == b.isLength() &&
         std::equal(of_a.begin(),
                    of_a.end(),
                    of_b.begin(),
                    of_b.end(),
                    [](const FieldComponent& x, const FieldComponent& y) {
                      return x.offset == y.offset && x.datatype == y.datatype;
                    });
}

std::vector<ScalarField>
resolveFields(const CloudView& cloud, const std::vector<std::string>& names)
{
  if (names.empty())
    throw InvalidArgument("no_attributes", {{"fields", describeFields(cloud.fields)}});
  std::vector<ScalarField> fields;
  for (const std::string& name : names) {
    const ScalarField field(cloud.fields, name);
    for (const ScalarField& other : fields)
      if (areSame(field, other))
        throw InvalidArgument("same_attributes",
                              {{"attribute", shortenText(other.getName())},
                               {"other", shortenText(name)}});
    fields.push_back(field);
  }
  return fields;
}

/** What single precision cannot hold is missing. */
double
usableValue(double value, bool keeps_double)
{
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
    return std::numeric_limits<double>::quiet_NaN();
  return keeps_double ? value : rounded;
}

std::vector<Attribute>
readColumns(const CloudView& cloud,
            const std::vector<std::uint32_t>& use,
            const std::vector<std::string>& names,
            bool keeps_double,
            unsigned threads)
{
  const std::vector<ScalarField> fields = resolveFields(cloud, names);
  std::vector<Attribute> attributes;
  attributes.reserve(names.size());
  for (const std::string& name : names)
    attributes.push_back({name, std::vector<double>(use.size())});
  parallelBlocks(use.size(), block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t column = 0; column < fields.size(); ++column)
        attributes[column].values[i] =
            usableValue(fields[column].read(cloud.point(use[i])), keeps_double);
  });
  return attributes;
}

Rows
completeRows(const std::vector<Attribute>& attributes,
             std::size_t count,
             unsigned threads)
{
  return parallelGather<std::uint32_t>(
      count, block_points, threads, [&](auto begin, auto end, Rows& rows) {
        for (std::size_t i = begin; i < end; ++i)
          if (std::all_of(attributes.begin(), attributes.end(), [&](const auto& a) {
                return std::isfinite(a.values[i]);
              }))
            rows.push_back(static_cast<std::uint32_t>(i));
      });
}

bool
isConstant(const Attribute& attribute, const Rows& rows)
{
  return std::all_of(rows.begin(), rows.end(), [&](std::uint32_t row) {
    return attribute.values[row] == attribute.values[rows.front()];
  });
}

/** Leave out attributes that are the same in all rows, whose missing values cost no
 * point then. */
Rows
dropConstants(std::vector<Attribute>& attributes,
              std::size_t count,
              unsigned threads,
              Report& report)
{
  for (;;) {
    Rows rows = completeRows(attributes, count, threads);
    if (rows.empty())
      throw InvalidArgument("no_complete_point", {{"points", count}});
    const auto constant =
        std::stable_partition(attributes.begin(), attributes.end(), [&](const auto& a) {
          return !isConstant(a, rows);
        });
    if (constant == attributes.end())
      return rows;
    for (auto attribute = constant; attribute != attributes.end(); ++attribute)
      report.warn("constant_attribute", {{"attribute", attribute->name}});
    attributes.erase(constant, attributes.end());
    if (attributes.empty())
      throw InvalidArgument("only_constant_attributes", {});
  }
}

/** Sum over rows, in blocks. */
template <typename Term>
double
sumOver(const Rows& rows, unsigned threads, const Term& term)
{
  const auto parts = parallelGather<double>(
      rows.size(), block_points, threads, [&](auto begin, auto end, auto& part) {
        double sum = 0.0;
        for (std::size_t i = begin; i < end; ++i)
          sum += term(rows[i]);
        part.push_back(sum);
      });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

/** \return mean and standard deviation */
std::pair<double, double>
standardize(Attribute& attribute, const Rows& rows, unsigned threads)
{
  std::vector<double>& values = attribute.values;
  const auto count = static_cast<double>(rows.size());
  const double mean =
      sumOver(rows, threads, [&](std::uint32_t row) { return values[row]; }) / count;
  const double variance = sumOver(rows,
                                  threads,
                                  [&](std::uint32_t row) {
                                    return (values[row] - mean) * (values[row] - mean);
                                  }) /
                          count;
  const double deviation = std::sqrt(variance);
  for (double& value : values)
    value = (value - mean) / deviation;
  return {mean, deviation};
}

} // namespace

AttributeTable
readAttributes(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               const std::vector<std::string>& names,
               bool is_standardized,
               unsigned threads,
               Report& report)
{
  const StepTimer step(report, "attributes");
  std::vector<Attribute> attributes =
      readColumns(cloud, use, names, is_standardized, threads);
  if (use.empty())
    throw InvalidArgument("attributes_of_empty_cloud", {});
  const Rows rows = dropConstants(attributes, use.size(), threads, report);
  report.count("missing_values", use.size() - rows.size());
  AttributeTable table;
  for (Attribute& attribute : attributes) {
    const auto [mean, unit] =
        is_standardized ? standardize(attribute, rows, threads) : std::pair(0.0, 1.0);
    table.means.push_back(mean);
    table.units.push_back(unit);
    table.names.push_back(attribute.name);
  }
  table.points.resize(rows.size());
  table.values.resize(rows.size() * table.columns());
  parallelBlocks(rows.size(), block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      table.points[i] = use[rows[i]];
      for (std::size_t column = 0; column < table.columns(); ++column)
        table.values[i * table.columns() + column] =
            static_cast<float>(attributes[column].values[rows[i]]);
    }
  });
  return table;
}

} // namespace pcl_uvol
