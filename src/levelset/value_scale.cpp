// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/value_scale.h"

#include "common/median.h"
#include "common/parallel.h"
#include "levelset/constants.h"
#include "levelset/parallel_kernels.h"
#include "levelset/quadratic_residuals.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_uvol {

namespace {

/** Values of a smaller part of the isovalue, or below 0, go on along a line, which
 * noise about 0 asks for: two spacings off, growth by ten in two spacings is that far
 * down. */
constexpr double least_part = 0.1;

/** \param part value over isovalue
 * \param above the same minus 1, which tells small logarithms with more digits */
double
takeLogarithm(double part, double above)
{
  if (part < least_part)
    return std::log(least_part) + part / least_part - 1.0;
  return part < 2.0 ? std::log1p(above) : std::log(part);
}

} // namespace

std::vector<float>
takeLogarithms(const std::vector<float>& values,
               const ValueFrame& frame,
               double isovalue)
{
  const double threshold = frame.apply(isovalue), unit = frame.factor * isovalue;
  std::vector<float> logarithms;
  logarithms.reserve(values.size());
  for (const float value : values)
    logarithms.push_back(
        static_cast<float>(unit * takeLogarithm(frame.toInput(value) / isovalue,
                                                (value - threshold) / unit)));
  return logarithms;
}

bool
areLogarithmsSmoother(const SampleSet& samples,
                      const std::vector<std::uint32_t>& crossing,
                      const std::vector<float>& f,
                      const std::vector<float>& logarithms,
                      unsigned threads)
{
  const std::size_t count = std::min(level_set.scale_fits, crossing.size());
  if (count == 0)
    return false;
  std::vector<double> of_values(count), of_logarithms(count);
  parallelBlocks(count, block_fits, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, level_set.noise_samples);
    float reach = 1.0f;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t center = crossing[i * crossing.size() / count];
      const auto row = finder.find(samples.getPositions()[center], reach);
      reach = std::sqrt(*std::max_element(row.sq_dists, row.sq_dists + row.size));
      of_values[i] = measureResidual(samples, center, row, reach, f);
      of_logarithms[i] = measureResidual(samples, center, row, reach, logarithms);
    }
  });
  return computeMedian(of_logarithms) < computeMedian(of_values);
}

} // namespace pcl_uvol
