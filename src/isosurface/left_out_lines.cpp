// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/left_out_lines.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Across lines samples are so many times farther apart than along them, at least. */
constexpr double certain_lines = 2.0;

/** In spacings: samples that lie no farther apart across lines are on the same one. */
constexpr double same_line = 0.5;

/** Over a gap twice as wide quadratics miss by eight times as much, cubics by 16. The
 * share covers nine in ten together with the factor of standard errors. */
constexpr double shorter_gap = 1.0 / 7.0;

/** In radii: a zero level that is not found without a line may be anywhere in the
 * support. */
constexpr double anywhere = 1.0;

constexpr std::size_t no_line = std::numeric_limits<std::size_t>::max();

Eigen::Vector3d
placeOf(const FitSample& sample, std::size_t lane)
{
  return {sample.x[lane], sample.y[lane], sample.z[lane]};
}

} // namespace

SampleLines
findLines(const Eigen::Matrix3d& spacings)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spacings);
  const Eigen::Vector3d& squares = eigen.eigenvalues();
  if (!(squares[1] >= certain_lines * certain_lines * squares[0]))
    return {};
  return {eigen.eigenvectors().col(0), std::sqrt(squares[0])};
}

LeftOutLines::LeftOutLines(FitKernel fit)
    : fit_(fit)
{
}

void
LeftOutLines::sortIntoLines(const std::vector<FitSample>& samples,
                            std::size_t lane,
                            const SampleLines& lines)
{
  const auto footOf = [&](std::size_t i) -> Eigen::Vector3d {
    const Eigen::Vector3d place = placeOf(samples[i], lane);
    return place - place.dot(lines.along) * lines.along;
  };
  order_.clear();
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (placeOf(samples[i], lane).squaredNorm() < 1.0)
      order_.emplace_back(footOf(i).norm(), i);
  std::sort(order_.begin(), order_.end());
  lines_.assign(samples.size(), no_line);
  feet_.clear();
  for (const auto& [distance, i] : order_) {
    const Eigen::Vector3d foot = footOf(i);
    const auto line = std::find_if(feet_.begin(), feet_.end(), [&](const auto& other) {
      return (foot - other).norm() <= same_line * lines.spacing;
    });
    lines_[i] = static_cast<std::size_t>(line - feet_.begin());
    if (line == feet_.end())
      feet_.push_back(foot);
  }
}

int
LeftOutLines::copyWithout(std::size_t line,
                          const std::vector<FitSample>& samples,
                          std::size_t lane,
                          std::size_t target)
{
  constexpr float outside = 2.0f; // no weight there
  int weighted = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool stays = lines_[i] != line && lines_[i] != no_line;
    rest_[i].x[target] = stays ? samples[i].x[lane] : outside;
    rest_[i].y[target] = samples[i].y[lane];
    rest_[i].z[target] = samples[i].z[lane];
    rest_[i].value[target] = samples[i].value[lane];
    weighted += stays;
  }
  return weighted;
}

double
LeftOutLines::measureError(const std::vector<FitSample>& samples,
                           std::size_t lane,
                           const SampleLines& lines,
                           const FitResult& result)
{
  sortIntoLines(samples, lane, lines);
  rest_.resize(samples.size());
  int weighted[fit_lanes];
  for (std::size_t line = 0; line < fit_lanes; ++line)
    weighted[line] = copyWithout(line, samples, lane, line);
  FitResult moved;
  fit_(rest_.data(), rest_.size(), weighted, moved);
  const auto column = static_cast<Eigen::Index>(lane);
  const Eigen::Map<const Eigen::Matrix<double, fit_lanes, 3>> gradients(
      result.gradient[0]),
      offsets(result.offset[0]), moved_offsets(moved.offset[0]);
  const Eigen::Vector3d normal = gradients.row(column).normalized();
  double squares = 0.0;
  for (std::size_t line = 0; line < std::min(fit_lanes, feet_.size()); ++line) {
    const auto row = static_cast<Eigen::Index>(line);
    squares +=
        moved.order[line] == fit_failed
            ? anywhere * anywhere
            : std::pow((moved_offsets.row(row) - offsets.row(column)).dot(normal), 2);
  }
  return shorter_gap * std::sqrt(squares);
}

} // namespace pcl_uvol
