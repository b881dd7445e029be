// SPDX-License-Identifier: BSD-3-Clause
// Projections of tables that leave nothing to choose, or hold what is easily divided
// by.
#include "multivariate/projections.h"
#include "support/messages.h"
#include "support/star_clusters.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace test_star_coordinates_input {

using namespace pcl_uvol;
using namespace uvol_test;

TEST(StarCoordinatesInput, NoClustersGivePrincipalAxesAndAWarning)
{
  const LabelledTable planted = makeLong();
  for (const std::int32_t label : {-1, 0, 77}) {
    const std::vector<std::int32_t> labels(planted.table.rows(), label);
    Report report;
    const Projection projection =
        starCoordinates(planted.table, labels, StarCoordinateParameters(), 0, report);
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_EQ("few_clusters", report.warnings[0].code);
    EXPECT_EQ(label < 0 ? 0.0 : 1.0, numberOf(report.warnings[0], "clusters"));
    expectSame(projection, principalAxes(planted.table));
    EXPECT_TRUE(std::isinf(smallestFisherRatio(planted.table, labels, projection)));
  }
}

TEST(StarCoordinatesInput, ClustersOfOnePointAreKeptApart)
{
  Planter planter("points", 5);
  const VectorXd ones = VectorXd::Ones(5);
  planter.add(0, 300, VectorXd::Zero(5), ones)
      .add(1, 1, unit(5, 0, 30.0), 0.0 * ones)
      .add(2, 1, unit(5, 1, 30.0), 0.0 * ones)
      .add(3, 1, unit(5, 1, 31.0), 0.0 * ones);
  const LabelledTable& planted = planter.get();
  const Projection projection = optimize(planted);
  expectOrthonormal(projection, 3);
  EXPECT_GT(ratioIn(planted, projection), 500.0);

  // Nothing varies but along the line of the two.
  planter = Planter("two points", 5);
  planter.add(0, 1, VectorXd::Zero(5), 0.0 * ones).add(1, 1, ones, 0.0 * ones);
  const Projection line = optimize(planter.get());
  expectOrthonormal(line, 3);
  EXPECT_NEAR((axesOf(line) * ones).norm(), ones.norm(), 1e-6);
}

TEST(StarCoordinatesInput, EqualCentresAreCounted)
{
  Planter planter("equal", 5);
  const VectorXd none = VectorXd::Zero(5);
  planter.add(0, 2, unit(5, 2, 1.0), none)
      .add(1, 3, unit(5, 2, 1.0), none)
      .add(2, 200, unit(5, 3, 9.0), VectorXd::Ones(5));
  Report report;
  const Projection projection = starCoordinates(
      planter.get().table, planter.get().labels, StarCoordinateParameters(), 0, report);
  EXPECT_EQ(report.getCount("inseparable_pairs"), 1u);
  EXPECT_EQ(ratioIn(planter.get(), projection), 0.0);
  expectOrthonormal(projection, 3);

  planter = Planter("all equal", 5);
  planter.add(0, 2, none, none).add(1, 2, none, none);
  expectOrthonormal(optimize(planter.get()), 3);
  planter.add(2, 2, none, none);
  expectOrthonormal(optimize(planter.get()), 3);
}

TEST(StarCoordinatesInput, FewAttributesLeaveAxesEmpty)
{
  for (Index m = 1; m <= 3; ++m) {
    Planter planter("few", static_cast<std::size_t>(m));
    planter.add(0, 100, VectorXd::Zero(m), VectorXd::Ones(m))
        .add(1, 100, unit(m, m - 1, 8.0), VectorXd::Ones(m))
        .add(2, 100, unit(m, m - 1, -8.0), VectorXd::Ones(m));
    const Projection projection = optimize(planter.get());
    expectOrthonormal(projection, m);
    expectSame(projection, principalAxes(planter.get().table));
    EXPECT_NEAR(ratioIn(planter.get(), projection), 32.0, 8.0);
    const auto place = projection.project(planter.get().table.row(0));
    for (auto k = static_cast<std::size_t>(m); k < 3; ++k)
      EXPECT_EQ(place[k], 0.0f);
  }
}

TEST(StarCoordinatesInput, ConstantColumnsDoNoHarm)
{
  Planter planter("constant", 6);
  VectorXd deviations = VectorXd::Ones(6);
  deviations[2] = deviations[5] = 0.0;
  planter.add(0, 200, unit(6, 2, 5.0), deviations);
  for (Index c = 0; c < 2; ++c)
    planter.add(static_cast<std::int32_t>(c) + 1,
                200,
                unit(6, 2, 5.0) + unit(6, c, 7.0),
                deviations);
  const Projection projection = optimize(planter.get());
  expectOrthonormal(projection, 3);
  EXPECT_GT(ratioIn(planter.get(), projection), 20.0);
  for (const auto& row : projection.rows)
    EXPECT_LT(std::abs(row[2]) + std::abs(row[5]), 1e-6);
}

TEST(StarCoordinatesInput, BadInputIsRefused)
{
  const LabelledTable planted = makeRound();
  std::vector<std::int32_t> labels = planted.labels;
  labels.pop_back();
  StarCoordinateParameters parameters;
  Report report;
  EXPECT_THROW(starCoordinates(planted.table, labels, parameters, 0, report),
               InvalidArgument);
  EXPECT_THROW(smallestFisherRatio(planted.table, labels, principalAxes(planted.table)),
               InvalidArgument);
  EXPECT_THROW(principalAxes(AttributeTable()), InvalidArgument);
  AttributeTable broken = planted.table;
  broken.values.pop_back();
  EXPECT_THROW(principalAxes(broken), InvalidArgument);
  EXPECT_THROW(ratioIn(planted, principalAxes(makeLong().table)), InvalidArgument);
  for (const double bad : {0.0, -1.0, 2.0, std::nan("")}) {
    parameters.regularization = bad;
    EXPECT_THROW(starCoordinates(planted.table, planted.labels, parameters, 0, report),
                 InvalidArgument);
  }
}

} // namespace test_star_coordinates_input
