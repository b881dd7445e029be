// SPDX-License-Identifier: BSD-3-Clause
// Projections of planted clusters: that they keep apart what principal axes do not,
// what form they have, and what they do with tables that leave nothing to choose.
#include "common/random.h"
#include "multivariate/projections.h"
#include "support/star_clusters.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>

namespace test_star_coordinates {

using namespace pcl_uvol;
using namespace uvol_test;

/** Places of the rows of a cluster, as columns. */
MatrixXd
collectPlaces(const LabelledTable& planted,
              const Projection& projection,
              std::int32_t label)
{
  std::vector<std::array<float, 3>> places;
  for (std::size_t row = 0; row < planted.labels.size(); ++row)
    if (planted.labels[row] == label)
      places.push_back(projection.project(planted.table.row(row)));
  return Eigen::Map<const Eigen::MatrixXf>(
             &places[0][0], 3, static_cast<Index>(places.size()))
      .cast<double>();
}

/** The smallest ratio, from the definition. */
double
ratioOfPlaces(const LabelledTable& planted, const Projection& projection)
{
  std::vector<std::int32_t> labels = planted.labels;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::int32_t a : labels)
    for (const std::int32_t b : labels) {
      if (a < 0 || b <= a)
        continue;
      Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
      Eigen::Vector3d offset = Eigen::Vector3d::Zero();
      for (const std::int32_t label : {a, b}) {
        const MatrixXd places = collectPlaces(planted, projection, label);
        const Eigen::Vector3d centre = places.rowwise().mean();
        spread += computeScatter(places) / static_cast<double>(places.cols());
        offset += label == a ? centre : Eigen::Vector3d(-centre);
      }
      smallest = std::min(smallest, offset.dot(spread.inverse() * offset));
    }
  return smallest;
}

TEST(StarCoordinates, KeepClustersFartherApartThanPrincipalAxes)
{
  int clearly = 0;
  for (const LabelledTable& planted : allPlanted()) {
    const double principal = ratioIn(planted, principalAxes(planted.table));
    const double optimized = ratioIn(planted, optimize(planted));
    std::cout << planted.name << ": principal axes " << principal << ", optimized "
              << optimized << "\n";
    EXPECT_GE(optimized, principal * (1.0 - 1e-9)) << planted.name;
    clearly += optimized > 1.5 * principal ? 1 : 0;
  }
  EXPECT_GE(clearly, 4);
}

TEST(StarCoordinates, FindWhatNoiseHides)
{
  // Squared distance 25 in units of twice the variance 1.
  EXPECT_GT(ratioIn(makeNoisy(), optimize(makeNoisy())), 11.0);
  EXPECT_LT(ratioIn(makeNoisy(), principalAxes(makeNoisy().table)), 1.0);
}

TEST(StarCoordinates, AscentGainsOnTheStarts)
{
  const LabelledTable planted = makeMany();
  StarCoordinateParameters parameters;
  Report report;
  const double ascended = ratioIn(
      planted, starCoordinates(planted.table, planted.labels, parameters, 0, report));
  parameters.steps = 0;
  const double start = ratioIn(
      planted, starCoordinates(planted.table, planted.labels, parameters, 0, report));
  EXPECT_GT(ascended, 1.5 * start);
  EXPECT_GE(start, ratioIn(planted, principalAxes(planted.table)));
}

TEST(StarCoordinates, NoDirectionAtRandomIsBetter)
{
  // A maximum, if a local one: small turns in any direction do not gain.
  const LabelledTable planted = makeMany();
  const Projection projection = optimize(planted);
  const double best = ratioIn(planted, projection);
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Projection turned = projection;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 10; ++i)
        turned.rows[k][i] += 0.02 * normalAt(trial, k, i);
    EXPECT_LT(ratioIn(planted, turned), best * 1.01);
  }
}

TEST(StarCoordinates, RatioIsThatOfTheProjectedPoints)
{
  for (const LabelledTable& planted : allPlanted())
    for (const Projection& projection :
         {optimize(planted), principalAxes(planted.table)}) {
      const double expected = ratioOfPlaces(planted, projection);
      EXPECT_NEAR(ratioIn(planted, projection), expected, 1e-4 * expected)
          << planted.name;
    }
}

TEST(StarCoordinates, TwoClustersGetTheirDiscriminant)
{
  const MatrixXd rotation = mixing(6);
  VectorXd deviations(6);
  deviations << 0.2, 9.0, 9.0, 9.0, 1.0, 1.0;
  const MatrixXd root = rotation * deviations.asDiagonal();
  Planter planter("two", 6);
  planter.addMixed(3, 5000, VectorXd::Zero(6), root)
      .addMixed(8, 5000, rotation * VectorXd::Ones(6), root);
  const LabelledTable& planted = planter.get();
  const Projection projection = optimize(planted);
  // d^T (2 S)^-1 d in all dimensions.
  const double expected = 0.5 * deviations.array().square().inverse().sum();
  EXPECT_NEAR(ratioIn(planted, projection), expected, 0.05 * expected);
  const VectorXd discriminant =
      (rotation * deviations.array().square().inverse().matrix()).normalized();
  const Eigen::Vector3d in_space = axesOf(projection) * discriminant;
  EXPECT_GT(in_space.norm(), 0.999);
  // The other axes show what varies most: one of the three noisy directions each.
  EXPECT_GT((axesOf(projection) * rotation.middleCols(1, 3)).norm(), 1.39);
  expectOrthonormal(projection, 3);
}

TEST(StarCoordinates, RowsAreOrthonormalAndPointOneWay)
{
  for (const LabelledTable& planted : allPlanted())
    for (const Projection& projection :
         {optimize(planted), principalAxes(planted.table)}) {
      expectOrthonormal(projection, 3);
      for (const auto& row : projection.rows) {
        const auto range = std::minmax_element(row.begin(), row.end());
        EXPECT_GT(*range.second, -*range.first) << planted.name;
      }
    }
}

TEST(StarCoordinates, FirstAxisCarriesMostOfTheCentres)
{
  for (const LabelledTable& planted : allPlanted()) {
    const Projection projection = optimize(planted);
    std::vector<std::int32_t> labels = planted.labels;
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    labels.erase(std::remove(labels.begin(), labels.end(), -1), labels.end());
    MatrixXd centres(3, static_cast<Index>(labels.size()));
    for (std::size_t c = 0; c < labels.size(); ++c)
      centres.col(static_cast<Index>(c)) =
          collectPlaces(planted, projection, labels[c]).rowwise().mean();
    const MatrixXd spread = computeScatter(centres);
    EXPECT_GE(spread(0, 0), spread(1, 1)) << planted.name;
    EXPECT_GE(spread(1, 1), spread(2, 2)) << planted.name;
    EXPECT_LT(std::abs(spread(0, 1)), 1e-3 * spread(0, 0)) << planted.name;
  }
}

TEST(StarCoordinates, PrincipalAxesAreThoseOfTheCovariance)
{
  const LabelledTable planted = makeLong();
  const MatrixXd values =
      Eigen::Map<const Eigen::MatrixXf>(
          planted.table.values.data(), 8, static_cast<Index>(planted.table.rows()))
          .cast<double>();
  const VectorXd mean = values.rowwise().mean();
  const MatrixXd eigenvectors = computeEigenvectors(computeScatter(values));
  const Projection projection = principalAxes(planted.table);
  const MatrixXd axes = axesOf(projection);
  for (Index k = 0; k < 3; ++k)
    EXPECT_NEAR(std::abs(axes.row(k).dot(eigenvectors.col(7 - k))), 1.0, 1e-9);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(projection.mean[i], mean[static_cast<Index>(i)], 1e-9);
  const auto place = projection.project(planted.table.row(17));
  const VectorXd expected = axes * (values.col(17) - mean);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(place[k], expected[static_cast<Index>(k)], 1e-5);
}

TEST(StarCoordinates, LargeOffsetsLoseNoDigits)
{
  LabelledTable planted = makeNoisy();
  const double ratio = ratioIn(planted, optimize(planted));
  for (std::size_t i = 0; i < planted.table.values.size(); i += 6)
    planted.table.values[i] += 4096.0f;
  EXPECT_NEAR(ratioIn(planted, optimize(planted)), ratio, 1e-3 * ratio);
}

TEST(StarCoordinates, UnitsOfAttributesDoNotCount)
{
  LabelledTable planted = makeNoisy();
  const double ratio = ratioIn(planted, optimize(planted));
  for (std::size_t i = 0; i < planted.table.values.size(); i += 6)
    planted.table.values[i] *= 1048576.0f;
  EXPECT_NEAR(ratioIn(planted, optimize(planted)), ratio, 1e-3 * ratio);
}

TEST(StarCoordinates, AnyNumberOfThreadsGivesTheSameBytes)
{
  for (const LabelledTable& planted : allPlanted()) {
    StarCoordinateParameters parameters;
    Report report;
    const Projection one =
        starCoordinates(planted.table, planted.labels, parameters, 1, report);
    const Projection axes = principalAxes(planted.table, 1);
    const double ratio =
        smallestFisherRatio(planted.table, planted.labels, one, parameters, 1);
    for (const unsigned threads : {2u, 3u, 8u}) {
      expectSame(
          one,
          starCoordinates(planted.table, planted.labels, parameters, threads, report));
      expectSame(axes, principalAxes(planted.table, threads));
      EXPECT_EQ(
          ratio,
          smallestFisherRatio(planted.table, planted.labels, one, parameters, threads));
    }
  }
}

TEST(StarCoordinates, OrderOfRowsDoesNotMatter)
{
  for (const LabelledTable& planted : allPlanted()) {
    std::vector<std::uint32_t> order(planted.table.rows());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [](auto a, auto b) {
      return mixBits(a) < mixBits(b);
    });
    LabelledTable mixed{planted.name, {planted.table.names, {}, {}}, {}};
    for (const std::uint32_t row : order) {
      const float* values = planted.table.row(row);
      mixed.table.values.insert(
          mixed.table.values.end(), values, values + planted.table.columns());
      mixed.table.points.push_back(planted.table.points[row]);
      mixed.labels.push_back(planted.labels[row]);
    }
    // The ascent ends near a maximum, and rounding decides where.
    const Projection projection = optimize(planted), again = optimize(mixed);
    EXPECT_LT((axesOf(projection) - axesOf(again)).cwiseAbs().maxCoeff(), 1e-2)
        << planted.name;
    const double ratio = ratioIn(planted, projection);
    EXPECT_NEAR(ratioIn(mixed, again), ratio, 1e-3 * ratio) << planted.name;
    EXPECT_NEAR(ratioIn(mixed, projection), ratio, 1e-9 * ratio) << planted.name;
  }
}

} // namespace test_star_coordinates
