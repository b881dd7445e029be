// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/metric_kernel.h"

#include <cstring>

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

using FourFloats = float __attribute__((vector_size(16)));
using FourDoubles = double __attribute__((vector_size(32)));
using Pair = double __attribute__((vector_size(16)));
using Lines = float __attribute__((vector_size(line_lanes * sizeof(float))));

constexpr std::size_t float_lanes = 4;
constexpr float gone = __builtin_inff();

template <typename Vector, typename T>
inline Vector
load(const T* values)
{
  Vector vector;
  std::memcpy(&vector, values, sizeof(vector));
  return vector;
}

inline Pair
magnitude(Pair a)
{
  return a < 0.0 ? -a : a;
}

inline Pair
larger(Pair a, Pair b)
{
  return a > b ? a : b;
}

/** Squared distances of four positions. */
inline FourDoubles
measureFour(const float* positions,
            const FourDoubles (&point)[3],
            const MetricRows& metric)
{
  const auto a = load<FourFloats>(positions), b = load<FourFloats>(positions + 4),
             c = load<FourFloats>(positions + 8);
  const FourFloats xs[3] = {
      __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, 6), c, 0, 1, 2, 5),
      __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 7), c, 0, 1, 2, 6),
      __builtin_shufflevector(
          __builtin_shufflevector(a, b, 2, 5, 5, 5), c, 0, 1, 4, 7)};
  FourDoubles offset[3];
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = __builtin_convertvector(xs[axis], FourDoubles) - point[axis];
  FourDoubles sq_dist{};
  for (const auto& row : metric.row) {
    const FourDoubles image =
        row[0] * offset[0] + row[1] * offset[1] + row[2] * offset[2];
    sq_dist += image * image;
  }
  return sq_dist;
}

double
measure(const float* positions,
        std::size_t count,
        const float* point,
        const MetricRows& metric,
        double* sq_dists)
{
  FourDoubles place[3];
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = FourDoubles{} + static_cast<double>(point[axis]);
  FourDoubles least = FourDoubles{} + __builtin_inf();
  std::size_t i = 0;
  for (; i + float_lanes <= count; i += float_lanes) {
    const FourDoubles sq_dist = measureFour(positions + 3 * i, place, metric);
    std::memcpy(sq_dists + i, &sq_dist, sizeof(sq_dist));
    least = sq_dist < least ? sq_dist : least;
  }
  double nearest = __builtin_inf();
  if (i < count) {
    float rest[3 * float_lanes] = {};
    std::memcpy(rest, positions + 3 * i, 3 * sizeof(float) * (count - i));
    const FourDoubles sq_dist = measureFour(rest, place, metric);
    for (std::size_t lane = 0; lane < count - i; ++lane) {
      sq_dists[i + lane] = sq_dist[lane];
      nearest = sq_dist[lane] < nearest ? sq_dist[lane] : nearest;
    }
  }
  for (std::size_t lane = 0; lane < float_lanes; ++lane)
    nearest = least[lane] < nearest ? least[lane] : nearest;
  return nearest;
}

void
findBounds(const BoxPair& boxes, const MetricBounds& metric, double* sq_bounds)
{
  Pair middle[3], half[3], sq_beside{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = load<Pair>(boxes.low[axis]), high = load<Pair>(boxes.high[axis]);
    middle[axis] = 0.5 * (low + high);
    half[axis] = 0.5 * (high - low);
    // Across the faces of the box along an axis.
    const Pair gap = larger(magnitude(middle[axis]) - half[axis], Pair{});
    sq_beside = larger(gap * gap * metric.per_sq_extent[axis], sq_beside);
  }
  // Across the axes of the metric: the image of the box lies between two planes.
  Pair sq_between{};
  for (const auto& row : metric.rows.row) {
    const Pair place = row[0] * middle[0] + row[1] * middle[1] + row[2] * middle[2];
    const Pair room = __builtin_fabs(row[0]) * half[0] +
                      __builtin_fabs(row[1]) * half[1] +
                      __builtin_fabs(row[2]) * half[2];
    const Pair gap = larger(magnitude(place) - room, Pair{});
    sq_between += gap * gap;
  }
  const Pair bounds = larger(sq_between, sq_beside);
  sq_bounds[0] = bounds[0];
  sq_bounds[1] = bounds[1];
}

void
addLine(float x, float y, float z, float sq_length, MetricMoments& moments)
{
  const double line[3] = {x, y, z};
  constexpr int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int i = 0; i < 6; ++i) {
    const double square = line[row[i]] * line[column[i]];
    moments.lengths[i] += square;
    moments.directions[i] += square / static_cast<double>(sq_length);
  }
}

inline float
leastOf(Lines values)
{
  float least = values[0];
  for (std::size_t lane = 1; lane < line_lanes; ++lane)
    least = values[lane] < least ? values[lane] : least;
  return least;
}

void
addLines(const float* x,
         const float* y,
         const float* z,
         float* sq_lengths,
         std::size_t count,
         float sq_cosine,
         MetricMoments& moments)
{
  Lines least = Lines{} + gone;
  for (std::size_t j = 0; j < count; j += line_lanes) {
    const auto sq_length = load<Lines>(sq_lengths + j);
    least = sq_length < least ? sq_length : least;
  }
  for (;;) {
    const float sq_length = leastOf(least);
    if (sq_length == gone)
      return;
    std::size_t nearest = 0;
    while (sq_lengths[nearest] != sq_length)
      ++nearest;
    const float a = x[nearest], b = y[nearest], c = z[nearest];
    addLine(a, b, c, sq_length, moments);
    sq_lengths[nearest] = gone;
    const float bound = sq_cosine * sq_length;
    least = Lines{} + gone;
    for (std::size_t j = 0; j < count; j += line_lanes) {
      const Lines product =
          a * load<Lines>(x + j) + b * load<Lines>(y + j) + c * load<Lines>(z + j);
      const auto old = load<Lines>(sq_lengths + j);
      const Lines left = product * product > bound * old ? Lines{} + gone : old;
      std::memcpy(sq_lengths + j, &left, sizeof(left));
      least = left < least ? left : least;
    }
  }
}

} // namespace

extern const MetricKernels metric_kernels{measure, findBounds, addLines};

} // namespace pcl_uvol::PCL_UVOL_SIMD
