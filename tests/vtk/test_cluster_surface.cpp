// SPDX-License-Identifier: BSD-3-Clause
// Surfaces around clusters: what they enclose, how far away they are, and that they are
// closed surfaces of the genus of the cluster.
#include "support/meshes.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/random.h>
#include <pcl_uvol/multivariate/cluster_hull.h>
#include <pcl_uvol/multivariate/spanning_tree.h>
#include <pcl_uvol/vtk/cluster_surface.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace {

using Eigen::Vector3d;
using pcl_uvol::ClusterSurface;
using pcl_uvol::ClusterSurfaceKind;
using pcl_uvol::ClusterSurfaceSettings;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Mesh;
using pcl_uvol::Report;
using pcl_uvol::Triangle;
using pcl_uvol::uniformAt;
using uvol_test::distanceToTriangles;
using uvol_test::signedVolume;
using uvol_test::vertexOf;

constexpr double pi = 3.14159265358979323846;
constexpr std::uint32_t cells = 96;
constexpr auto all_kinds = {ClusterSurfaceKind::Distance,
                            ClusterSurfaceKind::Hull,
                            ClusterSurfaceKind::HullDistance};

using Points = std::vector<Vector3d>;

ClusterSurfaceSettings
settingsOf(double distance)
{
  ClusterSurfaceSettings settings;
  settings.cells = cells;
  settings.distance = distance;
  return settings;
}

/** A cloud with something before and after the coordinates. */
class Cluster {
public:
  explicit Cluster(const Points& points)
      : members_(points.size())
  {
    for (const Vector3d& point : points) {
      const Eigen::Vector3f p = point.cast<float>();
      floats_.insert(floats_.end(), {-7.0f, p[0], p[1], p[2], 1e9f});
    }
    std::iota(members_.begin(), members_.end(), 0u);
  }

  ClusterSurface
  enclose(ClusterSurfaceKind kind,
          const ClusterSurfaceSettings& settings,
          Report& report) const
  {
    pcl_uvol::CloudView view;
    view.data = reinterpret_cast<const std::uint8_t*>(floats_.data());
    view.count = floats_.size() / 5;
    view.point_step = 5 * sizeof(float);
    view.xyz_offset = sizeof(float);
    return makeClusterSurface(view, members_, kind, settings, report);
  }

  ClusterSurface
  enclose(ClusterSurfaceKind kind,
          double distance,
          std::uint32_t along = cells,
          unsigned threads = 0) const
  {
    ClusterSurfaceSettings settings = settingsOf(distance);
    settings.cells = along;
    settings.threads = threads;
    Report report;
    return enclose(kind, settings, report);
  }

  Vector3d
  operator[](std::size_t i) const
  {
    return {floats_[5 * i + 1], floats_[5 * i + 2], floats_[5 * i + 3]};
  }

  const std::vector<std::uint32_t>&
  members() const
  {
    return members_;
  }

  void
  setMembers(std::vector<std::uint32_t> members)
  {
    members_ = std::move(members);
  }

  /** Side of a cell, by the definition of the settings. */
  double
  voxel(double distance, std::uint32_t along = cells) const
  {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t member : members_)
      box.extend((*this)[member]);
    return (box.sizes().maxCoeff() + 2.0 * distance) / along;
  }

  double
  longestEdge() const
  {
    std::vector<pcl_uvol::Position> positions;
    for (const std::uint32_t member : members_) {
      const Eigen::Vector3f p = (*this)[member].cast<float>();
      positions.push_back({{p[0], p[1], p[2]}});
    }
    Report report;
    return pcl_uvol::longestSpanningEdge(positions, 0, report);
  }

private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> members_;
};

/** Random places in [-2.5, 2.5]^3 that belong to a solid. */
Points
pointsIn(std::size_t number,
         std::uint64_t seed,
         const std::function<bool(const Vector3d&)>& contains)
{
  Points points;
  for (std::uint64_t i = 0; points.size() < number; ++i) {
    const Vector3d place =
        5.0 *
        (Vector3d(uniformAt(seed, i, 0), uniformAt(seed, i, 1), uniformAt(seed, i, 2)) -
         Vector3d::Constant(0.5));
    if (contains(place))
      points.push_back(place);
  }
  return points;
}

/** Negative inside; the ring lies in the plane of x and y. */
double
distanceToTorus(const Vector3d& place, double radius)
{
  return std::hypot(std::hypot(place.x(), place.y()) - 1.0, place.z()) - radius;
}

Points
ballOf(std::size_t number, std::uint64_t seed)
{
  return pointsIn(
      number, seed, [](const Vector3d& place) { return place.norm() <= 1.0; });
}

Points
torusOf(std::size_t number, std::uint64_t seed)
{
  return pointsIn(number, seed, [](const Vector3d& place) {
    return distanceToTorus(place, 0.4) <= 0.0;
  });
}

/** The second one goes through the hole of the first one. */
Points
linkedTubesOf(std::size_t number, std::uint64_t seed)
{
  return pointsIn(number, seed, [](const Vector3d& place) {
    const Vector3d turned(place.x() - 1.0, place.z(), place.y());
    return std::min(distanceToTorus(place, 0.25), distanceToTorus(turned, 0.25)) <= 0.0;
  });
}

Points
bentSheetOf(std::size_t number, std::uint64_t seed)
{
  Points points;
  for (std::uint64_t i = 0; i < number; ++i) {
    const double x = 2.0 * uniformAt(seed, i, 0) - 1.0;
    points.emplace_back(x, 2.0 * uniformAt(seed, i, 1) - 1.0, 0.4 * std::sin(2.0 * x));
  }
  return points;
}

/** Each edge is walked as often in one direction as in the other one; where nothing
 * coincides, the triangles around a vertex are one ring.
 * \return the part of the vertices that nothing coincides at */
double
expectClosed(const Mesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<std::map<std::uint32_t, std::uint32_t>> rings(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
      rings[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
    }
  std::size_t unmatched = 0, torn = 0, apart = 0;
  std::vector<bool> coincides(mesh.vertices.size(), false);
  for (const auto& edge : edges) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    unmatched += opposite == edges.end() || opposite->second != edge.second ||
                 edge.first.first == edge.first.second;
    if (edge.second > 1)
      coincides[edge.first.first] = coincides[edge.first.second] = true;
  }
  EXPECT_EQ(0u, unmatched) << "of " << edges.size() << " edges";
  for (std::size_t vertex = 0; vertex < rings.size() && unmatched == 0; ++vertex)
    if (!coincides[vertex]) {
      const auto& ring = rings[vertex];
      std::size_t length = 0;
      std::uint32_t at = ring.empty() ? 0 : ring.begin()->first;
      do
        at = ring.empty() ? 0 : ring.at(at);
      while (++length < ring.size() && at != ring.begin()->first);
      torn += length != ring.size();
      ++apart;
    }
  EXPECT_EQ(0u, torn) << "of " << apart << " vertices";
  return static_cast<double>(apart) / static_cast<double>(rings.size());
}

/** Genus of each component, ascending. */
std::vector<long>
generaOf(const Mesh& mesh)
{
  std::vector<std::uint32_t> parents(mesh.vertices.size());
  std::iota(parents.begin(), parents.end(), 0u);
  const auto rootOf = [&](std::uint32_t vertex) {
    while (parents[vertex] != vertex)
      vertex = parents[vertex] = parents[parents[vertex]];
    return vertex;
  };
  for (const Triangle& t : mesh.triangles) {
    parents[rootOf(t[0])] = rootOf(t[1]);
    parents[rootOf(t[1])] = rootOf(t[2]);
  }
  std::map<std::uint32_t, long> twice_euler;
  for (std::uint32_t vertex = 0; vertex < parents.size(); ++vertex)
    twice_euler[rootOf(vertex)] += 2;
  for (const Triangle& t : mesh.triangles)
    --twice_euler[rootOf(t[0])];
  std::vector<long> genera;
  for (const auto& component : twice_euler) {
    EXPECT_EQ(0, component.second % 4);
    genera.push_back(1 - component.second / 4);
  }
  std::sort(genera.begin(), genera.end());
  return genera;
}

/** How often the mesh winds around a place: the solid angles of its triangles (van
 * Oosterom and Strackee 1983). */
double
windingNumber(const Mesh& mesh, const Vector3d& place)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = vertexOf(mesh, t[0]) - place, b = vertexOf(mesh, t[1]) - place,
                   c = vertexOf(mesh, t[2]) - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)),
                      la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2.0 * pi);
}

/** A cluster of a shape whose surface is known. */
struct Shape {
  std::string name;
  Points (*make)(std::size_t number, std::uint64_t seed);
  double distance; ///< bridges the gaps between points, and nothing else
  std::vector<long> genera;
  bool is_solid;
};

void
PrintTo(const Shape& shape, std::ostream* stream)
{
  *stream << shape.name;
}

class HullsOfShapes : public testing::TestWithParam<Shape> {
protected:
  static constexpr std::size_t number = 4000;
  const Cluster cluster_{Cluster(GetParam().make(number, 1))};
  const double voxel_ = cluster_.voxel(GetParam().distance);
  const ClusterSurface hull_ =
      cluster_.enclose(ClusterSurfaceKind::Hull, GetParam().distance);
};

TEST_P(HullsOfShapes, AreClosedAndOfTheirGenus)
{
  for (std::uint64_t seed = 1; seed < 4; ++seed)
    for (const std::uint32_t along : {64u, cells, 150u}) {
      const Cluster cluster(GetParam().make(number, seed));
      const Mesh mesh =
          cluster.enclose(ClusterSurfaceKind::Hull, GetParam().distance, along).mesh;
      EXPECT_GT(expectClosed(mesh), 0.9); // small pieces may have two neighbours only
      EXPECT_EQ(GetParam().genera, generaOf(mesh)) << seed << ", " << along;
      if (GetParam().is_solid) {
        EXPECT_GT(signedVolume(mesh), 0.0);
      }
    }
}

TEST_P(HullsOfShapes, HaveTheirPointsAsVertices)
{
  ASSERT_EQ(hull_.mesh.vertices.size(), hull_.points.size());
  for (std::uint32_t i = 0; i < hull_.points.size(); ++i)
    EXPECT_EQ(cluster_[hull_.points[i]], vertexOf(hull_.mesh, i));
}

/** Nearly all regions of a solid are of one piece; a sheet shows most of its points to
 * both sides. */
TEST_P(HullsOfShapes, HaveAVertexPerPieceOfARegion)
{
  const ClusterSurface fine =
      cluster_.enclose(ClusterSurfaceKind::Hull, GetParam().distance, 384);
  std::map<std::uint32_t, std::size_t> times;
  for (const std::uint32_t point : fine.points)
    ++times[point];
  const auto several = static_cast<std::size_t>(std::count_if(
      times.begin(), times.end(), [](const auto& entry) { return entry.second > 1; }));
  if (GetParam().is_solid) {
    EXPECT_LT(several, times.size() / 10);
  }
  else {
    EXPECT_GT(several, times.size() / 2);
  }
}

/** The points that the surface at the distance is nearest to, and no others. */
TEST_P(HullsOfShapes, TakeThePointsThatTheSurfaceIsNearestTo)
{
  const Mesh around =
      cluster_.enclose(ClusterSurfaceKind::Distance, GetParam().distance).mesh;
  // Points count as at the centres of their cells.
  const double rounding = 1.7321 * voxel_;
  std::vector<bool> is_vertex(number, false), is_nearest(number, false);
  for (const std::uint32_t point : hull_.points)
    is_vertex[point] = true;
  Points points;
  for (std::size_t i = 0; i < number; ++i)
    points.push_back(cluster_[i]);
  double worst = 0.0;
  for (std::uint32_t i = 0; i < around.vertices.size(); i += 3) {
    const Vector3d place = vertexOf(around, i);
    double least = 1e30, least_of_hull = 1e30;
    for (std::size_t j = 0; j < number; ++j) {
      const double distance = (points[j] - place).norm();
      least = std::min(least, distance);
      if (is_vertex[j])
        least_of_hull = std::min(least_of_hull, distance);
    }
    worst = std::max(worst, least_of_hull - least);
    for (std::size_t j = 0; j < number; ++j)
      if (is_vertex[j] && !is_nearest[j])
        is_nearest[j] = (points[j] - place).norm() < least + rounding;
  }
  EXPECT_LT(worst, rounding);
  EXPECT_EQ(is_vertex, is_nearest);
}

TEST_P(HullsOfShapes, LeaveNoPointOutside)
{
  double farthest = 0.0;
  for (std::size_t i = 0; i < number; ++i) {
    const Vector3d place = cluster_[i];
    // Vertices are on the hull: there is no winding number.
    const double distance = distanceToTriangles(hull_.mesh, place);
    if (distance <= farthest ||
        (GetParam().is_solid && windingNumber(hull_.mesh, place) > 0.5))
      continue;
    farthest = distance;
  }
  EXPECT_LT(farthest, voxel_);
}

/** Every 29th vertex of the surface at a distance from the hull. */
TEST_P(HullsOfShapes, AreWhatHullDistancesAreMeasuredFrom)
{
  const Mesh around =
      cluster_.enclose(ClusterSurfaceKind::HullDistance, GetParam().distance).mesh;
  expectClosed(around);
  EXPECT_EQ(GetParam().genera, generaOf(around));
  EXPECT_GT(signedVolume(around), 0.0);
  double largest_error = 0.0;
  for (std::uint32_t i = 0; i < around.vertices.size(); i += 29)
    largest_error =
        std::max(largest_error,
                 std::abs(distanceToTriangles(hull_.mesh, vertexOf(around, i)) -
                          GetParam().distance));
  EXPECT_LT(largest_error, voxel_);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes,
    HullsOfShapes,
    testing::Values(Shape{"Ball", ballOf, 0.22, {0}, true},
                    Shape{"Torus", torusOf, 0.2, {1}, true},
                    Shape{"LinkedTubes", linkedTubesOf, 0.17, {1, 1}, true},
                    Shape{"BentSheet", bentSheetOf, 0.12, {0}, false}),
    [](const auto& shape) { return shape.param.name; });

/** By brute force; of equally near places the first one. */
template <typename Candidates>
std::uint32_t
nearestOf(const Points& points, const Candidates& candidates, const Vector3d& place)
{
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = 0;
  for (const std::uint32_t i : candidates) {
    const double sq_dist = (points[i] - place).squaredNorm();
    if (sq_dist < least) {
      least = sq_dist;
      nearest = i;
    }
  }
  return nearest;
}

/** Points at the centres of cells of side 1, so that nothing is rounded. The region of
 * a vertex is that of one of the eight centres around it. */
TEST(ClusterSurfaces, ShrinkTheRegionsOfBruteForce)
{
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Points points;
    for (int z = -20; z <= 20; ++z)
      for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x) {
          const Vector3d place(x, y, z);
          const auto index = static_cast<std::uint64_t>((z * 41 + y) * 41 + x);
          // The whole sphere spans the grid.
          if (place.norm() == 20.0 ||
              (place.norm() < 20.0 && uniformAt(seed, index, 0) < 0.04))
            points.push_back(place);
        }
    const Cluster cluster(points);
    const Mesh around = cluster.enclose(ClusterSurfaceKind::Distance, 4.5, 49).mesh;
    std::vector<std::uint32_t> regions;
    for (std::uint32_t i = 0; i < around.vertices.size(); ++i) {
      const Vector3d place = vertexOf(around, i);
      std::set<std::uint32_t> candidates;
      for (int corner = 0; corner < 8; ++corner)
        candidates.insert(
            nearestOf(points,
                      cluster.members(),
                      place.array().floor().matrix() +
                          Vector3d(corner & 1, corner >> 1 & 1, corner >> 2)));
      regions.push_back(nearestOf(points, candidates, place));
    }
    const auto expected = pcl_uvol::makeClusterHull(around.triangles, regions);
    const ClusterSurface hull = cluster.enclose(ClusterSurfaceKind::Hull, 4.5, 49);
    EXPECT_EQ(expected.regions, hull.points);
    EXPECT_EQ(expected.triangles, hull.mesh.triangles);
  }
}

/** A solid whose surface is covered with points that densely that the distance to them
 * is that to the solid. */
struct Solid {
  std::string name;
  Points points;
  double (*distanceTo)(const Vector3d&);
  double volume; ///< of what lies within the distance
  long genus;
};

constexpr double distance_around = 0.25;

/** Spiral of Fibonacci: points 0.03 apart, the surface bulges by less than 0.001
 * between them. */
Solid
denseBall()
{
  Solid ball{"ball", ballOf(4000, 3), nullptr, 0.0, 0};
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count,
                 around = i * pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    ball.points.emplace_back(radius * std::cos(around), radius * std::sin(around), z);
  }
  ball.distanceTo = [](const Vector3d& place) { return place.norm() - 1.0; };
  ball.volume = 4.0 / 3.0 * pi * std::pow(1.0 + distance_around, 3.0);
  return ball;
}

Solid
denseTorus()
{
  Solid torus{"torus", torusOf(4000, 3), nullptr, 0.0, 1};
  for (int i = 0; i < 300; ++i)
    for (int j = 0; j < 90; ++j) {
      const double ring = pi * i / 150.0, tube = pi * j / 45.0;
      const double radius = 1.0 + 0.4 * std::cos(tube);
      torus.points.emplace_back(
          radius * std::cos(ring), radius * std::sin(ring), 0.4 * std::sin(tube));
    }
  torus.distanceTo = [](const Vector3d& place) { return distanceToTorus(place, 0.4); };
  torus.volume = 2.0 * pi * pi * std::pow(0.4 + distance_around, 2.0);
  return torus;
}

TEST(ClusterSurfaces, LieAtTheirDistance)
{
  for (const Solid& solid : {denseBall(), denseTorus()}) {
    const Cluster cluster(solid.points);
    const double voxel = cluster.voxel(distance_around);
    for (const auto kind :
         {ClusterSurfaceKind::Distance, ClusterSurfaceKind::HullDistance}) {
      const ClusterSurface surface = cluster.enclose(kind, distance_around);
      EXPECT_EQ(distance_around, surface.distance);
      EXPECT_TRUE(surface.points.empty());
      EXPECT_EQ(1.0, expectClosed(surface.mesh));
      EXPECT_EQ(std::vector<long>{solid.genus}, generaOf(surface.mesh));
      double low = 1e30, high = -1e30;
      for (std::uint32_t i = 0; i < surface.mesh.vertices.size(); ++i) {
        const double off =
            solid.distanceTo(vertexOf(surface.mesh, i)) - distance_around;
        low = std::min(low, off / voxel);
        high = std::max(high, off / voxel);
      }
      EXPECT_GT(low, -1.0) << solid.name;
      EXPECT_LT(high, 1.0) << solid.name;
      EXPECT_NEAR(solid.volume, signedVolume(surface.mesh), 0.05 * solid.volume);
    }
  }
}

TEST(ClusterSurfaces, ChooseADistanceThatLeavesOnePiece)
{
  Points two_balls = ballOf(1500, 5);
  for (const Vector3d& point : ballOf(1500, 6))
    two_balls.emplace_back(point + Vector3d(2.6, 0.0, 0.0));
  for (const Points& points : {ballOf(4000, 2), bentSheetOf(4000, 2), two_balls})
    for (const auto kind : all_kinds) {
      const Cluster cluster(points);
      Report report;
      const ClusterSurface surface = cluster.enclose(kind, settingsOf(0.0), report);
      EXPECT_GT(surface.distance, cluster.longestEdge());
      EXPECT_LT(surface.distance,
                cluster.longestEdge() + 2.0 * cluster.voxel(surface.distance));
      expectClosed(surface.mesh);
      EXPECT_EQ(std::vector<long>{0}, generaOf(surface.mesh));
      EXPECT_TRUE(report.warnings.empty());
    }
}

TEST(ClusterSurfaces, FallIntoPiecesBelowHalfTheLongestEdge)
{
  Points points = ballOf(1500, 5);
  for (const Vector3d& point : ballOf(1500, 6))
    points.emplace_back(point + Vector3d(2.8, 0.0, 0.0));
  for (const auto kind : all_kinds) {
    Report report;
    const ClusterSurface surface =
        Cluster(points).enclose(kind, settingsOf(0.25), report);
    EXPECT_EQ((std::vector<long>{0, 0}), generaOf(surface.mesh));
    EXPECT_EQ(1u, report.warnings.size());
  }
}

/** A shell has an inner side as well, which looks into its void. */
TEST(ClusterSurfaces, EncloseVoids)
{
  const Cluster cluster(pointsIn(6000, 1, [](const Vector3d& place) {
    return place.norm() < 1.2 && place.norm() > 0.8;
  }));
  for (const auto kind : {ClusterSurfaceKind::Distance, ClusterSurfaceKind::Hull}) {
    const Mesh mesh = cluster.enclose(kind, 0.25).mesh;
    expectClosed(mesh);
    EXPECT_EQ((std::vector<long>{0, 0}), generaOf(mesh));
    EXPECT_NEAR(0.0, windingNumber(mesh, Vector3d(0.01, 0.02, 0.03)), 1e-6);
    EXPECT_NEAR(1.0, windingNumber(mesh, Vector3d(1.0, 0.02, 0.03)), 1e-6);
  }
}

TEST(ClusterSurfaces, TakeTheMembersOnly)
{
  const Points ball = ballOf(1000, 8);
  Points mixed;
  std::vector<std::uint32_t> members;
  for (const Vector3d& point : ball) {
    mixed.emplace_back(100.0, -50.0, point.x());
    members.push_back(static_cast<std::uint32_t>(mixed.size()));
    mixed.push_back(point);
  }
  Cluster cluster(mixed);
  cluster.setMembers(members);
  for (const auto kind : all_kinds) {
    const ClusterSurface expected = Cluster(ball).enclose(kind, 0.3);
    const ClusterSurface surface = cluster.enclose(kind, 0.3);
    EXPECT_EQ(expected.mesh.vertices, surface.mesh.vertices);
    EXPECT_EQ(expected.mesh.triangles, surface.mesh.triangles);
    ASSERT_EQ(expected.points.size(), surface.points.size());
    for (std::size_t i = 0; i < surface.points.size(); ++i)
      EXPECT_EQ(2 * expected.points[i] + 1, surface.points[i]);
  }
}

TEST(ClusterSurfaces, LeaveOutPointsThatAreNotFinite)
{
  const Points ball = ballOf(1000, 8);
  Points spoiled = ball;
  spoiled.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  spoiled.emplace_back(0.0, std::numeric_limits<double>::infinity(), 0.0);
  spoiled.emplace_back(0.0, 0.0, -std::numeric_limits<double>::infinity());
  for (const auto kind : all_kinds) {
    Report report;
    const ClusterSurface surface =
        Cluster(spoiled).enclose(kind, settingsOf(0.0), report);
    const ClusterSurface expected = Cluster(ball).enclose(kind, 0.0);
    EXPECT_EQ(expected.mesh.vertices, surface.mesh.vertices);
    EXPECT_EQ(expected.mesh.triangles, surface.mesh.triangles);
    EXPECT_EQ(expected.points, surface.points);
    EXPECT_EQ(1000u, report.getCount("members"));
    EXPECT_EQ(3u, report.getCount("non_finite"));
    EXPECT_EQ(surface.mesh.vertices.size(), report.getCount("vertices"));
    EXPECT_EQ(surface.mesh.triangles.size(), report.getCount("triangles"));
  }
}

TEST(ClusterSurfaces, DoNotDependOnUnits)
{
  const Points ball = ballOf(1000, 9);
  for (const double factor : {std::ldexp(1.0, -40), std::ldexp(1.0, 40)}) {
    Points scaled;
    for (const Vector3d& point : ball)
      scaled.emplace_back(factor * point);
    for (const auto kind : all_kinds)
      EXPECT_EQ(Cluster(ball).enclose(kind, 0.3).mesh.triangles,
                Cluster(scaled).enclose(kind, 0.3 * factor).mesh.triangles);
  }
}

/** Powers of two, so that nothing is rounded. */
TEST(ClusterSurfaces, MeasureDistancesInTheStretchedSpace)
{
  const Points ball = ballOf(1000, 9);
  const Eigen::Array3d scale(1.0, 2.0, 0.5);
  Points stretched;
  for (const Vector3d& point : ball)
    stretched.emplace_back(scale * point.array());
  ClusterSurfaceSettings settings = settingsOf(0.3);
  settings.scale = {{1.0f, 2.0f, 0.5f}};
  for (const auto kind : all_kinds) {
    Report report;
    const ClusterSurface surface = Cluster(ball).enclose(kind, settings, report);
    const ClusterSurface expected = Cluster(stretched).enclose(kind, 0.3);
    EXPECT_EQ(expected.mesh.triangles, surface.mesh.triangles);
    EXPECT_EQ(expected.points, surface.points);
    ASSERT_EQ(expected.mesh.vertices.size(), surface.mesh.vertices.size());
    for (std::uint32_t i = 0; i < surface.mesh.vertices.size(); ++i)
      ASSERT_EQ(vertexOf(expected.mesh, i),
                Vector3d(scale * vertexOf(surface.mesh, i).array()));
  }
}

TEST(ClusterSurfaces, HaveTheirPointsAsVerticesWhateverTheScale)
{
  const Cluster ball(ballOf(1000, 9));
  ClusterSurfaceSettings settings = settingsOf(0.3);
  settings.scale = {{0.7f, 1.1f, 0.9f}};
  Report report;
  const ClusterSurface hull = ball.enclose(ClusterSurfaceKind::Hull, settings, report);
  for (std::uint32_t i = 0; i < hull.points.size(); ++i)
    ASSERT_EQ(ball[hull.points[i]], vertexOf(hull.mesh, i)) << i;
}

TEST(ClusterSurfaces, RefuseScalesThatAreNone)
{
  const Cluster ball(ballOf(200, 9));
  for (const float factor : {0.0f,
                             -1.0f,
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ClusterSurfaceSettings settings = settingsOf(0.3);
      settings.scale[axis] = factor;
      Report report;
      EXPECT_THROW(ball.enclose(ClusterSurfaceKind::Distance, settings, report),
                   InvalidArgument);
    }
}

/** Vertices are floats: 0.001 at this place. */
TEST(ClusterSurfaces, StandFarFromTheOrigin)
{
  const Vector3d far(10000.0, -8000.0, 9000.0);
  Points points;
  for (const Vector3d& point : denseBall().points)
    points.emplace_back(point + far);
  const Cluster cluster(points);
  const double voxel = cluster.voxel(distance_around);
  for (const auto kind : all_kinds) {
    const ClusterSurface surface = cluster.enclose(kind, distance_around);
    expectClosed(surface.mesh);
    EXPECT_EQ(std::vector<long>{0}, generaOf(surface.mesh));
    EXPECT_GT(signedVolume(surface.mesh), 3.8);
    for (std::uint32_t i = 0;
         i < surface.mesh.vertices.size() && kind != ClusterSurfaceKind::Hull;
         ++i)
      ASSERT_NEAR(1.0 + distance_around,
                  (vertexOf(surface.mesh, i) - far).norm(),
                  voxel + 0.002);
  }
}

TEST(ClusterSurfaces, OfOneOrTwoPlacesAreSpheresWithoutHull)
{
  const Points one = {Vector3d(3.0, 4.0, 5.0)};
  const Points equal(20, one[0]);
  const Points two = {one[0], Vector3d(3.1, 4.0, 5.0)};
  for (const Points& points : {one, equal, two}) {
    const Cluster cluster(points);
    const Mesh mesh = cluster.enclose(ClusterSurfaceKind::Distance, 0.5).mesh;
    expectClosed(mesh);
    EXPECT_EQ(std::vector<long>{0}, generaOf(mesh));
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
      const double distance = std::min((vertexOf(mesh, i) - points.front()).norm(),
                                       (vertexOf(mesh, i) - points.back()).norm());
      ASSERT_NEAR(0.5, distance, cluster.voxel(0.5));
    }
    EXPECT_THROW(cluster.enclose(ClusterSurfaceKind::Hull, 0.5), InvalidArgument);
    EXPECT_THROW(cluster.enclose(ClusterSurfaceKind::HullDistance, 0.5),
                 InvalidArgument);
  }
  // Two places give a distance, one does not.
  EXPECT_GT(Cluster(two).enclose(ClusterSurfaceKind::Distance, 0.0).distance, 0.1);
  EXPECT_THROW(Cluster(one).enclose(ClusterSurfaceKind::Distance, 0.0),
               InvalidArgument);
  EXPECT_THROW(Cluster(equal).enclose(ClusterSurfaceKind::Distance, 0.0),
               InvalidArgument);
}

/** Four points: a tetrahedron; three: a triangle of two sides; points on a line have
 * neighbours to two sides only. */
TEST(ClusterSurfaces, OfFewPointsHaveHullsOfFewTriangles)
{
  const Points corners = {
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const ClusterSurface tetrahedron =
      Cluster(corners).enclose(ClusterSurfaceKind::Hull, 1.5);
  EXPECT_EQ(4u, tetrahedron.mesh.vertices.size());
  EXPECT_EQ(4u, tetrahedron.mesh.triangles.size());
  EXPECT_NEAR(1.0 / 6.0, signedVolume(tetrahedron.mesh), 1e-6);
  const ClusterSurface triangle = Cluster({corners[0], corners[1], corners[2]})
                                      .enclose(ClusterSurfaceKind::Hull, 1.5);
  EXPECT_EQ(3u, triangle.mesh.vertices.size());
  EXPECT_EQ(2u, triangle.mesh.triangles.size());
  expectClosed(triangle.mesh);
}

/** Regions in the middle of a thread reach around it and are cut. */
TEST(ClusterSurfaces, OfAThreadAreClosed)
{
  Points thread;
  for (int i = 0; i < 12; ++i)
    thread.emplace_back(0.1 * i, 0.03 * std::sin(i), 0.0);
  for (const auto kind : all_kinds) {
    const ClusterSurface surface = Cluster(thread).enclose(kind, 0.2);
    expectClosed(surface.mesh);
    EXPECT_EQ(std::vector<long>{0}, generaOf(surface.mesh));
  }
}

/** Far more points than cells: the distance must still do. */
TEST(ClusterSurfaces, ChooseADistanceForDensePoints)
{
  Points line;
  for (int i = 0; i < 5000; ++i)
    line.emplace_back(i / 5000.0, 0.0, 0.0);
  const ClusterSurface surface =
      Cluster(line).enclose(ClusterSurfaceKind::Distance, 0.0);
  expectClosed(surface.mesh);
  EXPECT_EQ(std::vector<long>{0}, generaOf(surface.mesh));
}

TEST(ClusterSurfaces, RefuseWhatTheyCannotEnclose)
{
  const Cluster ball(ballOf(500, 4));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const auto kind : all_kinds) {
    for (const double distance :
         {-1.0, -1e-300, not_a_number, infinity, -infinity, 1e-3})
      EXPECT_THROW(ball.enclose(kind, distance), InvalidArgument) << distance;
    for (const std::uint32_t along : {0u, 16000u, 16385u, 4294967295u})
      EXPECT_THROW(ball.enclose(kind, 0.3, along), InvalidArgument) << along;
    Cluster empty = ball;
    empty.setMembers({});
    EXPECT_THROW(empty.enclose(kind, 0.3), InvalidArgument);
    const Cluster bad({Vector3d::Constant(not_a_number), Vector3d::Constant(infinity)});
    EXPECT_THROW(bad.enclose(kind, 0.3), InvalidArgument);
  }
}

TEST(ClusterSurfaces, SayHowFineTheGridMustBe)
{
  try {
    Cluster(ballOf(500, 4)).enclose(ClusterSurfaceKind::Distance, 0.01);
    ADD_FAILURE();
  }
  catch (const InvalidArgument& error) {
    EXPECT_NE(std::string::npos, error.message().find("too small for cells of 0.02"))
        << error.message();
  }
}

TEST(ClusterSurfaces, DoNotDependOnThreads)
{
  const Cluster cluster(torusOf(3000, 7));
  for (const auto kind : all_kinds) {
    const ClusterSurface first = cluster.enclose(kind, 0.0, cells, 1);
    for (const unsigned threads : {2u, 7u}) {
      const ClusterSurface other = cluster.enclose(kind, 0.0, cells, threads);
      EXPECT_EQ(first.mesh.vertices, other.mesh.vertices);
      EXPECT_EQ(first.mesh.triangles, other.mesh.triangles);
      EXPECT_EQ(first.points, other.points);
      EXPECT_EQ(first.distance, other.distance);
    }
  }
}

} // namespace
