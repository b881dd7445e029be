// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl_uvol::detail {

namespace {

constexpr std::uint32_t leaf_triangles = 4;

constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/** More than rounding takes from a sum of a few products. */
constexpr double box_rounding = 1e-14;

TrianglePoint
pointAt(const std::array<Eigen::Vector3d, 3>& corners,
        const std::array<double, 3>& lambda)
{
  return {lambda[0] * corners[0] + lambda[1] * corners[1] + lambda[2] * corners[2],
          lambda};
}

/** The nearest point of the edge opposite to a corner. */
TrianglePoint
nearestOfEdge(const std::array<Eigen::Vector3d, 3>& corners,
              std::size_t opposite,
              const Eigen::Vector3d& place)
{
  const std::size_t from = (opposite + 1) % 3, to = (opposite + 2) % 3;
  const Eigen::Vector3d edge = corners[to] - corners[from];
  const double sq_length = edge.squaredNorm();
  const double t =
      sq_length > 0.0
          ? std::clamp(edge.dot(place - corners[from]) / sq_length, 0.0, 1.0)
          : 0.0;
  std::array<double, 3> lambda{};
  lambda[from] = 1.0 - t;
  lambda[to] = t;
  return pointAt(corners, lambda);
}

} // namespace

TrianglePoint
nearestOfTriangle(const std::array<Eigen::Vector3d, 3>& corners,
                  const Eigen::Vector3d& place)
{
  const Eigen::Vector3d normal =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double sq_area = normal.squaredNorm();
  if (sq_area > 0.0) {
    std::array<double, 3> lambda{};
    for (std::size_t i = 0; i < 3; ++i)
      lambda[i] = (corners[(i + 2) % 3] - corners[(i + 1) % 3])
                      .cross(place - corners[(i + 1) % 3])
                      .dot(normal) /
                  sq_area;
    if (lambda[0] >= 0.0 && lambda[1] >= 0.0 && lambda[2] >= 0.0)
      return pointAt(corners, lambda);
  }
  TrianglePoint best = nearestOfEdge(corners, 0, place);
  for (const std::size_t opposite : {1u, 2u}) {
    const TrianglePoint other = nearestOfEdge(corners, opposite, place);
    if ((other.place - place).squaredNorm() < (best.place - place).squaredNorm())
      best = other;
  }
  return best;
}

/** What is asked of boxes and triangles for a segment between two vertices. */
class TriangleTree::Segment {
public:
  Segment(const std::vector<Eigen::Vector3d>& places,
          std::uint32_t from,
          std::uint32_t to)
      : ends_{from, to}
      , middle_(0.5 * places[from] + 0.5 * places[to])
      , half_(0.5 * places[to] - 0.5 * places[from])
      , rounding_(box_rounding * (places[from].cwiseAbs() + places[to].cwiseAbs()))
  {
    box_.extend(places[from]).extend(places[to]);
  }

  bool
  endsIn(const Triangle& triangle) const
  {
    return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      return vertex == ends_[0] || vertex == ends_[1];
    });
  }

  /** False only if a box and the segment certainly have no point in common: their
   * boxes have none, or a plane through the segment parts them (Ericson, 5.3.3). */
  bool
  mayMeet(const Eigen::AlignedBox3d& box) const
  {
    if (!box.intersects(box_))
      return false;
    const Eigen::Array3d rounding =
        box_rounding * (box.min().array().abs() + box.max().array().abs()) + rounding_;
    const Eigen::Array3d size =
        0.5 * box.max().array() - 0.5 * box.min().array() + rounding;
    const Eigen::Array3d way =
        middle_ - 0.5 * box.min().array() - 0.5 * box.max().array();
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3, l = (i + 2) % 3;
      const double a = way[k] * half_[l], b = way[l] * half_[k],
                   reach = size[k] * std::abs(half_[l]) + size[l] * std::abs(half_[k]);
      if (std::abs(a - b) > reach + box_rounding * (reach + std::abs(a) + std::abs(b)))
        return false;
    }
    return true;
  }

private:
  std::array<std::uint32_t, 2> ends_;
  Eigen::AlignedBox3d box_;
  Eigen::Array3d middle_, half_, rounding_;
};

TriangleTree::TriangleTree(const std::vector<Eigen::Vector3d>& places,
                           const std::vector<Triangle>& triangles)
    : places_(places)
    , triangles_(triangles)
    , order_(triangles.size())
{
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Eigen::Vector3d> centers;
  centers.reserve(triangles.size());
  for (const Triangle& triangle : triangles)
    centers.emplace_back(places[triangle[0]] + places[triangle[1]] +
                         places[triangle[2]]);
  build(centers, 0, static_cast<std::uint32_t>(triangles.size()));
}

std::array<Eigen::Vector3d, 3>
TriangleTree::cornersOf(std::uint32_t triangle) const
{
  const auto& [a, b, c] = triangles_[triangle];
  return {places_[a], places_[b], places_[c]};
}

Triangle
TriangleTree::findCommonCorners(std::uint32_t begin, std::uint32_t end) const
{
  Triangle corners = triangles_[order_[begin]];
  for (std::uint32_t i = begin; i < end; ++i)
    for (std::uint32_t& corner : corners) {
      const Triangle& triangle = triangles_[order_[i]];
      if (std::find(triangle.begin(), triangle.end(), corner) == triangle.end())
        corner = no_vertex;
    }
  return corners;
}

std::uint32_t
TriangleTree::build(const std::vector<Eigen::Vector3d>& centers,
                    std::uint32_t begin,
                    std::uint32_t end)
{
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Eigen::AlignedBox3d box, of_centers;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Eigen::Vector3d& corner : cornersOf(order_[i]))
      box.extend(corner);
    of_centers.extend(centers[order_[i]]);
  }
  nodes_.push_back({box, begin, end, 0, findCommonCorners(begin, end)});
  if (end - begin <= leaf_triangles)
    return number;
  int axis = 0;
  of_centers.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin,
                   order_.begin() + middle,
                   order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::make_pair(centers[a][axis], a) <
                            std::make_pair(centers[b][axis], b);
                   });
  build(centers, begin, middle);
  const std::uint32_t second = build(centers, middle, end);
  nodes_[number].second = second;
  return number;
}

TriangleTree::Nearest
TriangleTree::find(const Eigen::Vector3d& place) const
{
  Nearest nearest;
  find(0, place, nearest);
  return nearest;
}

void
TriangleTree::find(std::uint32_t number,
                   const Eigen::Vector3d& place,
                   Nearest& nearest) const
{
  const Node& node = nodes_[number];
  if (node.second == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const TrianglePoint point = nearestOfTriangle(cornersOf(order_[i]), place);
      const double distance = (point.place - place).norm();
      if (distance < nearest.distance)
        nearest = {distance, order_[i], point};
    }
    return;
  }
  std::array<std::pair<double, std::uint32_t>, 2> children = {
      {{nodes_[number + 1].box.exteriorDistance(place), number + 1},
       {nodes_[node.second].box.exteriorDistance(place), node.second}}};
  if (children[1].first < children[0].first)
    std::swap(children[0], children[1]);
  for (const auto& [distance, child] : children)
    if (distance < nearest.distance)
      find(child, place, nearest);
}

void
TriangleTree::findMet(std::uint32_t from,
                      std::uint32_t to,
                      std::vector<std::uint32_t>& found) const
{
  findMet(0, Segment(places_, from, to), found);
}

void
TriangleTree::findMet(std::uint32_t number,
                      const Segment& segment,
                      std::vector<std::uint32_t>& found) const
{
  const Node& node = nodes_[number];
  if (segment.endsIn(node.corners) || !segment.mayMeet(node.box))
    return;
  if (node.second != 0) {
    findMet(number + 1, segment, found);
    findMet(node.second, segment, found);
    return;
  }
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    Eigen::AlignedBox3d own;
    for (const Eigen::Vector3d& corner : cornersOf(order_[i]))
      own.extend(corner);
    if (!segment.endsIn(triangles_[order_[i]]) && segment.mayMeet(own))
      found.push_back(order_[i]);
  }
}

} // namespace pcl_uvol::detail
