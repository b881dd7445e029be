// SPDX-License-Identifier: BSD-3-Clause
// The equations of kriging against the textbook's bordered matrix in long double, and
// variograms against what they were made from.
#include "common/random.h"
#include "derivatives/equations.h"
#include "src/interpolation/field_model.h"
#include "src/interpolation/kriging_system.h"
#include "src/interpolation/variogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace test_kriging_system {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using Real = long double;
using MatrixX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using VectorX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/** The variogram by its definition, see VariogramKind. */
Real
correlationOf(VariogramKind kind, Real u)
{
  switch (kind) {
  case VariogramKind::Exponential:
    return std::exp(-u);
  case VariogramKind::Gaussian:
    return std::exp(-u * u);
  case VariogramKind::Matern32:
    return (1.0L + std::sqrt(3.0L) * u) * std::exp(-std::sqrt(3.0L) * u);
  case VariogramKind::Matern52:
    return (1.0L + std::sqrt(5.0L) * u + 5.0L / 3.0L * u * u) *
           std::exp(-std::sqrt(5.0L) * u);
  default:
    return u < 1.0L ? 1.0L - 1.5L * u + 0.5L * u * u * u : 0.0L;
  }
}

struct Case {
  Eigen::MatrixX3d offsets;
  Eigen::VectorXd values;
};

Case
randomCase(Eigen::Index n, std::uint64_t seed)
{
  Case made{Eigen::MatrixX3d(n, 3), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    for (int axis = 0; axis < 3; ++axis)
      made.offsets(i, axis) =
          2.0 * uniformAt(seed, index, static_cast<std::uint64_t>(axis)) - 1.0;
    made.values[i] = 5.0 + uniformAt(seed, index, 3) + made.offsets(i, 0);
  }
  return made;
}

/** Estimate and variance of the mean over some places by the bordered system.
 * \param prior variance of that mean without samples */
std::pair<Real, Real>
krige(const Case& at,
      const Variogram& variogram,
      int trend,
      const Eigen::MatrixX3d& places,
      Real prior)
{
  const auto count = static_cast<Real>(places.rows());
  const Eigen::Index n = at.offsets.rows(), p = trendTerms(trend);
  MatrixX matrix = MatrixX::Zero(n + p, n + p);
  VectorX right = VectorX::Zero(n + p);
  for (Eigen::Index k = 0; k < places.rows(); ++k)
    right.tail(p) +=
        trendAt(places.row(k).transpose(), trend).cast<Real>().transpose() / count;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Real h = (at.offsets.row(i) - at.offsets.row(j)).cast<Real>().norm();
      matrix(i, j) =
          variogram.psill * correlationOf(variogram.kind, h / variogram.range) +
          (i == j ? variogram.nugget : 0.0);
    }
    for (Eigen::Index k = 0; k < places.rows(); ++k) {
      const Real h = (at.offsets.row(i) - places.row(k)).cast<Real>().norm();
      right[i] +=
          variogram.psill * correlationOf(variogram.kind, h / variogram.range) / count;
    }
    const auto terms = trendAt(at.offsets.row(i).transpose(), trend);
    for (Eigen::Index k = 0; k < p; ++k)
      matrix(i, n + k) = matrix(n + k, i) = terms[k];
  }
  const VectorX weights = uvol_test::solve(matrix, right);
  return {weights.head(n).dot(at.values.cast<Real>()), prior - weights.dot(right)};
}

/** Places that are symmetric about the origin. */
Eigen::MatrixX3d
somePlaces()
{
  const Case at = randomCase(6, 11);
  Eigen::MatrixX3d places(12, 3);
  places << 0.3 * at.offsets, -0.3 * at.offsets;
  return places;
}

TEST(KrigingSystem, SolvesTheTextbooksEquations)
{
  for (const auto& word : listWords(VariogramKind()))
    for (const int trend : {0, 1, 2})
      for (const double nugget : {0.0, 0.2}) {
        const Case at = randomCase(24, 7);
        const Variogram variogram{word.value, nugget, 1.5, 1.3};
        for (const KrigingTarget& target :
             {KrigingTarget(variogram), KrigingTarget(variogram, somePlaces())}) {
          const auto [value, variance] =
              krige(at, variogram, trend, target.places, target.variance);
          const KrigingSystem system(at.offsets, variogram, target, trend);
          const KrigingEstimate estimate = system.estimate(at.values);
          // Gaussian covariances are as good as singular.
          const double close = word.value == VariogramKind::Gaussian ? 1e-5 : 1e-9;
          EXPECT_NEAR(estimate.value, static_cast<double>(value), close) << word.word;
          EXPECT_NEAR(estimate.variance, static_cast<double>(variance), close);
        }
      }
}

TEST(KrigingTarget, OfABlockVariesLessThanAValue)
{
  const Variogram variogram{VariogramKind::Exponential, 0.2, 1.5, 1.0};
  EXPECT_EQ(1.7, KrigingTarget(variogram).variance);
  const KrigingTarget small(variogram, 1e-9 * somePlaces()),
      block(variogram, somePlaces());
  EXPECT_NEAR(1.5, small.variance, 1e-6); // a nugget averages out
  EXPECT_LT(block.variance, 1.5);
  EXPECT_GT(block.variance, 0.5);
}

TEST(KrigingSystem, GradientIsTheDerivative)
{
  const Case at = randomCase(20, 8);
  constexpr double step = 1e-6;
  for (const auto& word : listWords(VariogramKind()))
    for (const int trend : {0, 1, 2}) {
      const Variogram variogram{word.value, 0.1, 1.0, 1.1};
      const KrigingTarget target(variogram, somePlaces());
      const auto estimate = [&](const Eigen::MatrixX3d& offsets) {
        return KrigingSystem(offsets, variogram, target, trend).estimate(at.values);
      };
      const Eigen::Vector3d gradient = estimate(at.offsets).gradient;
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::MatrixX3d ahead = at.offsets, behind = at.offsets;
        ahead.col(axis).array() -= step; // the origin moves ahead
        behind.col(axis).array() += step;
        const double slope =
            (estimate(ahead).value - estimate(behind).value) / (2.0 * step);
        EXPECT_NEAR(gradient[axis], slope, 1e-5) << word.word << trend;
      }
    }
}

TEST(KrigingSystem, FewSamplesLowerTheTrend)
{
  for (const Eigen::Index n : {1, 2, 3, 4, 9, 10}) {
    const Case at = randomCase(n, 9);
    const Variogram variogram{VariogramKind::Exponential, 0.0, 1.0, 1.0};
    const KrigingTarget target(variogram);
    const auto estimate =
        KrigingSystem(at.offsets, variogram, target, 2).estimate(at.values);
    EXPECT_TRUE(std::isfinite(estimate.value));
    EXPECT_GE(estimate.variance, 0.0);
  }
}

TEST(Variogram, FitsFindWhatIsThere)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& word : listWords(VariogramKind())) {
    const Variogram truth{word.value, 0.3, 2.0, 0.4};
    EmpiricalVariogram empirical;
    for (int i = 0; i < 21; ++i) {
      const double h = 0.02 * std::pow(1.25, i);
      empirical.distance.push_back(h);
      empirical.value.push_back(truth.value(h));
      empirical.pairs.push_back(100.0);
    }
    const Variogram fitted = fitVariogram(empirical, {word.value, nan, nan, nan});
    EXPECT_NEAR(fitted.nugget, truth.nugget, 1e-3) << word.word;
    EXPECT_NEAR(fitted.psill, truth.psill, 1e-3);
    EXPECT_NEAR(fitted.range, truth.range, 1e-3);
    // What is given stays.
    const Variogram given = fitVariogram(empirical, {word.value, 0.3, nan, 0.4});
    EXPECT_EQ(given.nugget, 0.3);
    EXPECT_DOUBLE_EQ(given.range, 0.4);
    EXPECT_NEAR(given.psill, truth.psill, 1e-9);
  }
}

TEST(Variogram, PairsAlongAnAxisDifferFromItByThirtyDegreesAtMost)
{
  // The field grows along one axis: half the squared difference of a pair is half its
  // squared distance times the squared cosine of the angle to this axis.
  std::vector<float> xyz;
  std::vector<std::uint32_t> use;
  for (std::uint32_t i = 0; i < 500; ++i) {
    use.push_back(i);
    for (int axis = 0; axis < 3; ++axis)
      xyz.push_back(
          static_cast<float>(uniformAt(3, i, static_cast<std::uint64_t>(axis))));
  }
  Report report;
  for (std::size_t grows = 0; grows < 3; ++grows) {
    SampledFields sampled;
    sampled.samples =
        SampleSet::build(xyz.data(), 3, use, {{1.0f, 1.0f, 1.0f}}, 1, report);
    sampled.fields = 1;
    for (const Position& position : sampled.samples->getPositions())
      sampled.values.push_back(position[grows]);
    const EmpiricalVariograms found =
        computeEmpiricalVariograms(sampled, 0, Eigen::Matrix3d::Identity(), 0);
    double pairs = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const EmpiricalVariogram& along = found.along[axis];
      ASSERT_GE(along.distance.size(), 10u);
      for (std::size_t i = 0; i < along.distance.size(); ++i) {
        const double part = along.value[i] / (along.distance[i] * along.distance[i]);
        // Means of squares exceed squares of means a little, within a class.
        if (axis == grows) {
          EXPECT_GT(part, 0.375);
          EXPECT_LT(part, 0.52);
        }
        else
          EXPECT_LT(part, 0.13);
        pairs += along.pairs[i];
      }
    }
    double all = 0.0;
    for (const double count : found.all.pairs)
      all += count;
    // Six caps of 30 degrees are 0.402 of a sphere; of a cube the nearer pairs count.
    EXPECT_NEAR(pairs / all, 6.0 * (1.0 - std::sqrt(0.75)) / 2.0, 0.03);
  }
}

/** 500 samples of a wave in a unit cube. */
SampledFields
sampleWave(std::vector<float> xyz = {})
{
  for (std::uint32_t i = 0; i < 1500; ++i)
    xyz.push_back(static_cast<float>(uniformAt(3, i / 3, i % 3)));
  std::vector<std::uint32_t> use(xyz.size() / 3);
  std::iota(use.begin(), use.end(), 0);
  Report report;
  SampledFields sampled;
  sampled.samples =
      SampleSet::build(xyz.data(), 3, use, {{1.0f, 1.0f, 1.0f}}, 1, report);
  sampled.fields = 1;
  const double factor = static_cast<double>(sampled.samples->getUnit().factor);
  for (const Position& position : sampled.samples->getPositions())
    sampled.values.push_back(std::sin(6.0 * static_cast<double>(position[0]) / factor));
  return sampled;
}

EmpiricalVariogram
variogramOf(const SampledFields& sampled,
            VariogramEstimator estimator = VariogramEstimator::MeanSquare)
{
  return computeEmpiricalVariograms(
             sampled, 0, Eigen::Matrix3d::Identity(), 0, estimator)
      .all;
}

TEST(EmpiricalVariogram, HasNoClassOfFewPairs)
{
  // Two pairs of samples very near to each other, with a wrong value in each.
  SampledFields sampled = sampleWave(
      {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.501f, 0.2f, 0.3f, 0.5f, 0.2f, 0.3f, 0.501f});
  const std::vector<Position>& positions = sampled.samples->getPositions();
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (positions[i][2] == 0.501f * sampled.samples->getUnit().factor)
      sampled.values[i] += 1.0;
  const EmpiricalVariogram found = variogramOf(sampled);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Variogram fitted =
      fitVariogram(found, {VariogramKind::Spherical, nan, nan, nan});
  EXPECT_GE(*std::min_element(found.pairs.begin(), found.pairs.end()), 30.0);
  EXPECT_GT(fitted.range, 1.0); // not the distance of these pairs
}

TEST(EmpiricalVariogram, OfRootsIsThatOfSquaresAndBearsSpikes)
{
  SampledFields sampled = sampleWave();
  for (std::size_t i = 0; i < sampled.values.size(); ++i) {
    double sum = 0.0; // nearly normal, of variance 1
    for (std::uint64_t j = 0; j < 12; ++j)
      sum += uniformAt(5, i, j) - 0.5;
    sampled.values[i] = sum;
  }
  const EmpiricalVariogram square = variogramOf(sampled),
                           root = variogramOf(sampled, VariogramEstimator::MeanRoot);
  for (std::size_t i = 0; i < sampled.values.size(); i += 50)
    sampled.values[i] += 30.0;
  const EmpiricalVariogram spiked = variogramOf(sampled, VariogramEstimator::MeanRoot);
  const EmpiricalVariogram spiked_square = variogramOf(sampled);
  for (std::size_t i = 0; i < root.value.size(); ++i)
    if (root.pairs[i] > 1000.0) {
      EXPECT_NEAR(root.value[i], square.value[i], 0.06 * square.value[i]);
      EXPECT_LT(spiked.value[i], 3.0 * root.value[i]);
      EXPECT_GT(spiked_square.value[i], 10.0 * square.value[i]);
    }
}

} // namespace test_kriging_system
