// SPDX-License-Identifier: BSD-3-Clause
// Clusters that are steps of rounding are told of, and classes are none of these.
#include "common/random.h"
#include "multivariate/cluster_attributes.h"
#include "multivariate/planted_clusters.h"
#include "support/messages.h"
#include <pcl_uvol/multivariate/density_clustering.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace test_rounded_attributes {

using namespace uvol_test;
using pcl_uvol::normalAt;
using pcl_uvol::Report;
using pcl_uvol::uniformAt;

/** Value of a column in a row. */
using Value = std::function<double(std::uint64_t row, std::uint64_t column)>;

double
roundTo(double step, double value)
{
  return step * std::round(value / step);
}

std::vector<float>
makeValues(std::size_t rows, std::size_t columns, const Value& value)
{
  std::vector<float> values;
  for (std::uint64_t row = 0; row < rows; ++row)
    for (std::uint64_t column = 0; column < columns; ++column)
      values.push_back(static_cast<float>(value(row, column)));
  return values;
}

Report
clusterValues(std::size_t columns, const std::vector<float>& values)
{
  Report report;
  pcl_uvol::detail::clusterAttributes(tableOf(columns, values), {}, 0, report);
  return report;
}

/** \param value of x and of intensity, columns 0 and 1 */
Report
clusterCloud(const std::vector<std::string>& attributes,
             std::size_t rows,
             const Value& value,
             bool is_standardized = true)
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (std::uint64_t row = 0; row < rows; ++row) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(value(row, 0));
    point.intensity = static_cast<float>(value(row, 1));
    cloud->push_back(point);
  }
  pcl_uvol::DensityClustering<pcl::PointXYZI> clustering;
  clustering.setInputCloud(cloud);
  clustering.setAttributes(attributes);
  clustering.setStandardized(is_standardized);
  std::vector<int> labels;
  clustering.compute(labels);
  return clustering.getReport();
}

/** What the warnings of rounding tell of attributes. */
std::vector<std::string>
findWarnings(const Report& report)
{
  std::vector<std::string> found;
  for (const pcl_uvol::Message& warning : report.warnings)
    if (warning.code == "clusters_of_rounding")
      found.push_back(uvol_test::wordOf(warning, "steps"));
  return found;
}

bool
hasAll(const std::string& steps, const std::vector<std::string>& words)
{
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return steps.find(word) != std::string::npos;
  });
}

/** Contents of two metals, of which one is small and written with few digits. */
double
assay(std::uint64_t row, std::uint64_t column)
{
  const double rock = normalAt(1, row, 0), own = normalAt(1, row, column + 1);
  return (column == 0 ? 0.3 : 0.05) * std::exp(0.6 * rock + 0.3 * own);
}

TEST(RoundedAttributes, StepsOfNoiseAreReported)
{
  const auto report = clusterValues(1, makeValues(5000, 1, [](auto row, auto column) {
                                      return roundTo(0.1, uniformAt(1, row, column));
                                    }));
  EXPECT_EQ(11u, report.getCount("clusters"));
  const auto warnings = findWarnings(report);
  ASSERT_EQ(1u, warnings.size());
  EXPECT_TRUE(hasAll(warnings[0], {"11 of 11", " a0 ", " 0.1 "})) << warnings[0];
}

TEST(RoundedAttributes, AreReportedByNameUntilNoiseSpreadsThem)
{
  const Value rounded = [](auto row, auto column) {
    return roundTo(0.01, assay(row, column));
  };
  const auto warnings = findWarnings(clusterCloud({"x", "intensity"}, 20000, rounded));
  ASSERT_EQ(1u, warnings.size());
  EXPECT_TRUE(hasAll(warnings[0], {" intensity ", " 0.01 "})) << warnings[0];
  EXPECT_FALSE(hasAll(warnings[0], {" x "})) << warnings[0];
  const auto spread =
      clusterCloud({"x", "intensity"}, 20000, [&](auto row, auto column) {
        return rounded(row, column) + 0.01 * (uniformAt(7, row, column) - 0.5);
      });
  EXPECT_TRUE(findWarnings(spread).empty());
  EXPECT_LE(spread.getCount("clusters"), 1u);
}

TEST(RoundedAttributes, SeveralAreReportedTogether)
{
  const auto report = clusterValues(2, makeValues(50000, 2, [](auto row, auto column) {
                                      return roundTo(0.1, uniformAt(1, row, column));
                                    }));
  const auto warnings = findWarnings(report);
  ASSERT_EQ(1u, warnings.size());
  EXPECT_TRUE(hasAll(warnings[0], {" a0 ", " 0.1 ", " a1 "})) << warnings[0];
}

TEST(RoundedAttributes, StepsAreReportedInUnitsOfTheField)
{
  for (const bool is_standardized : {true, false}) {
    const auto report = clusterCloud(
        {"intensity"},
        5000,
        [](auto row, auto) {
          return 1000.0 + roundTo(2.5, 40.0 * uniformAt(1, row, 0));
        },
        is_standardized);
    const auto warnings = findWarnings(report);
    ASSERT_EQ(1u, warnings.size());
    EXPECT_TRUE(hasAll(warnings[0], {" 2.5 "})) << warnings[0];
  }
}

TEST(RoundedAttributes, WholeNumbersOfManyMoreValuesThanClustersAreRounded)
{
  const auto report = clusterValues(1, makeValues(5000, 1, [](auto row, auto) {
                                      return std::round(100.0 * assay(row, 1));
                                    }));
  EXPECT_EQ(1u, findWarnings(report).size()) << report.getCount("clusters");
}

/** Coarser than the points lie, rounding joins values to patches of chance: that they
 * tell little is said by the share of noise. */
TEST(RoundedAttributes, PatchesOfManyValuesAreNoSteps)
{
  const auto report = clusterValues(2, makeValues(5000, 2, [](auto row, auto column) {
                                      return roundTo(0.01, uniformAt(5, row, column));
                                    }));
  EXPECT_TRUE(findWarnings(report).empty());
  EXPECT_EQ(1u, report.warnings.size());
}

/** Four planted clusters and noise; one more column of the label. */
Report
clusterWith(const std::function<double(std::uint64_t row, int label)>& value)
{
  const auto planted = plantClusters(3, 400, 1);
  std::vector<float> values;
  for (std::size_t row = 0; row < planted.labels.size(); ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      values.push_back(
          static_cast<float>(roundTo(0.01, planted.values[3 * row + column])));
    values.push_back(static_cast<float>(value(row, planted.labels[row])));
  }
  return clusterValues(4, values);
}

TEST(RoundedAttributes, ClassesOfClustersAreNone)
{
  const auto draw = [](std::uint64_t row, double classes) {
    return std::floor(classes * uniformAt(3, row, 0));
  };
  for (const double classes : {4.0, 20.0})
    for (const double level : {1.0, 100.0}) {
      const auto report = clusterWith([&](auto row, int label) {
        return level * (label < 0 ? draw(row, classes) : label);
      });
      EXPECT_GE(report.getCount("clusters"), 4u);
      EXPECT_TRUE(findWarnings(report).empty()) << classes << ' ' << level;
    }
}

TEST(RoundedAttributes, ConstantsOfClustersAreNone)
{
  constexpr double constants[] = {0.37, 1.91, 2.23, 4.02};
  const auto report = clusterWith([&](auto row, int label) {
    return label < 0 ? 5.0 * uniformAt(3, row, 0) : constants[label];
  });
  EXPECT_GE(report.getCount("clusters"), 4u);
  EXPECT_TRUE(findWarnings(report).empty());
  EXPECT_TRUE(findWarnings(clusterWith([](auto row, int) {
                return 5.0 * uniformAt(3, row, 0);
              })).empty());
}

/** Settings of an experiment are steps, too, but of clusters that lie apart anyway. */
TEST(RoundedAttributes, LevelsOfClustersThatLieApartAreNone)
{
  const auto report = clusterValues(2, makeValues(6000, 2, [](auto row, auto column) {
                                      const auto level = static_cast<double>(row % 12);
                                      return column == 0
                                                 ? 0.5 * level
                                                 : 9.0 * level + normalAt(1, row, 0);
                                    }));
  EXPECT_EQ(12u, report.getCount("clusters"));
  EXPECT_TRUE(findWarnings(report).empty());
}

/** As many as there are clusters: numbers of holes, of dives. */
TEST(RoundedAttributes, NumbersOfManyGroupsAreNone)
{
  const auto report = clusterValues(1, makeValues(8000, 1, [](auto row, auto) {
                                      return 300.0 + static_cast<double>(row % 40);
                                    }));
  EXPECT_EQ(40u, report.getCount("clusters"));
  EXPECT_TRUE(findWarnings(report).empty());
}

} // namespace test_rounded_attributes
