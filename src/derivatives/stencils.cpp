// SPDX-License-Identifier: BSD-3-Clause
#include "derivatives/stencils.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"

#include <Eigen/Core>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pcl_uvol {

namespace {

/** A multiple of the lanes: no group is written by two threads. */
constexpr std::size_t block_centers = 1024;
static_assert(block_centers % stencil_lanes == 0);

constexpr double largest_weight = 32767.0;

constexpr std::size_t cube_directions = 13;

/** In parts of the absolute weights: by less the curvature of a sample does not answer
 * its own deviation, and waves of that direction grow. */
constexpr double least_feedback = 0.1;

/** Stiffness times the squared reach: about 12 for random samples. Much stiffer
 * curvature is that of samples nearly on a line or a plane, and mostly noise. */
constexpr double most_stiffness = 50.0;

/** What the curvature (tr H - n^T H n) / 2 does with the values, over unit vectors n:
 * the axes and diagonals of a cube, which no direction is far from. */
struct CurvatureWeights {
  double stiffness; ///< sum of the absolute weights, at most
  double feedback;  ///< sum of the weights over that, at least
};

CurvatureWeights
computeCurvatureWeights(const LocalFit& fit, std::size_t count)
{
  constexpr std::size_t xx = 3, xy = 4, xz = 5, yy = 6, yz = 7, zz = 8;
  constexpr int directions[cube_directions][3] = {{1, 0, 0},
                                                  {0, 1, 0},
                                                  {0, 0, 1},
                                                  {1, 1, 0},
                                                  {1, -1, 0},
                                                  {1, 0, 1},
                                                  {1, 0, -1},
                                                  {0, 1, 1},
                                                  {0, 1, -1},
                                                  {1, 1, 1},
                                                  {1, 1, -1},
                                                  {1, -1, 1},
                                                  {-1, 1, 1}};
  const auto of = [&](std::size_t derivative) {
    return Eigen::Map<const Eigen::ArrayXd>(fit.getWeights(derivative),
                                            static_cast<Eigen::Index>(count));
  };
  CurvatureWeights weights{0.0, 1.0};
  for (const auto& n : directions) {
    const double per_length = 1.0 / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const auto across = [&](int i, int j) {
      return 0.5 * ((i == j ? 1.0 : 0.0) - n[i] * n[j] * per_length);
    };
    const auto weight = across(0, 0) * of(xx) + across(1, 1) * of(yy) +
                        across(2, 2) * of(zz) + 2.0 * across(0, 1) * of(xy) +
                        2.0 * across(0, 2) * of(xz) + 2.0 * across(1, 2) * of(yz);
    const double absolute = weight.abs().sum();
    weights.stiffness = std::max(weights.stiffness, absolute);
    weights.feedback = std::min(weights.feedback, weight.sum() / absolute);
  }
  return weights;
}

} // namespace

void
Stencils::compute(const SampleSet& samples,
                  const std::vector<std::uint32_t>& centers,
                  FitScheme scheme,
                  std::size_t k,
                  unsigned threads,
                  Report& report)
{
  StepTimer step(report, "stencils", centers.size());
  rows_ = derivativesOf(scheme);
  neighbors_ = std::min(k, samples.size() - 1);
  stiffness_.assign(centers.size(), 0.0f);
  nearest_.assign(centers.size(), 0.0f);
  reach_.assign(centers.size(), 0.0f);
  const std::size_t places = groups() * stencil_lanes;
  indices_.assign(places * neighbors_, centers.empty() ? 0 : centers.front());
  weights_.assign(places * neighbors_ * rows_, 0);
  scales_.assign(places * rows_, 0.0f);
  std::atomic<std::uint64_t> isotropic{0};
  parallelBlocks(centers.size(), block_centers, threads, [&](auto begin, auto end) {
    const std::vector<Position>& positions = samples.getPositions();
    NearestFinder finder(samples, neighbors_ + 1);
    LocalFit fit(scheme);
    std::vector<std::uint32_t> neighbors;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t center = centers[i];
      const float typical = i > begin ? reach_[i - 1] : 1.0f;
      const auto row = finder.find(positions[center], typical);
      neighbors.clear();
      float sq_nearest = row.size > 0 ? row.sq_dists[0] : 0.0f;
      bool is_first = true;
      for (std::size_t j = 0; j < row.size; ++j)
        // Others at distance 0, in float, may keep the centre out of its own row.
        if (row.samples[j] != center && neighbors.size() < neighbors_) {
          neighbors.push_back(row.samples[j]);
          sq_nearest =
              is_first ? row.sq_dists[j] : std::min(sq_nearest, row.sq_dists[j]);
          is_first = false;
        }
      const FitOutcome outcome =
          fit.fit(positions, center, neighbors.data(), neighbors.size());
      if (scheme == FitScheme::Quadratic) {
        CurvatureWeights weights = computeCurvatureWeights(fit, neighbors.size());
        if (outcome != FitOutcome::Full || weights.feedback < least_feedback ||
            weights.stiffness * fit.getReach() * fit.getReach() > most_stiffness) {
          fit.makeIsotropic();
          weights = computeCurvatureWeights(fit, neighbors.size());
          ++isotropic;
        }
        stiffness_[i] = static_cast<float>(weights.stiffness);
      }
      nearest_[i] = std::sqrt(sq_nearest);
      reach_[i] = static_cast<float>(fit.getReach());
      store(fit, neighbors.data(), neighbors.size(), i);
    }
    step.advance(end - begin);
  });
  report.count("isotropic_fits", isotropic);
}

void
Stencils::store(const LocalFit& fit,
                const std::uint32_t* neighbors,
                std::size_t count,
                std::size_t center)
{
  const std::size_t group = center / stencil_lanes, lane = center % stencil_lanes;
  std::uint32_t* const indices = &indices_[group * neighbors_ * stencil_lanes + lane];
  std::int16_t* const weights =
      &weights_[group * neighbors_ * rows_ * stencil_lanes + lane];
  float* const scales = &scales_[group * rows_ * stencil_lanes + lane];
  for (std::size_t j = 0; j < count; ++j)
    indices[j * stencil_lanes] = neighbors[j];
  for (std::size_t row = 0; row < rows_; ++row) {
    const double* const row_weights = fit.getWeights(row);
    double largest = 0.0;
    for (std::size_t j = 0; j < count; ++j)
      largest = std::max(largest, std::abs(row_weights[j]));
    if (largest == 0.0)
      continue;
    scales[row * stencil_lanes] = static_cast<float>(largest / largest_weight);
    const double steps = largest_weight / largest;
    for (std::size_t j = 0; j < count; ++j)
      weights[(j * rows_ + row) * stencil_lanes] = static_cast<std::int16_t>(
          row_weights[j] * steps + std::copysign(0.5, row_weights[j]));
  }
}

void
Stencils::renumber(const std::vector<std::uint32_t>& to)
{
  for (std::uint32_t& index : indices_)
    index = to[index];
}

} // namespace pcl_uvol
