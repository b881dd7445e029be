// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/local_metric.h"

#include "common/constants.h"
#include "neighbors/kernel_tables.h"

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

/** Share of the variances of nearest samples across a layer and along it: with less,
 * none of the lines between them lead across. */
constexpr double sq_layer = 0.0025;

/** In spacings across layers: what is nearer belongs to the same layer. */
constexpr double half_layer = 0.5;

/** In radii of the samples that a metric is made from: edges of rotated lattices end
 * farther out than those, edges across gaps that nothing can be said of far beyond. */
constexpr double gap = 16.0;

/** cos^2 of the angle between lines, 63 degrees: wider than the angle criterion's 55
 * (thesis Table 2.4), which diagonals of cubes just pass. */
constexpr float sq_cosine = 0.2f;

/** The ratio of the longest and the shortest of some lengths. */
double
computeRatio(const Eigen::Vector3d& squares)
{
  return std::sqrt(squares.maxCoeff() / squares.minCoeff());
}

Eigen::Vector3d
between(const Position& from, const Position& to)
{
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis)
    offset[axis] = static_cast<double>(to[axis]) - from[axis];
  return offset;
}

Eigen::Matrix3d
toMatrix(const double (&moments)[6])
{
  Eigen::Matrix3d matrix;
  matrix << moments[0], moments[1], moments[2], //
      moments[1], moments[3], moments[4],       //
      moments[2], moments[4], moments[5];
  return matrix;
}

/** Whether samples differ along all axes: those of the whole cloud, whose axes the tree
 * of a piece has. */
bool
fillsSpace(const KdTree& tree)
{
  const int a = tree.getAxis(0), b = tree.getAxis(1), c = tree.getAxis(2);
  return a != b && b != c && c != a;
}

} // namespace

LineMoments::LineMoments(const std::vector<float> (&offsets)[3], std::size_t central)
{
  constexpr float gone = std::numeric_limits<float>::infinity();
  const std::size_t samples = offsets[0].size();
  const std::size_t count = (samples + line_lanes - 1) / line_lanes * line_lanes;
  std::vector<float> lines[3], sq_lengths(count);
  for (auto& coordinate : lines)
    coordinate.resize(count);
  const MetricKernels& kernels = *metric_kernel_table.get();
  MetricMoments moments{};
  for (std::size_t i = 0; i < central; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t j = 0; j < samples; ++j)
        lines[axis][j] = offsets[axis][j] - offsets[axis][i];
    const float *x = lines[0].data(), *y = lines[1].data(), *z = lines[2].data();
    for (std::size_t j = 0; j < samples; ++j)
      sq_lengths[j] = x[j] * x[j] + y[j] * y[j] + z[j] * z[j];
    std::fill(sq_lengths.begin() + static_cast<std::ptrdiff_t>(samples),
              sq_lengths.end(),
              gone);
    sq_lengths[i] = gone;
    kernels.addLines(x, y, z, sq_lengths.data(), count, sq_cosine, moments);
  }
  lengths = toMatrix(moments.lengths);
  directions = toMatrix(moments.directions);
}

LocalMetricFinder::LocalMetricFinder(const SampleSet& samples)
    : samples_(samples)
    , is_flat_(!fillsSpace(samples.getTree()))
    , first_finder_(samples, pool)
    , finder_(samples, pool)
{
}

bool
LocalMetricFinder::reaches(const Position& point) const
{
  const Eigen::Vector3d offset = between(samples_.getPositions()[last_], point);
  const double sq_distance = (metric_ * offset).squaredNorm() / (gap * gap);
  return std::any_of(nearest_.begin(), nearest_.end(), [&](const auto& neighbor) {
    return (metric_ * neighbor.second).squaredNorm() >= sq_distance;
  });
}

double
LocalMetricFinder::findPoolRadius(const Position& point) const
{
  const Eigen::Vector3d offset = between(samples_.getPositions()[last_], point);
  double sq_farthest = 0.0;
  for (const auto& neighbor : nearest_)
    sq_farthest =
        std::max(sq_farthest, (metric_ * (neighbor.second - offset)).squaredNorm());
  return std::sqrt(sq_farthest);
}

std::uint32_t
LocalMetricFinder::findAnchor(std::uint32_t sample) const
{
  const auto& trees = samples_.getTrees();
  const auto next = std::upper_bound(
      trees.begin(), trees.end(), sample, [](std::uint32_t i, const KdTree& tree) {
        return i < tree.getRoot().begin;
      });
  KdNode node = std::prev(next)->getRoot();
  while (node.count > group_samples) {
    const KdNode right = node.right();
    node = sample < right.begin ? node.left() : right;
  }
  return node.begin + node.count / 2;
}

void
LocalMetricFinder::gather(std::uint32_t sample,
                          const std::uint32_t* neighbors,
                          std::size_t count)
{
  const std::vector<Position>& positions = samples_.getPositions();
  const Position& place = positions[sample];
  order_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d image = metric_ * between(place, positions[neighbors[i]]);
    order_.emplace_back(image.squaredNorm(), neighbors[i]);
  }
  std::sort(order_.begin(), order_.end());
  nearest_.clear();
  for (auto& coordinate : offsets_)
    coordinate.clear();
  for (const auto& [sq_dist, neighbor] : order_) {
    const Eigen::Vector3d offset = between(place, positions[neighbor]);
    nearest_.emplace_back(sq_dist, offset);
    for (int axis = 0; axis < 3; ++axis)
      offsets_[axis].push_back(static_cast<float>(offset[axis]));
  }
}

bool
LocalMetricFinder::stretchAcrossLayer()
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& neighbor : nearest_) {
    const Eigen::Vector3d image = metric_ * neighbor.second;
    mean += image;
    squares += image * image.transpose();
  }
  squares -= mean * mean.transpose() / static_cast<double>(nearest_.size());
  const Solver eigen(squares);
  if (!(eigen.eigenvalues()[0] < sq_layer * eigen.eigenvalues()[1]))
    return false;
  const Eigen::Vector3d normal =
      (metric_.transpose() * eigen.eigenvectors().col(0)).normalized();
  metric_ -= (1.0 - 1.0 / stretching) * (metric_ * normal) * normal.transpose();
  return true;
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

double
LocalMetricFinder::setMetric(const LineMoments& lines)
{
  const Solver eigen(lines.lengths);
  const Eigen::Matrix3d& axes = eigen.eigenvectors();
  Eigen::Vector3d squares;
  for (int i = 0; i < 3; ++i)
    squares[i] =
        eigen.eigenvalues()[i] / axes.col(i).dot(lines.directions * axes.col(i));
  // Lines between samples that are both very near and very far have no squares in
  // float.
  if (!(squares.minCoeff() > 0.0) || !squares.allFinite()) {
    metric_.setIdentity();
    return infinity<double>;
  }
  spacings_ = axes * squares.asDiagonal() * axes.transpose();
  ratio_ = computeRatio(squares);
  const Solver seen(metric_ * spacings_ * metric_.transpose());
  const Eigen::Vector3d factors =
      (squares.minCoeff() * squares.cwiseInverse()).cwiseSqrt();
  metric_ = axes * factors.asDiagonal() * axes.transpose();
  return computeRatio(seen.eigenvalues());
}

bool
LocalMetricFinder::find(std::uint32_t sample, double least_ratio)
{
  if (known_ == Known::Nothing || known_ == Known::Refined || sample != last_) {
    last_ = sample;
    is_seen_ = lookAround(sample);
    first_ratio_ = ratio_;
    known_ = Known::FirstLook;
  }
  if (is_flat_ || (is_seen_ && first_ratio_ < least_ratio))
    return false;
  if (known_ == Known::FirstLook) {
    has_metric_ = search(sample);
    known_ = Known::Searched;
  }
  return has_metric_;
}

bool
LocalMetricFinder::lookAround(std::uint32_t sample)
{
  metric_.setIdentity();
  spacings_.setIdentity();
  ratio_ = infinity<double>;
  searched_.clear();
  if (is_flat_)
    return false;
  const auto row = first_finder_.find(samples_.getPositions()[sample],
                                      static_cast<float>(typical_reach_));
  gather(sample, row.samples, row.size);
  typical_reach_ = std::sqrt(nearest_.back().first);
  searched_.push_back(
      {samples_.getPositions()[sample], static_cast<float>(typical_reach_)});
  if (stretchAcrossLayer())
    return false;
  const LineMoments lines(offsets_, std::min(central_samples, nearest_.size()));
  return !stretchAcross(lines) && setMetric(lines) < infinity<double>;
}

bool
LocalMetricFinder::hasLayers() const
{
  const Solver eigen(spacings_);
  const Eigen::Vector3d across =
      eigen.eigenvectors().col(2) / std::sqrt(eigen.eigenvalues()[2]);
  double first = infinity<double>, lowest = 0.0, highest = 0.0;
  for (const auto& neighbor : nearest_) {
    const double height = across.dot(neighbor.second);
    if (std::abs(height) > half_layer)
      first = std::min(first, std::abs(height));
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  const double second = first + half_layer;
  return (lowest < -half_layer && highest > half_layer) ||
         std::max(-lowest, highest) > second;
}

double
LocalMetricFinder::sqFarthest() const
{
  double sq_farthest = 0.0;
  for (const auto& neighbor : nearest_)
    sq_farthest = std::max(sq_farthest, (metric_ * neighbor.second).squaredNorm());
  return sq_farthest;
}

double
LocalMetricFinder::lookInMetric(std::uint32_t sample, double sq_limit, bool may_stretch)
{
  const auto& row = finder_.find(samples_.getPositions()[sample], metric_, sq_limit);
  gather(sample, row.data(), row.size());
  searched_.push_back(finder_.getSearched());
  if (may_stretch && stretchAcrossLayer())
    return infinity<double>;
  const LineMoments lines(offsets_, std::min(central_samples, nearest_.size()));
  return stretchAcross(lines) ? infinity<double> : setMetric(lines);
}

bool
LocalMetricFinder::search(std::uint32_t sample)
{
  bool was_seen = is_seen_;
  for (int round = 1; round < most_rounds; ++round) {
    const double ratio = lookInMetric(sample, sqFarthest(), !was_seen);
    if (was_seen &&
        !std::isfinite(ratio)) // what is seen from here is not what is there
      break;
    was_seen = std::isfinite(ratio);
    if (ratio < even_ratio)
      return is_seen_ || hasLayers();
  }
  ratio_ = infinity<double>;
  return false;
}

bool
LocalMetricFinder::refine(std::uint32_t sample,
                          const LocalMetricFinder& nearby,
                          double least_ratio)
{
  if (known_ != Known::Refined || sample != last_) {
    last_ = sample;
    metric_ = nearby.metric_;
    searched_.clear();
    const double pool_radius = nearby.findPoolRadius(samples_.getPositions()[sample]);
    double ratio = lookInMetric(sample, pool_radius * pool_radius, false);
    for (int round = 2;
         round < most_rounds && ratio >= even_ratio && std::isfinite(ratio);
         ++round)
      ratio = lookInMetric(sample, sqFarthest(), false);
    has_metric_ = ratio < even_ratio;
    known_ = Known::Refined;
  }
  return has_metric_ && ratio_ >= least_ratio;
}

} // namespace pcl_uvol
