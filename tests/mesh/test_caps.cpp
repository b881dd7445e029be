// SPDX-License-Identifier: BSD-3-Clause
// Where surfaces meet the border of the samples: caps have sharp edges and corners,
// open surfaces reach the border, and area and volume are those within the samples'
// box.
#include "measured_shapes.h"
#include "mesh/creases.h"
#include "mesh/surface_pieces.h"
#include "mesh_fields.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <limits>

namespace test_caps {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using namespace uvol_test;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Box = Eigen::AlignedBox3d;

Box
findBox(const Cloud& cloud)
{
  Box box;
  for (const auto& point : cloud)
    box.extend(point.getVector3fMap().cast<double>());
  return box;
}

PieceMeasures
measureRun(const MeshRun& run, bool curved = true)
{
  auto vertices = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(run.mesh.vertices, vertices->cloud);
  setField(
      *vertices,
      "cap",
      std::vector<std::int32_t>(run.mesh.is_on_cap.begin(), run.mesh.is_on_cap.end()));
  SurfaceMeasures measures;
  measures.setInputSurface(vertices, run.mesh.triangles);
  pcl_uvol::SurfaceMeasuresParameters parameters;
  parameters.curved = curved;
  measures.setParameters(parameters);
  return measures.compute().isovalues.at(0);
}

/** The volume where a field is positive, by columns along z whose crossings are found
 * by linear interpolation. */
double
integrateVolume(const MeshField& field, const Box& box)
{
  constexpr int columns = 300, steps = 300;
  const Eigen::Vector3d cell =
      box.sizes().cwiseQuotient(Eigen::Vector3d(columns, columns, steps));
  double length = 0.0;
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < columns; ++y) {
      const auto valueAt = [&](int z) {
        return field.value(box.min() +
                           cell.cwiseProduct(Eigen::Vector3d(x + 0.5, y + 0.5, z)));
      };
      double low = valueAt(0);
      for (int z = 1; z <= steps; ++z) {
        const double high = valueAt(z);
        const double part = low == high ? 0.5 : low / (low - high);
        if (low >= 0.0)
          length += high >= 0.0 ? 1.0 : part;
        else if (high >= 0.0)
          length += 1.0 - part;
        low = high;
      }
    }
  return length * cell.prod();
}

/** \param part of the truth that it may be off by, besides the error that it tells */
void
expectMeasure(const Measure& measure, double truth, double part)
{
  EXPECT_NEAR(1.0, measure.value / truth, part);
  EXPECT_LE(std::abs(measure.value - truth), measure.error + 1e-6 * truth);
}

MeshField
slabField()
{
  return {"slab", [](const Eigen::Vector3d& x) { return 10.0 - x[2]; }, 20.0, 1, 0};
}

/** About the corner of the cube from the origin. */
MeshField
octantField()
{
  return {
      "octant", [](const Eigen::Vector3d& x) { return 14.0 - x.norm(); }, 20.0, 1, 0};
}

TEST(Caps, CloseASlabToABox)
{
  const auto cloud = sampleField(slabField(), 2);
  const Box box = findBox(*cloud);
  for (const Remeshing remeshing : {Remeshing::Even, Remeshing::None}) {
    MeshingParameters meshing;
    meshing.remesh = remeshing;
    const MeshRun run = runMesh(cloud, meshing);
    const Eigen::Vector3d sides(box.sizes()[0], box.sizes()[1], 10.0 - box.min()[2]);
    EXPECT_NEAR(1.0, volumeOf(run.mesh) / sides.prod(), 1e-5);
    if (remeshing == Remeshing::None)
      continue;
    const double area =
        2.0 * (sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]);
    EXPECT_NEAR(1.0, areaOf(run.mesh) / area, 1e-5);
    for (const bool curved : {true, false}) {
      expectMeasure(measureRun(run, curved).volume, sides.prod(), 1e-5);
      expectMeasure(measureRun(run, curved).area, area, 1e-5);
    }
    EXPECT_NEAR(1.0, run.mesh.cap_part / (1.0 - sides[0] * sides[1] / area), 1e-5);
    EXPECT_EQ(0u, run.report.getCount("folds"));
    EXPECT_GE(run.mesh.smallest_angle, 10.0);
    // Its corners are those of the box.
    Box reached;
    for (const PointIso& vertex : run.mesh.vertices)
      reached.extend(vertex.getVector3fMap().cast<double>());
    EXPECT_EQ(box.min(), reached.min());
    EXPECT_NEAR(10.0, reached.max()[2], 1e-5);
  }
}

TEST(Caps, OpenSurfacesReachTheBorder)
{
  const auto cloud = sampleField(slabField(), 2);
  const Box box = findBox(*cloud);
  MeshingParameters meshing;
  meshing.open = true;
  for (const Remeshing remeshing : {Remeshing::Even, Remeshing::None}) {
    meshing.remesh = remeshing;
    const MeshRun run = runMesh(cloud, meshing);
    // As the cells make them, some triangles are folded over others.
    EXPECT_NEAR(1.0,
                areaOf(run.mesh) / (box.sizes()[0] * box.sizes()[1]),
                remeshing == Remeshing::None ? 1e-3 : 1e-5);
    EXPECT_TRUE(std::none_of(run.mesh.is_on_cap.begin(),
                             run.mesh.is_on_cap.end(),
                             [](std::uint8_t cap) { return cap != 0; }));
  }
}

TEST(Caps, MeetASphereInItsCorner)
{
  const auto cloud = sampleField(octantField(), 3);
  const MeshRun run = runMesh(cloud);
  ASSERT_EQ(1u, run.mesh.pieces.size());
  EXPECT_EQ(0u, run.mesh.pieces[0].genus);
  const Box box = findBox(*cloud);
  const double volume = integrateVolume(octantField(), box);
  EXPECT_NEAR(1.0, volume / (M_PI / 6.0 * std::pow(14.0, 3)), 0.01);
  // The box begins a little beside the corner.
  constexpr double radius = 14.0;
  const double beside = box.min().sum();
  const double open_area = 0.5 * M_PI * radius * (radius - beside),
               cap_area = 0.75 * M_PI * radius * radius - 2.0 * radius * beside;
  const PieceMeasures octant = measureRun(run);
  expectMeasure(octant.volume, volume, 2e-4);
  expectMeasure(octant.area, open_area + cap_area, 2e-4);
  EXPECT_LT(octant.volume.error, 0.01 * volume);
  EXPECT_LT(octant.area.error, 0.01 * octant.area.value);

  MeshingParameters meshing;
  meshing.open = true;
  const PieceMeasures open = measureRun(runMesh(cloud, meshing));
  EXPECT_EQ(1u, open.rims);
  expectMeasure(open.area, open_area, 2e-4);
}

TEST(Caps, CloseAGyroid)
{
  const MeshField field = gyroidField();
  const auto cloud = sampleField(field, 1);
  const PieceMeasures gyroid = measureRun(runMesh(cloud));
  expectMeasure(gyroid.volume, integrateVolume(field, findBox(*cloud)), 2e-4);
}

/** The triangle between three vertices, and its mirror image, so that they are closed.
 */
WorkingMesh
makeLens(const std::array<BoxSides, 3>& sides)
{
  WorkingMesh mesh;
  mesh.sides = {-99.0, 99.0, -99.0, 99.0, -99.0, 99.0};
  const Eigen::Vector3d places[] = {{9.0, 2.0, 2.0}, {2.0, 9.0, 2.0}, {2.0, 2.0, 9.0}};
  for (std::size_t i = 0; i < 3; ++i) {
    WorkingVertex vertex;
    vertex.foot = {places[i], Eigen::Vector3d::Unit(static_cast<int>(i)), 0.0};
    vertex.size = 20.0;
    vertex.pair = {static_cast<std::uint32_t>(i), 9};
    vertex.sides = sides[i];
    vertex.is_on_surface = sides[i] == 0;
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  return mesh;
}

TEST(SplitCreases, PutsVerticesOnEdgesAndCornersOfTheBox)
{
  // The upper sides of x, y and z.
  WorkingMesh mesh = makeLens({2, 8, 32});
  splitCreases(mesh);
  ASSERT_EQ(8u, mesh.vertices.size()); // three edges and a corner on either side
  ASSERT_EQ(12u, mesh.triangles.size());
  EXPECT_EQ(0u, expectManifold(mesh.triangles, mesh.vertices.size()));
  EXPECT_EQ(Eigen::Vector3d(9.0, 9.0, 2.0), mesh.vertices[3].foot.place);
  EXPECT_EQ(2 + 8, mesh.vertices[3].sides);
  EXPECT_EQ(Eigen::Vector3d(9.0, 9.0, 9.0), mesh.vertices[6].foot.place);
  EXPECT_EQ(2 + 8 + 32, mesh.vertices[6].sides);
  for (const WorkingVertex& vertex : mesh.vertices)
    EXPECT_FALSE(vertex.is_on_surface);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t vertex : mesh.triangles[i])
      EXPECT_NE(0, mesh.vertices[vertex].sides >> mesh.regions[i] & 1);
}

TEST(SplitCreases, PutsVerticesWhereTheSurfaceMeetsSides)
{
  // The first vertex is on the surface, which is the plane x = 9 there. Both triangles
  // have the same diagonal, so that the lens is no manifold any more.
  WorkingMesh mesh = makeLens({0, 8, 8});
  mesh.vertices[2].foot.place = {2.0, 9.0, 7.0};
  splitCreases(mesh);
  ASSERT_EQ(5u, mesh.vertices.size());
  ASSERT_EQ(6u, mesh.triangles.size());
  for (const std::size_t i : {3u, 4u}) {
    const WorkingVertex& vertex = mesh.vertices[i];
    EXPECT_TRUE(vertex.is_on_surface);
    EXPECT_EQ(8, vertex.sides);
    EXPECT_NEAR(9.0, vertex.foot.place[0], 1e-12);
    EXPECT_EQ(9.0, vertex.foot.place[1]);
    EXPECT_EQ(0u, vertex.pair.lower); // that of the vertex on the surface
    EXPECT_NEAR(1.0, vertex.foot.normal[0], 1e-12);
  }
  EXPECT_NEAR(4.5, mesh.vertices[4].foot.place[2], 1e-12); // halfway
  EXPECT_EQ(2, std::count(mesh.regions.begin(), mesh.regions.end(), surface_region));
  EXPECT_EQ(4, std::count(mesh.regions.begin(), mesh.regions.end(), MeshRegion{3}));
}

TEST(WayDown, StaysWithinSides)
{
  const Eigen::Vector3d normal(0.6, 0.8, 0.0);
  EXPECT_EQ(Eigen::Vector3d(-1.2, -1.6, 0.0), wayDown(2.0, normal, 0));
  // To the plane, along it: height over the sine of the angle between them.
  EXPECT_NEAR(
      0.0, (wayDown(2.0, normal, 1) - Eigen::Vector3d(0.0, -2.5, 0.0)).norm(), 1e-12);
  EXPECT_TRUE(wayDown(2.0, normal, 1 + 8).isZero(0.0));
  const Eigen::Vector3d flat = Eigen::Vector3d(0.05, 0.0, 1.0).normalized();
  EXPECT_TRUE(wayDown(2.0, flat, 16).isZero(0.0));
  EXPECT_EQ(Eigen::Vector3d(0.0, 2.0, 0.0), keepWithin(1 + 32, {1.0, 2.0, 3.0}));
}

} // namespace test_caps
