// SPDX-License-Identifier: BSD-3-Clause
#include "local_metric.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/** Samples whose neighbours are averaged: fewer scatter on random samples, more have
 * neighbours beyond the others. */
constexpr std::size_t central_samples = 12;

/** Of the standard deviations of samples across and along: below it they lie on a
 * surface or a line. Of samples in a ball it is 1, on two layers more than 0.3. */
constexpr double flat_ratio = 0.2;

/** How much farther a next search looks across such samples, and how often: up to
 * spacings of 1 : 2000. */
constexpr double stretching = 3.0;
constexpr int most_rounds = 10;

/** cos^2 of the angle between lines, 63 degrees: wider than the angle criterion's 55
 * (thesis Table 2.4), which diagonals of cubes just pass. */
constexpr double sq_cosine = 0.2;

/** Of the longest and the shortest axis. */
double
ratioOf(const Solver& moment)
{
  return std::sqrt(moment.eigenvalues()[2] / moment.eigenvalues()[0]);
}

} // namespace

Eigen::Matrix3d
momentOfLines(const std::vector<Eigen::Vector3d>& offsets, std::size_t central)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Vector3d> lines;
  std::vector<double> sq_lengths;
  for (std::size_t i = 0; i < central; ++i) {
    lines.clear();
    sq_lengths.clear();
    for (std::size_t j = 0; j < offsets.size(); ++j)
      if (j != i) {
        lines.push_back(offsets[j] - offsets[i]);
        sq_lengths.push_back(lines.back().squaredNorm());
      }
    Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
    double kept = 0.0;
    while (!lines.empty()) {
      const auto nearest = static_cast<std::size_t>(
          std::min_element(sq_lengths.begin(), sq_lengths.end()) - sq_lengths.begin());
      const Eigen::Vector3d line = lines[nearest];
      const double sq_length = sq_lengths[nearest];
      own += line * line.transpose();
      kept += 1.0;
      std::size_t left = 0;
      for (std::size_t j = 0; j < lines.size(); ++j) {
        const double product = line.dot(lines[j]);
        if (product * product > sq_cosine * sq_length * sq_lengths[j])
          continue;
        lines[left] = lines[j];
        sq_lengths[left++] = sq_lengths[j];
      }
      lines.resize(left);
      sq_lengths.resize(left);
    }
    sum += own / kept;
  }
  return sum / static_cast<double>(central);
}

void
LocalMetricFinder::sortOffsets(const Position& point)
{
  offsets_.clear();
  order_.clear();
  for (const std::uint32_t sample : nearest_) {
    const Position& x = samples_.getPositions()[sample];
    Eigen::Vector3d offset;
    for (int axis = 0; axis < 3; ++axis)
      offset[axis] = static_cast<double>(x[axis]) - point[axis];
    order_.emplace_back((metric_ * offset).squaredNorm(),
                        static_cast<std::uint32_t>(offsets_.size()));
    offsets_.push_back(offset);
  }
  std::sort(order_.begin(), order_.end());
  std::vector<Eigen::Vector3d> sorted;
  for (const auto& entry : order_)
    sorted.push_back(offsets_[entry.second]);
  offsets_.swap(sorted);
}

bool
LocalMetricFinder::stretchAcross()
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& offset : offsets_)
    mean += metric_ * offset;
  mean /= static_cast<double>(offsets_.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& offset : offsets_) {
    const Eigen::Vector3d u = metric_ * offset - mean;
    scatter += u * u.transpose();
  }
  const Solver eigen(scatter);
  const double largest = eigen.eigenvalues()[2];
  bool is_flat = false;
  Eigen::Matrix3d shrink = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 2; ++i)
    if (!(eigen.eigenvalues()[i] > flat_ratio * flat_ratio * largest)) {
      const Eigen::Vector3d axis = eigen.eigenvectors().col(i);
      shrink -= (1.0 - 1.0 / stretching) * axis * axis.transpose();
      is_flat = true;
    }
  if (is_flat)
    metric_ = shrink * metric_;
  return is_flat;
}

LocalMetricFinder::Outcome
LocalMetricFinder::find(const Position& point,
                        const std::uint32_t* nearest,
                        std::size_t count,
                        double most_even)
{
  metric_.setIdentity();
  nearest_.assign(nearest, nearest + count);
  for (int round = 0; round < most_rounds; ++round) {
    if (round > 0)
      nearest_ = finder_.find(point, metric_);
    sortOffsets(point);
    reach_ = round == 0 ? offsets_.back().norm()
                        : std::max(reach_,
                                   finder_.getReach() *
                                       std::sqrt(metric_.inverse().operatorNorm()));
    if (stretchAcross())
      continue;
    moment_ = momentOfLines(offsets_, std::min(central_samples, offsets_.size()));
    const Solver eigen(moment_);
    if (!(eigen.eigenvalues()[0] > 0.0))
      break;
    ratio_ = ratioOf(eigen);
    const Solver seen(metric_ * moment_ * metric_.transpose());
    if (ratioOf(seen) < (round == 0 ? most_even : even_ratio))
      return round == 0 ? Outcome::Even : Outcome::Stretched;
    metric_ = std::sqrt(eigen.eigenvalues()[0]) * eigen.operatorInverseSqrt();
  }
  return Outcome::None;
}

} // namespace pcl_uvol
