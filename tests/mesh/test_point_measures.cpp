// SPDX-License-Identifier: BSD-3-Clause
// Figures of surfaces that are given as points with normals: against the truth of
// spheres, tori and half spheres; the same for any unit, place, order and number of
// threads.
#include "measured_shapes.h"
#include "mesh/disjoint_sets.h"
#include "mesh/point_fans.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace test_point_measures {

using namespace pcl_uvol;
using namespace uvol_test;

/** Random points of the unit sphere, in clumps as isopoints are. */
MeasuredShape
scatterSphere(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  MeasuredShape sphere;
  while (sphere.places.size() < count) {
    const Eigen::Vector3d place(2.0 * random.uniform() - 1.0,
                                2.0 * random.uniform() - 1.0,
                                2.0 * random.uniform() - 1.0);
    if (place.norm() <= 1.0 && place.norm() > 0.1)
      sphere.places.push_back(place.normalized());
  }
  sphere.normals = sphere.places;
  return sphere;
}

MeasuredShape
scatterTorus(double large, double small, std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  MeasuredShape torus;
  while (torus.places.size() < count) {
    const double u = 2.0 * M_PI * random.uniform(), v = 2.0 * M_PI * random.uniform();
    if (random.uniform() * (large + small) > large + small * std::cos(v))
      continue; // even per area
    const Eigen::Vector3d out(std::cos(u), std::sin(u), 0.0);
    torus.normals.emplace_back(std::cos(v) * out +
                               std::sin(v) * Eigen::Vector3d::UnitZ());
    torus.places.emplace_back(large * out + small * torus.normals.back());
  }
  return torus;
}

void
expectTruth(const Measure& measure, double truth, double part)
{
  EXPECT_NEAR(truth, measure.value, part * truth);
  EXPECT_LE(std::abs(measure.value - truth), measure.error);
  EXPECT_LT(measure.error, 30.0 * part * truth);
}

TEST(PointMeasures, SpheresAndToriOfRandomPoints)
{
  for (const std::uint64_t seed : {1, 2, 3})
    for (const auto& [count, part] : {std::pair{1000, 2e-3}, {20000, 1e-4}}) {
      const auto n = static_cast<std::size_t>(count);
      const SurfaceFigures sphere = measure(scatterSphere(n, seed));
      ASSERT_EQ(1u, sphere.pieces.size());
      EXPECT_EQ(n, sphere.pieces[0].vertices);
      EXPECT_EQ(0u, sphere.pieces[0].triangles);
      EXPECT_EQ(0u, sphere.pieces[0].rims);
      EXPECT_FALSE(sphere.pieces[0].genus.has_value());
      expectTruth(sphere.pieces[0].area, 4.0 * M_PI, part);
      expectTruth(sphere.pieces[0].volume, 4.0 / 3.0 * M_PI, part);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(1.0, sphere.pieces[0].half_axes[axis], 5.0 * part);

      const PieceMeasures torus =
          measure(scatterTorus(3.0, 1.0, 4 * n, seed)).isovalues[0];
      expectTruth(torus.area, 12.0 * M_PI * M_PI, 2.0 * part);
      expectTruth(torus.volume, 6.0 * M_PI * M_PI, 2.0 * part);
    }
}

TEST(PointMeasures, SharesAddUpToIntegrals)
{
  const MeasuredShape sphere = scatterSphere(5000, 4);
  auto points = std::make_shared<Dataset>(sphere.toDataset());
  std::vector<double> squares;
  for (const Eigen::Vector3d& place : sphere.places)
    squares.push_back(place[2] * place[2]);
  setField(*points, "square", squares);
  SurfaceMeasures measures;
  measures.setInputSurface(points, {});
  const SurfaceFigures figures = measures.compute();
  double area = 0.0, integral = 0.0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    area += figures.vertex_areas[i];
    integral += figures.vertex_areas[i] * squares[i];
    EXPECT_EQ(0, figures.piece_of[i]);
    EXPECT_GT(figures.vertex_areas[i], 0.0);
  }
  EXPECT_NEAR(figures.pieces[0].area.value, area, 1e-12 * area);
  EXPECT_NEAR(4.0 / 3.0 * M_PI, integral, 2e-3);
  EXPECT_EQ("square", figures.pieces[0].on_surface[0].name);
  EXPECT_NEAR(integral, figures.pieces[0].on_surface[0].integral.value, 1e-12);
}

/** Points along a track, with normals to all sides, have thin triangles that few of
 * their corners know. */
TEST(PointMeasures, MeansOfFieldsLieWithinTheirRange)
{
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    MeasuredShape track;
    for (int i = 0; i < 60; ++i) {
      track.places.emplace_back(1e4 * random.uniform(), 300.0 * random.uniform(), 10.0);
      track.places.back()[2] *= random.uniform();
      track.normals.push_back(
          Eigen::Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, 0.2)
              .normalized());
    }
    auto points = std::make_shared<Dataset>(track.toDataset());
    std::vector<double> errors;
    for (std::size_t i = 0; i < track.places.size(); ++i)
      errors.push_back(1.0 + random.uniform());
    setField(*points, "error", errors);
    SurfaceMeasures measures;
    measures.setInputSurface(points, {});
    const SurfaceFigures figures = measures.compute();
    for (const PieceMeasures& piece : figures.pieces) {
      EXPECT_GT(piece.area.value, 0.0) << seed;
      EXPECT_GE(piece.area.error, 0.0) << seed;
      for (const auto& field : piece.on_surface) {
        EXPECT_GE(field.mean, 1.0) << seed << ' ' << field.name;
        EXPECT_LE(field.mean, 2.0) << seed << ' ' << field.name;
      }
    }
  }
}

TEST(PointMeasures, ReportTheirInput)
{
  SurfaceMeasures measures;
  EXPECT_EQ(nullptr, measures.getInputVertices());
  EXPECT_EQ(nullptr, measures.getInputSamples());
  const auto vertices = std::make_shared<Dataset>(),
             samples = std::make_shared<Dataset>();
  measures.setInputSurface(vertices, {{0, 1, 2}});
  measures.setInputSamples(samples);
  EXPECT_EQ(vertices, measures.getInputVertices());
  EXPECT_EQ((std::vector<Triangle>{{0, 1, 2}}), measures.getInputTriangles());
  EXPECT_EQ(samples, measures.getInputSamples());
}

TEST(PointMeasures, OpenSurfacesHaveAnAreaAndNoVolume)
{
  MeasuredShape half = scatterSphere(20000, 5);
  MeasuredShape kept;
  for (const Eigen::Vector3d& place : half.places)
    if (place[2] > 0.0)
      kept.places.push_back(place);
  kept.normals = kept.places;
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(kept.toDataset()), {});
  const PieceMeasures piece = measures.compute().isovalues[0];
  EXPECT_EQ(1u, piece.rims);
  EXPECT_TRUE(std::isnan(piece.volume.value));
  EXPECT_NEAR(2.0 * M_PI, piece.area.value, piece.area.error);
  EXPECT_LT(piece.area.error, 0.03 * piece.area.value);
  ASSERT_EQ(1u, measures.getReport().warnings.size());
  EXPECT_EQ("open_pieces", measures.getReport().warnings[0].code);
  EXPECT_EQ(1.0, uvol_test::numberOf(measures.getReport().warnings[0], "open"));
}

TEST(PointMeasures, PiecesAreThoseThatTouchAndLookToOneSide)
{
  // A shell a tenth of its points' spacing thick, and a ball within of another
  // isovalue.
  MeasuredShape shape = scatterSphere(3000, 6);
  MeasuredShape inner = scatterSphere(2000, 7);
  for (std::size_t i = 0; i < inner.places.size(); ++i) {
    inner.places[i] *= 0.997;
    inner.normals[i] = -inner.normals[i];
  }
  MeasuredShape other = scatterSphere(1000, 8);
  for (Eigen::Vector3d& place : other.places)
    place *= 0.995;
  shape.isovalues.assign(3000, 1.0f);
  inner.isovalues.assign(2000, 1.0f);
  other.isovalues.assign(1000, 2.0f);
  shape.append(inner);
  shape.append(other);
  const SurfaceFigures figures = measure(shape);
  ASSERT_EQ(2u, figures.isovalues.size());
  ASSERT_EQ(3u, figures.pieces.size());
  EXPECT_EQ(3000u, figures.pieces[0].vertices);
  EXPECT_EQ(2000u, figures.pieces[1].vertices);
  EXPECT_LT(figures.pieces[1].volume.value, 0.0);
  const double truth = 4.0 / 3.0 * M_PI * (1.0 - std::pow(0.997, 3));
  EXPECT_NEAR(truth, figures.isovalues[0].volume.value, 0.1 * truth);
  EXPECT_EQ(1000u, figures.pieces[2].vertices);
  EXPECT_EQ(2.0, figures.isovalues[1].isovalue);
}

TEST(PointMeasures, TheSameForAnyOrderUnitAndThreads)
{
  MeasuredShape shape = scatterTorus(3.0, 1.0, 3000, 9);
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(shape.toDataset()), {});
  measures.setNumberOfThreads(1);
  const SurfaceFigures one = measures.compute();
  measures.setNumberOfThreads(4);
  EXPECT_EQ(one.vertex_areas, measures.compute().vertex_areas);
  MeasuredShape turned = shape;
  std::reverse(turned.places.begin(), turned.places.end());
  std::reverse(turned.normals.begin(), turned.normals.end());
  std::vector<double> areas = measure(turned).vertex_areas;
  std::reverse(areas.begin(), areas.end());
  EXPECT_EQ(one.vertex_areas, areas);
  for (const double factor : {0x1p-30, 0x1p30}) {
    MeasuredShape scaled = shape;
    for (Eigen::Vector3d& place : scaled.places)
      place *= factor;
    const PieceMeasures other = measure(scaled).isovalues[0];
    EXPECT_EQ(one.isovalues[0].area.value * factor * factor, other.area.value);
    EXPECT_EQ(one.isovalues[0].volume.value * factor * factor * factor,
              other.volume.value);
  }
}

TEST(PointMeasures, PointsAloneHaveNoPartAndAreReported)
{
  MeasuredShape shape = scatterSphere(500, 10);
  shape.append(shape); // every point twice
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(shape.toDataset()), {});
  const SurfaceFigures figures = measures.compute();
  EXPECT_NEAR(4.0 * M_PI, figures.isovalues[0].area.value, 0.02);
  EXPECT_EQ(500, std::count(figures.piece_of.begin(), figures.piece_of.end(), -1));
  ASSERT_EQ(1u, measures.getReport().warnings.size());
  EXPECT_EQ("points_without_area", measures.getReport().warnings[0].code);
  EXPECT_EQ(50.0, uvol_test::numberOf(measures.getReport().warnings[0], "percent"));

  // Two points are no surface.
  MeasuredShape two;
  two.places = {{0, 0, 0}, {1, 0, 0}};
  two.normals.assign(2, Eigen::Vector3d::UnitZ());
  measures.setInputSurface(std::make_shared<Dataset>(two.toDataset()), {});
  EXPECT_THROW(measures.compute(), InvalidArgument);
}

TEST(PointMeasures, NormalsOfAnySideAreReported)
{
  MeasuredShape shape = scatterSphere(3000, 11);
  for (std::size_t i = 0; i < shape.normals.size(); i += 2)
    shape.normals[i] = -shape.normals[i];
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(shape.toDataset()), {});
  measures.compute();
  ASSERT_FALSE(measures.getReport().warnings.empty());
  EXPECT_EQ("contrary_normals", measures.getReport().warnings[0].code);
  // Sheets that lie as far apart as their points are no such case.
  MeasuredShape shell = scatterSphere(3000, 12);
  MeasuredShape inner = scatterSphere(3000, 13);
  for (std::size_t i = 0; i < inner.places.size(); ++i) {
    inner.places[i] *= 0.93;
    inner.normals[i] = -inner.normals[i];
  }
  shell.append(inner);
  measures.setInputSurface(std::make_shared<Dataset>(shell.toDataset()), {});
  measures.compute();
  EXPECT_TRUE(measures.getReport().warnings.empty());
}

TEST(PointFans, LatticesAreRingedByTrianglesAndEndAtTheirBorder)
{
  // A hexagonal lattice, whose triangles all points agree on.
  std::vector<float> xyz;
  std::vector<detail::SurfaceCorner> flat;
  std::vector<std::uint32_t> use;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d place(i + 0.5 * (j % 2), std::sqrt(0.75) * j, 0.0);
      xyz.insert(xyz.end(),
                 {static_cast<float>(place[0]), static_cast<float>(place[1]), 0.0f});
      flat.push_back({place, Eigen::Vector3d::UnitZ()});
      use.push_back(static_cast<std::uint32_t>(use.size()));
    }
  Report report;
  const auto samples =
      SampleSet::build(xyz.data(), 3, use, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
  std::vector<detail::SurfaceCorner> corners;
  for (std::size_t i = 0; i < flat.size(); ++i)
    corners.push_back(flat[samples->getInputIndex(i)]);
  const detail::PointFans fans(*samples, corners, {}, 1);
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t input = samples->getInputIndex(i);
    const bool is_inside =
        input % 12 > 0 && input % 12 < 11 && input / 12 > 0 && input / 12 < 11;
    // Every other row begins, or ends, in a notch, which is no border but a gap.
    const bool is_notch = input % 12 == (input / 12 % 2 == 1 ? 0u : 11u) &&
                          input / 12 > 0 && input / 12 < 11;
    EXPECT_EQ(!is_inside && !is_notch, fans.isOnRim(i)) << input;
    if (!is_inside)
      continue;
    EXPECT_EQ(6u, fans.getFan(i).size());
    for (const detail::FanTriangle& others : fans.getFan(i)) {
      const Eigen::Vector3d u = corners[others[0]].place - corners[i].place,
                            v = corners[others[1]].place - corners[i].place;
      EXPECT_NEAR(std::sqrt(0.75), u.cross(v)[2], 1e-6); // counter-clockwise
    }
  }
}

TEST(DisjointSets, TheLowestItemStandsForItsSet)
{
  detail::DisjointSets sets(6);
  sets.join(5, 3);
  sets.join(4, 5);
  sets.join(1, 2);
  EXPECT_EQ(3u, sets.find(4));
  EXPECT_EQ(3u, sets.find(5));
  EXPECT_EQ(1u, sets.find(2));
  EXPECT_EQ(0u, sets.find(0));
}

} // namespace test_point_measures
