// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/local_metric.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/** Samples whose neighbours are averaged: fewer scatter on random samples, more have
 * neighbours beyond the others. */
constexpr std::size_t central_samples = 12;

/** Lines per sample that a direction must have, as a mean, to count as seen. Of random
 * samples it has one, of layers with nothing beside them none but for what they are
 * curved or scattered. */
constexpr double least_lines = 0.3;

/** How much farther a next search looks across such samples, and how often: up to
 * spacings of 1 : 600. */
constexpr double stretching = 5.0;
constexpr int most_rounds = 6;

/** cos^2 of the angle between lines, 63 degrees: wider than the angle criterion's 55
 * (thesis Table 2.4), which diagonals of cubes just pass. */
constexpr float sq_cosine = 0.2f;

/** Of the longest and the shortest of some lengths. */
double
computeRatio(const Eigen::Vector3d& squares)
{
  return std::sqrt(squares.maxCoeff() / squares.minCoeff());
}

} // namespace

LineMoments::LineMoments(const std::vector<float> (&offsets)[3], std::size_t central)
{
  constexpr float gone = std::numeric_limits<float>::infinity();
  const std::size_t count = offsets[0].size();
  std::vector<float> lines[3], sq_lengths(count);
  for (auto& coordinate : lines)
    coordinate.resize(count);
  float* const x = lines[0].data();
  float* const y = lines[1].data();
  float* const z = lines[2].data();
  float* const sq = sq_lengths.data();
  for (std::size_t i = 0; i < central; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t j = 0; j < count; ++j)
        lines[axis][j] = offsets[axis][j] - offsets[axis][i];
    for (std::size_t j = 0; j < count; ++j)
      sq[j] = x[j] * x[j] + y[j] * y[j] + z[j] * z[j];
    sq[i] = gone;
    for (;;) {
      const auto nearest =
          static_cast<std::size_t>(std::min_element(sq, sq + count) - sq);
      const float sq_length = sq[nearest];
      if (sq_length == gone)
        break;
      const float a = x[nearest], b = y[nearest], c = z[nearest];
      const Eigen::Vector3d line(a, b, c);
      const Eigen::Matrix3d square = line * line.transpose();
      lengths += square;
      directions += square / static_cast<double>(sq_length);
      const float bound = sq_cosine * sq_length;
      for (std::size_t j = 0; j < count; ++j) {
        const float product = a * x[j] + b * y[j] + c * z[j];
        sq[j] = product * product > bound * sq[j] ? gone : sq[j];
      }
      sq[nearest] = gone;
    }
  }
}

void
LocalMetricFinder::gather(std::uint32_t sample,
                          const std::uint32_t* neighbors,
                          std::size_t count)
{
  const std::vector<Position>& positions = samples_.getPositions();
  nearest_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t neighbor = neighbors[i];
    Eigen::Vector3d offset;
    for (int axis = 0; axis < 3; ++axis)
      offset[axis] =
          static_cast<double>(positions[neighbor][axis]) - positions[sample][axis];
    nearest_.emplace_back((metric_ * offset).squaredNorm(), offset);
  }
  std::stable_sort(nearest_.begin(), nearest_.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    offsets_[axis].clear();
    for (const auto& neighbor : nearest_)
      offsets_[axis].push_back(
          static_cast<float>(neighbor.second[static_cast<Eigen::Index>(axis)]));
  }
}

bool
LocalMetricFinder::stretchAcross(const LineMoments& lines)
{
  const Solver eigen(lines.directions);
  Eigen::Matrix3d shrink = Eigen::Matrix3d::Identity();
  int unseen = 0;
  for (; unseen < 3 && eigen.eigenvalues()[unseen] < least_lines * central_samples;
       ++unseen) {
    const Eigen::Vector3d axis = eigen.eigenvectors().col(unseen);
    shrink -= (1.0 - 1.0 / stretching) * axis * axis.transpose();
  }
  metric_ *= shrink;
  return unseen > 0;
}

bool
LocalMetricFinder::find(std::uint32_t sample, double least_ratio)
{
  if (!has_last_ || sample != last_ || least_ratio != last_ratio_) {
    last_found_ = search(sample, least_ratio);
    last_ = sample;
    last_ratio_ = least_ratio;
    has_last_ = true;
  }
  return last_found_;
}

bool
LocalMetricFinder::search(std::uint32_t sample, double least_ratio)
{
  const Position& place = samples_.getPositions()[sample];
  metric_.setIdentity();
  spacings_.setIdentity();
  bool was_seen = false;
  for (int round = 0; round < most_rounds; ++round) {
    if (round == 0) {
      const auto row = first_finder_.find(place, static_cast<float>(typical_reach_));
      gather(sample, row.samples, row.size);
      reach_ = typical_reach_ = std::sqrt(nearest_.back().first);
    }
    else {
      const auto& row = finder_.find(place, metric_);
      gather(sample, row.data(), row.size());
      reach_ = std::max(reach_, finder_.getReach());
    }
    const LineMoments lines(offsets_, std::min(central_samples, nearest_.size()));
    if (stretchAcross(lines)) {
      if (was_seen) // what is seen from here is not what is there
        break;
      continue;
    }
    was_seen = true;
    const Solver eigen(lines.lengths);
    const Eigen::Matrix3d& axes = eigen.eigenvectors();
    Eigen::Vector3d squares;
    for (int i = 0; i < 3; ++i)
      squares[i] =
          eigen.eigenvalues()[i] / axes.col(i).dot(lines.directions * axes.col(i));
    spacings_ = axes * squares.asDiagonal() * axes.transpose();
    ratio_ = computeRatio(squares);
    const Solver seen(metric_ * spacings_ * metric_.transpose());
    if (round == 0 && ratio_ < least_ratio)
      return false;
    const Eigen::Vector3d factors =
        (squares.minCoeff() * squares.cwiseInverse()).cwiseSqrt();
    metric_ = axes * factors.asDiagonal() * axes.transpose();
    if (round > 0 && computeRatio(seen.eigenvalues()) < even_ratio)
      return true;
  }
  ratio_ = std::numeric_limits<double>::infinity();
  return false;
}

} // namespace pcl_uvol
