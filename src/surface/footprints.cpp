// SPDX-License-Identifier: BSD-3-Clause
#include "surface/footprints.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/planar_cell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace pcl_uvol {

namespace {

constexpr std::size_t footprint_block = 1u << 12;
/** Points that are looked up in a box in common. */
constexpr std::size_t run_points = 16;

/** Neighbours that bound nearly all cells, and those for the others: rims, and scans
 * whose lines lie far apart. */
constexpr std::size_t few_neighbors = 16, many_neighbors = 64;

/** In parts of the largest radius among the nearest points: an outlier gets no more.
 * Isopoints come in clumps, so that the nearest alone may have much less room than all
 * around. */
constexpr float largest_growth = 3.0f;
constexpr std::size_t compared_neighbors = 8;

/** For the surface's curvature, which takes neighbours out of the tangent plane. */
constexpr float room = 1.05f;

/** Farther corners, in spacings, are holes in the surface, not in its sampling. */
constexpr float most_spacings = 4.0f;

/** Edges, and parts of all edges that are shorter, that bound the disc of an isopoint:
 * on a surface that goes on all around, where isopoints may lie at the ends of edges
 * and edges across a thin layer of samples are short; and where it does not, as on
 * specks of noise. @{ */
constexpr float measured_edges = 2.0f, unmeasured_edges = 1.0f;
constexpr std::size_t measured_percentile = 90, unmeasured_percentile = 50;
/** @} */

/** Cosine of the angle of normals, and sine of the angle to the tangent plane, of
 * points that lie on one smooth surface. @{ */
constexpr float least_agreement = 0.5f, steepest = 0.7f;
/** @} */

/** Neighbours that a disc has to meet: it closes no surface else. */
constexpr std::size_t least_company = 3;

/** In parts of what half of the nearest points have: a point whose 16th neighbour is
 * farther away is isolated. Isopoints of graded samples grow apart by less, and clumps
 * of them are in the other half. */
constexpr float isolated_distance = 6.0f;

/** Cosine of the angle to the mean direction: a point beyond it lies on the other side.
 */
constexpr float opposite = -0.2f;

/** Footprints of one point after another; one object per thread. */
class FootprintFinder {
public:
  explicit FootprintFinder(const OrientedPoints& points)
      : samples_(*points.samples)
      , normals_(points.normals)
      , edge_lengths_(points.edge_lengths)
      , surfaces_(points.surfaces)
      , bridged_(points.bridged)
      , two_sided_(points.two_sided)
      , few_(samples_, std::tuple_size_v<NearestPoints> + 1)
      , many_(samples_, many_neighbors + 1)
  {
  }

  /** Prepare for consecutive points. */
  void
  expect(std::size_t first, std::size_t count)
  {
    few_.expect(&samples_.getPositions()[first], count);
  }

  /** Distances of a point's corners: of all, and of those it is the first for; and of
   * its 16th neighbour, or the last one. */
  struct Reach {
    float all = 0.0f, first = 0.0f;
    bool on_rim = true;
    float around = 0.0f;
    SurfaceBend bend = SurfaceBend::Zero();
    PackedRim rim = 0; ///< of a disc of that radius
  };

  /** \param nearest set to the indices of the nearest other points */
  Reach
  find(std::uint32_t point, float typical_distance, NearestPoints& nearest)
  {
    const Position& position = samples_.getPositions()[point];
    lookFrom(point);
    gather(few_.find(position, typical_distance), point);
    if (neighbors_.size() < few_neighbors &&
        !(surfaces_.empty() && bridged_.empty())) // others crowd them out
      gather(many_.find(position, typical_distance), point);
    nearest.fill(point);
    for (std::size_t i = 0; i < std::min(nearest.size(), neighbors_.size()); ++i)
      nearest[i] = neighbors_[i].second;
    neighbors_.resize(std::min(neighbors_.size(), few_neighbors));
    if (neighbors_.empty())
      return {};
    const float around = std::sqrt(neighbors_.back().first);
    const float to_company = distanceToCompany();
    sortEdges(point);
    Reach reach = reachAmong(point);
    if (reach.on_rim) {
      gather(many_.find(position, typical_distance), point);
      reach = reachAmong(point);
    }
    reach.around = around;
    reach.bend = bendAmong(point, 0.5f * reach.all);
    const float edges = edgesAbout(!reach.on_rim && isMeasured());
    const float most = std::min(around, edges);
    const bool is_alone = to_company > 2.0f * most;
    reach.on_rim |= is_alone || reach.all > edges;
    reach.all = is_alone ? 0.0f : std::min(reach.all, most);
    reach.first = std::min(reach.first, reach.all);
    reach.rim = rimOf(point, reach.all);
    return reach;
  }

private:
  void
  lookFrom(std::uint32_t point)
  {
    normal_ = normalOf(point);
    here_ = positionOf(point);
    axes_[0] = normal_.unitOrthogonal();
    axes_[1] = normal_.cross(axes_[0]);
  }

  /** The lengths of the edges of a point and of those that gather() found. */
  void
  sortEdges(std::uint32_t point)
  {
    if (edge_lengths_.empty())
      return;
    lengths_ = {edge_lengths_[point]};
    for (const auto& neighbor : neighbors_)
      lengths_.push_back(edge_lengths_[neighbor.second]);
    std::sort(lengths_.begin(), lengths_.end());
  }

  /** What edges tell of a point's surroundings: single ones are much shorter than the
   * samples lie apart, or cross a gap. */
  float
  edgesAbout(bool is_measured) const
  {
    if (lengths_.empty())
      return std::numeric_limits<float>::infinity();
    const std::size_t percentile =
        is_measured ? measured_percentile : unmeasured_percentile;
    return (is_measured ? measured_edges : unmeasured_edges) *
           lengths_[lengths_.size() * percentile / 100];
  }

  bool
  isNearPlane(std::uint32_t other) const
  {
    const Eigen::Vector3f offset = positionOf(other) - here_;
    const float height = offset.dot(normal_);
    return height * height <= steepest * steepest * offset.squaredNorm();
  }

  /** How far the last of the neighbours is that a disc has to meet; infinitely, where
   * there are fewer on a surface through the point, as around specks beside one. Of
   * some points that are all there are, any one counts. */
  float
  distanceToCompany() const
  {
    if (neighbors_.size() < few_neighbors)
      return std::sqrt(
          neighbors_[std::min(least_company, neighbors_.size()) - 1].first);
    std::size_t company = 0;
    for (const auto& [sq_dist, neighbor] : neighbors_)
      if (isNearPlane(neighbor) &&
          std::abs(normal_.dot(normalOf(neighbor))) >= least_agreement &&
          ++company == least_company)
        return std::sqrt(sq_dist);
    return std::numeric_limits<float>::infinity();
  }

  /** Whether the points around the cell that reachAmong() cut lie on one surface with
   * its point. */
  bool
  isMeasured() const
  {
    return cell_.allNeighbors([&](std::uint32_t neighbor) {
      const float agreement = normal_.dot(normalOf(neighbor));
      return (two_sided_ ? std::abs(agreement) : agreement) >= least_agreement &&
             isNearPlane(neighbor);
    });
  }

  void
  gather(const NearestFinder::Row& row, std::uint32_t point)
  {
    neighbors_.clear();
    for (std::size_t i = 0; i < row.size; ++i)
      if (row.samples[i] != point && isOfSameSurface(row.samples[i], point))
        neighbors_.emplace_back(row.sq_dists[i], row.samples[i]);
    std::sort(neighbors_.begin(), neighbors_.end());
    sq_known_ = row.size < samples_.size()
                    ? *std::max_element(row.sq_dists, row.sq_dists + row.size)
                    : std::numeric_limits<float>::infinity();
    placeInPlane();
  }

  /** Bring the neighbours into the plane. */
  void
  placeInPlane()
  {
    const Eigen::Vector3f here = here_, a = axes_[0], b = axes_[1];
    places_.clear();
    for (const auto& neighbor : neighbors_) {
      const Eigen::Vector3f offset = positionOf(neighbor.second) - here;
      places_.emplace_back(offset.dot(a), offset.dot(b));
    }
  }

  bool
  isOfSameSurface(std::uint32_t other, std::uint32_t point) const
  {
    return (surfaces_.empty() || surfaces_[other] == surfaces_[point]) &&
           (bridged_.empty() || !bridged_[other]);
  }

  /** Spacing s of points with 1 / s^2 points per area, k of them in a circle of radius
   * s sqrt(k / pi): half of those that are known, so that clumps of points count as
   * what they are only where few neighbours decide. */
  float
  spacing() const
  {
    constexpr float pi = 3.14159265f;
    const std::size_t k = (neighbors_.size() + 1) / 2;
    return std::sqrt(neighbors_[k - 1].first * pi / static_cast<float>(k));
  }

  Eigen::Vector3f
  normalOf(std::uint32_t point) const
  {
    Eigen::Vector3f normal;
    unpackNormal(normals_[point], normal.data());
    return normal;
  }

  Eigen::Vector3f
  positionOf(std::uint32_t point) const
  {
    return Eigen::Map<const Eigen::Vector3f>(samples_.getPositions()[point].x);
  }

  /** On the rim: as far as these neighbours tell. */
  Reach
  reachAmong(std::uint32_t point)
  {
    if (neighbors_.empty())
      return {};
    in_plane_.clear();
    looked_at_ = 0;
    cell_.reset(2.0f * std::sqrt(neighbors_.back().first));
    // What is farther than twice the farthest corner cuts nothing off.
    while (looked_at_ < neighbors_.size() &&
           neighbors_[looked_at_].first <= 4.0f * cell_.sqExtent())
      if (lookAtNext())
        cell_.cut(in_plane_.back(), neighbors_[looked_at_ - 1].second);
    bool on_rim = !cell_.isBounded();
    const float sq_spacing = spacing() * spacing();
    float sq_all = 0.0f, sq_first = 0.0f;
    cell_.forCorners([&](const Eigen::Vector2f& corner, auto before, auto next) {
      const float sq_dist = corner.squaredNorm();
      const bool is_first = point < std::min(before, next);
      if (sq_dist <= (is_first ? std::min(sq_all, sq_first) : sq_all))
        return;
      if (sq_dist > most_spacings * most_spacings * sq_spacing ||
          (sq_dist > sq_spacing && !isSurrounded(corner))) {
        on_rim = true; // there may be points farther behind the corner
        return;
      }
      sq_all = std::max(sq_all, sq_dist);
      if (is_first)
        sq_first = std::max(sq_first, sq_dist);
    });
    Reach reach;
    reach.all = std::sqrt(sq_all);
    reach.first = std::sqrt(sq_first);
    reach.on_rim = on_rim;
    return reach;
  }

  /** As the normals of the neighbours on the same side tell. */
  SurfaceBend
  bendAmong(std::uint32_t point, float near) const
  {
    const Eigen::Matrix<float, 3, 2> axes = tangentAxes(normals_[point]);
    BendFit fit(near);
    for (std::size_t i = 0; i < std::min(neighbors_.size(), few_neighbors); ++i) {
      const Eigen::Vector3f normal = normalOf(neighbors_[i].second);
      const float agreement = normal_.dot(normal);
      if ((two_sided_ ? std::abs(agreement) : agreement) < least_agreement)
        continue;
      const Eigen::Vector3f turn = (agreement < 0.0f ? -normal : normal) - normal_;
      const Eigen::Vector3f offset = positionOf(neighbors_[i].second) - here_;
      fit.add(axes.transpose() * offset, axes.transpose() * turn, offset.dot(normal_));
    }
    return fit.solve();
  }

  /** The lines at which a disc ends. Few neighbours tell that there is none, many
   * whether one is. */
  PackedRim
  rimOf(std::uint32_t point, float radius)
  {
    const float reach = RimFinder::reachOf(radius);
    RimLines lines = rim_.find(places_, radius);
    if (sq_known_ < reach * reach || lines[0].distance < radius) {
      gather(many_.find(samples_.getPositions()[point], radius), point);
      lines = rim_.find(places_, radius);
    }
    if (sq_known_ < reach * reach || !(lines[0].distance < radius))
      return 0;
    const Eigen::Matrix<float, 3, 2> axes = tangentAxes(normals_[point]);
    for (RimLine& line : lines)
      line.outwards = axes.transpose() *
                      (line.outwards[0] * axes_[0] + line.outwards[1] * axes_[1]);
    return packRim(lines, room * radius);
  }

  /** Look at the next neighbour; false for one on another side. */
  bool
  lookAtNext()
  {
    const std::size_t neighbor = looked_at_++;
    const float facing = normal_.dot(normalOf(neighbors_[neighbor].second));
    if ((two_sided_ ? std::abs(facing) : facing) <= 0.0f)
      return false;
    in_plane_.push_back(places_[neighbor]);
    return true;
  }

  /** Whether points lie on all sides of a place: beyond the rim of a surface they do
   * not. */
  bool
  isSurrounded(const Eigen::Vector2f& place)
  {
    while (looked_at_ < neighbors_.size())
      lookAtNext();
    // The point itself is one of those around.
    Eigen::Vector2f sum = (-place).normalized();
    for (const Eigen::Vector2f& neighbor : in_plane_)
      sum += (neighbor - place).normalized();
    const Eigen::Vector2f inwards = sum.normalized();
    return std::any_of(in_plane_.begin(), in_plane_.end(), [&](const auto& neighbor) {
      return (neighbor - place).normalized().dot(inwards) < opposite;
    });
  }

  const SampleSet& samples_;
  const std::vector<PackedNormal>& normals_;
  const std::vector<float>& edge_lengths_;
  const std::vector<std::uint8_t>&surfaces_, &bridged_;
  bool two_sided_;
  NearestFinder few_, many_;
  std::vector<std::pair<float, std::uint32_t>> neighbors_; ///< nearest first
  std::vector<Eigen::Vector2f> places_; ///< of all that gather() found, in the plane
  float sq_known_ = 0.0f;               ///< they are all that are nearer

  std::vector<float> lengths_; ///< of edges, the shortest first

  // The point that is looked at.
  Eigen::Vector3f here_, normal_, axes_[2];
  std::size_t looked_at_ = 0;             ///< neighbours
  std::vector<Eigen::Vector2f> in_plane_; ///< of these, those on the same side
  detail::PlanarCell cell_;
  RimFinder rim_;
};

/** Median of the distances of the 16th neighbours of points. */
float
usualDistance(const NearestPoints& points,
              const std::vector<FootprintFinder::Reach>& reach)
{
  std::array<float, std::tuple_size_v<NearestPoints>> distances;
  std::transform(points.begin(), points.end(), distances.begin(), [&](auto point) {
    return reach[point].around;
  });
  const auto middle = distances.begin() + distances.size() / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

} // namespace

Footprints
computeFootprints(const OrientedPoints& points, unsigned threads, Report& report)
{
  const SampleSet& samples = *points.samples;
  StepTimer step(report, "footprints", 2 * samples.size());
  Footprints footprints;
  footprints.nearest.resize(samples.size());
  std::vector<FootprintFinder::Reach> reach(samples.size());

  Position low = samples.getPositions()[0], high = low;
  for (const Position& position : samples.getPositions())
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position[axis]);
      high[axis] = std::max(high[axis], position[axis]);
    }
  const float extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const float typical_distance =
      std::max(extent / std::sqrt(static_cast<float>(samples.size())),
               std::numeric_limits<float>::min());
  parallelBlocks(samples.size(), footprint_block, threads, [&](auto begin, auto end) {
    FootprintFinder finder(points);
    for (std::size_t i = begin; i < end; ++i) {
      if ((i - begin) % run_points == 0)
        finder.expect(i, std::min(run_points, end - i));
      reach[i] = finder.find(
          static_cast<std::uint32_t>(i), typical_distance, footprints.nearest[i]);
    }
    step.advance(end - begin);
  });
  footprints.radii.resize(samples.size());
  footprints.fillers.resize(samples.size());
  footprints.on_rim.resize(samples.size());
  footprints.bends.resize(samples.size());
  footprints.rims.resize(samples.size());
  parallelBlocks(samples.size(), footprint_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NearestPoints& nearest = footprints.nearest[i];
      float most = 0.0f;
      for (std::size_t k = 0; k < compared_neighbors; ++k)
        most = std::max(most, largest_growth * reach[nearest[k]].all);
      const bool is_isolated =
          reach[i].around > isolated_distance * usualDistance(nearest, reach);
      if (is_isolated)
        most = 0.0f;
      footprints.radii[i] = room * std::min(reach[i].all, most);
      footprints.fillers[i] = room * std::min(reach[i].first, most);
      footprints.on_rim[i] = reach[i].on_rim || is_isolated ? 1 : 0;
      if (!points.bridged.empty() && points.bridged[i])
        footprints.radii[i] = footprints.fillers[i] = 0.0f;
      footprints.bends[i] = packBend(reach[i].bend, footprints.radii[i]);
      footprints.rims[i] = reach[i].all <= most ? reach[i].rim : 0;
    }
    step.advance(end - begin);
  });
  return footprints;
}

} // namespace pcl_uvol
