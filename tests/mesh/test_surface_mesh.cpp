// SPDX-License-Identifier: BSD-3-Clause
// Meshes of isosurfaces: shape, place, angles; the same for any order, unit and number
// of threads; manifold whatever the input.
#include "mesh_fields.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace test_surface_mesh {

using namespace pcl_uvol;
using namespace uvol_test;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;

void
expectShape(const MeshField& field, unsigned seed)
{
  const MeshRun run = runMesh(sampleField(field, seed));
  EXPECT_EQ(field.pieces, run.mesh.pieces.size()) << field.name << seed;
  EXPECT_EQ(field.handles, run.report.getCount("handles")) << field.name << seed;
  EXPECT_EQ(0u, run.report.getCount("folds")) << field.name << seed;
  EXPECT_EQ(0u, expectManifold(run.mesh.triangles, run.mesh.vertices.size()));
  EXPECT_GE(run.mesh.smallest_angle, 1.0) << field.name << seed;
  if (field.volume > 0.0) {
    EXPECT_GE(run.mesh.smallest_angle, 20.0) << field.name << seed;
    EXPECT_NEAR(1.0, volumeOf(run.mesh) / field.volume, 5e-3) << field.name << seed;
    // The fields have kinks 8 spacings away, which the fits see a little of.
    for (const PointIso& vertex : run.mesh.vertices)
      ASSERT_NEAR(0.0, field.value(vertex.getVector3fMap().cast<double>()), 0.1);
  }
}

void
expectShapes(unsigned first, unsigned last)
{
  for (unsigned seed = first; seed < last; ++seed)
    for (const MeshField& field : {sphereField(9.0),
                                   torusField(12.0, 8.0),
                                   twoSpheresField(3.0),
                                   shellField(3.0)})
      expectShape(field, seed);
}

TEST(SurfaceMesh, HasTheShapeOfTheField)
{
  expectShapes(1, 4);
}

TEST(SurfaceMesh, HasTheShapeOfAGyroidThatCapsClose)
{
  // The cells of seed 71 have a crumb beside a cap.
  for (const unsigned seed : {1u, 2u, 71u})
    expectShape(gyroidField(), seed);
}

TEST(SurfaceMesh, HasTheShapeOfAGyroidThatCapsCloseForManySeeds_long)
{
  for (unsigned seed = 3; seed < 101; ++seed)
    expectShape(gyroidField(), seed);
}

TEST(SurfaceMesh, HasTheShapeOfTheFieldForManySeeds_long)
{
  expectShapes(4, 101);
}

TEST(SurfaceMesh, EnclosesTheVolumeOfALargeSphere)
{
  const MeshField field = sphereField(22.0);
  const MeshRun run = runMesh(sampleField(field, 1));
  EXPECT_NEAR(1.0, volumeOf(run.mesh) / field.volume, 1e-3);
  EXPECT_NEAR(1.0, areaOf(run.mesh) / (4.0 * M_PI * 22.0 * 22.0), 1e-3);
  EXPECT_GE(run.mesh.smallest_angle, 20.0);
  for (const PointIso& vertex : run.mesh.vertices) {
    const Eigen::Vector3d away = vertex.getVector3fMap().cast<double>() -
                                 Eigen::Vector3d::Constant(0.5 * field.side);
    ASSERT_NEAR(
        1.0, vertex.getNormalVector3fMap().cast<double>().dot(away.normalized()), 1e-4);
    ASSERT_NEAR(1.0 / 22.0, vertex.mean_curvature, 0.02);
    ASSERT_LT(vertex.error, 0.1f);
    ASSERT_NEAR(22.0, away.norm(), std::max(1e-3, 2.0 * vertex.error));
  }
}

TEST(SurfaceMesh, LatticesAndGradedSamplesAreNoWorse)
{
  Cloud::Ptr lattice(new Cloud), graded(new Cloud);
  const MeshField sphere = sphereField(11.0);
  for (int x = 0; x < 28; ++x)
    for (int y = 0; y < 28; ++y)
      for (int z = 0; z < 28; ++z) {
        pcl::PointXYZI point;
        point.x = static_cast<float>(x);
        point.y = static_cast<float>(y);
        point.z = static_cast<float>(z);
        point.intensity =
            static_cast<float>(sphere.value(point.getVector3fMap().cast<double>()));
        lattice->push_back(point);
      }
  // Density over a factor of 1000 along x.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int i = 0; i < 100000; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>((std::pow(1000.0, any(random)) - 1.0) / 999.0);
    point.y = static_cast<float>(any(random));
    point.z = static_cast<float>(any(random));
    point.intensity =
        0.35f - (point.getVector3fMap() - Eigen::Vector3f::Constant(0.5f)).norm();
    graded->push_back(point);
  }
  for (const Cloud::Ptr& cloud : {lattice, graded}) {
    const MeshRun run = runMesh(cloud);
    EXPECT_EQ(1u, run.mesh.pieces.size());
    EXPECT_EQ(0u, run.report.getCount("handles"));
    EXPECT_EQ(0u, run.report.getCount("folds"));
    EXPECT_EQ(0u, run.report.getCount("cap_vertices"));
    EXPECT_GE(run.mesh.smallest_angle, 20.0);
  }
}

TEST(SurfaceMesh, StaysWholeInNoise)
{
  // Noise is 2 % of the values' range: a Delaunay mesh has about 160 pieces and 540
  // handles.
  const MeshRun run = runMesh(sampleField(sphereField(22.0), 1, 0.84));
  EXPECT_LE(run.mesh.pieces.size(), 30u);
  EXPECT_LE(run.report.getCount("handles"), 40u);
  MeshingParameters meshing;
  meshing.drop_pieces = 100;
  const MeshRun dropped = runMesh(sampleField(sphereField(22.0), 1, 0.84), meshing);
  EXPECT_EQ(1u, dropped.mesh.pieces.size());
  EXPECT_EQ(run.mesh.pieces.size() - 1, dropped.report.getCount("dropped_pieces"));
}

TEST(SurfaceMesh, IsTheSameForAnyOrderAndThreads)
{
  const auto cloud = sampleField(torusField(8.0, 5.0), 3);
  std::vector<std::size_t> order(cloud->size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  Cloud::Ptr shuffled(new Cloud);
  for (const std::size_t i : order)
    shuffled->push_back((*cloud)[i]);
  const MeshRun one = runMesh(cloud, {}, {0.0, 1.0}, Outside::Lower, 1),
                many = runMesh(shuffled, {}, {0.0, 1.0}, Outside::Lower, 7);
  ASSERT_EQ(one.mesh.triangles, many.mesh.triangles);
  ASSERT_EQ(one.mesh.vertices.size(), many.mesh.vertices.size());
  for (std::size_t i = 0; i < one.mesh.vertices.size(); ++i) {
    const PointIso &a = one.mesh.vertices[i], &b = many.mesh.vertices[i];
    ASSERT_EQ(a.getVector3fMap(), b.getVector3fMap());
    ASSERT_EQ(a.getNormalVector3fMap(), b.getNormalVector3fMap());
    ASSERT_EQ(a.isovalue, b.isovalue);
    ASSERT_EQ(one.mesh.edges[i].first, order[many.mesh.edges[i].first]);
    ASSERT_EQ(one.mesh.edges[i].second, order[many.mesh.edges[i].second]);
    ASSERT_EQ(one.mesh.edges[i].t, many.mesh.edges[i].t);
  }
  ASSERT_EQ(2u, one.mesh.pieces.size());
  EXPECT_EQ(0.0, one.mesh.pieces[0].isovalue);
  EXPECT_EQ(1.0, one.mesh.pieces[1].isovalue);
}

TEST(SurfaceMesh, UnitsChangeNothing)
{
  const auto cloud = sampleField(sphereField(6.0), 5);
  const MeshRun run = runMesh(cloud);
  for (const float factor : {0x1p-30f, 0x1p25f}) {
    Cloud::Ptr scaled(new Cloud(*cloud));
    for (pcl::PointXYZI& point : *scaled)
      point.getVector3fMap() *= factor;
    const MeshRun other = runMesh(scaled);
    ASSERT_EQ(run.mesh.triangles, other.mesh.triangles);
    for (std::size_t i = 0; i < run.mesh.vertices.size(); ++i)
      ASSERT_EQ(factor * run.mesh.vertices[i].getVector3fMap(),
                other.mesh.vertices[i].getVector3fMap());
  }
}

TEST(SurfaceMesh, OutsideTurnsTrianglesAndNormals)
{
  const auto cloud = sampleField(sphereField(6.0), 5);
  for (pcl::PointXYZI& point : *cloud)
    point.intensity = -point.intensity;
  const MeshRun run = runMesh(cloud, {}, {0.0}, Outside::Higher);
  EXPECT_NEAR(1.0, volumeOf(run.mesh) / (4.0 / 3.0 * M_PI * 216.0), 0.02);
  EXPECT_EQ(0u, run.report.getCount("cap_vertices"));
  for (const PointIso& vertex : run.mesh.vertices)
    EXPECT_GT(vertex.mean_curvature, 0.0f);
}

/** A slab between two sides of the cube. */
Cloud::Ptr
makeSlab()
{
  const MeshField slab{
      "slab", [](const Eigen::Vector3d& x) { return 10.0 - x[2]; }, 20.0, 1, 0};
  return sampleField(slab, 2);
}

TEST(SurfaceMesh, CapsCloseWhatReachesTheBorder)
{
  const MeshRun run = runMesh(makeSlab());
  EXPECT_EQ(0u, expectManifold(run.mesh.triangles, run.mesh.vertices.size()));
  ASSERT_EQ(1u, run.mesh.pieces.size());
  EXPECT_EQ(0u, run.mesh.pieces[0].genus);
  EXPECT_EQ(0u, run.mesh.pieces[0].rims);
  EXPECT_NEAR(1.0, volumeOf(run.mesh) / 4000.0, 0.03);
  EXPECT_GT(run.report.getCount("cap_vertices"), 100u);
  // More caps than surface.
  ASSERT_EQ(1u, run.report.warnings.size());
  EXPECT_EQ("large_caps", run.report.warnings[0].code);
  EXPECT_EQ(1.0, uvol_test::numberOf(run.report.warnings[0], "is_lower_outside"));
  // On the other side of the values the caps are others.
  const MeshRun other = runMesh(makeSlab(), {}, {0.0}, Outside::Higher);
  EXPECT_NEAR(1.0, volumeOf(other.mesh) / 4000.0, 0.03);
}

TEST(SurfaceMesh, OpenSurfacesEndAtTheBorder)
{
  MeshingParameters meshing;
  meshing.open = true;
  for (const Remeshing remesh : {Remeshing::Even, Remeshing::None}) {
    meshing.remesh = remesh;
    const MeshRun run = runMesh(makeSlab(), meshing);
    const std::size_t rim =
        expectManifold(run.mesh.triangles, run.mesh.vertices.size());
    EXPECT_GT(rim, 40u);
    EXPECT_EQ(rim, run.report.getCount("rim_edges"));
    ASSERT_EQ(1u, run.mesh.pieces.size());
    EXPECT_EQ(0u, run.mesh.pieces[0].genus);
    EXPECT_EQ(1u, run.mesh.pieces[0].rims);
    EXPECT_EQ(0u, run.report.getCount("cap_vertices"));
    EXPECT_NEAR(1.0, areaOf(run.mesh) / 400.0, 0.15);
  }
}

TEST(SurfaceMesh, EdgesGetTheLengthThatIsAskedFor)
{
  const auto cloud = sampleField(sphereField(14.0), 1);
  for (const double length : {1.5, 2.5}) {
    MeshingParameters meshing;
    meshing.edge_length = length;
    const MeshRun run = runMesh(cloud, meshing);
    double sum = 0.0;
    for (const Triangle& triangle : run.mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        sum +=
            (placeOf(run.mesh, triangle[i]) - placeOf(run.mesh, triangle[(i + 1) % 3]))
                .norm();
    const double mean = sum / (3.0 * static_cast<double>(run.mesh.triangles.size()));
    EXPECT_NEAR(1.0, mean / length, 0.1);
    EXPECT_GE(run.mesh.smallest_angle, 20.0);
  }
}

TEST(SurfaceMesh, AnyInputGivesAManifold)
{
  std::size_t triangles = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const int values = std::uniform_int_distribution<int>(1, 12)(random);
    const std::size_t count =
        std::uniform_int_distribution<std::size_t>(1, 700)(random);
    std::uniform_int_distribution<int> any(0, values);
    std::normal_distribution<float> noise;
    Cloud::Ptr cloud(new Cloud);
    for (std::size_t i = 0; i < count; ++i) {
      pcl::PointXYZI point;
      for (int axis = 0; axis < 3; ++axis)
        point.data[axis] = static_cast<float>(any(random));
      point.x += seed % 3 == 0 ? noise(random) : 0.0f;
      point.z = seed % 5 == 0 ? 1.0f : point.z;
      point.intensity = seed % 2 == 0 ? static_cast<float>(any(random)) - 1.0f
                                      : point.x - 0.5f + 0.3f * noise(random);
      cloud->push_back(point);
    }
    MeshingParameters meshing;
    meshing.open = seed % 4 == 1;
    meshing.remesh = seed % 7 == 1 ? Remeshing::None : Remeshing::Even;
    const MeshRun run = runMesh(
        cloud, meshing, {0.25}, seed % 3 == 1 ? Outside::Higher : Outside::Lower);
    const std::size_t rim =
        expectManifold(run.mesh.triangles, run.mesh.vertices.size());
    EXPECT_TRUE(meshing.open || rim == 0) << seed;
    for (const PointIso& vertex : run.mesh.vertices) {
      ASSERT_TRUE(vertex.getVector3fMap().allFinite()) << seed;
      ASSERT_TRUE(vertex.getNormalVector3fMap().allFinite()) << seed;
    }
    ASSERT_FALSE(::testing::Test::HasFailure()) << seed;
    triangles += run.mesh.triangles.size();
  }
  EXPECT_GT(triangles, 50000u);
}

TEST(SurfaceMesh, GivesPolygonMeshesWithTheFieldsOfTheSamples)
{
  const auto cloud = sampleField(sphereField(6.0), 5);
  SurfaceMesh<pcl::PointXYZI> mesher;
  mesher.setInputCloud(cloud);
  SurfaceMeshParameters parameters;
  parameters.isosurface.isovalues = {0.0};
  mesher.setParameters(parameters);
  pcl::PolygonMesh mesh;
  mesher.extract(mesh);
  EXPECT_EQ(mesher.getReport().getCount("triangles"), mesh.polygons.size());
  pcl::PointCloud<pcl::PointXYZI> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  EXPECT_EQ(mesher.getReport().getCount("vertices"), vertices.size());
  // The scalar is the isovalue where samples lie on its two sides.
  const auto near = std::count_if(vertices.begin(), vertices.end(), [](const auto& v) {
    return std::abs(v.intensity) < 1e-6f;
  });
  EXPECT_GT(static_cast<std::size_t>(near), vertices.size() / 2);
}

TEST(SurfaceMesh, ParametersSurviveJson)
{
  SurfaceMeshParameters parameters;
  parameters.isosurface.isovalues = {0.5};
  parameters.meshing.remesh = Remeshing::None;
  parameters.meshing.edge_length = 0.25;
  parameters.meshing.open = true;
  parameters.meshing.drop_pieces = 7;
  const auto read = SurfaceMeshParameters::fromJson(parameters.toJson());
  EXPECT_EQ(parameters, read);
  EXPECT_NE(SurfaceMeshParameters(), read);
}

TEST(SurfaceMesh, RefusesWhatItCannotDo)
{
  const auto cloud = sampleField(sphereField(6.0), 5);
  const auto refuses = [&](const auto& change) {
    SurfaceMesh<pcl::PointXYZI> mesher;
    mesher.setInputCloud(cloud);
    SurfaceMeshParameters parameters;
    parameters.isosurface.isovalues = {0.0};
    change(parameters);
    mesher.setParameters(parameters);
    SurfaceTriangles mesh;
    EXPECT_THROW(mesher.extract(mesh), InvalidArgument);
  };
  refuses([](auto& p) { p.isosurface.isovalues.clear(); });
  refuses([](auto& p) { p.isosurface.interpolation = Interpolation::Linear; });
  refuses([](auto& p) { p.isosurface.neighbors = NeighborSource::Voronoi; });
  refuses([](auto& p) { p.meshing.edge_length = -1.0; });
  refuses([](auto& p) { p.meshing.edge_length = std::nan(""); });
  refuses([](auto& p) { p.isosurface.field = "nothing"; });
  SurfaceMesh<pcl::PointXYZI> without_input;
  SurfaceTriangles mesh;
  EXPECT_THROW(without_input.extract(mesh), InvalidArgument);
  // No surface, but a warning.
  const MeshRun none = runMesh(cloud, {}, {100.0});
  EXPECT_TRUE(none.mesh.vertices.empty());
  ASSERT_EQ(1u, none.report.warnings.size());
  EXPECT_EQ("no_isopoints", none.report.warnings[0].code);
}

} // namespace test_surface_mesh
