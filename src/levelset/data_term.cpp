// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/data_term.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "levelset/evolution_kernel.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_groups = 64, block_fits = 64;

/** Of the median slope. */
constexpr float least_slope = 0.1f;

/** Neighbour by neighbour, slopes of the surface reach as far as the band. */
constexpr int spreading_passes = 5;

/** Fits that tell the noise, and samples in each: twice the terms of a quadratic leave
 * enough degrees of freedom. */
constexpr std::size_t noise_fits = 4096, noise_samples = 27;
constexpr int quadratic_terms = 10;

const KernelTable<const EvolutionKernels*> kernel_table{
    &baseline::evolution_kernels, &avx2::evolution_kernels, &avx512::evolution_kernels};

template <typename T>
T
medianOf(std::vector<T> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
      kernel_table.get()->findNormals(step, begin, end);
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
    kernel_table.get()->average(step, begin, end);
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
  for (int pass = 0; pass < spreading_passes; ++pass) {
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

/** Standard deviation of a field about quadratics, per slope; the median over some of
 * the centres. */
double
findNoise(const Band& band,
          const std::vector<std::uint32_t>& centers,
          const SampleSet& samples,
          const std::vector<float>& f,
          const std::vector<float>& slopes,
          unsigned threads)
{
  const std::size_t count = std::min(noise_fits, centers.size());
  std::vector<double> noises(count, 0.0);
  parallelBlocks(count, block_fits, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, noise_samples);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t center = centers[i * centers.size() / count];
      const Position& x = samples.getPositions()[band.centers[center]];
      const auto row = finder.find(x, band.stencils.getReach()[center]);
      const auto terms = static_cast<Eigen::Index>(quadratic_terms);
      if (static_cast<Eigen::Index>(row.size) <= terms)
        continue;
      Eigen::MatrixXd a(static_cast<Eigen::Index>(row.size), terms);
      Eigen::VectorXd b(static_cast<Eigen::Index>(row.size));
      const double reach = band.stencils.getReach()[center];
      for (std::size_t j = 0; j < row.size; ++j) {
        const Position& y = samples.getPositions()[row.samples[j]];
        double u[3];
        for (int axis = 0; axis < 3; ++axis)
          u[axis] = (static_cast<double>(y[axis]) - x[axis]) / reach;
        const auto r = static_cast<Eigen::Index>(j);
        a.row(r) << 1.0, u[0], u[1], u[2], u[0] * u[0], u[0] * u[1], u[0] * u[2],
            u[1] * u[1], u[1] * u[2], u[2] * u[2];
        b[r] = f[row.samples[j]];
      }
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(a);
      const double sq_residual = (b - a * factor.solve(b)).squaredNorm();
      const auto freedom = static_cast<double>(a.rows() - factor.rank());
      noises[i] = std::sqrt(sq_residual / freedom) / slopes[center];
    }
  });
  return medianOf(std::move(noises));
}

} // namespace

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
  std::vector<float> slopes = findSlopes(band, values, threads);
  const auto surface = findSurface(band, values);
  std::vector<float> known;
  known.reserve(surface.size());
  for (const std::uint32_t center : surface)
    known.push_back(slopes[center]);
  const float median = medianOf(std::move(known));
  extendSlopes(band, slopes);
  for (float& slope : slopes)
    slope = std::max(slope, least_slope * median);
  const std::vector<float> spread = spreadSlopes(band, surface, slopes, median);
  DataTerm term;
  term.slope = median;
  term.noise = findNoise(band, surface, samples, f, slopes, threads);
  term.target = std::move(values);
  term.trust.assign(band.centerPlaces(), 0.0f);
  for (std::size_t place = 0; place < band.places(); ++place) {
    term.target[place] /= 0.5f * (slopes[place] + spread[place]);
    if (place < band.centers.size())
      term.trust[place] = std::min(1.0f, std::pow(slopes[place] / spread[place], 2.0f));
  }
  term.slope_error = findSlopeError(band, surface, term.target, threads);
  return term;
}

} // namespace pcl_uvol
