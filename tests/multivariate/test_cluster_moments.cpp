// SPDX-License-Identifier: BSD-3-Clause
// Moments of clusters, and Fisher ratios in subspaces, against sums in long double.
#include "derivatives/equations.h"
#include "src/multivariate/cluster_moments.h"
#include "src/multivariate/cluster_separation.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_cluster_moments {

using namespace pcl_uvol;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Real = long double;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

constexpr std::size_t columns = 5;

/** Three clusters of correlated attributes far from the origin, and noise. */
struct Clusters {
  AttributeTable table;
  std::vector<std::int32_t> labels;

  Clusters()
  {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal;
    for (std::size_t k = 0; k < columns; ++k)
      table.names.push_back("a" + std::to_string(k));
    for (std::uint32_t i = 0; i < 9000; ++i) {
      const auto label = static_cast<std::int32_t>(i % 4) - 1;
      const double common = normal(engine);
      for (std::size_t k = 0; k < columns; ++k)
        table.values.push_back(static_cast<float>(
            1000.0 + 3.0 * label * (k == 1 ? 1.0 : 0.2) + common +
            (1.0 + 0.3 * label) * normal(engine) * static_cast<double>(k + 1)));
      table.points.push_back(i);
      labels.push_back(label < 0 ? label - static_cast<std::int32_t>(i % 3)
                                 : 7 * label);
    }
  }

  /** Rows of one of the four. */
  RealMatrix
  rows(std::size_t cluster) const
  {
    RealMatrix rows(Index(columns), Index(table.rows() / 4));
    for (std::size_t i = cluster, at = 0; i < table.rows(); i += 4, ++at)
      for (std::size_t k = 0; k < columns; ++k)
        rows(Index(k), Index(at)) = table.row(i)[k];
    return rows;
  }
};

RealMatrix
covarianceOf(const RealMatrix& rows)
{
  const RealMatrix centered = rows.colwise() - rows.rowwise().mean();
  return centered * centered.transpose() / static_cast<Real>(rows.cols());
}

TEST(ClusterMoments, AreThoseOfTwoPassesInLongDouble)
{
  const Clusters clusters;
  const auto moments = momentsPerCluster(clusters.table, clusters.labels, 2);
  ASSERT_EQ(4u, moments.size());
  Moments all = moments[0];
  RealMatrix rows(Index(columns), Index(clusters.table.rows()));
  for (std::size_t c = 0; c < 4; ++c) {
    const RealMatrix own = clusters.rows(c);
    rows.middleCols(Index(c) * own.cols(), own.cols()) = own;
    EXPECT_EQ(static_cast<double>(own.cols()), moments[c].count);
    EXPECT_NEAR(
        0.0, (own.rowwise().mean().cast<double>() - moments[c].mean).norm(), 1e-10);
    EXPECT_NEAR(
        0.0, (covarianceOf(own).cast<double>() - moments[c].covariance()).norm(), 1e-9);
    if (c > 0)
      all.join(moments[c]);
  }
  EXPECT_EQ(static_cast<double>(rows.cols()), all.count);
  EXPECT_NEAR(0.0, (rows.rowwise().mean().cast<double>() - all.mean).norm(), 1e-10);
  EXPECT_NEAR(0.0, (covarianceOf(rows).cast<double>() - all.covariance()).norm(), 1e-9);
}

/** Three clusters, and Fisher's ratio of two of them in the space of functionals. */
struct Separated {
  std::vector<Moments> clusters;
  Moments total;
  double regularization = 1e-3;
  ClusterSeparation separation;

  explicit Separated(const Clusters& of)
      : clusters(makeClusters(of))
      , total(joined(clusters))
      , separation(clusters, total, regularization)
  {
  }

  static std::vector<Moments>
  makeClusters(const Clusters& of)
  {
    auto moments = momentsPerCluster(of.table, of.labels, 1);
    moments.erase(moments.begin()); // the noise
    return moments;
  }

  static Moments
  joined(const std::vector<Moments>& clusters)
  {
    Moments all = clusters[0];
    for (std::size_t c = 1; c < clusters.size(); ++c)
      all.join(clusters[c]);
    return all;
  }

  double
  smallestRatio(const MatrixXd& functionals) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < clusters.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        MatrixXd both = clusters[a].covariance() + clusters[b].covariance();
        both.diagonal() += 2.0 * regularization * total.covariance().diagonal();
        const VectorXd offset =
            functionals.transpose() * (clusters[a].mean - clusters[b].mean);
        const MatrixXd inside = functionals.transpose() * both * functionals;
        smallest = std::min(smallest, offset.dot(uvol_test::solve(inside, offset)));
      }
    return smallest;
  }
};

TEST(ClusterSeparation, SmallestRatioIsFishersInTheSubspace)
{
  const Separated separated{Clusters()};
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    MatrixXd functionals(Index(columns), 3);
    for (Index k = 0; k < functionals.size(); ++k)
      functionals.data()[k] = normal(engine);
    const MatrixXd basis = separated.separation.toBasis(functionals);
    EXPECT_NEAR(
        0.0, (basis.transpose() * basis - MatrixXd::Identity(3, 3)).norm(), 1e-9);
    const double expected = separated.smallestRatio(functionals);
    EXPECT_NEAR(expected, separated.separation.smallestRatio(basis), 1e-8 * expected);
    const MatrixXd back = separated.separation.toFunctionals(basis);
    EXPECT_NEAR(expected, separated.smallestRatio(back), 1e-8 * expected);
  }
}

/** Two clusters of one covariance: no subspace beats the one that holds the
 * discriminant, whose ratio is that of all attributes. */
TEST(ClusterSeparation, AscentEndsAtTheBestSubspace)
{
  Separated three{Clusters()};
  const std::vector<Moments> two{three.clusters[0], three.clusters[1]};
  const Moments total = Separated::joined(two);
  const ClusterSeparation separation(two, total, three.regularization);
  MatrixXd both = two[0].covariance() + two[1].covariance();
  both.diagonal() += 2.0 * three.regularization * total.covariance().diagonal();
  const VectorXd offset = two[0].mean - two[1].mean;
  const double best = offset.dot(uvol_test::solve(both, offset));
  MatrixXd start(Index(columns), 3);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (Index k = 0; k < start.size(); ++k)
    start.data()[k] = normal(engine);
  const MatrixXd basis = separation.toBasis(start);
  EXPECT_LT(separation.smallestRatio(basis), 0.99 * best);
  EXPECT_NEAR(
      best, separation.smallestRatio(separation.ascend(basis, 100)), 1e-4 * best);
  EXPECT_NEAR(best, separation.smallestRatio(separation.discriminants()), 1e-9 * best);
}

} // namespace test_cluster_moments
