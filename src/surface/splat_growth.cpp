// SPDX-License-Identifier: BSD-3-Clause
#include "surface/splat_growth.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Neighbours that are looked up where a splat covers all that are known, and how their
 * number grows where it covers them as well. */
constexpr std::size_t first_neighbors = 64, neighbor_growth = 4;

/** Neighbours that are sorted; of more of them, first halves are made. */
constexpr std::size_t sorted_at_once = 128;

/** Points by which normals are fitted, at least: nine unknowns have to be found. */
constexpr std::size_t fewest_for_normals = 8;

/** Cosine of the angle to the splat's normal from which on normals of neighbours belong
 * to another part of the surface, beyond an edge. */
constexpr float same_part = 0.5f;

/** Added to the squares of a fit for directions that no neighbour tells of. */
constexpr double ridge = 1e-6;

} // namespace

SplatGrower::SplatGrower(const SplatGround& ground)
    : ground_(ground)
{
}

NearestFinder&
SplatGrower::finder()
{
  while (finders_.size() < level_) {
    std::size_t k = first_neighbors;
    for (std::size_t level = 0; level < finders_.size(); ++level)
      k *= neighbor_growth;
    finders_.push_back(std::make_unique<NearestFinder>(*ground_.points.samples, k));
  }
  return *finders_[level_ - 1];
}

void
SplatGrower::expect(const std::vector<std::uint32_t>& samples)
{
  if (level_ == 0)
    return;
  expected_.clear();
  for (const std::uint32_t sample : samples)
    expected_.push_back(ground_.points.samples->getPositions()[sample]);
  finder().expect(expected_.data(), expected_.size());
}

void
SplatGrower::findNeighbors(std::uint32_t sample)
{
  const SampleSet& samples = *ground_.points.samples;
  neighbors_.clear();
  if (level_ == 0) {
    for (const std::uint32_t neighbor : ground_.nearest[sample])
      if (neighbor != sample)
        neighbors_.emplace_back(
            (Eigen::Map<const Eigen::Vector3f>(samples.getPositions()[neighbor].x) -
             here_)
                .squaredNorm(),
            neighbor);
    has_all_neighbors_ = neighbors_.size() + 1 >= samples.size();
    return;
  }
  const float length =
      std::max(ground_.least_radii[sample], std::numeric_limits<float>::min());
  const auto row = finder().find(samples.getPositions()[sample], length);
  const std::vector<std::uint8_t>& surfaces = ground_.points.surfaces;
  for (std::size_t i = 0; i < row.size; ++i)
    if (row.samples[i] != sample &&
        (surfaces.empty() || surfaces[row.samples[i]] == surfaces[sample]))
      neighbors_.emplace_back(row.sq_dists[i], row.samples[i]);
  has_all_neighbors_ = row.size >= samples.size();
}

bool
SplatGrower::look(std::uint32_t sample, Covered& seen) const
{
  seen.sample = sample;
  Eigen::Vector3f normal;
  unpackNormal(ground_.points.normals[sample], normal.data());
  float facing = normal.dot(axes_[2]);
  if (ground_.points.two_sided && facing < 0.0f) {
    normal = -normal;
    facing = -facing;
  }
  if (facing <= 0.0f)
    return false;
  const Eigen::Vector3f offset = Eigen::Map<const Eigen::Vector3f>(
                                     ground_.points.samples->getPositions()[sample].x) -
                                 here_;
  for (int axis = 0; axis < 3; ++axis)
    seen.offset[axis] = offset.dot(axes_[axis]);
  seen.distance = seen.offset.head<2>().norm();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  seen.inclination = facing > same_part ? Eigen::Vector2f(normal.dot(axes_[0]) / facing,
                                                          normal.dot(axes_[1]) / facing)
                                        : Eigen::Vector2f(nan, nan);
  return true;
}

bool
SplatGrower::isLast(const Covered& point)
{
  low_ = std::min(low_, point.offset[2]);
  high_ = std::max(high_, point.offset[2]);
  return high_ - low_ > 2.0 * ground_.delta || ground_.on_rim[point.sample];
}

bool
SplatGrower::coverAll(std::size_t begin, std::size_t end)
{
  const std::size_t covered = covered_.size();
  const float low = low_, high = high_;
  Covered next;
  for (std::size_t i = begin; i < end; ++i) {
    if (!look(neighbors_[i].second, next))
      continue;
    if (isLast(next)) {
      covered_.resize(covered);
      low_ = low;
      high_ = high;
      return false;
    }
    covered_.push_back(next);
  }
  return true;
}

bool
SplatGrower::coverSorted(std::size_t begin, std::size_t end)
{
  const auto first = neighbors_.begin();
  std::sort(first + static_cast<std::ptrdiff_t>(begin),
            first + static_cast<std::ptrdiff_t>(end));
  Covered next;
  for (std::size_t i = begin; i < end; ++i) {
    if (!look(neighbors_[i].second, next))
      continue;
    const float low = low_, high = high_;
    if (isLast(next)) {
      if (high_ - low_ > 2.0 * ground_.delta) {
        low_ = low;
        high_ = high;
      }
      else
        covered_.push_back(next); // on the rim
      return false;
    }
    covered_.push_back(next);
  }
  return true;
}

bool
SplatGrower::coverNearest(std::size_t begin, std::size_t end)
{
  if (end - begin <= sorted_at_once)
    return coverSorted(begin, end);
  if (coverAll(begin, end))
    return true;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = neighbors_.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                   first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end));
  return coverNearest(begin, middle) && coverNearest(middle, end);
}

bool
SplatGrower::growAcross(std::uint32_t sample)
{
  covered_.clear();
  low_ = high_ = 0.0f;
  if (ground_.on_rim[sample])
    return true;
  return !coverNearest(0, neighbors_.size()) || has_all_neighbors_;
}

void
SplatGrower::coverWithin(std::uint32_t sample, float radius)
{
  std::sort(neighbors_.begin(), neighbors_.end());
  while (!has_all_neighbors_ &&
         (neighbors_.empty() || neighbors_.back().first <= radius * radius)) {
    ++level_;
    findNeighbors(sample);
    std::sort(neighbors_.begin(), neighbors_.end());
  }
  covered_.clear();
  Covered next;
  for (const auto& [sq_dist, neighbor] : neighbors_) {
    if (sq_dist > radius * radius && covered_.size() >= fewest_for_normals)
      break;
    if (look(neighbor, next))
      covered_.push_back(next);
  }
}

void
SplatGrower::fitNormals(PointSplat& splat) const
{
  // In parts of a length that holds all points.
  float length = splat.radius;
  for (const Covered& point : covered_)
    length = std::max(length, point.distance);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  squares(0, 0) = 1.0; // the point itself, whose normal is that of the plane
  for (const Covered& point : covered_) {
    if (std::isnan(point.inclination[0]))
      continue;
    const Eigen::Vector3d terms(
        1.0, point.offset[0] / length, point.offset[1] / length);
    squares += terms * terms.transpose();
    right += terms * point.inclination.cast<double>().transpose();
  }
  for (int i = 1; i < 3; ++i)
    squares(i, i) += ridge * squares(0, 0);
  const Eigen::Matrix<double, 3, 2> fit = squares.ldlt().solve(right);
  // Turned to the directions of most and least change the field has the two slopes of
  // equation (4.1) only; what would turn normals about the centre is no surface.
  const double uu = fit(1, 0), vv = fit(2, 1), uv = 0.5 * (fit(1, 1) + fit(2, 0));
  const double angle = 0.5 * std::atan2(2.0 * uv, uu - vv);
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::Vector3d tangent =
      (c * axes_[0].cast<double>() + s * axes_[1].cast<double>()).normalized();
  splat.getTangentVector3fMap() = tangent.cast<float>();
  splat.tilt_u = static_cast<float>(c * fit(0, 0) + s * fit(0, 1));
  splat.tilt_v = static_cast<float>(c * fit(0, 1) - s * fit(0, 0));
  const double scale = splat.radius / length;
  splat.slope_u =
      static_cast<float>(scale * (c * c * uu + 2.0 * c * s * uv + s * s * vv));
  splat.slope_v =
      static_cast<float>(scale * (s * s * uu - 2.0 * c * s * uv + c * c * vv));
}

PackedRim
SplatGrower::rimOf(std::uint32_t sample, const PointSplat& splat) const
{
  if (ground_.rims[sample] == 0 || splat.radius > ground_.least_radii[sample])
    return 0;
  Eigen::Matrix<float, 3, 2> axes;
  axes << splat.getTangentVector3fMap(),
      splat.getNormalVector3fMap().cross(splat.getTangentVector3fMap());
  return turnRim(ground_.rims[sample],
                 tangentAxes(ground_.points.normals[sample]).transpose() * axes);
}

GrownSplat
SplatGrower::grow(std::uint32_t sample)
{
  here_ = Eigen::Map<const Eigen::Vector3f>(
      ground_.points.samples->getPositions()[sample].x);
  unpackNormal(ground_.points.normals[sample], axes_[2].data());
  axes_[0] = axes_[2].unitOrthogonal();
  axes_[1] = axes_[2].cross(axes_[0]);
  findNeighbors(sample);
  while (!growAcross(sample)) {
    ++level_;
    findNeighbors(sample);
  }
  GrownSplat grown;
  PointSplat& splat = grown.splat;
  const float middle = 0.5f * (low_ + high_);
  splat.getVector3fMap() = here_ + middle * axes_[2];
  splat.getNormalVector3fMap() = axes_[2];
  for (const Covered& point : covered_)
    splat.radius = std::max(splat.radius, point.distance);
  const float least = ground_.least_radii[sample];
  grown.widened = least > splat.radius;
  splat.radius = std::max(splat.radius, least);
  for (const Covered& point : covered_)
    if (point.distance <= ground_.lambda * splat.radius &&
        point.distance + ground_.least_radii[point.sample] <= splat.radius)
      grown.passed_over.push_back(point.sample);
  if (level_ > 0 && covered_.size() * neighbor_growth < neighbors_.size())
    --level_; // splats nearby are about as large
  if (grown.widened || covered_.size() < fewest_for_normals)
    coverWithin(sample, splat.radius);
  for (const Covered& point : covered_)
    if (point.distance <= splat.radius && std::abs(point.offset[2]) <= splat.radius)
      splat.error = std::max(splat.error, std::abs(point.offset[2] - middle));
  fitNormals(splat);
  grown.rim = rimOf(sample, splat);
  return grown;
}

} // namespace pcl_uvol
