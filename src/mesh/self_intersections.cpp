// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/self_intersections.h"

#include "common/parallel.h"
#include "mesh/edge_fans.h"
#include "mesh/exact_signs.h"
#include "mesh/measured_mesh.h"
#include "mesh/triangle_tree.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <functional>

namespace pcl_uvol::detail {

namespace {

/** Triangles that a thread looks at at a time. */
constexpr std::size_t crossing_block = 512;

/** Of a surface that goes through itself on purpose there are some per triangle; where
 * triangles lie on one another there are as many as the square of their number. */
constexpr std::size_t most_pairs = 10000000;

using Place = Eigen::Vector3d;

std::array<Place, 3>
cornersOf(const std::vector<Place>& places, const Triangle& triangle)
{
  return {places[triangle[0]], places[triangle[1]], places[triangle[2]]};
}

template <typename Places>
Eigen::AlignedBox3d
boxOf(const Places& places)
{
  Eigen::AlignedBox3d box;
  for (const Place& place : places)
    box.extend(place);
  return box;
}

bool
hasArea(const std::array<Place, 3>& corners)
{
  return findVisibleAxis(corners[0], corners[1], corners[2]) >= 0;
}

/** Whether a place in the plane of a triangle is in it, its edges included. */
bool
isWithin(const Place& place, const std::array<Place, 3>& corners, int axis)
{
  int lowest = 1, highest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = signOfArea(corners[i], corners[(i + 1) % 3], place, axis);
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  return lowest >= 0 || highest <= 0;
}

/** Whether two segments in a plane have a point in common. */
bool
doCross(const Place& p, const Place& q, const Place& a, const Place& b, int axis)
{
  const int p_side = signOfArea(a, b, p, axis), q_side = signOfArea(a, b, q, axis),
            a_side = signOfArea(p, q, a, axis), b_side = signOfArea(p, q, b, axis);
  // On one line, or without length, they meet where an end of one lies in the other:
  // ends in triangles are looked for elsewhere.
  return p_side * q_side <= 0 && a_side * b_side <= 0 &&
         (p_side != q_side || a_side != b_side);
}

/** Whether a segment and a triangle with area have a point in common. */
bool
meets(const Place& p, const Place& q, const std::array<Place, 3>& corners)
{
  const auto& [a, b, c] = corners;
  const int of_p = signOfVolume(a, b, c, p), of_q = signOfVolume(a, b, c, q);
  if (of_p * of_q > 0)
    return false;
  if (of_p == 0 || of_q == 0) {
    const int axis = findVisibleAxis(a, b, c);
    if ((of_p == 0 && isWithin(p, corners, axis)) ||
        (of_q == 0 && isWithin(q, corners, axis)))
      return true;
    if (of_p != of_q)
      return false;
    return doCross(p, q, a, b, axis) || doCross(p, q, b, c, axis) ||
           doCross(p, q, c, a, axis);
  }
  const int sides[] = {
      signOfVolume(p, q, a, b), signOfVolume(p, q, b, c), signOfVolume(p, q, c, a)};
  const auto [lowest, highest] =
      std::minmax_element(std::begin(sides), std::end(sides));
  return *lowest >= 0 || *highest <= 0;
}

/** Vertices that two triangles share. */
class SharedVertices {
public:
  SharedVertices(const Triangle& a, const Triangle& b)
  {
    for (const std::uint32_t vertex : a)
      if (std::find(b.begin(), b.end(), vertex) != b.end())
        vertices_[count_++] = vertex;
  }

  std::size_t
  count() const
  {
    return count_;
  }

  bool
  has(std::uint32_t vertex) const
  {
    const auto end = vertices_.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::find(vertices_.begin(), end, vertex) != end;
  }

  std::uint32_t
  operator[](std::size_t i) const
  {
    return vertices_[i];
  }

private:
  Triangle vertices_;
  std::size_t count_ = 0;
};

/** Whether triangles at one edge lie on each other: their tips are on one side of the
 * edge in one plane. */
bool
areFolded(const std::vector<Place>& places,
          const Triangle& a,
          const Triangle& b,
          const SharedVertices& shared)
{
  const auto tipOf = [&](const Triangle& triangle) -> const Place& {
    return places[*std::find_if_not(
        triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
          return shared.has(vertex);
        })];
  };
  const Place &p = places[shared[0]], &q = places[shared[1]];
  const Place &of_a = tipOf(a), &of_b = tipOf(b);
  if (signOfVolume(p, q, of_a, of_b) != 0)
    return false;
  const int axis = findVisibleAxis(p, q, of_a);
  return signOfArea(p, q, of_a, axis) == signOfArea(p, q, of_b, axis);
}

/** Whether an edge of a triangle meets another one with area, but those at a shared
 * vertex, which do so there; where they share more, the edge opposite to it meets as
 * well. */
bool
entersWithEdge(const std::vector<Place>& places,
               const Triangle& triangle,
               const Triangle& other,
               const SharedVertices& shared)
{
  const std::array<Place, 3> corners = cornersOf(places, other);
  const Eigen::AlignedBox3d box = boxOf(corners);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
    if (!shared.has(from) && !shared.has(to) &&
        box.intersects(boxOf(std::array{places[from], places[to]})) &&
        meets(places[from], places[to], corners))
      return true;
  }
  return false;
}

/** The same of triangles with areas; each pair of them is told once: by the lower one
 * at a shared edge and where the edges of both enter, else by the one whose do. */
bool
showsIntersection(const std::vector<Place>& places,
                  const std::vector<Triangle>& triangles,
                  std::uint32_t number,
                  std::uint32_t other)
{
  const Triangle &a = triangles[number], &b = triangles[other];
  const SharedVertices shared(a, b);
  if (shared.count() >= 2)
    return number < other && (shared.count() == 3 || areFolded(places, a, b, shared));
  return entersWithEdge(places, a, b, shared) &&
         (number < other || !entersWithEdge(places, b, a, shared));
}

} // namespace

bool
doIntersect(const std::vector<Eigen::Vector3d>& places,
            const Triangle& a,
            const Triangle& b)
{
  const std::vector<Triangle> both{a, b};
  return hasArea(cornersOf(places, a)) && hasArea(cornersOf(places, b)) &&
         (showsIntersection(places, both, 0, 1) ||
          showsIntersection(places, both, 1, 0));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>>
findSelfIntersections(const std::vector<Eigen::Vector3d>& places,
                      const std::vector<Triangle>& triangles,
                      const std::vector<double>& surface_of,
                      unsigned threads,
                      Report& report)
{
  StepTimer step(report, "intersections", triangles.size());
  // Asked for once: of lines it takes whole numbers to tell that they have no area.
  std::vector<Triangle> solid;
  std::vector<std::uint32_t> number_of;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    if (hasArea(cornersOf(places, triangles[i]))) {
      solid.push_back(triangles[i]);
      number_of.push_back(i);
    }
  if (solid.empty())
    return {};
  const auto areOfOne = [&](const Triangle& a, const Triangle& b) {
    return surface_of.empty() || surface_of[a[0]] == surface_of[b[0]];
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  const TriangleTree tree(places, solid);
  const EdgeFans fans(places, solid);
  std::atomic<std::size_t> total{0};
  auto pairs = parallelGather<Pair>(
      solid.size(), crossing_block, threads, [&](auto begin, auto end, auto& found) {
        std::vector<std::uint32_t> others;
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
          others.clear();
          fans.findFolded(i, others);
          for (std::size_t k = 0; k < 3; ++k)
            tree.findMet(solid[i][k], solid[i][(k + 1) % 3], others);
          std::sort(others.begin(), others.end());
          others.erase(std::unique(others.begin(), others.end()), others.end());
          const std::size_t before = found.size();
          for (const std::uint32_t other : others)
            if (areOfOne(solid[i], solid[other]) &&
                showsIntersection(places, solid, i, other))
              found.push_back(std::minmax(number_of[i], number_of[other]));
          if ((total += found.size() - before) > most_pairs)
            throw InvalidArgument("too_many_intersections", {{"most", most_pairs}});
        }
        step.advance(end - begin);
      });
  parallelSort(pairs.begin(), pairs.end(), threads, std::less<Pair>());
  return pairs;
}

std::vector<TriangleIntersection>
describeIntersections(const CloudView& vertices,
                      const std::vector<Triangle>& triangles,
                      const std::array<double, 3>& origin,
                      unsigned threads,
                      Report& report)
{
  std::vector<Eigen::Vector3d> places;
  std::vector<double> isovalues;
  const std::optional<ScalarField> isovalue = findScalar(vertices, "isovalue");
  for (std::size_t i = 0; i < vertices.count; ++i) {
    const float* const place = vertices.xyz(i);
    places.emplace_back(place[0], place[1], place[2]);
    if (isovalue)
      isovalues.push_back(isovalue->read(vertices.point(i)));
  }
  std::vector<TriangleIntersection> found;
  for (const auto& [first, second] :
       findSelfIntersections(places, triangles, isovalues, threads, report)) {
    const auto& [a, b, c] = triangles[first];
    found.push_back({first,
                     second,
                     (places[a] + places[b] + places[c]) / 3.0 +
                         Eigen::Vector3d(origin[0], origin[1], origin[2])});
  }
  report.count("intersections", found.size());
  if (!found.empty())
    report.warn("self_intersections",
                {{"pairs", found.size()},
                 {"x", found[0].place[0]},
                 {"y", found[0].place[1]},
                 {"z", found[0].place[2]}});
  return found;
}

} // namespace pcl_uvol::detail
