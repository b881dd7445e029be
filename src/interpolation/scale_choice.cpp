// SPDX-License-Identifier: BSD-3-Clause
// Factors per axis that make a field change alike along all of them.
#include "common/stretch_axes.h"
#include "interpolation/directional_variogram.h"
#include "interpolation/gap_test.h"
#include "neighbors/anisotropy.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/interpolation/cross_validation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

using Eigen::Array3d;
using Eigen::Array3f;

/** Fewer samples tell nothing of directions. */
constexpr std::size_t least_samples = 100;

/** Powers of the factors that the variogram asks for, which are tried. It sees how a
 * field changes over all distances, and asks for too much where large ones differ. */
constexpr double tried_powers[] = {0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0};

/** Factors other than 1 are taken if the error is below that part, and the difference
 * is so many of its standard errors. */
constexpr double least_gain = 0.9, least_certainty = 4.0;

/** The lowest power is taken of those that are worse than the best one by less than
 * that part of its error, or by fewer standard errors. */
constexpr double alike = 1.05, alike_errors = 2.0;

double
computeMean(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) /
         static_cast<double>(numbers.size());
}

/** How many standard errors some numbers are lower than others by, pair by pair. */
double
measureCertainty(const std::vector<double>& lower, const std::vector<double>& others)
{
  const double mean = computeMean(others) - computeMean(lower);
  double squares = 0.0;
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const double rest = others[i] - lower[i] - mean;
    squares += rest * rest;
  }
  const double count = static_cast<double>(lower.size());
  return squares > 0.0 ? mean * count / std::sqrt(squares) : 0.0;
}

/** Values that are near 1 and differ as the field does. */
std::vector<double>
normalized(const std::vector<float>& values)
{
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double range = static_cast<double>(*high) - static_cast<double>(*low);
  std::vector<double> numbers(values.begin(), values.end());
  if (range > 0.0)
    for (double& number : numbers)
      number = std::ldexp(number - static_cast<double>(*low), -std::ilogb(range));
  return numbers;
}

/** The best of the powers, if one is clearly better than factors of 1.
 * \param log_factors that the variogram asks for, by those of the original space
 * \param log_spread logarithms of the factors that the samples are stretched by */
double
choosePower(const detail::GapTest& test,
            const Array3d& log_factors,
            const Array3d& log_spread,
            unsigned threads,
            double& error_ratio)
{
  const auto errorsOf = [&](double power) {
    return test.computeErrors((power * log_factors - log_spread).exp(), threads);
  };
  const std::vector<double> before = errorsOf(0.0);
  const double mean_before = computeMean(before);
  std::vector<std::vector<double>> tried;
  std::size_t best = 0;
  for (const double power : tried_powers) {
    tried.push_back(errorsOf(power));
    if (computeMean(tried.back()) < computeMean(tried[best]))
      best = tried.size() - 1;
  }
  std::size_t lowest = 0;
  while (lowest < best &&
         computeMean(tried[lowest]) > alike * computeMean(tried[best]) &&
         measureCertainty(tried[best], tried[lowest]) > alike_errors)
    ++lowest;
  const double ratio = computeMean(tried[lowest]) / mean_before;
  if (!(ratio < least_gain) ||
      !(measureCertainty(tried[lowest], before) > least_certainty))
    return 0.0;
  error_ratio = ratio;
  return tried_powers[lowest];
}

} // namespace

ScaleChoice
chooseScale(const CloudView& cloud,
            const pcl::Indices& indices,
            const std::string& name,
            const Array3d& rotation,
            unsigned threads,
            Report& report)
{
  const StepTimer timer(report, "scale");
  detail::checkIndices(indices, cloud.count, "chooseScale");
  const CloudView turned = detail::StretchAxes(rotation).turn(cloud);
  const ScalarField field(turned.fields, name);
  const ValueFrame frame = findValueRange(turned, field, threads).findFrame();
  std::vector<float> values = readValues(turned, field, frame, threads);
  std::vector<std::uint32_t> use;
  for (const std::uint32_t point : pointsWithValue(values, indices, field))
    if (Eigen::Map<const Array3f>(turned.xyz(point)).isFinite().all())
      use.push_back(point);
  ScaleChoice choice;
  if (use.size() < least_samples)
    return choice;
  const Array3f spread = findSpread(turned, use), equal = equalizeSpread(spread);
  if (!(spread.maxCoeff() > 0.0f))
    return choice;
  Report own; // others tell of these samples
  const auto samples = SampleSet::build(
      turned.xyz(0), turned.stride(), use, toPosition(equal), threads, own);
  const std::vector<double> numbers =
      normalized(gatherValues(*samples, values, threads, own).values);
  const double largest = static_cast<double>(spread.maxCoeff()) *
                         static_cast<double>(samples->getUnit().factor);
  const auto classes = detail::classifyPairs(*samples, numbers, largest);
  const Array3d log_spread = equal.cast<double>().log();
  Array3d log_factors =
      detail::fitFactors(classes, {Array3d::Zero(), -log_spread}) + log_spread;
  choice.explained = detail::explainedBy(classes, log_factors - log_spread);
  choice.explained_before = detail::explainedBy(classes, -log_spread);
  // An axis without spread keeps its length.
  const auto is_spread = (spread > 0.0f).eval();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (is_spread[axis])
      least = std::min(least, log_factors[axis]);
  log_factors = is_spread.select(log_factors - least, 0.0);
  const detail::GapTest test(
      *samples, numbers, static_cast<int>(is_spread.count()), threads);
  choice.tested = test.size();
  const double power =
      choosePower(test, log_factors, log_spread, threads, choice.error_ratio);
  choice.scale = (power * log_factors).exp().cast<float>();
  return choice;
}

} // namespace pcl_uvol
