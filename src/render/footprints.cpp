// SPDX-License-Identifier: BSD-3-Clause
#include "footprints.h"

#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/neighbors/nearest_finder.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_points = 1u << 12;

/** Neighbours that bound nearly all cells, and those for the others: rims, and scans
 * whose lines lie far apart. */
constexpr std::size_t few_neighbors = 16, many_neighbors = 64;

/** Of the radius of the nearest point: an outlier gets no more. */
constexpr float largest_growth = 3.0f;

/** For the surface's curvature, which takes neighbours out of the tangent plane. */
constexpr float room = 1.05f;

/** A cell in the tangent plane, around the origin. */
class Cell {
public:
  /** A square that no neighbour within a distance leaves whole. */
  explicit Cell(float distance)
      : corners_{{{-distance, -distance}, true},
                 {{distance, -distance}, true},
                 {{distance, distance}, true},
                 {{-distance, distance}, true}}
  {
  }

  /** Cut off what is nearer to a neighbour. */
  void
  cut(const Eigen::Vector2f& neighbor)
  {
    const float limit = 0.5f * neighbor.squaredNorm();
    const auto beyond = [&](const Corner& corner) {
      return corner.position.dot(neighbor) - limit;
    };
    kept_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner& here = corners_[i];
      const Corner& next = corners_[(i + 1) % corners_.size()];
      const float a = beyond(here), b = beyond(next);
      if (a <= 0.0f)
        kept_.push_back(here);
      if ((a <= 0.0f) != (b <= 0.0f)) {
        const Eigen::Vector2f crossing =
            here.position + a / (a - b) * (next.position - here.position);
        // Leaving, the cut goes on from there; coming back, the old edge does.
        kept_.push_back({crossing, a > 0.0f && here.before_border});
      }
    }
    corners_.swap(kept_);
  }

  /** Distance of the farthest corner, of those not on the border. */
  float
  reach() const
  {
    float sq_reach = 0.0f;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner& before = corners_[(i + corners_.size() - 1) % corners_.size()];
      if (!before.before_border && !corners_[i].before_border)
        sq_reach = std::max(sq_reach, corners_[i].position.squaredNorm());
    }
    return std::sqrt(sq_reach);
  }

  bool
  isBounded() const
  {
    return std::none_of(corners_.begin(), corners_.end(), [](const Corner& corner) {
      return corner.before_border;
    });
  }

private:
  struct Corner {
    Eigen::Vector2f position;
    bool before_border; ///< the edge to the next corner is one of the square
  };

  std::vector<Corner> corners_, kept_;
};

/** Footprints of one point after another; one object per thread. */
class FootprintFinder {
public:
  FootprintFinder(const SampleSet& samples,
                  const std::vector<PackedNormal>& normals,
                  bool two_sided)
      : samples_(samples)
      , normals_(normals)
      , two_sided_(two_sided)
      , few_(samples, few_neighbors + 1)
      , many_(samples, many_neighbors + 1)
  {
  }

  /** \param nearest set to the index of the nearest other point, or of the point */
  float
  find(std::uint32_t point, float typical_distance, std::uint32_t& nearest)
  {
    const Position& position = samples_.getPositions()[point];
    gather(few_.find(position, typical_distance), point);
    nearest = neighbors_.empty() ? point : neighbors_.front().second;
    bool is_bounded = true;
    const float reach = reachAmong(point, is_bounded);
    if (is_bounded || neighbors_.empty())
      return reach;
    gather(many_.find(position, typical_distance), point);
    return reachAmong(point, is_bounded);
  }

private:
  void
  gather(const NearestFinder::Row& row, std::uint32_t point)
  {
    neighbors_.clear();
    for (std::size_t i = 0; i < row.size; ++i)
      if (row.samples[i] != point)
        neighbors_.emplace_back(row.sq_dists[i], row.samples[i]);
    std::sort(neighbors_.begin(), neighbors_.end());
  }

  Eigen::Vector3f
  normalOf(std::uint32_t point) const
  {
    Eigen::Vector3f normal;
    unpackNormal(normals_[point], normal.data());
    return normal;
  }

  float
  reachAmong(std::uint32_t point, bool& is_bounded) const
  {
    if (neighbors_.empty())
      return 0.0f;
    const Eigen::Vector3f normal = normalOf(point);
    const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
    const Eigen::Map<const Eigen::Vector3f> here(samples_.getPositions()[point].x);
    Cell cell(2.0f * std::sqrt(neighbors_.back().first));
    is_bounded = false;
    float reach = std::numeric_limits<float>::infinity();
    for (const auto& [sq_dist, neighbor] : neighbors_) {
      // What is farther than twice the reach of a closed cell does not cut it.
      if (is_bounded && sq_dist > 4.0f * reach * reach)
        break;
      const float facing = normal.dot(normalOf(neighbor));
      if ((two_sided_ ? std::abs(facing) : facing) <= 0.0f)
        continue;
      const Eigen::Map<const Eigen::Vector3f> there(
          samples_.getPositions()[neighbor].x);
      const Eigen::Vector3f offset = there - here;
      cell.cut({offset.dot(u), offset.dot(v)});
      is_bounded = cell.isBounded();
      reach = cell.reach();
    }
    return cell.reach();
  }

  const SampleSet& samples_;
  const std::vector<PackedNormal>& normals_;
  bool two_sided_;
  NearestFinder few_, many_;
  std::vector<std::pair<float, std::uint32_t>> neighbors_; ///< nearest first
};

} // namespace

std::vector<float>
computeFootprints(const SampleSet& samples,
                  const std::vector<PackedNormal>& normals,
                  bool two_sided,
                  unsigned threads,
                  Report& report)
{
  const StepTimer timer(report, "footprints");
  std::vector<float> reach(samples.size());
  std::vector<std::uint32_t> nearest(samples.size());
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
  parallelBlocks(samples.size(), block_points, threads, [&](auto begin, auto end) {
    FootprintFinder finder(samples, normals, two_sided);
    for (std::size_t i = begin; i < end; ++i)
      reach[i] =
          finder.find(static_cast<std::uint32_t>(i), typical_distance, nearest[i]);
  });
  std::vector<float> footprints(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    footprints[i] = room * std::min(reach[i], largest_growth * reach[nearest[i]]);
  return footprints;
}

} // namespace pcl_uvol
