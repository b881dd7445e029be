// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/self_intersections.h"

#include "common/numbers.h"
#include "common/parallel.h"
#include "mesh/exact_signs.h"
#include "mesh/measured_mesh.h"
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <sstream>

namespace pcl_uvol::detail {

namespace {

/** Triangles that a thread looks at at a time. */
constexpr std::size_t block_triangles = 512;

using Place = Eigen::Vector3d;

/** An axis along which a triangle is seen from its side nowhere; -1 for one without
 * area. */
int
findAxis(const Place& a, const Place& b, const Place& c)
{
  for (int axis = 0; axis < 3; ++axis)
    if (signOfArea(a, b, c, axis) != 0)
      return axis;
  return -1;
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
    const int axis = findAxis(a, b, c);
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

} // namespace

bool
doIntersect(const std::vector<Eigen::Vector3d>& places,
            const Triangle& a,
            const Triangle& b)
{
  const auto cornersOf = [&](const Triangle& triangle) {
    return std::array<Place, 3>{
        places[triangle[0]], places[triangle[1]], places[triangle[2]]};
  };
  const std::array<Place, 3> of_a = cornersOf(a), of_b = cornersOf(b);
  const int axis = findAxis(of_a[0], of_a[1], of_a[2]);
  if (axis < 0 || findAxis(of_b[0], of_b[1], of_b[2]) < 0)
    return false;
  std::vector<std::uint32_t> shared;
  for (const std::uint32_t vertex : a)
    if (std::find(b.begin(), b.end(), vertex) != b.end())
      shared.push_back(vertex);
  if (shared.size() == 3)
    return true;
  const auto isShared = [&](std::uint32_t vertex) {
    return std::find(shared.begin(), shared.end(), vertex) != shared.end();
  };
  if (shared.size() == 2) {
    // Folded onto each other: the tips are on one side of the edge in one plane.
    const Place &tip_a = places[*std::find_if_not(a.begin(), a.end(), isShared)],
                &tip_b = places[*std::find_if_not(b.begin(), b.end(), isShared)],
                &p = places[shared[0]], &q = places[shared[1]];
    return signOfVolume(p, q, tip_a, tip_b) == 0 &&
           signOfArea(p, q, tip_a, axis) == signOfArea(p, q, tip_b, axis);
  }
  // Edges of one that meet the other; those at a shared vertex do so there, and what
  // more they share, edges opposite to it meet as well.
  const auto anyMeets = [&](const Triangle& edges,
                            const std::array<Place, 3>& of_edges,
                            const std::array<Place, 3>& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3;
      if (!isShared(edges[i]) && !isShared(edges[k]) &&
          meets(of_edges[i], of_edges[k], other))
        return true;
    }
    return false;
  };
  return anyMeets(a, of_a, of_b) || anyMeets(b, of_b, of_a);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>>
findSelfIntersections(const std::vector<Eigen::Vector3d>& places,
                      const std::vector<Triangle>& triangles,
                      const std::vector<double>& surface_of,
                      unsigned threads,
                      Report& report)
{
  StepTimer step(report, "intersections", triangles.size());
  const auto areOfOne = [&](const Triangle& a, const Triangle& b) {
    return surface_of.empty() || surface_of[a[0]] == surface_of[b[0]];
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  const TriangleTree tree(places, triangles);
  return parallelGather<Pair>(
      triangles.size(),
      block_triangles,
      threads,
      [&](auto begin, auto end, auto& pairs) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = begin; i < end; ++i) {
          const auto first = static_cast<std::uint32_t>(i);
          Eigen::AlignedBox3d box;
          for (const std::uint32_t vertex : triangles[i])
            box.extend(places[vertex]);
          tree.findOverlapping(box, found);
          std::sort(found.begin(), found.end());
          for (const std::uint32_t second : found)
            if (second > first && areOfOne(triangles[first], triangles[second]) &&
                doIntersect(places, triangles[first], triangles[second]))
              pairs.emplace_back(first, second);
        }
        step.advance(end - begin);
      });
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
  if (!found.empty()) {
    std::ostringstream text;
    text << "The surface goes through itself: "
         << describeCount(found.size(), "pair", "pairs")
         << " of triangles intersect, the first at " << found[0].place[0] << ","
         << found[0].place[1] << "," << found[0].place[2] << ".";
    report.warnings.push_back(text.str());
  }
  return found;
}

} // namespace pcl_uvol::detail
