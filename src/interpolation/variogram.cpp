// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/variogram.h"

#include "common/eigen_solvers.h"
#include "interpolation/field_model.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Samples out of all parts of a cloud, all pairs of which count. */
constexpr std::size_t most_centers = 600;

/** Nearest samples of each of them that make pairs with it: short distances. */
constexpr std::size_t near_samples = 32;

/** Classes of distance. Twice as wide as the one before every few of them: what is near
 * matters to estimates. */
constexpr std::size_t classes = 24;

/** Share of the diagonal of the cloud's box: farther pairs are few and from its ends.
 */
constexpr double farthest_part = 1.0 / 3.0;

/** Between the bounds of the nearest class and the farthest one, at least. */
constexpr double least_spread = 1e-3;

/** Pairs that a class has at least, for its mean to mean something (Journel and
 * Huijbregts, Mining Geostatistics, 1978, section III.B.3). */
constexpr double least_pairs = 30.0;

/** Where there are few pairs in all, a class has at least that share of them: six
 * classes tell nugget, sill and range apart. */
constexpr double least_share = 1.0 / 6.0;

/** Ranges that are tried, and times that weights are made anew. */
constexpr int tried_ranges = 64, refinements = 24, rounds = 4;

double
correlation(VariogramKind kind, double u)
{
  switch (kind) {
  case VariogramKind::Exponential:
    return std::exp(-u);
  case VariogramKind::Gaussian:
    return std::exp(-u * u);
  case VariogramKind::Matern32:
    return (1.0 + std::sqrt(3.0) * u) * std::exp(-std::sqrt(3.0) * u);
  case VariogramKind::Matern52:
    return (1.0 + std::sqrt(5.0) * u + 5.0 / 3.0 * u * u) *
           std::exp(-std::sqrt(5.0) * u);
  default:
    return u < 1.0 ? 1.0 - u * (1.5 - 0.5 * u * u) : 0.0;
  }
}

/** The derivative of the correlation, divided by u. */
double
correlationSlope(VariogramKind kind, double u)
{
  switch (kind) {
  case VariogramKind::Exponential:
    return -std::exp(-u) / u;
  case VariogramKind::Gaussian:
    return -2.0 * std::exp(-u * u);
  case VariogramKind::Matern32:
    return -3.0 * std::exp(-std::sqrt(3.0) * u);
  case VariogramKind::Matern52:
    return -5.0 / 3.0 * (1.0 + std::sqrt(5.0) * u) * std::exp(-std::sqrt(5.0) * u);
  default:
    return u < 1.0 ? -1.5 / u + 1.5 * u : 0.0;
  }
}

Vector3d
positionOf(const SampledFields& sampled, std::size_t sample)
{
  const Position& position = sampled.samples->getPositions()[sample];
  return {position[0], position[1], position[2]};
}

/** Values of a field at some samples, less their trend. */
class Residuals {
public:
  Residuals(const SampledFields& sampled,
            std::size_t field,
            const std::vector<std::size_t>& centers,
            int trend)
      : sampled_(sampled)
      , field_(field)
      , trend_(trend)
      , middle_(Vector3d::Zero())
  {
    for (const std::size_t center : centers)
      middle_ += positionOf(sampled, center);
    middle_ /= static_cast<double>(centers.size());
    Eigen::MatrixXd terms(static_cast<Eigen::Index>(centers.size()), trendTerms(trend));
    Eigen::VectorXd values(terms.rows());
    for (Eigen::Index i = 0; i < terms.rows(); ++i) {
      const std::size_t center = centers[static_cast<std::size_t>(i)];
      terms.row(i) = trendAt(positionOf(sampled, center) - middle_, trend);
      values[i] = sampled.valuesOf(center)[field];
    }
    coefficients_ = terms.completeOrthogonalDecomposition().solve(values);
  }

  double
  operator[](std::size_t sample) const
  {
    const double value = sampled_.valuesOf(sample)[field_];
    return trend_ == 0 ? value
                       : value - trendAt(positionOf(sampled_, sample) - middle_, trend_)
                                     .dot(coefficients_);
  }

private:
  const SampledFields& sampled_;
  std::size_t field_;
  int trend_;
  Vector3d middle_;
  Eigen::VectorXd coefficients_;
};

/** Cosine of 30 degrees: pairs that are counted along an axis differ from it by less.
 */
constexpr double along_axis = 0.8660254037844386;

/** Two samples. */
struct Pair {
  double distance, half_square;
  int axis; ///< along which they lie; -1: none
};

int
findAxis(const Vector3d& offset, double distance)
{
  Eigen::Index axis = 0;
  const double longest = offset.cwiseAbs().maxCoeff(&axis);
  return longest > along_axis * distance ? static_cast<int>(axis) : -1;
}

/** The pairs along an axis, or all for -1, by their distance. */
EmpiricalVariogram
classify(const std::vector<Pair>& pairs,
         double nearest,
         double farthest,
         int axis,
         VariogramEstimator estimator)
{
  std::array<double, classes> distance{}, value{}, count{};
  for (const Pair& pair : pairs) {
    if (pair.distance > farthest || (axis >= 0 && pair.axis != axis))
      continue;
    const double part = std::log(pair.distance / nearest) /
                        std::max(std::log(farthest / nearest), 1e-9);
    const auto index = static_cast<std::size_t>(
        std::clamp(part * classes, 0.0, static_cast<double>(classes - 1)));
    distance[index] += pair.distance;
    value[index] += estimator == VariogramEstimator::MeanSquare
                        ? pair.half_square
                        : std::pow(2.0 * pair.half_square, 0.25);
    count[index] += 1.0;
  }
  const auto join = [&](std::size_t from, std::size_t to) {
    for (auto* const sum : {&distance, &value, &count})
      (*sum)[to] += std::exchange((*sum)[from], 0.0);
  };
  // Classes with few pairs join the next one, and the farthest ones the one before.
  const double all = std::accumulate(count.begin(), count.end(), 0.0);
  const double least = std::min(least_pairs, least_share * all);
  for (std::size_t i = 0; i + 1 < classes; ++i)
    if (count[i] < least)
      join(i, i + 1);
  for (std::size_t i = classes; --i > 0;)
    if (count[i] > 0.0 && count[i] < least)
      join(i, i - 1);
  EmpiricalVariogram empirical;
  for (std::size_t i = 0; i < classes; ++i)
    if (count[i] > 0.0) {
      empirical.distance.push_back(distance[i] / count[i]);
      const double mean = value[i] / count[i];
      empirical.value.push_back(estimator == VariogramEstimator::MeanSquare
                                    ? mean
                                    : 0.5 * std::pow(mean, 4.0) /
                                          (0.457 + 0.494 / count[i]));
      empirical.pairs.push_back(count[i]);
    }
  return empirical;
}

/** Nugget and sill that fit best for a range, and how well. */
struct LinearFit {
  double nugget, psill, misfit;
};

LinearFit
fitLevels(const EmpiricalVariogram& empirical,
          const std::vector<double>& weights,
          const Variogram& given,
          double range)
{
  const bool has_nugget = !std::isnan(given.nugget),
             has_sill = !std::isnan(given.psill);
  double ww = 0.0, ws = 0.0, ss = 0.0, wv = 0.0, sv = 0.0;
  std::vector<double> shape(empirical.distance.size());
  for (std::size_t i = 0; i < shape.size(); ++i) {
    shape[i] = 1.0 - correlation(given.kind, empirical.distance[i] / range);
    const double v = empirical.value[i], w = weights[i];
    ww += w;
    ws += w * shape[i];
    ss += w * shape[i] * shape[i];
    wv += w * v;
    sv += w * shape[i] * v;
  }
  // The best non-negative pair: both free, or one of them zero or given.
  std::vector<std::pair<double, double>> pairs;
  const double determinant = ww * ss - ws * ws;
  if (has_nugget && has_sill)
    pairs.emplace_back(given.nugget, given.psill);
  else if (has_nugget)
    pairs.emplace_back(given.nugget, std::max(0.0, (sv - given.nugget * ws) / ss));
  else if (has_sill)
    pairs.emplace_back(std::max(0.0, (wv - given.psill * ws) / ww), given.psill);
  else {
    pairs.emplace_back(0.0, std::max(0.0, sv / ss));
    pairs.emplace_back(std::max(0.0, wv / ww), 0.0);
    if (determinant > 1e-12 * ww * ss)
      pairs.emplace_back((wv * ss - sv * ws) / determinant,
                         (ww * sv - ws * wv) / determinant);
  }
  LinearFit best{0.0, 0.0, std::numeric_limits<double>::infinity()};
  for (const auto& [nugget, psill] : pairs) {
    if (!(nugget >= 0.0 && psill >= 0.0))
      continue;
    double misfit = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const double rest = empirical.value[i] - nugget - psill * shape[i];
      misfit += weights[i] * rest * rest;
    }
    if (misfit < best.misfit)
      best = {nugget, psill, misfit};
  }
  return best;
}

} // namespace

double
Variogram::covariance(double h) const
{
  return psill * correlation(kind, h / range);
}

double
Variogram::covarianceSlope(double h) const
{
  return psill * correlationSlope(kind, h / range) / (range * range);
}

Eigen::Index
trendTerms(int degree)
{
  return degree == 0 ? 1 : (degree == 1 ? 4 : 10);
}

Eigen::RowVectorXd
trendAt(const Vector3d& x, int degree)
{
  Eigen::RowVectorXd terms(trendTerms(degree));
  terms[0] = 1.0;
  if (degree > 0)
    terms.segment<3>(1) = x.transpose();
  if (degree > 1)
    terms.segment<6>(4) << x[0] * x[0], x[0] * x[1], x[0] * x[2], x[1] * x[1],
        x[1] * x[2], x[2] * x[2];
  return terms;
}

double
variogramBytes(double samples)
{
  const double centers = std::min(samples, static_cast<double>(most_centers));
  return centers * (static_cast<double>(near_samples) + 0.5 * centers) * sizeof(Pair);
}

EmpiricalVariograms
computeEmpiricalVariograms(const SampledFields& sampled,
                           std::size_t field,
                           const Eigen::Matrix3d& metric,
                           int trend,
                           VariogramEstimator estimator)
{
  const SampleSet& samples = *sampled.samples;
  const std::size_t step = (samples.size() + most_centers - 1) / most_centers;
  std::vector<std::size_t> centers;
  for (std::size_t i = 0; i < samples.size(); i += step)
    centers.push_back(i);
  const Residuals residuals(sampled, field, centers, trend);

  std::vector<Pair> pairs;
  pairs.reserve(centers.size() * (near_samples + centers.size() / 2));
  const auto add = [&](std::size_t a, std::size_t b) {
    const Vector3d offset = metric * (positionOf(sampled, a) - positionOf(sampled, b));
    const double distance = offset.norm(), difference = residuals[a] - residuals[b];
    pairs.push_back(
        {distance, 0.5 * difference * difference, findAxis(offset, distance)});
  };
  NearestFinder finder(samples, near_samples + 1);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const auto near = finder.find(samples.getPositions()[centers[i]], 1.0f);
    for (std::size_t j = 0; j < near.size; ++j)
      if (near.samples[j] != centers[i])
        add(centers[i], near.samples[j]);
    for (std::size_t j = 0; j < i; ++j)
      add(centers[i], centers[j]);
  }
  if (pairs.empty())
    return {};
  double farthest = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (const Pair& pair : pairs) {
    farthest = std::max(farthest, farthest_part * pair.distance);
    nearest = std::min(nearest, pair.distance);
  }
  // A few very close pairs should not stretch the classes.
  nearest = std::max(nearest, least_spread * farthest);
  EmpiricalVariograms empirical{classify(pairs, nearest, farthest, -1, estimator), {}};
  for (int axis = 0; axis < 3; ++axis)
    empirical.along[static_cast<std::size_t>(axis)] =
        classify(pairs, nearest, farthest, axis, estimator);
  return empirical;
}

Variogram
fitVariogram(const EmpiricalVariogram& empirical, const Variogram& given)
{
  Variogram fitted = given;
  const bool is_level = std::all_of(empirical.value.begin(),
                                    empirical.value.end(),
                                    [](double value) { return value == 0.0; });
  if (is_level) { // a constant, or a single sample
    fitted.nugget = std::isnan(given.nugget) ? 0.0 : given.nugget;
    fitted.psill = std::isnan(given.psill) ? 0.0 : given.psill;
    fitted.range = std::isnan(given.range) ? 1.0 : given.range;
    return fitted;
  }
  const double shortest = std::log(0.5 * empirical.distance.front()),
               longest = std::log(4.0 * empirical.distance.back());
  std::vector<double> weights = empirical.pairs;
  const auto misfitAt = [&](double log_range) {
    return fitLevels(empirical, weights, given, std::exp(log_range)).misfit;
  };
  for (int round = 0; round < rounds; ++round) {
    double best = std::log(given.range);
    if (std::isnan(given.range)) {
      const double step = (longest - shortest) / (tried_ranges - 1);
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < tried_ranges; ++i)
        if (const double misfit = misfitAt(shortest + i * step); misfit < least) {
          least = misfit;
          best = shortest + i * step;
        }
      // Between its neighbours, by thirds.
      double low = std::max(shortest, best - step),
             high = std::min(longest, best + step);
      for (int i = 0; i < refinements; ++i) {
        const double third = (high - low) / 3.0;
        (misfitAt(low + third) <= misfitAt(high - third) ? high : low) +=
            (misfitAt(low + third) <= misfitAt(high - third) ? -third : third);
      }
      best = 0.5 * (low + high);
    }
    const LinearFit levels = fitLevels(empirical, weights, given, std::exp(best));
    fitted.range = std::exp(best);
    fitted.nugget = levels.nugget;
    fitted.psill = levels.psill;
    double largest = 0.0;
    for (const double distance : empirical.distance)
      largest = std::max(largest, fitted.value(distance));
    if (!(largest > 0.0))
      break;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      // Not less than a millionth, or the first class would be all that counts.
      const double model =
          std::max(fitted.value(empirical.distance[i]), 1e-3 * largest);
      weights[i] = empirical.pairs[i] / (model * model);
    }
  }
  return fitted;
}

} // namespace pcl_uvol::detail
