// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/deviation.h"

#include "common/parallel.h"
#include "levelset/constants.h"
#include "levelset/evolution_kernel.h"
#include "levelset/parallel_kernels.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Two fields of the centres become their means over neighbours. */
void
average(const Band& band,
        std::vector<float>& first,
        std::vector<float>& second,
        unsigned threads)
{
  std::vector<float> means[2] = {std::vector<float>(first.size(), 0.0f),
                                 std::vector<float>(second.size(), 0.0f)};
  const AverageStep step{band.stencils.view(),
                         band.centers.size(),
                         2,
                         {first.data(), second.data()},
                         {means[0].data(), means[1].data()}};
  parallelBlocks(
      band.stencils.groups(), block_groups, threads, [&](auto begin, auto end) {
        evolution_kernel_table.get()->average(step, begin, end);
      });
  first = std::move(means[0]);
  second = std::move(means[1]);
}

} // namespace

std::vector<float>
findDeviations(const Band& band,
               const std::vector<float>& phi,
               const DataTerm& term,
               const NoiseShares& shares,
               unsigned threads)
{
  std::vector<float> deviations(band.centers.size(), 0.0f);
  if (!(shares.of_residual >= level_set.least_residual))
    return deviations;
  // The mean of residuals and that of their squares become variance and squared shift.
  std::vector<float> variance(band.centerPlaces(), 0.0f), shift = variance;
  for (std::size_t i = 0; i < band.centers.size(); ++i) {
    shift[i] = term.target[i] - phi[i];
    variance[i] = shift[i] * shift[i];
  }
  average(band, shift, variance, threads);
  const auto count = static_cast<float>(band.stencils.view().neighbors + 1);
  const auto left =
      static_cast<float>(std::pow(shares.of_surface / shares.of_residual, 2));
  for (std::size_t i = 0; i < band.centers.size(); ++i) {
    const float sq_mean = shift[i] * shift[i];
    variance[i] = std::max(0.0f, variance[i] - sq_mean) * count / (count - 1.0f);
    // The mean of the residuals lacks what phi has followed.
    shift[i] = sq_mean + (left - 1.0f / count) * variance[i];
  }
  average(band, shift, variance, threads);
  for (std::size_t i = 0; i < deviations.size(); ++i)
    deviations[i] = std::sqrt(left * variance[i] + std::max(0.0f, shift[i]));
  return deviations;
}

} // namespace pcl_uvol
