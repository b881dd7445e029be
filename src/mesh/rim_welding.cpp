// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/rim_welding.h"

#include "mesh/half_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace pcl_uvol::detail {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/** Part of the reach: vertices of two rims that are nearer become images of one
 * another. A vertex moves by no more along its rim, so that no triangle there turns
 * over. */
constexpr double near_vertex = 0.2;

/** A point on the rim in the low face: on the edge that begins in a vertex. */
struct RimPlace {
  std::uint32_t from;
  double t;
};

/** The edges of rims in one face. */
class FaceRims {
public:
  FaceRims(const std::vector<RimVertex>& vertices,
           const HalfEdges& edges,
           std::size_t half_edges,
           std::size_t axis,
           double coordinate)
      : vertices_(vertices)
      , u_((axis + 1) % 3)
      , v_((axis + 2) % 3)
  {
    const auto lies_in_face = [&](std::uint32_t vertex) {
      return vertices[vertex].place[static_cast<int>(axis)] == coordinate;
    };
    for (HalfEdge edge = 0; edge < half_edges; ++edge) {
      const std::uint32_t from = edges.originOf(edge), to = edges.targetOf(edge);
      if (edges.twinOf(edge) != HalfEdges::none || !lies_in_face(from) ||
          !lies_in_face(to))
        continue;
      next_[from] = to;
      previous_[to] = from;
      edge_from_[from] = edge;
      starts_.push_back(from);
      longest_ = std::max(longest_, (placeOf(to) - placeOf(from)).norm());
    }
    std::sort(starts_.begin(), starts_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::make_pair(placeOf(a)[0], a) < std::make_pair(placeOf(b)[0], b);
    });
  }

  /** \brief Vertices that an edge of a rim begins in, by their first coordinate. */
  const std::vector<std::uint32_t>&
  getStarts() const
  {
    return starts_;
  }

  /** \brief The vertices of the rims, in that order; ends of open ones last. */
  std::vector<std::uint32_t>
  listVertices() const
  {
    std::vector<std::uint32_t> all = starts_;
    for (const std::uint32_t start : starts_)
      if (next_.count(next_.at(start)) == 0)
        all.push_back(next_.at(start));
    return all;
  }

  /** \brief The vertex behind one; none at the end of an open rim. */
  std::uint32_t
  findNext(std::uint32_t vertex) const
  {
    return find(next_, vertex);
  }

  std::uint32_t
  findPrevious(std::uint32_t vertex) const
  {
    return find(previous_, vertex);
  }

  HalfEdge
  edgeFrom(std::uint32_t vertex) const
  {
    return edge_from_.at(vertex);
  }

  Eigen::Vector2d
  placeOf(std::uint32_t vertex) const
  {
    const Eigen::Vector3d& place = vertices_[vertex].place;
    return {place[static_cast<int>(u_)], place[static_cast<int>(v_)]};
  }

  /** \brief How a rim runs at a vertex; not of unit length. */
  Eigen::Vector2d
  directionAt(std::uint32_t vertex) const
  {
    const std::uint32_t next = findNext(vertex), previous = findPrevious(vertex);
    return placeOf(next == none ? vertex : next) -
           placeOf(previous == none ? vertex : previous);
  }

  /** \brief The nearest place of a rim that runs against a direction, within the reach
   * of a vertex of another face. */
  std::optional<RimPlace>
  findNearest(const RimVertex& vertex,
              const Eigen::Vector2d& place,
              const Eigen::Vector2d& direction) const
  {
    std::optional<RimPlace> nearest;
    double best = vertex.reach;
    const double window = vertex.reach + longest_;
    for (auto at = std::lower_bound(
             starts_.begin(),
             starts_.end(),
             place[0] - window,
             [&](std::uint32_t start, double x) { return placeOf(start)[0] < x; });
         at != starts_.end() && placeOf(*at)[0] <= place[0] + window;
         ++at) {
      const Eigen::Vector2d from = placeOf(*at), step = placeOf(next_.at(*at)) - from;
      const double sq_length = step.squaredNorm();
      if (vertices_[*at].isovalue != vertex.isovalue || !(step.dot(direction) < 0.0))
        continue;
      const double t = std::clamp(step.dot(place - from) / sq_length, 0.0, 1.0);
      const double distance = (place - from - t * step).norm();
      if (distance >= best)
        continue;
      best = distance;
      nearest = {*at, t};
    }
    return nearest;
  }

private:
  static std::uint32_t
  find(const std::unordered_map<std::uint32_t, std::uint32_t>& map, std::uint32_t key)
  {
    const auto found = map.find(key);
    return found == map.end() ? none : found->second;
  }

  const std::vector<RimVertex>& vertices_;
  const std::size_t u_, v_;
  std::unordered_map<std::uint32_t, std::uint32_t> next_, previous_;
  std::unordered_map<std::uint32_t, HalfEdge> edge_from_;
  std::vector<std::uint32_t> starts_;
  double longest_ = 0.0;
};

/** Matches the vertices of the high rims with places of the low ones, and collects what
 * edges are split in. */
class RimMatch {
public:
  RimMatch(const std::vector<RimVertex>& vertices,
           const FaceRims& low,
           const FaceRims& high)
      : vertices_(vertices)
      , low_(low)
      , high_(high)
  {
    matchCorners();
    findPlaces();
    orderPlaces();
    listRuns();
    matchNearVertices();
    splitLowEdges();
    splitHighEdges();
  }

  /** \brief What a low edge is split in, by the vertex that it begins in: shares of its
   * length and the vertices of the high rim that belong there, along the edge. */
  const std::map<std::uint32_t, std::vector<std::pair<double, std::uint32_t>>>&
  getLowSplits() const
  {
    return low_splits_;
  }

  /** \brief Vertices of the low rim that a high edge is split in, along the edge. */
  const std::map<std::uint32_t, std::vector<std::uint32_t>>&
  getHighSplits() const
  {
    return high_splits_;
  }

  /** \brief Vertices of the low rim, by those of the high one that are their images. */
  const std::map<std::uint32_t, std::uint32_t>&
  getImages() const
  {
    return image_of_;
  }

private:
  double
  distanceOf(std::uint32_t low, std::uint32_t high) const
  {
    return (low_.placeOf(low) - high_.placeOf(high)).norm();
  }

  std::vector<std::uint32_t>
  listCorners(const FaceRims& rims) const
  {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t vertex : rims.listVertices())
      if (vertices_[vertex].corner != 0)
        corners.push_back(vertex);
    return corners;
  }

  /** On edges of the box rims end: they do so in images of one another. */
  void
  matchCorners()
  {
    const std::vector<std::uint32_t> lows = listCorners(low_);
    for (const std::uint32_t high : listCorners(high_)) {
      const RimVertex& corner = vertices_[high];
      std::uint32_t nearest = none;
      double best = corner.reach;
      for (const std::uint32_t low : lows)
        if (vertices_[low].corner == corner.corner &&
            vertices_[low].isovalue == corner.isovalue && taken_.count(low) == 0 &&
            distanceOf(low, high) < best) {
          best = distanceOf(low, high);
          nearest = low;
        }
      if (nearest != none)
        join(nearest, high);
    }
  }

  void
  join(std::uint32_t low, std::uint32_t high)
  {
    image_of_[high] = low;
    taken_[low] = high;
  }

  void
  findPlaces()
  {
    for (const std::uint32_t vertex : high_.listVertices())
      if (vertices_[vertex].corner == 0)
        if (const auto place = low_.findNearest(
                vertices_[vertex], high_.placeOf(vertex), high_.directionAt(vertex)))
          places_[vertex] = *place;
  }

  /** Both rims pass their common vertices in one order: where the nearest places have
   * another, as at bends that differ a little, a vertex stays beside the one before it.
   */
  void
  orderPlaces()
  {
    bool is_changed = true;
    for (int round = 0; is_changed && round < most_rounds; ++round) {
      is_changed = false;
      for (const std::uint32_t start : high_.getStarts()) {
        const auto from = places_.find(start), to = places_.find(high_.findNext(start));
        if (from == places_.end() || to == places_.end() ||
            !isAhead(from->second.from, to->second.from))
          continue;
        to->second = from->second;
        is_changed = true;
      }
    }
  }

  /** \return whether a vertex of the low rim comes soon behind another one */
  bool
  isAhead(std::uint32_t vertex, std::uint32_t other) const
  {
    for (int steps = 0; steps < most_rounds; ++steps) {
      if (vertex == none || vertex == other)
        return vertex == other && steps > 0;
      vertex = low_.findNext(vertex);
    }
    return false;
  }

  /** Vertices of the high rim by the low edges that they lie on, along these. Where
   * they do not follow one another, they have no images. */
  void
  listRuns()
  {
    std::map<std::uint32_t, std::vector<std::uint32_t>> on_edges;
    for (const auto& [high, place] : places_)
      on_edges[place.from].push_back(high);
    for (const auto& [from, highs] : on_edges)
      if (std::vector<std::uint32_t> run = findRun(highs); !run.empty())
        runs_[from] = std::move(run);
  }

  /** The first and the last vertex on an edge may become the images of its ends; of two
   * the nearer one does. */
  void
  matchNearVertices()
  {
    std::map<std::uint32_t, std::pair<double, std::uint32_t>> nearest;
    const auto offer = [&](std::uint32_t low, std::uint32_t high) {
      const std::pair<double, std::uint32_t> found{distanceOf(low, high), high};
      if (vertices_[low].corner != 0 ||
          !(found.first < near_vertex * reachOf(low, high)))
        return;
      const auto known = nearest.emplace(low, found);
      known.first->second = std::min(known.first->second, found);
    };
    for (const auto& [from, run] : runs_) {
      const std::uint32_t to = low_.findNext(from);
      const bool is_one = run.size() == 1;
      const bool is_at_start =
          distanceOf(from, run.front()) <= distanceOf(to, run.front());
      if (!is_one || is_at_start)
        offer(from, run.front());
      if (!is_one || !is_at_start)
        offer(to, run.back());
    }
    for (const auto& [low, found] : nearest)
      join(low, found.second);
  }

  double
  reachOf(std::uint32_t low, std::uint32_t high) const
  {
    return std::min(vertices_[low].reach, vertices_[high].reach);
  }

  /** Where rims run a little differently, the order along them counts, not the place:
   * vertices that crowd, or are out of order, are spread evenly. */
  void
  splitLowEdges()
  {
    for (const auto& [from, run] : runs_) {
      std::vector<std::pair<double, std::uint32_t>> splits;
      bool is_too_dense = false;
      double last = 0.0;
      for (const std::uint32_t high : run) {
        if (image_of_.count(high) > 0)
          continue;
        const double t = places_.at(high).t;
        is_too_dense = is_too_dense || t - last < least_share;
        splits.emplace_back(last = t, high);
      }
      if (splits.empty())
        continue;
      if (is_too_dense || 1.0 - last < least_share)
        for (std::size_t i = 0; i < splits.size(); ++i)
          splits[i].first =
              static_cast<double>(i + 1) / static_cast<double>(splits.size() + 1);
      low_splits_[from] = std::move(splits);
    }
  }

  /** The vertices on one low edge along it, which the high rim runs against; none
   * unless they follow one another. */
  std::vector<std::uint32_t>
  findRun(const std::vector<std::uint32_t>& highs) const
  {
    const auto is_here = [&](std::uint32_t vertex) {
      return vertex != none &&
             std::find(highs.begin(), highs.end(), vertex) != highs.end();
    };
    std::vector<std::uint32_t> run;
    for (const std::uint32_t high : highs) {
      if (is_here(high_.findNext(high)))
        continue;
      if (!run.empty())
        return {};
      for (std::uint32_t vertex = high; is_here(vertex);
           vertex = high_.findPrevious(vertex))
        run.push_back(vertex);
    }
    return run.size() == highs.size() ? run : std::vector<std::uint32_t>{};
  }

  /** The low vertices between the images of the ends of each high edge. */
  void
  splitHighEdges()
  {
    std::map<std::uint32_t, std::size_t> step_of; // of high vertices on low edges
    for (const auto& [from, splits] : low_splits_)
      for (std::size_t i = 0; i < splits.size(); ++i) {
        step_of[splits[i].second] = i;
        images_on_edges_[splits[i].second] = from;
      }
    for (const std::uint32_t start : high_.getStarts()) {
      const std::uint32_t end = high_.findNext(start);
      if (!isMatched(start) || !isMatched(end))
        continue;
      std::vector<std::uint32_t> between;
      if (walk(end, start, step_of, between) && !between.empty()) {
        std::reverse(between.begin(), between.end());
        high_splits_[start] = std::move(between);
      }
    }
  }

  bool
  isMatched(std::uint32_t high) const
  {
    return image_of_.count(high) > 0 || images_on_edges_.count(high) > 0;
  }

  /** Go along the low rim from the image of one high vertex to that of another.
   * \return false if it is not met soon */
  bool
  walk(std::uint32_t first,
       std::uint32_t last,
       const std::map<std::uint32_t, std::size_t>& step_of,
       std::vector<std::uint32_t>& between) const
  {
    const auto image_of = [&](std::uint32_t high) {
      const auto found = image_of_.find(high);
      return found == image_of_.end() ? none : found->second;
    };
    const std::uint32_t target = image_of(last);
    std::uint32_t at = image_of(first);
    std::size_t next_split = 0;
    if (at == none) {
      at = images_on_edges_.at(first);
      next_split = step_of.at(first) + 1;
    }
    for (std::size_t steps = 0; steps < most_steps; ++steps) {
      const auto splits = low_splits_.find(at);
      if (splits != low_splits_.end() && next_split < splits->second.size())
        return splits->second[next_split].second == last;
      at = low_.findNext(at);
      next_split = 0;
      if (at == target)
        return true;
      if (at == none || taken_.count(at) > 0 || vertices_[at].corner != 0)
        return false;
      between.push_back(at);
    }
    return false;
  }

  /** Share of an edge that parts of it have at least. */
  static constexpr double least_share = 0.05;

  /** Vertices in a row that may be out of order. */
  static constexpr int most_rounds = 16;

  /** Edges of one rim beside one edge of the other at most. */
  static constexpr std::size_t most_steps = 1000;

  const std::vector<RimVertex>& vertices_;
  const FaceRims &low_, &high_;
  std::map<std::uint32_t, std::uint32_t> image_of_, taken_, images_on_edges_;
  std::map<std::uint32_t, RimPlace> places_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> runs_;
  std::map<std::uint32_t, std::vector<std::pair<double, std::uint32_t>>> low_splits_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> high_splits_;
};

/** Split the triangle at a rim edge in vertices along it: a fan about its third corner.
 */
void
splitTriangle(HalfEdge edge,
              const std::vector<std::uint32_t>& along,
              std::vector<Triangle>& triangles)
{
  const Triangle old = triangles[edge / 3];
  std::uint32_t from = old[edge % 3];
  const std::uint32_t to = old[nextOf(edge) % 3], apex = old[previousOf(edge) % 3];
  for (const std::uint32_t vertex : along) {
    triangles.push_back({from, vertex, apex});
    from = vertex;
  }
  triangles[edge / 3] = {from, to, apex};
}

} // namespace

MatchedRims
matchRims(const std::vector<RimVertex>& vertices,
          const OppositeFaces& faces,
          std::vector<Triangle> triangles)
{
  const HalfEdges edges(triangles, vertices.size());
  const std::size_t half_edges = 3 * triangles.size();
  const FaceRims low(vertices, edges, half_edges, faces.axis, faces.low),
      high(vertices, edges, half_edges, faces.axis, faces.high);
  const RimMatch match(vertices, low, high);
  MatchedRims result;
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    result.vertices.push_back({i, i, 0.0f});
  const auto append = [&](const IsoEdge& vertex) {
    result.vertices.push_back(vertex);
    return static_cast<std::uint32_t>(result.vertices.size() - 1);
  };
  for (const auto& [image, vertex] : match.getImages()) {
    result.vertices[image] = result.vertices[vertex];
    result.images.emplace_back(vertex, image);
  }
  for (const auto& [from, splits] : match.getLowSplits()) {
    std::vector<std::uint32_t> along;
    for (const auto& [t, image] : splits) {
      along.push_back(append({from, low.findNext(from), static_cast<float>(t)}));
      result.vertices[image] = result.vertices.back();
      result.images.emplace_back(along.back(), image);
    }
    splitTriangle(low.edgeFrom(from), along, triangles);
  }
  for (const auto& [from, sources] : match.getHighSplits()) {
    std::vector<std::uint32_t> along;
    for (const std::uint32_t source : sources) {
      along.push_back(append({source, source, 0.0f}));
      result.images.emplace_back(source, along.back());
    }
    splitTriangle(high.edgeFrom(from), along, triangles);
  }
  result.triangles = std::move(triangles);
  return result;
}

} // namespace pcl_uvol::detail
