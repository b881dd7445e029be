// SPDX-License-Identifier: BSD-3-Clause
// Figures of meshes: against the truth of spheres, ellipsoids and tori, of boxes and of
// samples counted one by one; the same for any unit, place and number of threads.
#include "measured_shapes.h"
#include "mesh_fields.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace test_surface_measures {

using namespace pcl_uvol;
using namespace uvol_test;

void
expectWithin(const Measure& measure, double truth, double part)
{
  EXPECT_NEAR(truth, measure.value, part * std::abs(truth));
  EXPECT_LE(std::abs(measure.value - truth), measure.error + 1e-6 * std::abs(truth));
}

TEST(SurfaceMeasures, BentTrianglesMeasureSpheres)
{
  // A bent triangle is off by the fourth power of its size.
  for (const auto& [levels, part] : {std::pair{2, 2e-3}, {3, 1.5e-4}, {4, 1e-5}}) {
    const SurfaceFigures figures = measure(makeEllipsoid({2.0, 2.0, 2.0}, levels));
    ASSERT_EQ(1u, figures.isovalues.size());
    const PieceMeasures& sphere = figures.isovalues[0];
    expectWithin(sphere.area, 16.0 * M_PI, part);
    expectWithin(sphere.volume, 32.0 / 3.0 * M_PI, part);
    EXPECT_LT(sphere.area.error, 20.0 * part * sphere.area.value);
    EXPECT_LT(sphere.volume.error, 20.0 * part * sphere.volume.value);
    EXPECT_EQ(0u, sphere.genus);
    EXPECT_TRUE(std::isnan(sphere.isovalue));
  }
}

TEST(SurfaceMeasures, MomentsGiveCentroidAndAxesOfEllipsoids)
{
  MeasuredShape shape = makeEllipsoid({1.0, 3.0, 2.0}, 5);
  Eigen::Matrix3d turn;
  turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  shape.transform(turn, Eigen::Vector3d(7.0, -5.0, 3.0));
  const PieceMeasures ellipsoid = measure(shape).isovalues[0];
  expectWithin(ellipsoid.volume, 8.0 * M_PI, 1e-5);
  // Numerically from the series of elliptic integrals.
  expectWithin(ellipsoid.area, 48.882154, 1e-5);
  EXPECT_LT((ellipsoid.centroid - Eigen::Vector3d(7.0, -5.0, 3.0)).norm(), 1e-5);
  EXPECT_LT((ellipsoid.half_axes - Eigen::Vector3d(3.0, 2.0, 1.0)).norm(), 1e-4);
  const int order[] = {1, 2, 0};
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(1.0, std::abs(ellipsoid.axes.col(i).dot(turn.col(order[i]))), 1e-6);
  EXPECT_NEAR(1.0, ellipsoid.axes.determinant(), 1e-12);
}

TEST(SurfaceMeasures, ToriHaveAHandle)
{
  const PieceMeasures torus = measure(makeTorus(3.0, 1.0, 120, 40)).isovalues[0];
  expectWithin(torus.volume, 6.0 * M_PI * M_PI, 1e-4);
  expectWithin(torus.area, 12.0 * M_PI * M_PI, 1e-4);
  EXPECT_EQ(1u, torus.genus);
  EXPECT_NEAR(4.0, torus.high[0], 1e-3);
  EXPECT_NEAR(-1.0, torus.low[2], 1e-3);
}

TEST(SurfaceMeasures, FlatTrianglesMeasurePolyhedraAndReportWhatTheyMiss)
{
  MeasuredShape sphere = makeEllipsoid({2.0, 2.0, 2.0}, 4);
  SurfaceMeasuresParameters parameters;
  parameters.curved = false;
  const PieceMeasures flat = measure(sphere, nullptr, parameters).isovalues[0];
  EXPECT_LT(flat.volume.value, 32.0 / 3.0 * M_PI * 0.999);
  EXPECT_NEAR(flat.volume.value + flat.volume.error, 32.0 / 3.0 * M_PI, 1e-3);
  EXPECT_NEAR(flat.area.value + flat.area.error, 16.0 * M_PI, 1e-3);

  MeasuredShape box = makeBox({1.0, 2.0, 4.0});
  const PieceMeasures of_box = measure(box).isovalues[0];
  EXPECT_DOUBLE_EQ(8.0, of_box.volume.value);
  EXPECT_DOUBLE_EQ(28.0, of_box.area.value);
  EXPECT_NEAR(0.0, (of_box.centroid - Eigen::Vector3d(0.5, 1.0, 2.0)).norm(), 1e-12);
  // Moments of a box are a twelfth of its squared sides.
  EXPECT_NEAR(4.0 * std::sqrt(5.0 / 12.0), of_box.half_axes[0], 1e-12);
  EXPECT_NEAR(1.0 * std::sqrt(5.0 / 12.0), of_box.half_axes[2], 1e-12);
  // A cube with normals at its corners is too sharp to be bent.
  MeasuredShape cube = makeBox({2.0, 2.0, 2.0});
  for (const Eigen::Vector3d& place : cube.places)
    cube.normals.push_back((place - Eigen::Vector3d::Ones()).normalized());
  EXPECT_DOUBLE_EQ(8.0, measure(cube).isovalues[0].volume.value);
}

TEST(SurfaceMeasures, CapsAreFlatAndBentAtTheirRims)
{
  // The upper half of a ball: its cap has the normals of the plane, its rim the ball's.
  MeasuredShape half = makeHalfBall(2.0, 5);
  const PieceMeasures solid = measure(half).isovalues[0];
  expectWithin(solid.volume, 16.0 / 3.0 * M_PI, 1e-5);
  expectWithin(solid.area, 12.0 * M_PI, 1e-5);
  EXPECT_NEAR(3.0 / 8.0 * 2.0, solid.centroid[2], 1e-5);
}

TEST(SurfaceMeasures, WallsOfCavitiesCountNegative)
{
  MeasuredShape shell = makeEllipsoid({3.0, 3.0, 3.0}, 4);
  MeasuredShape hole = makeEllipsoid({1.0, 1.0, 1.0}, 3);
  for (Triangle& triangle : hole.triangles)
    std::swap(triangle[0], triangle[1]);
  shell.append(hole);
  const SurfaceFigures figures = measure(shell);
  ASSERT_EQ(2u, figures.pieces.size());
  EXPECT_NEAR(-4.0 / 3.0 * M_PI, figures.pieces[1].volume.value, 1e-3);
  expectWithin(figures.isovalues[0].volume, 104.0 / 3.0 * M_PI, 1e-4);
  expectWithin(figures.isovalues[0].area, 40.0 * M_PI, 1e-4);

  // Also if samples do not determine the cavity: its volume is an error besides.
  auto vertices = std::make_shared<Dataset>(shell.toDataset());
  const std::size_t count = shell.places.size(), outer = count - hole.places.size();
  std::vector<float> errors(count, 0.0f);
  std::vector<std::int32_t> support(count, 0);
  std::fill(errors.begin() + static_cast<std::ptrdiff_t>(outer), errors.end(), 0.01f);
  std::fill(support.begin() + static_cast<std::ptrdiff_t>(outer),
            support.end(),
            static_cast<std::int32_t>(IsoSupport::Bridged));
  setField(*vertices, "edge_length", std::vector<float>(count, 0.01f));
  setField(*vertices, "error", errors);
  setField(*vertices, "support", support);
  SurfaceMeasures measures;
  measures.setInputSurface(vertices, shell.triangles);
  const SurfaceFigures weak = measures.compute();
  EXPECT_EQ(figures.isovalues[0].volume.value, weak.isovalues[0].volume.value);
  EXPECT_EQ(figures.pieces[1].volume.value, weak.pieces[1].volume.value);
  EXPECT_GT(weak.pieces[1].volume.error, 4.0 / 3.0 * M_PI);
}

TEST(SurfaceMeasures, PiecesGoByIsovalue)
{
  MeasuredShape three = makeEllipsoid({1.0, 1.0, 1.0}, 2);
  three.isovalues.assign(three.places.size(), 5.0f);
  for (const auto& [radius, away, isovalue] :
       {std::tuple{2.0, 10.0, 3.0f}, {1.0, 20.0, 5.0f}}) {
    MeasuredShape next = makeEllipsoid({radius, radius, radius}, radius > 1.5 ? 3 : 1);
    next.transform(Eigen::Matrix3d::Identity(), {away, 0.0, 0.0});
    next.isovalues.assign(next.places.size(), isovalue);
    three.append(next);
  }
  const SurfaceFigures figures = measure(three);
  ASSERT_EQ(2u, figures.isovalues.size());
  EXPECT_EQ(5.0, figures.isovalues[0].isovalue);
  EXPECT_EQ(3.0, figures.isovalues[1].isovalue);
  ASSERT_EQ(3u, figures.pieces.size());
  EXPECT_EQ(128u, figures.pieces[0].triangles);
  EXPECT_EQ(32u, figures.pieces[1].triangles);
  EXPECT_EQ(160u, figures.isovalues[0].triangles);
  EXPECT_DOUBLE_EQ(figures.pieces[0].volume.value + figures.pieces[1].volume.value,
                   figures.isovalues[0].volume.value);
  EXPECT_NEAR(10.0, figures.isovalues[1].centroid[0], 1e-5);
  EXPECT_EQ(2, figures.piece_of[three.places.size() - 100]);
  EXPECT_EQ(1, figures.piece_of.back());
  double areas = 0.0;
  for (const double area : figures.vertex_areas)
    areas += area;
  EXPECT_NEAR(figures.isovalues[0].area.value + figures.isovalues[1].area.value,
              areas,
              1e-9 * areas);
}

TEST(SurfaceMeasures, FieldsOnTheSurfaceAreIntegrated)
{
  MeasuredShape sphere = makeEllipsoid({2.0, 2.0, 2.0}, 5);
  sphere.transform(Eigen::Matrix3d::Identity(), {1.0, 0.0, 0.0});
  std::vector<float> height, some;
  for (const Eigen::Vector3d& place : sphere.places) {
    height.push_back(static_cast<float>(place[0] * place[0]));
    some.push_back(place[2] > 0.0 ? 3.0f : std::numeric_limits<float>::quiet_NaN());
  }
  auto vertices = std::make_shared<Dataset>(sphere.toDataset());
  setField(*vertices, "square", height);
  setField(*vertices, "some", some);
  setField(*vertices, "cap", std::vector<std::int32_t>(height.size(), 0));
  SurfaceMeasures measures;
  measures.setInputSurface(vertices, sphere.triangles);
  const PieceMeasures piece = measures.compute().isovalues[0];
  ASSERT_EQ(2u, piece.on_surface.size());
  EXPECT_EQ("square", piece.on_surface[0].name);
  EXPECT_NEAR(1.0 + 4.0 / 3.0, piece.on_surface[0].mean, 2e-3);
  EXPECT_NEAR(16.0 * M_PI * 7.0 / 3.0, piece.on_surface[0].integral.value, 0.1);
  EXPECT_NEAR(3.0, piece.on_surface[1].mean, 1e-12);
}

TEST(SurfaceMeasures, ErrorsOfVerticesAreErrorsOfTheVolume)
{
  MeasuredShape sphere = makeEllipsoid({2.0, 2.0, 2.0}, 5);
  auto vertices = std::make_shared<Dataset>(sphere.toDataset());
  setField(*vertices, "error", std::vector<float>(sphere.places.size(), 0.01f));
  setField(*vertices, "mean_curvature", std::vector<float>(sphere.places.size(), 0.5f));
  SurfaceMeasures measures;
  measures.setInputSurface(vertices, sphere.triangles);
  const PieceMeasures piece = measures.compute().isovalues[0];
  // What a sphere has more that is larger by the error.
  EXPECT_NEAR(4.0 / 3.0 * M_PI * (std::pow(2.01, 3) - 8.0), piece.volume.error, 0.01);
  EXPECT_NEAR(4.0 * M_PI * (std::pow(2.01, 2) - 4.0), piece.area.error, 0.5);
  EXPECT_GT(piece.area.error, 4.0 * M_PI * (std::pow(2.01, 2) - 4.0));
  EXPECT_TRUE(measures.getReport().warnings.empty());
  // What has no estimate counts for nothing, and is told.
  std::vector<float> errors;
  for (const Eigen::Vector3d& place : sphere.places)
    errors.push_back(place[0] > 0.0 ? 0.01f : std::numeric_limits<float>::quiet_NaN());
  setField(*vertices, "error", errors);
  measures.setInputSurface(vertices, sphere.triangles);
  EXPECT_NEAR(
      0.5 * piece.volume.error, measures.compute().isovalues[0].volume.error, 0.02);
  ASSERT_EQ(1u, measures.getReport().warnings.size());
  EXPECT_EQ("area_without_error", measures.getReport().warnings[0].code);
  EXPECT_NEAR(
      50.0, uvol_test::numberOf(measures.getReport().warnings[0], "percent"), 10.0);
}

TEST(SurfaceMeasures, UnconstrainedPiecesAreUncertainByTheirSize)
{
  const MeasuredShape sphere = makeEllipsoid({2.0, 2.0, 2.0}, 5);
  auto vertices = std::make_shared<Dataset>(sphere.toDataset());
  const std::size_t count = sphere.places.size();
  setField(*vertices, "edge_length", std::vector<float>(count, 0.1f));
  // Next to gaps below a limit, and one vertex in seven with an error. Vertices on the
  // cap do not count.
  const auto measureWith = [&](double limit, float error) {
    std::vector<float> errors;
    std::vector<std::int32_t> support, cap;
    for (const Eigen::Vector3d& place : sphere.places) {
      support.push_back(static_cast<std::int32_t>(
          place[0] < limit ? IsoSupport::Rim : IsoSupport::Measured));
      errors.push_back(place[0] < -1.5 ? error : 0.0f);
      cap.push_back(place[0] > 1.5 ? 1 : 0);
    }
    setField(*vertices, "error", errors);
    setField(*vertices, "support", support);
    setField(*vertices, "cap", cap);
    SurfaceMeasures measures;
    measures.setInputSurface(vertices, sphere.triangles);
    const PieceMeasures piece = measures.compute().isovalues[0];
    const auto& warnings = measures.getReport().warnings;
    EXPECT_EQ(limit > -0.25 ? 1 : 0,
              std::count_if(warnings.begin(), warnings.end(), [](const Message& one) {
                return one.code == "unconstrained_measures";
              }));
    return piece;
  };
  const PieceMeasures few = measureWith(-0.5, 0.06f), most = measureWith(0.0, 0.06f),
                      located = measureWith(0.0, 0.04f);
  EXPECT_LT(few.volume.error, 0.1 * few.volume.value);
  EXPECT_LT(located.volume.error, few.volume.error);
  EXPECT_DOUBLE_EQ(few.volume.error + few.volume.value, most.volume.error);
  EXPECT_DOUBLE_EQ(few.area.error + few.area.value, most.area.error);
}

TEST(SurfaceMeasures, WhatRimsAreOffByIsAnErrorOfTheArea)
{
  MeasuredShape square;
  square.places = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  square.normals.assign(4, Eigen::Vector3d::UnitZ());
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto vertices = std::make_shared<Dataset>(square.toDataset());
  setField(*vertices, "error", std::vector<float>{0.01f, 0.01f, 0.01f, 0.02f});
  setField(*vertices, "mean_curvature", std::vector<float>(4, 0.0f));
  SurfaceMeasures measures;
  measures.setInputSurface(vertices, square.triangles);
  const Measure area = measures.compute().isovalues[0].area;
  EXPECT_DOUBLE_EQ(1.0, area.value);
  // Along its four sides, and of ripples of the vertices.
  EXPECT_NEAR(3.0 * 0.01 + 0.02 + 3.0 * 1e-4 + 4e-4, area.error, 1e-6);
}

TEST(SurfaceMeasures, OpenSurfacesHaveAnAreaAndNoVolume)
{
  MeasuredShape open = makeEllipsoid({2.0, 2.0, 2.0}, 4);
  open.triangles.pop_back();
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(open.toDataset()), open.triangles);
  const PieceMeasures piece = measures.compute().isovalues[0];
  EXPECT_EQ(1u, piece.rims);
  EXPECT_NEAR(16.0 * M_PI, piece.area.value, 0.1);
  EXPECT_TRUE(std::isnan(piece.volume.value));
  // Second moments of a spherical shell.
  EXPECT_NEAR(2.0, piece.half_axes[0], 1e-2);
  ASSERT_EQ(1u, measures.getReport().warnings.size());
  EXPECT_EQ("open_pieces", measures.getReport().warnings[0].code);
  EXPECT_EQ(1.0, uvol_test::numberOf(measures.getReport().warnings[0], "open"));
}

TEST(SurfaceMeasures, SaysWhatLooksInwards)
{
  MeasuredShape shape = makeEllipsoid({2.0, 2.0, 2.0}, 3);
  for (Triangle& triangle : shape.triangles)
    std::swap(triangle[0], triangle[1]);
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(shape.toDataset()),
                           shape.triangles);
  EXPECT_LT(measures.compute().isovalues[0].volume.value, -33.0);
  ASSERT_EQ(1u, measures.getReport().warnings.size());
  EXPECT_EQ("negative_volumes", measures.getReport().warnings[0].code);
}

TEST(SurfaceMeasures, ThingsThatTouchInAVertexOrAnEdgeAreTwo)
{
  // Two boxes with a corner in common, and two with an edge.
  for (const std::size_t shared : {1u, 2u}) {
    MeasuredShape boxes = makeBox({1.0, 1.0, 1.0}), other = boxes;
    other.transform(Eigen::Matrix3d::Identity(), {1.0, 1.0, shared == 1 ? 1.0 : 0.0});
    boxes.append(other);
    boxes.mergeEqualPlaces();
    ASSERT_EQ(16u - shared, boxes.places.size());
    const SurfaceFigures figures = measure(boxes);
    ASSERT_EQ(2u, figures.pieces.size());
    EXPECT_DOUBLE_EQ(2.0, figures.isovalues[0].volume.value);
    EXPECT_DOUBLE_EQ(12.0, figures.isovalues[0].area.value);
    EXPECT_EQ(boxes.places.size(), figures.vertex_areas.size());
    EXPECT_EQ(boxes.places.size(), figures.piece_of.size());
  }
}

TEST(SurfaceMeasures, FoldsAreErrorsOfTheArea)
{
  MeasuredShape sphere = makeEllipsoid({2.0, 2.0, 2.0}, 4);
  // A vertex drawn across one of its triangles, on the sphere.
  const auto& [a, b, c] = sphere.triangles[100];
  sphere.places[a] =
      2.0 * (0.8 * (sphere.places[b] + sphere.places[c]) - 0.6 * sphere.places[a])
                .normalized();
  sphere.normals[a] = sphere.places[a].normalized();
  const PieceMeasures folded = measure(sphere).isovalues[0];
  expectWithin(folded.area, 16.0 * M_PI, 0.01);
  EXPECT_GT(folded.area.value, 16.0 * M_PI * (1.0 + 1e-4));
  // Normals that all look inwards are no folds.
  MeasuredShape turned = makeEllipsoid({2.0, 2.0, 2.0}, 4);
  const double error = measure(turned).isovalues[0].area.error;
  for (Eigen::Vector3d& normal : turned.normals)
    normal = -normal;
  EXPECT_EQ(error, measure(turned).isovalues[0].area.error);
}

TEST(SurfaceMeasures, SaysWhereASurfaceGoesThroughItself)
{
  SurfaceMeasuresParameters parameters;
  parameters.find_intersections = true;
  EXPECT_TRUE(
      measure(makeTorus(3.0, 1.0, 30, 12), nullptr, parameters).intersections.empty());
  MeasuredShape boxes = makeBox({1.0, 1.0, 1.0}), other = boxes;
  other.transform(Eigen::Matrix3d::Identity(), {0.5, 0.25, 0.25});
  boxes.append(other);
  Dataset vertices = boxes.toDataset();
  vertices.origin = {{64.0, 0.0, 0.0}};
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(vertices), boxes.triangles);
  measures.setParameters(parameters);
  const SurfaceFigures figures = measures.compute();
  ASSERT_FALSE(figures.intersections.empty());
  for (const TriangleIntersection& pair : figures.intersections) {
    EXPECT_LT(pair.first, 12u);
    EXPECT_GE(pair.second, 12u);
    EXPECT_NEAR(64.5, pair.place[0], 0.5);
  }
  ASSERT_EQ(1u, measures.getReport().warnings.size());
  const Message& told = measures.getReport().warnings[0];
  EXPECT_EQ("self_intersections", told.code);
  EXPECT_EQ(static_cast<double>(figures.intersections.size()),
            uvol_test::numberOf(told, "pairs"));
  EXPECT_NEAR(64.5, uvol_test::numberOf(told, "x"), 0.5);
}

/** Samples at random in the unit cube, with a mass of 2. */
std::shared_ptr<Dataset>
makeUnitMasses(std::size_t count, const Eigen::Vector3d& sides)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> xyz;
  for (std::size_t i = 0; i < 3 * count; ++i)
    xyz.push_back(sides[static_cast<int>(i % 3)] * uniform(random));
  auto samples = std::make_shared<Dataset>();
  samples->cloud.width = static_cast<std::uint32_t>(count);
  samples->cloud.height = 1;
  setCoordinates(*samples, xyz);
  setField(*samples, "mass", std::vector<double>(count, 2.0));
  return samples;
}

TEST(SurfaceMeasures, DropsPiecesWhoseErrorExceedsTheirSize)
{
  MeasuredShape two = makeEllipsoid({2.0, 2.0, 2.0}, 3);
  const std::size_t body = two.places.size();
  MeasuredShape debris = makeEllipsoid({1.0, 1.0, 1.0}, 1);
  debris.transform(Eigen::Matrix3d::Identity(), {50.0, 0.0, 0.0});
  two.append(debris);
  const auto vertices = std::make_shared<Dataset>(two.toDataset());
  std::vector<double> errors(two.places.size(), 20.0);
  std::fill_n(errors.begin(), body, 0.001);
  setField(*vertices, "error", errors);
  SurfaceMeasures measures;
  measures.setInputSurface(vertices, two.triangles);
  const SurfaceFigures all = measures.compute();
  EXPECT_EQ(2u, all.pieces.size());
  ASSERT_FALSE(measures.getReport().warnings.empty());
  const Message told = measures.getReport().warnings.back();
  EXPECT_EQ("uncertain_pieces", told.code);
  EXPECT_EQ(1.0, uvol_test::numberOf(told, "uncertain"));
  EXPECT_EQ(2.0, uvol_test::numberOf(told, "pieces"));
  EXPECT_EQ(0.0, uvol_test::numberOf(told, "are_left_out"));
  SurfaceMeasuresParameters parameters;
  parameters.drop_uncertain = true;
  measures.setParameters(parameters);
  measures.setInputSamples(makeUnitMasses(100, {1.0, 1.0, 1.0}));
  const SurfaceFigures sure = measures.compute();
  ASSERT_EQ(1u, sure.pieces.size());
  expectWithin(sure.isovalues[0].volume, 32.0 / 3.0 * M_PI, 1e-3);
  EXPECT_EQ(100, sure.isovalues[0].samples);
  EXPECT_EQ(0, sure.piece_of[0]);
  EXPECT_EQ(-1, sure.piece_of[body]);
  EXPECT_EQ(0.0, sure.vertex_areas[body]);
  // Nothing is left out where nothing would be left.
  setField(*vertices, "error", std::vector<double>(errors.size(), 20.0));
  EXPECT_EQ(2u, measures.compute().pieces.size());
}

TEST(SurfaceMeasures, MeshesInOnePlaneHaveNoVolumeAndNoSamplesInside)
{
  Eigen::Matrix3d turn;
  turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  for (const Eigen::Matrix3d& axes :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn}) {
    MeasuredShape sheet = makeBox({1.0, 1.0, 0.0});
    sheet.transform(axes, {7.0, -5.0, 53.0});
    SurfaceMeasures measures;
    measures.setInputSurface(std::make_shared<Dataset>(sheet.toDataset()),
                             sheet.triangles);
    measures.setInputSamples(makeUnitMasses(100, {1.0, 1.0, 0.0}));
    const PieceMeasures all = measures.compute().isovalues.at(0);
    EXPECT_NEAR(2.0, all.area.value, 1e-4);
    EXPECT_EQ(0.0, all.volume.value);
    EXPECT_EQ(0, all.samples);
    EXPECT_TRUE(std::isnan(all.inside.at(0).mean));
    ASSERT_FALSE(measures.getReport().warnings.empty());
    EXPECT_EQ("flat_surfaces", measures.getReport().warnings[0].code);
    EXPECT_EQ(1.0, uvol_test::numberOf(measures.getReport().warnings[0], "flat"));
  }
}

TEST(SurfaceMeasures, SumsSamplesBeyondTheIsovalueWhereverTheyAre)
{
  MeasuredShape ball = makeEllipsoid({0.5, 0.5, 0.5}, 3);
  ball.isovalues.assign(ball.places.size(), 0.25f);
  const auto samples = makeUnitMasses(100, {1.0, 1.0, 1.0});
  std::vector<double> values;
  for (int i = 0; i < 100; ++i)
    values.push_back(0.01 * i);
  setField(*samples, "f", values);
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(ball.toDataset()), ball.triangles);
  measures.setInputSamples(samples);
  EXPECT_FALSE(measures.compute().isovalues[0].samples_beyond);
  SurfaceMeasuresParameters parameters;
  parameters.field = "f";
  for (const auto& [outside, count] :
       {std::pair{Outside::Lower, 75}, {Outside::Higher, 26}}) {
    parameters.outside = outside;
    measures.setParameters(parameters);
    const SurfaceFigures figures = measures.compute();
    const PieceMeasures& all = figures.isovalues[0];
    EXPECT_EQ(count, all.samples_beyond.value());
    EXPECT_EQ("mass", all.sums_beyond.at(0).name);
    EXPECT_EQ(2.0 * count, all.sums_beyond[0].sum);
    EXPECT_FALSE(figures.pieces[0].samples_beyond);
  }
  parameters.periodic = {-1.0, 0.0, 0.0};
  measures.setParameters(parameters);
  EXPECT_THROW(measures.compute(), InvalidArgument);
}

TEST(SurfaceMeasures, UnitsAndPlacesChangeNothing)
{
  MeasuredShape shape = makeTorus(3.0, 1.0, 30, 12);
  const PieceMeasures one = measure(shape).isovalues[0];
  Dataset far = shape.toDataset();
  far.origin = {{4e6, -2e6, 1e3}};
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(far), shape.triangles);
  const PieceMeasures moved = measures.compute().isovalues[0];
  EXPECT_EQ(one.volume.value, moved.volume.value);
  EXPECT_EQ(one.centroid[0] + 4e6, moved.centroid[0]);
  EXPECT_EQ(one.high[1] - 2e6, moved.high[1]);
  for (const double factor : {0x1p-30, 0x1p30}) {
    MeasuredShape scaled = shape;
    for (Eigen::Vector3d& place : scaled.places)
      place *= factor;
    const PieceMeasures other = measure(scaled).isovalues[0];
    EXPECT_EQ(one.volume.value * factor * factor * factor, other.volume.value);
    EXPECT_EQ(one.area.value * factor * factor, other.area.value);
    EXPECT_NEAR(one.half_axes[2] * factor, other.half_axes[2], 1e-9 * factor);
  }
}

TEST(SurfaceMeasures, RefusesWhatIsNoSurface)
{
  SurfaceMeasures measures;
  EXPECT_THROW(measures.compute(), InvalidArgument);
  const MeasuredShape box = makeBox({1.0, 1.0, 1.0});
  const auto refuses = [&](const MeasuredShape& shape, const pcl_uvol::Message& told) {
    measures.setInputSurface(std::make_shared<Dataset>(shape.toDataset()),
                             shape.triangles);
    EXPECT_EQ(told, uvol_test::thrownBy<InvalidArgument>([&] { measures.compute(); }));
  };
  MeasuredShape shape = box;
  shape.triangles.clear();
  refuses(shape, {"surface_without_normals", {}});
  shape.normals.assign(shape.places.size(), Eigen::Vector3d::Zero());
  refuses(shape, {"surface_points_without_normal", {}});
  measures.setInputSamples(std::make_shared<Dataset>(shape.toDataset()));
  refuses(shape, {"inside_without_triangles", {}});
  measures.setInputSamples(nullptr);
  shape = box;
  shape.triangles[3][1] = 8;
  refuses(shape, {"triangle_beyond_vertices", {{"vertex", 8}, {"vertices", 8}}});
  shape = box;
  shape.places[2][1] = std::numeric_limits<double>::quiet_NaN();
  refuses(shape, {"vertex_not_finite", {{"vertex", 2}}});
}

TEST(SurfaceMeasures, TrianglesThatAreLinesGo)
{
  MeasuredShape box = makeBox({1.0, 1.0, 1.0});
  box.triangles.push_back({0, 1, 1});
  EXPECT_DOUBLE_EQ(1.0, measure(box).isovalues[0].volume.value);
  EXPECT_EQ(12u, measure(box).isovalues[0].triangles);
}

TEST(SurfaceMeasures, ParametersAreJson)
{
  SurfaceMeasuresParameters parameters;
  EXPECT_EQ(parameters, SurfaceMeasuresParameters::fromJson("{}"));
  parameters.curved = false;
  EXPECT_EQ(parameters, SurfaceMeasuresParameters::fromJson(parameters.toJson()));
}

TEST(SurfaceMeasures, CountsSamplesInsideAndIntegratesOverThem)
{
  // A ball of radius 2 in a cube, a part of it in a second isovalue of radius 1.
  MeasuredShape shape = makeEllipsoid({2.0, 2.0, 2.0}, 4);
  shape.isovalues.assign(shape.places.size(), 4.0f);
  MeasuredShape inner = makeEllipsoid({1.0, 1.0, 1.0}, 4);
  inner.isovalues.assign(inner.places.size(), 7.0f);
  shape.append(inner);
  auto vertices = std::make_shared<Dataset>(shape.toDataset());
  std::vector<float> rho;
  for (const Eigen::Vector3d& place : shape.places)
    rho.push_back(static_cast<float>(8.0 - place.squaredNorm()));
  setField(*vertices, "rho", rho);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-2.5, 2.5);
  MeasuredShape points;
  std::vector<float> values, masses;
  std::size_t inside[2] = {};
  for (std::size_t i = 0; i < 100000; ++i) {
    const Eigen::Vector3d place(any(random), any(random), any(random));
    points.places.push_back(place);
    values.push_back(static_cast<float>(8.0 - place.squaredNorm()));
    masses.push_back(0.5f);
    inside[0] += place.norm() < 2.0;
    inside[1] += place.norm() < 1.0;
  }
  auto samples = std::make_shared<Dataset>(points.toDataset());
  setField(*samples, "rho", values);
  setField(*samples, "mass", masses);
  samples->cloud.data.insert(samples->cloud.data.end(), // a duplicate counts as well
                             samples->cloud.data.begin(),
                             samples->cloud.data.begin() + samples->cloud.point_step);
  ++samples->cloud.width;
  samples->cloud.row_step += samples->cloud.point_step;
  inside[0] += points.places[0].norm() < 2.0;
  inside[1] += points.places[0].norm() < 1.0;

  SurfaceMeasures measures;
  measures.setInputSurface(vertices, shape.triangles);
  measures.setInputSamples(samples);
  const SurfaceFigures figures = measures.compute();
  ASSERT_EQ(2u, figures.isovalues.size());
  const double radii[] = {2.0, 1.0};
  for (std::size_t i = 0; i < 2; ++i) {
    const PieceMeasures& ball = figures.isovalues[i];
    const double r = radii[i];
    // Flat triangles cut off half a per cent of the volume.
    EXPECT_NEAR(static_cast<double>(inside[i]),
                static_cast<double>(ball.samples),
                0.01 * static_cast<double>(inside[i]));
    ASSERT_EQ(2u, ball.inside.size());
    EXPECT_EQ("rho", ball.inside[0].name);
    const double truth =
        4.0 * M_PI * (8.0 * std::pow(r, 3) / 3.0 - std::pow(r, 5) / 5.0);
    expectWithin(ball.inside[0].integral, truth, 3e-3);
    EXPECT_LT(ball.inside[0].integral.error, 0.02 * truth);
    EXPECT_NEAR(truth / (4.0 / 3.0 * M_PI * std::pow(r, 3)), ball.inside[0].mean, 0.03);
    EXPECT_DOUBLE_EQ(0.5 * static_cast<double>(ball.samples), ball.inside[1].sum);
    // Without a mean on the surface that of the samples stands in.
    EXPECT_NEAR(0.5, ball.inside[1].mean, 1e-9);
  }
  // The same for any number of threads.
  measures.setNumberOfThreads(5);
  const SurfaceFigures many = measures.compute();
  EXPECT_EQ(figures.isovalues[0].inside[0].integral.value,
            many.isovalues[0].inside[0].integral.value);
  EXPECT_EQ(figures.isovalues[0].samples, many.isovalues[0].samples);
}

TEST(SurfaceMeasures, SamplesAndSurfaceMayHaveOtherOrigins)
{
  const MeasuredShape ball = makeEllipsoid({2.0, 2.0, 2.0}, 3);
  MeasuredShape points;
  points.places = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
  Dataset vertices = ball.toDataset(), samples = points.toDataset();
  vertices.origin = {{1024.0, 0.0, 0.0}};
  samples.origin = {{1026.5, 0.0, 0.0}}; // so that the third one is 5.5 to the right
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(vertices), ball.triangles);
  measures.setInputSamples(std::make_shared<Dataset>(samples));
  EXPECT_EQ(0, measures.compute().isovalues[0].samples);
  samples.origin[0] = 1023.0;
  measures.setInputSamples(std::make_shared<Dataset>(samples));
  EXPECT_EQ(2, measures.compute().isovalues[0].samples);
}

} // namespace test_surface_measures
