// SPDX-License-Identifier: BSD-3-Clause
// Each sample draws from a random stream of its own, so that blocks run in parallel.
#include <pcl_uvol/common/counter_random.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/common/sample_positions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

using Point = std::array<double, 3>;
using Cells = std::array<std::size_t, 3>;

constexpr std::size_t block_samples = 1u << 14;
constexpr std::uint64_t cluster_count = 64;
constexpr double cluster_spread = 0.03; // standard deviation over the side of the box
constexpr std::size_t density_cells = 96; // per axis: resolves a 100th of the box
constexpr int density_tries = 1000;

Point
inBox(const Box& box, double u, double v, double w)
{
  return {{box.lower[0] + u * (box.upper[0] - box.lower[0]),
           box.lower[1] + v * (box.upper[1] - box.lower[1]),
           box.lower[2] + w * (box.upper[2] - box.lower[2])}};
}

Point
uniformIn(const Box& box, CounterRandom& random)
{
  const double u = random.uniform(), v = random.uniform(), w = random.uniform();
  return inBox(box, u, v, w);
}

bool
isInside(const Box& box, const Point& point)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (point[axis] < box.lower[axis] || point[axis] > box.upper[axis])
      return false;
  return true;
}

std::vector<double>
gatherPositions(std::size_t count,
                std::uint64_t seed,
                unsigned threads,
                const std::function<Point(std::size_t, CounterRandom&)>& position)
{
  std::vector<double> xyz(3 * count);
  parallelBlocks(
      count, block_samples, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          CounterRandom random(seed, i);
          const Point point = position(i, random);
          std::copy(point.begin(), point.end(), &xyz[3 * i]);
        }
      });
  return xyz;
}

/** Cells of about equal sides, at most count of them; flat axes get one. */
Cells
latticeOf(const Box& box, std::size_t count)
{
  double volume = 1.0;
  int axes = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const double side = box.upper[axis] - box.lower[axis]; side > 0.0) {
      volume *= side;
      ++axes;
    }
  const double cell =
      std::pow(volume / static_cast<double>(count), 1.0 / std::max(axes, 1));
  Cells cells{{1, 1, 1}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double side = box.upper[axis] - box.lower[axis];
    // The root of a cube number may come out a little too small.
    cells[axis] = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::floor(side / cell + 1e-9)));
  }
  return cells;
}

Point
inCell(const Box& box, const Cells& cells, std::size_t cell, double u, double v, double w)
{
  const std::size_t i = cell % cells[0], j = cell / cells[0] % cells[1],
                    k = cell / cells[0] / cells[1];
  return inBox(box,
               (static_cast<double>(i) + u) / static_cast<double>(cells[0]),
               (static_cast<double>(j) + v) / static_cast<double>(cells[1]),
               (static_cast<double>(k) + w) / static_cast<double>(cells[2]));
}

Point
clustered(const Box& box, std::uint64_t seed, std::size_t index, CounterRandom& random)
{
  if (index % 2 == 0)
    return uniformIn(box, random);
  const auto cluster = static_cast<std::uint64_t>(random.uniform() * cluster_count);
  // Streams of centres lie beyond those of all samples.
  CounterRandom centers(seed, ~cluster);
  const Point center = uniformIn(box, centers);
  Point point;
  do {
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = center[axis] + cluster_spread * random.normal() *
                                       (box.upper[axis] - box.lower[axis]);
  } while (!isInside(box, point));
  return point;
}

/** Draws positions by rejection below a bound per cell of a lattice. */
class DensitySampler {
public:
  DensitySampler(const Box& box, const ScalarFunction& density, unsigned threads);

  Point
  draw(CounterRandom& random) const;

private:
  /** The density at a corner of the lattice; 0 where it is negative or NaN. */
  double
  atCorner(std::size_t i, std::size_t j, std::size_t k) const;

  const Box& box_;
  const ScalarFunction& density_;
  Cells cells_{{density_cells, density_cells, density_cells}};
  std::vector<double> bounds_;     // of the density in each cell, by its corners
  std::vector<double> cumulative_; // sums of the bounds
};

DensitySampler::DensitySampler(const Box& box,
                               const ScalarFunction& density,
                               unsigned threads)
    : box_(box)
    , density_(density)
{
  constexpr std::size_t n = density_cells, corners = n + 1;
  std::vector<double> values(corners * corners * corners);
  parallelBlocks(corners, 1, threads, [&](std::size_t k, std::size_t) {
    for (std::size_t j = 0; j < corners; ++j)
      for (std::size_t i = 0; i < corners; ++i)
        values[(k * corners + j) * corners + i] = atCorner(i, j, k);
  });
  bounds_.resize(n * n * n);
  cumulative_.resize(bounds_.size());
  double sum = 0.0;
  for (std::size_t cell = 0; cell < bounds_.size(); ++cell) {
    const std::size_t i = cell % n, j = cell / n % n, k = cell / n / n;
    double bound = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner)
      bound = std::max(bound,
                       values[((k + (corner >> 2)) * corners + j + (corner >> 1 & 1)) *
                                  corners +
                              i + (corner & 1)]);
    bounds_[cell] = bound;
    cumulative_[cell] = sum += bound;
  }
  if (!(sum > 0.0))
    throw InvalidArgument("Samples cannot follow the density of this field, which is "
                          "positive nowhere in its box: choose another sampling.");
}

double
DensitySampler::atCorner(std::size_t i, std::size_t j, std::size_t k) const
{
  const Point point = inBox(box_,
                            static_cast<double>(i) / density_cells,
                            static_cast<double>(j) / density_cells,
                            static_cast<double>(k) / density_cells);
  const double value = density_(point[0], point[1], point[2]);
  return value > 0.0 ? value : 0.0;
}

Point
DensitySampler::draw(CounterRandom& random) const
{
  Point point{};
  for (int i = 0; i < density_tries; ++i) {
    const double target = random.uniform() * cumulative_.back();
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), target);
    const auto cell = std::min(static_cast<std::size_t>(found - cumulative_.begin()),
                               cumulative_.size() - 1);
    const double u = random.uniform(), v = random.uniform(), w = random.uniform();
    point = inCell(box_, cells_, cell, u, v, w);
    if (random.uniform() * bounds_[cell] < density_(point[0], point[1], point[2]))
      break;
  }
  return point;
}

void
checkBox(const Box& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!std::isfinite(box.lower[axis]) || !std::isfinite(box.upper[axis]) ||
        box.lower[axis] > box.upper[axis])
      throw InvalidArgument("The box of the samples reaches from " +
                            std::to_string(box.lower[axis]) + " to " +
                            std::to_string(box.upper[axis]) + " along axis " +
                            std::to_string(axis) + ": it must be finite.");
}

} // namespace

const std::vector<std::string>&
samplingNames()
{
  static const std::vector<std::string> names = {
      "uniform", "jittered", "lattice", "clustered", "density"};
  return names;
}

std::vector<double>
samplePositions(Sampling sampling,
                const Box& box,
                const ScalarFunction& density,
                std::size_t count,
                std::uint64_t seed,
                unsigned threads)
{
  checkBox(box);
  if (count == 0)
    return {};
  const auto gather = [&](std::size_t n, const auto& position) {
    return gatherPositions(n, seed, threads, position);
  };
  if (sampling == Sampling::Jittered || sampling == Sampling::Lattice) {
    const Cells cells = latticeOf(box, count);
    const bool jittered = sampling == Sampling::Jittered;
    return gather(
        cells[0] * cells[1] * cells[2], [&](std::size_t i, CounterRandom& random) {
          if (!jittered)
            return inCell(box, cells, i, 0.5, 0.5, 0.5);
          const double u = random.uniform(), v = random.uniform(), w = random.uniform();
          return inCell(box, cells, i, u, v, w);
        });
  }
  if (sampling == Sampling::Clustered)
    return gather(count, [&](std::size_t i, CounterRandom& random) {
      return clustered(box, seed, i, random);
    });
  if (sampling == Sampling::Density) {
    const DensitySampler sampler(box, density, threads);
    return gather(
        count, [&](std::size_t, CounterRandom& random) { return sampler.draw(random); });
  }
  return gather(
      count, [&](std::size_t, CounterRandom& random) { return uniformIn(box, random); });
}

} // namespace pcl_uvol
