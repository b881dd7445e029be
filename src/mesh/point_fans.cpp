// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/point_fans.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/planar_cell.h"
#include <pcl_uvol/common/parameters.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t block_points = 1u << 10;
constexpr std::size_t run_points = 16; // that are looked up in common

/** Neighbours that bound nearly all cells, and those for the others: clumps of
 * isopoints. */
constexpr std::size_t few_neighbors = 24, many_neighbors = 128;

/** Farther corners of cells, in the largest spacing of the points around them, are
 * holes in the surface: in clumps of isopoints the spacing is small. */
constexpr float most_spacings = 4.0f;

/** Sine of the angle to the tangent plane below which a neighbour lies beside a point.
 */
constexpr float beside = 0.3f;

/** What a point knows of the surface around it. */
struct Surroundings {
  /** A triangle and the distance of its circumcentre. */
  struct Corner {
    FanTriangle triangle;
    float distance;
  };
  std::vector<Corner> corners;
  bool is_surrounded = false;
  bool is_contrary = false; ///< of its nearest neighbours some look to the other side
  float spacing = 0.0f;
};

/** Fans of one point after another; one object per thread. */
class FanFinder {
public:
  FanFinder(const SampleSet& samples,
            const std::vector<SurfaceCorner>& corners,
            const std::vector<double>& isovalues)
      : samples_(samples)
      , corners_(corners)
      , isovalues_(isovalues)
      , few_(samples, few_neighbors + 1)
      , many_(samples, many_neighbors + 1)
  {
  }

  /** Prepare for consecutive points. */
  void
  expect(std::size_t first, std::size_t count)
  {
    few_.expect(&samples_.getPositions()[first], count);
  }

  /** \param typical_distance about that of a neighbour */
  Surroundings
  find(std::uint32_t point, float typical_distance)
  {
    const Position& position = samples_.getPositions()[point];
    cutAmong(few_.find(position, typical_distance), point);
    if (!isCertain())
      cutAmong(many_.find(position, typical_distance), point);
    Surroundings found;
    if (neighbors_.empty())
      return found;
    found.is_surrounded = cell_.isBounded();
    found.is_contrary = isContrary(point);
    found.spacing = spacing();
    cell_.forCorners([&](const Eigen::Vector2f& corner, auto before, auto next) {
      if (before != next)
        found.corners.push_back({{before, next}, corner.norm()});
    });
    return found;
  }

private:
  /** Whether neighbours on the other side lie among the others, not above or below. */
  bool
  isContrary(std::uint32_t point) const
  {
    const float sq_spacing = spacing() * spacing();
    const Eigen::Vector3f normal = corners_[point].normal.cast<float>();
    const auto count =
        std::count_if(others_.begin(), others_.end(), [&](const auto& other) {
          const Eigen::Vector3f offset = placeOf(other.second) - placeOf(point);
          return other.first <= sq_spacing &&
                 std::abs(offset.dot(normal)) <= beside * offset.norm();
        });
    const auto near =
        std::count_if(neighbors_.begin(), neighbors_.end(), [&](const auto& neighbor) {
          return neighbor.first <= sq_spacing;
        });
    return count > 0 && 3 * count >= near;
  }

  /** Whether no farther point can cut the cell. */
  bool
  isCertain() const
  {
    return is_all_ || 4.0f * cell_.sqExtent() <= sq_reach_;
  }

  void
  cutAmong(const NearestFinder::Row& row, std::uint32_t point)
  {
    gather(row, point);
    const Eigen::Vector3f here = placeOf(point);
    const Eigen::Vector3f normal = corners_[point].normal.cast<float>();
    const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
    cell_.reset(2.0f * std::sqrt(sq_reach_));
    for (const auto& [sq_distance, neighbor] : neighbors_) {
      if (sq_distance > 4.0f * cell_.sqExtent())
        break;
      const Eigen::Vector3f offset = placeOf(neighbor) - here;
      const Eigen::Vector2f flat(offset.dot(u), offset.dot(v));
      // As far in the plane as in space.
      if (const float length = flat.norm(); length > 0.0f)
        cell_.cut(std::sqrt(sq_distance) / length * flat, neighbor);
    }
  }

  /** The neighbours on the same side of the same surface, the nearest first. */
  void
  gather(const NearestFinder::Row& row, std::uint32_t point)
  {
    neighbors_.clear();
    others_.clear();
    sq_reach_ = 0.0f;
    is_all_ = row.size == samples_.size();
    for (std::size_t i = 0; i < row.size; ++i) {
      sq_reach_ = std::max(sq_reach_, row.sq_dists[i]);
      if (row.samples[i] == point || !isOfOneSurface(row.samples[i], point))
        continue;
      const bool is_beside =
          corners_[row.samples[i]].normal.dot(corners_[point].normal) > 0.0;
      (is_beside ? neighbors_ : others_).emplace_back(row.sq_dists[i], row.samples[i]);
    }
    std::sort(neighbors_.begin(), neighbors_.end());
  }

  bool
  isOfOneSurface(std::uint32_t a, std::uint32_t b) const
  {
    return isovalues_.empty() || areEqual(isovalues_[a], isovalues_[b]);
  }

  /** Spacing s of points with 1 / s^2 points per area, k of them in a circle of radius
   * s sqrt(k / pi). */
  float
  spacing() const
  {
    constexpr float pi = 3.14159265f;
    const std::size_t k = std::min(few_neighbors, neighbors_.size());
    return std::sqrt(neighbors_[k - 1].first * pi / static_cast<float>(k));
  }

  Eigen::Vector3f
  placeOf(std::uint32_t point) const
  {
    return Eigen::Map<const Eigen::Vector3f>(samples_.getPositions()[point].x);
  }

  const SampleSet& samples_;
  const std::vector<SurfaceCorner>& corners_;
  const std::vector<double>& isovalues_;
  NearestFinder few_, many_;
  std::vector<std::pair<float, std::uint32_t>> neighbors_;
  std::vector<std::pair<float, std::uint32_t>> others_; // that look to the other side
  float sq_reach_ = 0.0f; // of the points that neighbours were chosen from
  bool is_all_ = false;
  PlanarCell cell_;
};

float
typicalDistance(const SampleSet& samples)
{
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < samples.size(); ++i)
    box.extend(Eigen::Map<const Eigen::Vector3f>(samples.getPositions()[i].x));
  return std::max(box.sizes().maxCoeff() /
                      std::sqrt(static_cast<float>(samples.size())),
                  std::numeric_limits<float>::min());
}

bool
hasTriangle(const std::vector<FanTriangle>& fan, const FanTriangle& triangle)
{
  return std::find(fan.begin(), fan.end(), triangle) != fan.end();
}

} // namespace

PointFans::PointFans(const SampleSet& samples,
                     const std::vector<SurfaceCorner>& corners,
                     const std::vector<double>& isovalues,
                     unsigned threads)
    : fans_(samples.size())
    , on_rim_(samples.size())
{
  std::vector<Surroundings> around(samples.size());
  const float typical_distance = typicalDistance(samples);
  parallelBlocks(samples.size(), block_points, threads, [&](auto begin, auto end) {
    FanFinder finder(samples, corners, isovalues);
    for (std::size_t i = begin; i < end; ++i) {
      if ((i - begin) % run_points == 0)
        finder.expect(i, std::min(run_points, end - i));
      around[i] = finder.find(static_cast<std::uint32_t>(i), typical_distance);
    }
  });
  contrary_ = static_cast<std::size_t>(
      std::count_if(around.begin(), around.end(), [](const Surroundings& own) {
        return own.is_contrary;
      }));
  parallelBlocks(samples.size(), block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      on_rim_[i] = !around[i].is_surrounded;
      for (const auto& [triangle, distance] : around[i].corners) {
        const float spacing = std::max({around[i].spacing,
                                        around[triangle[0]].spacing,
                                        around[triangle[1]].spacing});
        if (distance <= most_spacings * spacing)
          fans_[i].push_back(triangle);
        else
          on_rim_[i] = 1;
      }
    }
  });
}

bool
PointFans::isAgreedOn(std::uint32_t first, const FanTriangle& others) const
{
  return hasTriangle(fans_[others[0]], {others[1], first}) &&
         hasTriangle(fans_[others[1]], {first, others[0]});
}

} // namespace pcl_uvol::detail
