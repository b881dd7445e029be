// SPDX-License-Identifier: BSD-3-Clause
// What meshes are made with: feet, half edges, pieces, remeshing.
#include "mesh_fields.h"
#include "src/mesh/foot.h"
#include "src/mesh/half_edges.h"
#include "src/mesh/remeshing.h"
#include "src/mesh/surface_pieces.h"
#include "src/mesh/working_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_mesh_kernels {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using Eigen::Vector3d;

Foot
footOfSphere(const Vector3d& direction, double radius)
{
  const Vector3d normal = direction.normalized();
  return {radius * normal, normal, 1.0 / radius};
}

TEST(Foot, KnowsASphereToSecondOrder)
{
  const Foot foot = footOfSphere({1.0, 2.0, -1.0}, 10.0);
  for (const double angle : {0.0, 0.1, 0.2}) {
    const Vector3d aside = foot.normal.cross(Vector3d::UnitX()).normalized();
    const Vector3d direction = std::cos(angle) * foot.normal + std::sin(angle) * aside;
    for (const double height : {-0.5, 0.0, 0.5}) {
      const double rest =
          std::pow(10.0 * angle, 2) * 0.01 + std::pow(angle, 4) * 10.0 + 1e-12;
      EXPECT_NEAR(height, foot.heightOf((10.0 + height) * direction), rest);
    }
    EXPECT_NEAR(1.0,
                foot.normalAt(10.0 * direction).normalized().dot(direction),
                std::pow(angle, 4) + 1e-12);
  }
}

TEST(Foot, IsFiniteWhereCurvaturesBelongToNoSurface)
{
  for (const double curvature : {1e3, -1e3, 1e30, -1e30, 1e150}) {
    const std::vector<Foot> feet = {
        {{0.0, 0.0, 0.0}, Vector3d::UnitZ(), curvature},
        {{1.0, 0.0, 0.0}, Vector3d(0.6, 0.0, 0.8), -0.5 * curvature}};
    for (const BoxSides sides : {0, 1, 5})
      for (const double length : {1.0, 1e-3, 0.0}) {
        const Vector3d start(0.4, 0.7, 0.3);
        Foot foot = feet[0];
        foot.place = start;
        // As where the box sends places back again and again.
        for (int round = 0; round < 5; ++round)
          foot = blendFeet(feet, foot.place, length, sides);
        EXPECT_TRUE(foot.place.allFinite()) << curvature << " " << length;
        // Five rounds of up to five steps, each a thousand lengths long at most.
        EXPECT_LE((foot.place - start).norm(), 25e3 * length) << curvature;
        EXPECT_TRUE(foot.normal.allFinite()) << curvature << " " << length;
      }
  }
}

TEST(Foot, BlendsToTheSurfaceThatAllAreOf)
{
  std::vector<Foot> feet;
  for (const Vector3d& direction :
       {Vector3d(1.0, 0.1, 0.0), Vector3d(1.0, -0.1, 0.1), Vector3d(1.0, 0.0, -0.1)})
    feet.push_back(footOfSphere(direction, 10.0));
  const Foot foot = blendFeet(feet, {10.4, 0.2, 0.1}, 1.0);
  EXPECT_NEAR(10.0, foot.place.norm(), 1e-3);
  EXPECT_NEAR(1.0, foot.normal.dot(foot.place.normalized()), 1e-5);
  EXPECT_NEAR(1.0, foot.normal.norm(), 1e-12);
  EXPECT_NEAR(0.1, foot.mean_curvature, 1e-12);
  // The nearest one counts most: at its own place alone.
  feet[1].place *= 1.1;
  EXPECT_NEAR(10.0, blendFeet(feet, feet[0].place, 10.0).place.norm(), 0.3);
  EXPECT_NEAR(10.0, blendFeet(feet, feet[0].place, 0.1).place.norm(), 1e-3);
}

/** An octahedron with its vertices by axis and side. */
std::vector<Triangle>
makeOctahedron()
{
  std::vector<Triangle> triangles;
  for (std::uint32_t x : {0u, 1u})
    for (std::uint32_t y : {2u, 3u})
      for (std::uint32_t z : {4u, 5u})
        if ((x + y + z) % 2 == 0)
          triangles.push_back({x, y, z});
        else
          triangles.push_back({x, z, y});
  return triangles;
}

/** n times m vertices on a torus. */
std::vector<Triangle>
makeTorus(std::uint32_t n, std::uint32_t m)
{
  std::vector<Triangle> triangles;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % n * m + j % m; };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return triangles;
}

TEST(HalfEdges, KnowNeighboursAndRims)
{
  std::vector<Triangle> triangles = makeOctahedron();
  const HalfEdges closed(triangles, 6);
  EXPECT_EQ(0u, closed.getDefects().edges);
  EXPECT_EQ(0u, closed.getDefects().vertices);
  EXPECT_EQ(0u, closed.countRimEdges());
  std::vector<std::uint32_t> around;
  closed.findAround(0, around);
  std::sort(around.begin(), around.end());
  EXPECT_EQ((std::vector<std::uint32_t>{2, 3, 4, 5}), around);

  triangles.pop_back();
  const HalfEdges open(triangles, 6);
  EXPECT_EQ(0u, open.getDefects().edges);
  EXPECT_EQ(3u, open.countRimEdges());
  EXPECT_TRUE(open.isAtRim(1));
  EXPECT_FALSE(open.isAtRim(0));
  open.findAround(1, around);
  std::sort(around.begin(), around.end());
  EXPECT_EQ((std::vector<std::uint32_t>{2, 3, 4, 5}), around);
}

TEST(HalfEdges, NoticeEveryDefect)
{
  std::vector<Triangle> triangles = makeOctahedron();
  std::swap(triangles[0][0], triangles[0][1]);
  EXPECT_GT(HalfEdges(triangles, 6).getDefects().edges, 0u);
  triangles = makeOctahedron();
  triangles.push_back({0, 2, 1});
  EXPECT_GT(HalfEdges(triangles, 6).getDefects().edges, 0u);
  triangles = makeOctahedron();
  triangles[0] = {0, 0, 4};
  EXPECT_GT(HalfEdges(triangles, 6).getDefects().edges, 0u);
  // Two octahedra that share a vertex.
  triangles = makeOctahedron();
  for (Triangle triangle : makeOctahedron()) {
    for (std::uint32_t& vertex : triangle)
      vertex = vertex == 0 ? 0 : vertex + 5;
    triangles.push_back(triangle);
  }
  EXPECT_EQ(0u, HalfEdges(triangles, 11).getDefects().edges);
  EXPECT_EQ(1u, HalfEdges(triangles, 11).getDefects().vertices);
  EXPECT_THROW(findPieces(triangles, 11), std::logic_error);
}

TEST(HalfEdges, ManyTrianglesOfOneEdgeTakeNoLonger)
{
  constexpr std::size_t count = 200000;
  std::vector<Triangle> triangles = makeOctahedron();
  triangles.insert(triangles.end(), count, {6, 7, 8});
  const auto start = std::chrono::steady_clock::now();
  const HalfEdges edges(triangles, 9);
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 5.0); // minutes where each looks at all others
  EXPECT_EQ(3 * count, edges.getDefects().edges);
  EXPECT_EQ(3u, edges.getDefects().vertices);
  EXPECT_EQ(3 * count, edges.countRimEdges());
}

TEST(HalfEdges, FlipsAndCollapsesStayManifold)
{
  std::vector<Triangle> triangles = makeTorus(7, 6);
  HalfEdges edges(triangles, 42);
  for (HalfEdge edge = 0; edge < 3 * triangles.size(); edge += 5) {
    const std::uint32_t c = edges.originOf(previousOf(edge)),
                        d = edges.originOf(previousOf(edges.twinOf(edge)));
    std::vector<std::uint32_t> around;
    edges.findAround(c, around);
    if (std::find(around.begin(), around.end(), d) != around.end())
      continue;
    edges.flip(edge);
    ASSERT_EQ(0u, uvol_test::expectManifold(triangles, 42));
    // What flips keep in step is what is found anew.
    const HalfEdges anew(triangles, 42);
    ASSERT_EQ(0u, anew.getDefects().vertices);
    for (HalfEdge other = 0; other < 3 * triangles.size(); ++other)
      ASSERT_EQ(anew.twinOf(other), edges.twinOf(other));
  }
  EXPECT_EQ(1u, findPieces(triangles, 42).pieces[0].genus);

  triangles = makeTorus(7, 6);
  HalfEdges before(triangles, 42);
  const std::uint32_t gone = before.targetOf(0);
  before.collapse(0);
  std::vector<Triangle> left;
  for (const Triangle& triangle : triangles)
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] &&
        triangle[2] != triangle[0])
      left.push_back(triangle);
  EXPECT_EQ(triangles.size() - 2, left.size());
  for (const Triangle& triangle : left)
    EXPECT_EQ(0, std::count(triangle.begin(), triangle.end(), gone));
  EXPECT_EQ(0u, uvol_test::expectManifold(left, 42));
  EXPECT_EQ(1u, findPieces(left, 42).pieces[0].genus);
}

TEST(FindPieces, CountsHandlesAndRims)
{
  // A torus, an octahedron behind it, and a torus with two holes behind that.
  std::vector<Triangle> triangles = makeOctahedron();
  const auto add = [&](const std::vector<Triangle>& others, std::uint32_t first) {
    for (Triangle triangle : others) {
      for (std::uint32_t& vertex : triangle)
        vertex += first;
      triangles.push_back(triangle);
    }
  };
  std::vector<Triangle> holed = makeTorus(9, 8);
  holed.erase(holed.begin() + 60);
  holed.erase(holed.begin());
  add(makeTorus(5, 4), 6);
  add(holed, 26);
  const PieceList list = findPieces(triangles, 98);
  ASSERT_EQ(3u, list.pieces.size());
  EXPECT_EQ(142u, list.pieces[0].triangles);
  EXPECT_EQ(2u, list.pieces[0].rims);
  EXPECT_EQ(1u, list.pieces[0].genus);
  EXPECT_EQ(40u, list.pieces[1].triangles);
  EXPECT_EQ(0u, list.pieces[1].rims);
  EXPECT_EQ(1u, list.pieces[1].genus);
  EXPECT_EQ(8u, list.pieces[2].triangles);
  EXPECT_EQ(6u, list.pieces[2].vertices);
  EXPECT_EQ(0u, list.pieces[2].genus);
  EXPECT_EQ(2, list.of_vertex[0]);
  EXPECT_EQ(1, list.of_vertex[6]);
  EXPECT_EQ(0, list.of_vertex[97]);
}

TEST(SplitPinchedVertices, GivesEveryFanItsOwn)
{
  // Two triangles that touch in vertex 0, and one more beside the second.
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 3, 4}, {0, 4, 5}};
  std::vector<std::uint32_t> source_of;
  EXPECT_EQ(1u, splitPinchedVertices(triangles, 6, source_of));
  EXPECT_EQ((std::vector<std::uint32_t>{0}), source_of);
  EXPECT_EQ(0u, HalfEdges(triangles, 7).getDefects().vertices);
  EXPECT_EQ(4u, uvol_test::expectManifold({triangles[1], triangles[2]}, 7));
  EXPECT_EQ(2u, findPieces(triangles, 7).pieces.size());
  EXPECT_EQ(0u, splitPinchedVertices(triangles, 7, source_of));
}

/** A sphere of n by n vertices by longitude and latitude, and its two poles. */
WorkingMesh
makeGlobe(std::uint32_t n)
{
  WorkingMesh mesh;
  mesh.sides = {-9.0, 9.0, -9.0, 9.0, -9.0, 9.0};
  const auto add = [&](double longitude, double latitude) {
    WorkingVertex vertex;
    vertex.foot = footOfSphere({std::cos(longitude) * std::cos(latitude),
                                std::sin(longitude) * std::cos(latitude),
                                std::sin(latitude)},
                               2.0);
    vertex.size = 0.8;
    vertex.pair = {0, 1};
    mesh.vertices.push_back(vertex);
  };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      add(2.0 * M_PI * i / n, M_PI * ((j + 1.0) / (n + 1.0) - 0.5));
  add(0.0, -0.5 * M_PI);
  add(0.0, 0.5 * M_PI);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t here = i * n, there = (i + 1) % n * n;
    mesh.triangles.push_back({n * n, there, here});
    mesh.triangles.push_back({n * n + 1, here + n - 1, there + n - 1});
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      mesh.triangles.push_back({here + j, there + j, there + j + 1});
      mesh.triangles.push_back({here + j, there + j + 1, here + j + 1});
    }
  }
  mesh.regions.assign(mesh.triangles.size(), surface_region);
  return mesh;
}

TEST(Remesh, EvensOutAGlobe)
{
  WorkingMesh mesh = makeGlobe(40);
  ASSERT_EQ(0u, uvol_test::expectManifold(mesh.triangles, mesh.vertices.size()));
  WorkingMesh other = mesh;
  Report report;
  std::vector<double> told;
  report.progress = [&](const std::string&, double done) { told.push_back(done); };
  remesh(mesh, 0.0, 1, report);
  EXPECT_GT(told.size(), 11u); // rounds of smoothing, and passes of collapses
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(1.0, told.back());
  EXPECT_EQ(0u, uvol_test::expectManifold(mesh.triangles, mesh.vertices.size()));
  EXPECT_EQ(0u, findPieces(mesh.triangles, mesh.vertices.size()).pieces[0].genus);
  double shortest = 9.0, longest = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    EXPECT_GT(mesh.agreementOf(triangle, surface_region), 0.9);
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (mesh.vertices[triangle[i]].foot.place -
                             mesh.vertices[triangle[(i + 1) % 3]].foot.place)
                                .norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  }
  EXPECT_GT(shortest, 0.2);
  EXPECT_LT(longest, 1.2);
  for (const WorkingVertex& vertex : mesh.vertices)
    EXPECT_NEAR(2.0, vertex.foot.place.norm(), 0.02);
  remesh(other, 0.0, 3, report);
  EXPECT_EQ(mesh.triangles, other.triangles);
}

/** A slab of 3 by 3, thinner than edges that collapse: its upper side is the surface,
 * the others are caps. */
WorkingMesh
makeSlab(double height)
{
  constexpr std::uint32_t n = 5;
  constexpr MeshRegion low_x = 0, high_x = 1, low_y = 2, high_y = 3, low_z = 4;
  WorkingMesh mesh;
  mesh.sides = {0.0, 3.0, 0.0, 3.0, 0.0, 9.0};
  for (const bool is_upper : {false, true})
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        WorkingVertex vertex;
        const auto stayOn = [&](MeshRegion side, const Vector3d& outwards) {
          vertex.sides = static_cast<BoxSides>(vertex.sides | 1 << side);
          if (!is_upper)
            vertex.foot.normal += outwards;
        };
        vertex.foot = {Vector3d(0.75 * x, 0.75 * y, is_upper ? height : 0.0),
                       Vector3d::Zero(),
                       0.0};
        vertex.size = 1.0;
        vertex.pair = {0, 1};
        vertex.is_on_surface = is_upper;
        if (is_upper)
          vertex.foot.normal = Vector3d::UnitZ();
        else
          stayOn(low_z, -Vector3d::UnitZ());
        if (x == 0 || x == n - 1)
          stayOn(x == 0 ? low_x : high_x, (x == 0 ? -1.0 : 1.0) * Vector3d::UnitX());
        if (y == 0 || y == n - 1)
          stayOn(y == 0 ? low_y : high_y, (y == 0 ? -1.0 : 1.0) * Vector3d::UnitY());
        vertex.foot.normal.normalize();
        mesh.vertices.push_back(vertex);
      }
  const auto add = [&](std::array<std::uint32_t, 4> quad, MeshRegion region) {
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
    mesh.regions.insert(mesh.regions.end(), 2, region);
  };
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return (z * n + y) * n + x;
  };
  constexpr std::uint32_t last = n - 1;
  for (std::uint32_t i = 0; i < last; ++i) {
    for (std::uint32_t k = 0; k < last; ++k) {
      add({at(i, k, 1), at(i + 1, k, 1), at(i + 1, k + 1, 1), at(i, k + 1, 1)},
          surface_region);
      add({at(i, k, 0), at(i, k + 1, 0), at(i + 1, k + 1, 0), at(i + 1, k, 0)}, low_z);
    }
    add({at(0, i, 0), at(0, i, 1), at(0, i + 1, 1), at(0, i + 1, 0)}, low_x);
    add({at(last, i, 0), at(last, i + 1, 0), at(last, i + 1, 1), at(last, i, 1)},
        high_x);
    add({at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1)}, low_y);
    add({at(i, last, 0), at(i, last, 1), at(i + 1, last, 1), at(i + 1, last, 0)},
        high_y);
  }
  return mesh;
}

/** Edges from the crease above to the one below are short, but neither may go. */
TEST(Remesh, KeepsCreasesApart)
{
  constexpr double height = 0.2;
  WorkingMesh mesh = makeSlab(height);
  ASSERT_EQ(0u, uvol_test::expectManifold(mesh.triangles, mesh.vertices.size()));
  Report report;
  remesh(mesh, 0.0, 1, report);
  EXPECT_EQ(50u, mesh.vertices.size());
  for (const WorkingVertex& vertex : mesh.vertices)
    EXPECT_NEAR(vertex.is_on_surface ? height : 0.0, vertex.foot.place.z(), 1e-12);
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices[a].foot.place.dot(
                  mesh.vertices[b].foot.place.cross(mesh.vertices[c].foot.place)) /
              6.0;
  EXPECT_NEAR(9.0 * height, volume, 1e-12);
}

} // namespace test_mesh_kernels
