// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/self_intersections.h"

#include "common/numbers.h"
#include "common/parallel.h"
#include "mesh/exact_signs.h"
#include "mesh/measured_mesh.h"
#include "mesh/triangle_tree.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <sstream>

namespace pcl_uvol::detail {

namespace {

/** Triangles that a thread looks at at a time. */
constexpr std::size_t block_triangles = 512;

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

/** An axis along which a triangle is seen from its side nowhere; -1 for one without
 * area. */
int
findAxis(const Place& a, const Place& b, const Place& c)
{
  // The sign of an area of zero takes whole numbers: the largest area comes first.
  int largest = 0;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&largest);
  for (int i = 0; i < 3; ++i)
    if (const int axis = (largest + i) % 3; signOfArea(a, b, c, axis) != 0)
      return axis;
  return -1;
}

bool
hasArea(const std::array<Place, 3>& corners)
{
  return findAxis(corners[0], corners[1], corners[2]) >= 0;
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
  const std::array<Place, 3> of_a = cornersOf(places, a), of_b = cornersOf(places, b);
  const int axis = findAxis(of_a[0], of_a[1], of_a[2]);
  if (axis < 0 || !hasArea(of_b))
    return false;
  Triangle shared;
  const auto end = std::copy_if(a.begin(), a.end(), shared.begin(), [&](auto vertex) {
    return std::find(b.begin(), b.end(), vertex) != b.end();
  });
  if (end == shared.end())
    return true;
  const auto isShared = [&](std::uint32_t vertex) {
    return std::find(shared.begin(), end, vertex) != end;
  };
  if (end - shared.begin() == 2) {
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
    const Eigen::AlignedBox3d box = boxOf(other);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = (i + 1) % 3;
      if (!isShared(edges[i]) && !isShared(edges[k]) &&
          box.intersects(boxOf(std::array{of_edges[i], of_edges[k]})) &&
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
  std::vector<bool> has_area; // told once: of lines it takes whole numbers
  for (const Triangle& triangle : triangles)
    has_area.push_back(hasArea(cornersOf(places, triangle)));
  std::atomic<std::size_t> total{0};
  return parallelGather<Pair>(
      triangles.size(),
      block_triangles,
      threads,
      [&](auto begin, auto end, auto& pairs) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = begin; i < end; ++i) {
          const auto first = static_cast<std::uint32_t>(i);
          if (!has_area[i])
            continue;
          const std::size_t before = pairs.size();
          tree.findOverlapping(boxOf(cornersOf(places, triangles[i])), found);
          for (const std::uint32_t second : found)
            if (second > first && has_area[second] &&
                areOfOne(triangles[first], triangles[second]) &&
                doIntersect(places, triangles[first], triangles[second]))
              pairs.emplace_back(first, second);
          std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end());
          if ((total += pairs.size() - before) > most_pairs)
            throw InvalidArgument("More than " + std::to_string(most_pairs) +
                                  " pairs of triangles of the surface intersect: many "
                                  "lie on one another, repair the mesh.");
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
