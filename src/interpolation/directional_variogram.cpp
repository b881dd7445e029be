// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/directional_variogram.h"

#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace pcl_uvol::detail {

using Eigen::Array3d;

namespace {

/** Samples out of all parts of the set, all pairs of which count. */
constexpr std::size_t most_sector_centers = 1200;

/** Nearest samples of each of them that make pairs with it. */
constexpr std::size_t near_sector = 32;

/** Classes along an axis: of offsets of 2^-n to 2^(1-n) spreads; smaller ones are in
 * the last of them. */
constexpr int octaves = 11, offset_classes = octaves + 1;

/** Pairs that are farther apart along an axis, in parts of the spread, have
 * an outlier. */
constexpr double farthest = 1.5;

/** A class of fewer pairs tells nothing; of so many it counts half. */
constexpr double least_lag_pairs = 8.0, half_pairs = 50.0;

/** Steps of the search, of logarithms: from a factor of 4 to one of 1.05. */
constexpr double first_step = 1.3862943611198906, last_step = 0.0487901641694320;

int
classOf(double offset)
{
  if (!(offset > 0.0))
    return 0;
  return std::clamp(std::ilogb(offset) + octaves, 0, offset_classes - 1);
}

/** Sums over pairs, by classes of offsets. */
class PairTable {
public:
  PairTable(const SampleSet& samples, const std::vector<double>& values, double spread)
      : samples_(samples)
      , values_(values)
      , per_spread_(1.0 / spread)
      , sums_(offset_classes * offset_classes * offset_classes)
  {
  }

  void
  add(std::size_t a, std::size_t b)
  {
    const Position& from = samples_.getPositions()[a];
    const Position& to = samples_.getPositions()[b];
    Array3d offset;
    int place = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double difference = static_cast<double>(to[axis]) - from[axis];
      offset[axis] = std::abs(difference) * per_spread_;
      place = offset_classes * place + classOf(offset[axis]);
    }
    if (offset.maxCoeff() >= farthest)
      return;
    Sum& sum = sums_[static_cast<std::size_t>(place)];
    sum.sq_offset += offset * offset;
    sum.root += std::sqrt(std::abs(values_[a] - values_[b]));
    sum.pairs += 1.0;
  }

  std::vector<OffsetClass>
  list() const
  {
    std::vector<OffsetClass> classes;
    for (const Sum& sum : sums_)
      if (sum.pairs >= least_lag_pairs && sum.root > 0.0)
        classes.push_back({sum.sq_offset / sum.pairs,
                           4.0 * std::log(sum.root / sum.pairs),
                           sum.pairs / (sum.pairs + half_pairs)});
    return classes;
  }

private:
  struct Sum {
    Array3d sq_offset = Array3d::Zero();
    double root = 0.0, pairs = 0.0;
  };

  const SampleSet& samples_;
  const std::vector<double>& values_;
  double per_spread_;
  std::vector<Sum> sums_;
};

/** Values at places that follow one another, and their weight together. */
struct Level {
  double value, weight, square;

  /** What is left of the squares about the mean. */
  double
  rest() const
  {
    return std::max(0.0, square - weight * value * value);
  }
};

void
join(Level& first, const Level& second)
{
  const double weight = first.weight + second.weight;
  first.value = (first.value * first.weight + second.value * second.weight) / weight;
  first.weight = weight;
  first.square += second.square;
}

} // namespace

std::vector<OffsetClass>
classifyPairs(const SampleSet& samples,
              const std::vector<double>& values,
              double spread)
{
  PairTable table(samples, values, spread);
  const std::size_t step =
      (samples.size() + most_sector_centers - 1) / most_sector_centers;
  NearestFinder finder(samples, near_sector + 1);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const auto near = finder.find(samples.getPositions()[i], 1.0f);
    for (std::size_t j = 0; j < near.size; ++j)
      if (near.samples[j] != i)
        table.add(i, near.samples[j]);
    for (std::size_t j = 0; j < i; j += step)
      table.add(i, j);
  }
  return table.list();
}

double
explainedBy(const std::vector<OffsetClass>& classes, const Array3d& log_factors)
{
  if (classes.empty())
    return 0.0;
  const Array3d sq_factors = (2.0 * log_factors).exp();
  std::vector<double> sq_distance;
  for (const OffsetClass& offsets : classes)
    sq_distance.push_back((offsets.sq_offset * sq_factors).sum());
  std::vector<std::size_t> order(classes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sq_distance[a] < sq_distance[b];
  });
  // Logarithms count from their mean, so that squares keep their digits.
  double mean = 0.0, weight = 0.0;
  for (const OffsetClass& offsets : classes) {
    weight += offsets.weight;
    mean += offsets.weight * offsets.log_difference;
  }
  mean /= weight;
  // Levels that would fall are joined (pool adjacent violators).
  std::vector<Level> levels;
  double variance = 0.0;
  for (const std::size_t i : order) {
    const double value = classes[i].log_difference - mean;
    Level level{value, classes[i].weight, classes[i].weight * value * value};
    variance += level.square;
    while (!levels.empty() && levels.back().value >= level.value) {
      join(level, levels.back());
      levels.pop_back();
    }
    levels.push_back(level);
  }
  double rest = 0.0;
  for (const Level& level : levels)
    rest += level.rest();
  return variance > 0.0 ? 1.0 - rest / variance : 0.0;
}

Array3d
fitFactors(const std::vector<OffsetClass>& classes, const std::vector<Array3d>& starts)
{
  Array3d best = Array3d::Zero();
  double most = -1.0;
  for (const Array3d& start : starts) {
    Array3d factors = start;
    double explained = explainedBy(classes, factors);
    for (double step = first_step; step > last_step;) {
      bool is_better = false;
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
          Array3d moved = factors;
          moved[axis] += sign * step;
          const double share = explainedBy(classes, moved);
          if (share <= explained)
            continue;
          explained = share;
          factors = moved;
          is_better = true;
        }
      if (!is_better)
        step /= 2.0;
    }
    if (explained > most) {
      most = explained;
      best = factors;
    }
  }
  return best;
}

} // namespace pcl_uvol::detail
