// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/data_term.h"

#include "common/median.h"
#include "common/parallel.h"
#include "levelset/constants.h"
#include "levelset/evolution_kernel.h"
#include "levelset/parallel_kernels.h"
#include "levelset/quadratic_residuals.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** Call body(first, last) for blocks of a band's groups, in parallel. */
template <typename Body>
void
sweep(const Band& band, unsigned threads, const Body& body)
{
  parallelBlocks(band.stencils.groups(), block_groups, threads, body);
}

/** Gradients of a field at the centres, as normal and slope. */
struct Gradients {
  std::vector<float> normal[3], slope;

  Gradients(const Band& band, const std::vector<float>& f, unsigned threads)
      : slope(band.centerPlaces())
  {
    for (auto& coordinate : normal)
      coordinate.resize(band.centerPlaces());
    const NormalStep step{band.stencils.view(),
                          {f.data(), nullptr, 0.0f},
                          {normal[0].data(), normal[1].data(), normal[2].data()},
                          slope.data()};
    sweep(band, threads, [&](auto begin, auto end) {
      evolution_kernel_table.get()->findNormals(step, begin, end);
    });
  }
};

/** Length of the mean gradient over the centres and their neighbours, by place. */
std::vector<float>
findSlopes(const Band& band, const std::vector<float>& f, unsigned threads)
{
  const std::size_t centers = band.centerPlaces();
  Gradients gradients(band, f, threads);
  std::vector<float> means[3], squares(centers, 0.0f);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    means[axis].resize(centers);
    for (std::size_t i = 0; i < centers; ++i)
      gradients.normal[axis][i] *= gradients.slope[i];
  }
  const AverageStep step{band.stencils.view(),
                         band.centers.size(),
                         3,
                         {gradients.normal[0].data(),
                          gradients.normal[1].data(),
                          gradients.normal[2].data()},
                         {means[0].data(), means[1].data(), means[2].data()}};
  sweep(band, threads, [&](auto begin, auto end) {
    evolution_kernel_table.get()->average(step, begin, end);
  });
  for (const auto& mean : means)
    for (std::size_t i = 0; i < centers; ++i)
      squares[i] += mean[i] * mean[i];
  for (float& square : squares)
    square = std::sqrt(square);
  return squares;
}

/** Centres with a neighbour beyond the surface, or all if no surface is near: what the
 * data are like there counts, however far the band goes. */
std::vector<std::uint32_t>
findSurface(const Band& band, const std::vector<float>& f)
{
  std::vector<std::uint32_t> surface;
  const StencilView stencils = band.stencils.view();
  for (std::size_t i = 0; i < band.centers.size(); ++i) {
    const std::uint32_t* const row =
        stencils.indicesOf(i / stencil_lanes) + i % stencil_lanes;
    for (std::size_t j = 0; j < stencils.neighbors; ++j)
      if ((f[row[j * stencil_lanes]] < 0.0f) != (f[i] < 0.0f)) {
        surface.push_back(static_cast<std::uint32_t>(i));
        break;
      }
  }
  if (surface.empty()) {
    surface.resize(band.centers.size());
    std::iota(surface.begin(), surface.end(), 0u);
  }
  return surface;
}

/** How far a function is from a distance, in the mean over some centres. */
double
findSlopeError(const Band& band,
               const std::vector<std::uint32_t>& centers,
               const std::vector<float>& phi,
               unsigned threads)
{
  const Gradients gradients(band, phi, threads);
  double sum = 0.0;
  for (const std::uint32_t center : centers)
    sum += std::abs(static_cast<double>(gradients.slope[center]) - 1.0);
  return sum / static_cast<double>(centers.size());
}

/** The slopes at the surface beside each place: those of surface centres, handed on
 * from neighbour to neighbour; beyond, their median. */
std::vector<float>
spreadSlopes(const Band& band,
             const std::vector<std::uint32_t>& surface,
             const std::vector<float>& slopes,
             float median)
{
  const StencilView stencils = band.stencils.view();
  std::vector<float> spread(band.places(), 0.0f);
  for (const std::uint32_t center : surface)
    spread[center] = slopes[center];
  for (int pass = 0; pass < level_set.spreading_passes; ++pass) {
    const std::vector<float> known = spread;
    std::vector<std::uint32_t> count(band.places(), 0);
    const auto add = [&](std::size_t to, std::size_t from) {
      if (known[from] == 0.0f || (pass > 0 && known[to] != 0.0f))
        return;
      spread[to] = (count[to] == 0 ? 0.0f : spread[to]) + known[from];
      ++count[to];
    };
    for (std::size_t i = 0; i < band.centers.size(); ++i) {
      const std::uint32_t* const row =
          stencils.indicesOf(i / stencil_lanes) + i % stencil_lanes;
      add(i, i);
      for (std::size_t j = 0; j < stencils.neighbors; ++j) {
        const std::uint32_t place = row[j * stencil_lanes];
        add(i, place);
        if (place >= band.centerPlaces())
          add(place, i);
      }
    }
    for (std::size_t place = 0; place < band.places(); ++place)
      if (count[place] > 0)
        spread[place] /= static_cast<float>(count[place]);
  }
  std::replace(spread.begin(), spread.end(), 0.0f, median);
  return spread;
}

/** Samples that are no centres take the mean slope of the centres they serve. */
void
extendSlopes(const Band& band, std::vector<float>& slopes)
{
  const std::size_t centers = band.centerPlaces();
  slopes.resize(band.places(), 0.0f);
  std::vector<std::uint32_t> count(band.places(), 0);
  const StencilView stencils = band.stencils.view();
  for (std::size_t i = 0; i < band.centers.size(); ++i) {
    const std::uint32_t* const row =
        stencils.indicesOf(i / stencil_lanes) + i % stencil_lanes;
    for (std::size_t j = 0; j < stencils.neighbors; ++j)
      if (const std::uint32_t place = row[j * stencil_lanes]; place >= centers) {
        slopes[place] += slopes[i];
        ++count[place];
      }
  }
  for (std::size_t place = centers; place < band.places(); ++place)
    slopes[place] /= static_cast<float>(count[place]);
}

/** Standard deviation of a field per slope, by how samples differ from their nearest
 * neighbours beyond what the gradients at both tell: the closer half of such pairs. */
double
findNoiseOfPairs(const Band& band,
                 const std::vector<std::uint32_t>& centers,
                 const SampleSet& samples,
                 const std::vector<float>& f,
                 const std::vector<float>& slopes,
                 unsigned threads)
{
  struct Pair {
    double distance, difference;
  };
  // Normal deviates have this median size; a pair has two of them.
  constexpr double median_size = 0.6745, of_two = 1.4142135623731;
  const Gradients gradients(band, f, threads);
  const StencilView stencils = band.stencils.view();
  std::vector<Pair> pairs;
  for (const std::uint32_t center : centers) {
    const std::uint32_t* const row =
        stencils.indicesOf(center / stencil_lanes) + center % stencil_lanes;
    const Position& x = samples.getPositions()[band.centers[center]];
    const auto sq_distance = [&](const Position& y) {
      double sum = 0.0;
      for (int axis = 0; axis < 3; ++axis)
        sum += std::pow(static_cast<double>(y[axis]) - x[axis], 2);
      return sum;
    };
    std::uint32_t nearest = center;
    double sq_nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < stencils.neighbors; ++j) {
      const std::uint32_t place = row[j * stencil_lanes];
      if (place >= band.centers.size() || place == center)
        continue;
      const double sq = sq_distance(samples.getPositions()[band.centers[place]]);
      if (sq < sq_nearest) {
        sq_nearest = sq;
        nearest = place;
      }
    }
    if (nearest == center)
      continue;
    const Position& y = samples.getPositions()[band.centers[nearest]];
    double difference = static_cast<double>(f[nearest]) - f[center];
    for (int axis = 0; axis < 3; ++axis)
      for (const std::uint32_t end : {center, nearest})
        difference -= 0.5 * gradients.normal[axis][end] * gradients.slope[end] *
                      (static_cast<double>(y[axis]) - x[axis]);
    pairs.push_back({sq_nearest, std::abs(difference) / slopes[center]});
  }
  if (pairs.empty())
    return 0.0;
  const auto middle = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
  std::nth_element(
      pairs.begin(), middle, pairs.end(), [](const Pair& a, const Pair& b) {
        return std::make_pair(a.distance, a.difference) <
               std::make_pair(b.distance, b.difference);
      });
  std::vector<double> differences;
  for (auto pair = pairs.begin(); pair <= middle; ++pair)
    differences.push_back(pair->difference);
  return computeMedian(differences) / (median_size * of_two);
}

/** Standard deviation of a field about quadratics, per slope; the median over some of
 * the centres. */
double
findNoiseOfFits(const Band& band,
                const std::vector<std::uint32_t>& centers,
                const SampleSet& samples,
                const std::vector<float>& f,
                const std::vector<float>& slopes,
                unsigned threads)
{
  const std::size_t count = std::min(level_set.noise_fits, centers.size());
  std::vector<double> noises(count, 0.0);
  parallelBlocks(count, block_fits, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, level_set.noise_samples);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t center = centers[i * centers.size() / count];
      const float reach = band.stencils.getReach()[center];
      const std::uint32_t sample = band.centers[center];
      const auto row = finder.find(samples.getPositions()[sample], reach);
      noises[i] = measureResidual(samples, sample, row, reach, f) / slopes[center];
    }
  });
  return computeMedian(noises);
}

/** How steep a function is. */
struct SurfaceSlopes {
  std::vector<std::uint32_t> surface; ///< centres
  std::vector<float> own;             ///< by place, none below a part of the median
  std::vector<float> spread;          ///< by place, those at the surface beside it
  float median;                       ///< at the surface
};

SurfaceSlopes
findSurfaceSlopes(const Band& band, const std::vector<float>& values, unsigned threads)
{
  SurfaceSlopes slopes;
  slopes.own = findSlopes(band, values, threads);
  slopes.surface = findSurface(band, values);
  std::vector<float> known;
  known.reserve(slopes.surface.size());
  for (const std::uint32_t center : slopes.surface)
    known.push_back(slopes.own[center]);
  slopes.median = computeMedian(known);
  extendSlopes(band, slopes.own);
  for (float& slope : slopes.own)
    slope = std::max(slope, level_set.least_slope * slopes.median);
  slopes.spread = spreadSlopes(band, slopes.surface, slopes.own, slopes.median);
  return slopes;
}

/** Values become distances at the surface and about that beside it. */
void
divideBySlopes(const SurfaceSlopes& slopes, std::vector<float>& values)
{
  for (std::size_t place = 0; place < values.size(); ++place)
    values[place] /= 0.5f * (slopes.own[place] + slopes.spread[place]);
}

} // namespace

double
measureSlopeError(const Band& band, const std::vector<float>& phi, unsigned threads)
{
  return findSlopeError(band, findSurface(band, phi), phi, threads);
}

std::vector<float>
scaleToDistance(const Band& band, std::vector<float> phi, unsigned threads)
{
  divideBySlopes(findSurfaceSlopes(band, phi, threads), phi);
  return phi;
}

DataTerm
makeDataTerm(const Band& band,
             const SampleSet& samples,
             const std::vector<float>& f,
             unsigned threads,
             Report& report)
{
  const StepTimer timer(report, "data_term");
  std::vector<float> values(band.places(), 0.0f);
  band.forPlaces(
      [&](std::size_t place, std::uint32_t sample) { values[place] = f[sample]; });
  const SurfaceSlopes slopes = findSurfaceSlopes(band, values, threads);
  const double of_fits = findNoiseOfFits(
                   band, slopes.surface, samples, f, slopes.own, threads),
               of_pairs = findNoiseOfPairs(
                   band, slopes.surface, samples, values, slopes.own, threads);
  DataTerm term;
  term.slope = slopes.median;
  term.noise = of_pairs < level_set.misfit_part * of_fits ? of_pairs : of_fits;
  term.trust.assign(band.centerPlaces(), 0.0f);
  for (std::size_t i = 0; i < band.centers.size(); ++i)
    term.trust[i] = std::min(1.0f, std::pow(slopes.own[i] / slopes.spread[i], 2.0f));
  divideBySlopes(slopes, values);
  term.target = std::move(values);
  term.slope_error = findSlopeError(band, slopes.surface, term.target, threads);
  return term;
}

} // namespace pcl_uvol
