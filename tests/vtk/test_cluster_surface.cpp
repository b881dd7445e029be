// SPDX-License-Identifier: BSD-3-Clause
// Surfaces around clusters: what they enclose, and how far away they are.
#include "support/interruption.h"
#include "support/messages.h"
#include "vtk/cluster_shapes.h"

#include <pcl/point_types.h>

namespace test_cluster_surface {

using namespace uvol_test;

constexpr auto all_kinds = {ClusterSurfaceKind::Distance,
                            ClusterSurfaceKind::Hull,
                            ClusterSurfaceKind::HullDistance};

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
    EXPECT_EQ(std::vector<std::string>{"short_distance"}, listCodes(report.warnings));
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
  ClusterSurfaceParameters settings = settingsOf(0.3);
  settings.scale = {1.0f, 2.0f, 0.5f};
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
  ClusterSurfaceParameters settings = settingsOf(0.3);
  settings.scale = {0.7f, 1.1f, 0.9f};
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
      ClusterSurfaceParameters settings = settingsOf(0.3);
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

/** One outlier makes the grid so coarse that most points share a cell with others. */
TEST(ClusterSurfaces, ReportThatMembersShareCells)
{
  Points points = ballOf(2000, 4);
  Report report;
  Cluster(points).enclose(ClusterSurfaceKind::Hull, settingsOf(0.0), report);
  Cluster(points).enclose(ClusterSurfaceKind::Distance, settingsOf(0.0), report);
  EXPECT_TRUE(report.warnings.empty());
  points.emplace_back(60.0, 0.0, 0.0);
  for (const auto kind : {ClusterSurfaceKind::Hull, ClusterSurfaceKind::Distance}) {
    Report own;
    Cluster(points).enclose(kind, settingsOf(0.0), own);
    ASSERT_EQ(1u, own.warnings.size());
    const pcl_uvol::Message& warning = own.warnings[0];
    EXPECT_EQ("shared_cells", warning.code);
    EXPECT_EQ(2001.0, numberOf(warning, "points"));
    EXPECT_EQ(kind == ClusterSurfaceKind::Distance ? 1.0 : 0.0,
              numberOf(warning, "is_distance"));
    EXPECT_EQ(1.0, numberOf(warning, "has_outlier"));
    EXPECT_EQ(2000.0, numberOf(warning, "point"));
  }
}

TEST(ClusterSurfaces, NameThePointThatLeavesNoHull)
{
  Points points = ballOf(2000, 4);
  points.emplace(points.begin() + 7, 1000.0, 0.0, 0.0);
  const auto error = uvol_test::thrownBy<InvalidArgument>(
      [&] { Cluster(points).enclose(ClusterSurfaceKind::Hull, 0.0); });
  EXPECT_EQ("no_hull", error.code);
  EXPECT_EQ(7.0, numberOf(error, "point"));
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

TEST(ClusterSurfaces, RefuseWhatIsLargerThanFloat)
{
  // The largest corners of boxes are where floats end, or their diagonals are.
  for (const double side : {2.5e38, 3e38})
    for (const auto kind : all_kinds) {
      std::vector<Vector3d> places = ballOf(500, 4);
      for (Vector3d& place : places)
        place *= side / 2.0;
      const Cluster ball(places);
      EXPECT_THROW(ball.enclose(kind, 0.0, 20), InvalidArgument) << side;
    }
  std::vector<Vector3d> small = ballOf(500, 4);
  for (Vector3d& place : small)
    place *= 1e37;
  EXPECT_NO_THROW(Cluster(small).enclose(ClusterSurfaceKind::Hull, 0.0, 20));
}

TEST(ClusterSurfaces, SayHowFineTheGridMustBe)
{
  const auto error = uvol_test::thrownBy<InvalidArgument>(
      [] { Cluster(ballOf(500, 4)).enclose(ClusterSurfaceKind::Distance, 0.01); });
  EXPECT_EQ("small_cluster_distance", error.code);
  EXPECT_EQ(0.01, numberOf(error, "distance"));
  EXPECT_NEAR(0.02, numberOf(error, "cell"), 0.01);
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

TEST(ClusterSurfaceGeneration, IsAStageWithParameters)
{
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (std::uint64_t i = 0; i < 500; ++i)
    cloud->push_back({static_cast<float>(uniformAt(1, i, 0)),
                      static_cast<float>(uniformAt(1, i, 1)),
                      static_cast<float>(uniformAt(1, i, 2))});
  pcl_uvol::ClusterSurfaceGeneration<pcl::PointXYZ> generation;
  ClusterSurface surface;
  EXPECT_THROW(generation.compute(surface), InvalidArgument);
  generation.setInputCloud(cloud);
  generation.setKind(ClusterSurfaceKind::Hull);
  generation.setDistance(0.3);
  generation.compute(surface);
  EXPECT_EQ(surface.points.size(), surface.mesh.vertices.size());
  EXPECT_EQ(surface.distance, 0.3);
  EXPECT_EQ(generation.getReport().getCount("members"), 500u);
  const auto& parameters = generation.getParameters();
  EXPECT_TRUE(parameters == ClusterSurfaceParameters::fromJson(parameters.toJson()));
  EXPECT_EQ(ClusterSurfaceParameters::fromJson(R"({"kind": "hull"})").kind,
            ClusterSurfaceKind::Hull);
}

/** What a progress callback throws ends it, and leaves it fit for the next run. */
TEST(ClusterSurfaces, AreInterruptedAtEveryStep)
{
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Vector3d& point : torusOf(2000, 3)) {
    const Eigen::Vector3f place = point.cast<float>();
    cloud->push_back({place[0], place[1], place[2]});
  }
  pcl_uvol::ClusterSurfaceGeneration<pcl::PointXYZ> generation;
  generation.setInputCloud(cloud);
  for (const auto kind : all_kinds) {
    ClusterSurfaceParameters parameters;
    parameters.kind = kind;
    parameters.cells = 32;
    generation.setParameters(parameters);
    interruptEveryStep(
        [&](const pcl_uvol::ProgressCallback& progress) {
          generation.setProgressCallback(progress);
          ClusterSurface surface;
          generation.compute(surface);
          return std::pair(surface.mesh.vertices, surface.mesh.triangles);
        },
        2);
  }
}

} // namespace test_cluster_surface
