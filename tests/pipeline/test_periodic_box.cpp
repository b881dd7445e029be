// SPDX-License-Identifier: BSD-3-Clause
// Samples in a box that repeats: neighbours, surfaces and meshes across its faces.
#include "common/scalar_field.h"
#include "pipeline/periodic_samples.h"
#include "pipeline/run_pipeline.h"
#include "src/mesh/plane_cut.h"
#include "src/neighbors/periodic_box.h"
#include "support/messages.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

namespace test_periodic_box {

using namespace pcl_uvol;
using namespace uvol_test;

/** Length of the gradient, by central differences. */
double
slopeOf(const Field& field, Place p)
{
  constexpr double step = 1e-4;
  double sum = 0.0;
  for (double& x : p) {
    const double at = x;
    x = at + step;
    const double up = field(p);
    x = at - step;
    sum += std::pow((up - field(p)) / (2.0 * step), 2);
    x = at;
  }
  return std::sqrt(sum);
}

double
depthOf(const Place& p)
{
  double depth = side;
  for (const double x : p)
    depth = std::min({depth, x, side - x});
  return depth;
}

double
areaOf(const IsosurfaceResult& result)
{
  double area = 0.0;
  for (const Triangle& triangle : result.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = Eigen::Vector3d(placeOf(result.surface, triangle[i]).data());
    area += (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2.0;
  }
  return area;
}

TEST(PeriodicBox, ShiftingTheSamplesShiftsTheSurface)
{
  const auto reference =
      runPipeline(makePeriodicSamples(4000, gyroid), makePeriodicParameters(0.25), 1);
  ASSERT_GT(reference.surface.cloud.width, 1000u);
  for (const Place& shift : {Place{{1.25, 3.5, 7.0}}, Place{{-2.0, 0.0, 0.125}}}) {
    const auto moved = runPipeline(
        makePeriodicSamples(4000, gyroid, shift), makePeriodicParameters(0.25), 2);
    ASSERT_EQ(reference.surface.cloud.width, moved.surface.cloud.width);
    const std::size_t step = moved.surface.cloud.point_step;
    for (std::size_t i = 0; i < moved.surface.cloud.width; ++i) {
      const Place from = placeOf(reference.surface, i), to = placeOf(moved.surface, i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_GE(to[axis], 0.0);
        EXPECT_LE(to[axis], side);
        EXPECT_NEAR(
            0.0, std::remainder(to[axis] - from[axis] - shift[axis], side), 4e-6);
      }
      // What follows the coordinates is the same to the last bit.
      EXPECT_TRUE(std::equal(&moved.surface.cloud.data[i * step + 12],
                             &moved.surface.cloud.data[(i + 1) * step - 1],
                             &reference.surface.cloud.data[i * step + 12]));
      EXPECT_EQ(reference.edges[i].first, moved.edges[i].first);
      EXPECT_EQ(reference.edges[i].second, moved.edges[i].second);
    }
  }
}

TEST(PeriodicBox, SurfacesAreAsGoodAtTheFacesAsElsewhere)
{
  const auto samples = makePeriodicSamples(8000, gyroid); // of a spacing of 0.4
  for (const bool smooth : {false, true}) {
    IsosurfacePipelineParameters parameters = makePeriodicParameters(0.25);
    parameters.smooth = smooth;
    const auto rms = [&](const IsosurfaceResult& result, bool at_faces) {
      double sum = 0.0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < result.surface.cloud.width; ++i) {
        const Place place = placeOf(result.surface, i);
        if ((depthOf(place) < 0.2) != at_faces)
          continue;
        sum += std::pow((gyroid(place) - 0.25) / slopeOf(gyroid, place), 2);
        ++count;
      }
      return std::pair(std::sqrt(sum / static_cast<double>(count)), count);
    };
    const auto result = runPipeline(samples, parameters);
    const auto [at_faces, faces] = rms(result, true);
    const auto [within, inner] = rms(result, false);
    EXPECT_LT(at_faces, 1.25 * within) << smooth;
    // The layer is 1 - 0.95^3 of the volume.
    const double part = static_cast<double>(faces) / static_cast<double>(faces + inner);
    EXPECT_NEAR(1.0 - std::pow(0.95, 3), part, 0.02) << smooth;
    EXPECT_GT(result.report.getCount("images"), 3000u);
    if (!smooth) {
      parameters.periodic.setZero();
      const auto cut = runPipeline(samples, parameters);
      EXPECT_GT(rms(cut, true).first, 2.0 * rms(cut, false).first);
    }
  }
}

TEST(PeriodicBox, ASphereOnACornerIsWhole)
{
  constexpr double radius = 2.0;
  const auto samples = makePeriodicSamples(8000, distanceToCorner);
  IsosurfacePipelineParameters parameters = makePeriodicParameters(radius);
  parameters.isosurface.outside = Outside::Higher;
  const auto points = runPipeline(samples, parameters);
  const CloudView view = viewOf(points.surface.cloud);
  const ScalarField x(view.fields, "normal_x"), y(view.fields, "normal_y"),
      z(view.fields, "normal_z");
  Place sum{};
  for (std::size_t i = 0; i < view.count; ++i) {
    EXPECT_NEAR(radius, distanceToCorner(placeOf(points.surface, i)), 0.05);
    sum[0] += x.read(view.point(i));
    sum[1] += y.read(view.point(i));
    sum[2] += z.read(view.point(i));
  }
  for (const double s : sum) // all octants have as many, about
    EXPECT_LT(std::abs(s), 0.1 * static_cast<double>(view.count));

  parameters.mesh.emplace();
  const auto mesh = runPipeline(samples, parameters);
  EXPECT_NEAR(
      4.0 * pi * radius * radius, areaOf(mesh), 0.01 * 4.0 * pi * radius * radius);
  ASSERT_EQ(8u, mesh.pieces.size());
  for (const SurfacePiece& piece : mesh.pieces) {
    EXPECT_EQ(1u, piece.rims);
    EXPECT_EQ(0u, piece.genus);
    EXPECT_EQ(radius, piece.isovalue);
  }
}

TEST(PeriodicBox, MeshesEndInTheFaces)
{
  IsosurfacePipelineParameters parameters = makePeriodicParameters(0.25);
  parameters.mesh.emplace();
  const auto mesh = runPipeline(makePeriodicSamples(6000, gyroid), parameters);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Triangle& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++uses[std::minmax(triangle[i], triangle[(i + 1) % 3])];
  std::size_t rim_edges = 0;
  for (const auto& [edge, count] : uses) {
    EXPECT_LE(count, 2);
    if (count == 2)
      continue;
    ++rim_edges;
    for (const std::uint32_t vertex : {edge.first, edge.second})
      EXPECT_EQ(0.0, depthOf(placeOf(mesh.surface, vertex)));
  }
  EXPECT_GT(rim_edges, 100u);
  // The same surface from a box that is put elsewhere.
  const auto moved =
      runPipeline(makePeriodicSamples(6000, gyroid, {{1.5, 2.5, 4.0}}), parameters);
  EXPECT_NEAR(areaOf(mesh), areaOf(moved), 0.01 * areaOf(mesh));
  EXPECT_EQ(mesh.edges.size(), mesh.surface.cloud.width);
  EXPECT_EQ(mesh.isopoints, std::vector<std::size_t>{mesh.edges.size()});
}

/** A result whose mesh is to be welded. */
IsosurfaceResult
runWelded(const std::shared_ptr<Dataset>& samples,
          IsosurfacePipelineParameters parameters,
          unsigned threads = 0)
{
  parameters.mesh.emplace();
  parameters.periodic_mesh = PeriodicMesh::Weld;
  return runPipeline(samples, parameters, threads);
}

/** Images lie one side of the box from their vertices along the axes that repeat, and
 * have the same values.
 * \return how many there are */
std::size_t
checkImages(const IsosurfaceResult& result, const Eigen::Array3d& sides)
{
  const CloudView view = viewOf(result.surface.cloud);
  const ScalarField image_of(view.fields, "image_of"), f(view.fields, "f"),
      nx(view.fields, "normal_x");
  std::size_t images = 0;
  for (std::size_t i = 0; i < view.count; ++i) {
    const auto vertex = static_cast<std::size_t>(image_of.read(view.point(i)));
    if (vertex == i)
      continue;
    ++images;
    const Place at = placeOf(result.surface, i), from = placeOf(result.surface, vertex);
    SCOPED_TRACE(testing::Message() << "image " << testing::PrintToString(at) << " of "
                                    << testing::PrintToString(from));
    EXPECT_EQ(vertex, image_of.read(view.point(vertex))); // itself
    EXPECT_EQ(f.read(view.point(vertex)), f.read(view.point(i)));
    EXPECT_EQ(nx.read(view.point(vertex)), nx.read(view.point(i)));
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_TRUE(at[axis] == from[axis] ||
                  std::abs(at[axis] - from[axis]) == sides[static_cast<int>(axis)]);
  }
  return images;
}

TEST(PeriodicBox, WeldedMeshesCloseAcrossTheFaces)
{
  struct Surface {
    Field field;
    double isovalue;
    std::vector<std::uint32_t> genus;
  };
  const auto sheets = [](const Place& p) {
    return std::cos(2.0 * pi * p[2] / side) +
           0.2 * std::sin(2.0 * pi * (p[0] + p[1]) / side);
  };
  // The gyroid has eight saddles in its cube; two sheets are tori; of the sphere on a
  // corner eight parts are one.
  const Surface surfaces[] = {{gyroid, 0.0, {5}},
                              {gyroid, 0.4, {5}},
                              {sheets, 0.3, {1, 1}},
                              {distanceToCorner, 2.0, {0}},
                              {distanceToCorner, 3.3, {0}}};
  // At an eighth of the side the gyroid has saddles in the faces: any line would do
  // there.
  for (const Surface& surface : surfaces)
    for (const Place& shift :
         {Place{}, Place{{1.5, 2.5, 4.0}}, Place{{6.7, 0.25, 3.2}}}) {
      const auto samples = makePeriodicSamples(5000, surface.field, shift);
      const auto result = runWelded(samples, makePeriodicParameters(surface.isovalue));
      SCOPED_TRACE(testing::Message() << surface.isovalue << " moved by " << shift[0]);
      ASSERT_EQ(surface.genus.size(), result.pieces.size());
      for (std::size_t i = 0; i < surface.genus.size(); ++i) {
        EXPECT_EQ(surface.genus[i], result.pieces[i].genus);
        EXPECT_EQ(0u, result.pieces[i].rims);
      }
      EXPECT_GT(checkImages(result, Eigen::Array3d::Constant(side)), 30u);
      for (const Message& warning : result.report.warnings)
        EXPECT_NE("edges_without_image", warning.code) << warning;
    }
}

TEST(PeriodicBox, WeldingKeepsTheSurface)
{
  const auto samples = makePeriodicSamples(8000, gyroid);
  IsosurfacePipelineParameters parameters = makePeriodicParameters(0.1);
  const auto welded = runWelded(samples, parameters);
  parameters.mesh.emplace();
  const auto cut = runPipeline(samples, parameters);
  EXPECT_NEAR(areaOf(cut), areaOf(welded), 1e-3 * areaOf(cut));
  const CloudView view = viewOf(welded.surface.cloud);
  for (std::size_t i = 0; i < view.count; ++i) // deviation over a slope of about 1
    EXPECT_NEAR(0.1, gyroid(placeOf(welded.surface, i)), 0.02);
}

TEST(PeriodicBox, WeldedMeshesAreTheSameOnAnyThreads)
{
  const auto samples = makePeriodicSamples(6000, gyroid);
  const auto one = runWelded(samples, makePeriodicParameters(0.1), 1),
             three = runWelded(samples, makePeriodicParameters(0.1), 3);
  EXPECT_EQ(one.surface.cloud.data, three.surface.cloud.data);
  EXPECT_EQ(one.triangles, three.triangles);
}

TEST(PeriodicBox, OfSeveralIsovaluesAndAlongOneAxisMeshesAreWelded)
{
  IsosurfacePipelineParameters parameters = makePeriodicParameters(-0.2);
  parameters.isosurface.isovalues.push_back(-0.25); // a tenth of a spacing beside it
  const auto both = runWelded(makePeriodicSamples(8000, gyroid), parameters);
  ASSERT_EQ(2u, both.pieces.size());
  for (const SurfacePiece& piece : both.pieces) {
    EXPECT_EQ(5u, piece.genus);
    EXPECT_EQ(0u, piece.rims);
  }
  // A tube along x, closed by the faces alone.
  const auto tube = [](const Place& p) {
    return std::hypot(p[1] - 4.0, p[2] - 4.0) - 0.3 * std::sin(2.0 * pi * p[0] / side);
  };
  parameters = makePeriodicParameters(2.0);
  parameters.isosurface.outside = Outside::Higher;
  parameters.periodic << side, 0.0, 0.0;
  const auto torus = runWelded(makePeriodicSamples(8000, tube), parameters);
  ASSERT_EQ(1u, torus.pieces.size());
  EXPECT_EQ(1u, torus.pieces[0].genus);
  EXPECT_EQ(0u, torus.pieces[0].rims);
  checkImages(torus, parameters.periodic);
}

TEST(PeriodicBox, WhatCannotBeWeldedIsReported)
{
  // Noise of the size of the surface itself: rims differ by more than samples do.
  auto samples = makePeriodicSamples(3000, [](const Place& p) {
    return gyroid(p) +
           normalAt(3, static_cast<std::uint64_t>(1e6 * (p[0] + 11 * p[1])), 0);
  });
  const auto result = runWelded(samples, makePeriodicParameters(0.0));
  std::size_t rims = 0;
  for (const SurfacePiece& piece : result.pieces)
    rims += piece.rims;
  const auto told = findWarning(result, "edges_without_image");
  EXPECT_GT(rims, 0u);
  ASSERT_TRUE(told);
  EXPECT_GT(numberOf(*told, "left"), 0.0);
  EXPECT_LE(numberOf(*told, "left"), numberOf(*told, "edges"));
  checkImages(result, Eigen::Array3d::Constant(side));

  IsosurfacePipelineParameters parameters = makePeriodicParameters(0.0);
  parameters.periodic_mesh = PeriodicMesh::Weld;
  EXPECT_THROW(runPipeline(samples, parameters), InvalidArgument);
  parameters.mesh.emplace();
  parameters.periodic.setZero();
  EXPECT_THROW(runPipeline(samples, parameters), InvalidArgument);
}

/** Squared distances of the nearest samples among all images, by brute force. */
std::vector<double>
findNearest(const Dataset& samples, std::size_t i, const Place& sides, std::size_t k)
{
  const Place center = placeOf(samples, i);
  std::vector<double> found;
  for (std::size_t j = 0; j < samples.cloud.width; ++j)
    for (int shift = 0; shift < 27; ++shift) {
      const std::array<int, 3> by{{shift % 3 - 1, shift / 3 % 3 - 1, shift / 9 - 1}};
      double sum = 0.0;
      bool is_image = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        is_image = is_image && (by[axis] == 0 || sides[axis] > 0.0);
        sum += std::pow(
            placeOf(samples, j)[axis] + by[axis] * sides[axis] - center[axis], 2);
      }
      if (is_image)
        found.push_back(sum);
    }
  std::sort(found.begin(), found.end());
  found.resize(k);
  return found;
}

TEST(PeriodicBox, ImagesHoldAllNeighbors)
{
  const auto samples = makePeriodicSamples(300, gyroid);
  std::vector<std::uint32_t> use(300);
  std::iota(use.begin(), use.end(), 0u);
  Report report;
  for (const Place& sides : {Place{{side, side, side}}, Place{{side, 0.0, side}}}) {
    const PeriodicBox box = findPeriodicBox(*samples, sides, report);
    const PeriodicSamples images = addPeriodicImages(*samples, use, box, {}, 2, report);
    ASSERT_EQ(300u, images.countOwn());
    for (std::size_t i = 0; i < images.samples.cloud.width; ++i)
      EXPECT_EQ(placeOf(*samples, images.sourceOf(static_cast<std::uint32_t>(i)))[1],
                sides[1] > 0.0 ? std::fmod(placeOf(images.samples, i)[1] + side, side)
                               : placeOf(images.samples, i)[1]);
    for (std::size_t i = 0; i < 300; i += 7) {
      std::vector<double> found;
      for (std::size_t j = 0; j < images.samples.cloud.width; ++j) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum += std::pow(
              placeOf(images.samples, j)[axis] - placeOf(images.samples, i)[axis], 2);
        found.push_back(sum);
      }
      std::sort(found.begin(), found.end());
      const auto expected = findNearest(*samples, i, sides, 64);
      for (std::size_t j = 0; j < expected.size(); ++j)
        EXPECT_NEAR(expected[j], found[j], 1e-9);
    }
  }
  EXPECT_TRUE(report.warnings.empty());
}

TEST(PeriodicBox, CountsAreThoseOfTheSamples)
{
  const auto samples = makePeriodicSamples(3000, gyroid);
  const std::size_t step = samples->cloud.point_step;
  // One sample in the corner that comes five hundred times, as its seven images do.
  for (std::size_t axis = 0; axis < 3; ++axis)
    putCoordinate(0.01, axis, samples->cloud.data.data());
  resizePoints(samples->cloud, 3500);
  for (std::size_t i = 3000; i < 3500; ++i)
    std::copy_n(&samples->cloud.data[0], step, &samples->cloud.data[i * step]);
  const auto result = runPipeline(samples, makePeriodicParameters(0.1));
  EXPECT_EQ(3000u, result.report.getCount("samples"));
  EXPECT_EQ(500u, result.report.getCount("duplicates"));
}

TEST(PeriodicBox, LiesWhereTheSamplesDo)
{
  Report report;
  const auto low_of = [&](double move, double room) {
    auto samples = makePeriodicSamples(200, gyroid);
    for (std::size_t i = 0; i < 200; ++i)
      putCoordinate(placeOf(*samples, i)[0] * room + move,
                    0,
                    &samples->cloud.data[i * samples->cloud.point_step]);
    return findPeriodicBox(*samples, {{side, 0.0, 0.0}}, report).low[0];
  };
  EXPECT_EQ(0.0, low_of(0.0, 1.0));
  EXPECT_EQ(0.0, low_of(-0.01, 1.0)); // a step outside
  EXPECT_EQ(-side / 2.0, low_of(-side / 2.0, 1.0));
  EXPECT_NEAR(100.0, low_of(100.0, 1.0), 0.1); // at the lowest
  EXPECT_EQ(0.0, low_of(-20.0, 5.0));          // out of all boxes
  EXPECT_GT(report.getCount("moved_into_box"), 100u);
  ASSERT_EQ(1u, report.warnings.size());
  EXPECT_EQ("samples_beyond_box", report.warnings[0].code);
  EXPECT_EQ("x", wordOf(report.warnings[0], "axis"));
  low_of(0.0, 0.5);
  ASSERT_EQ(2u, report.warnings.size());
  EXPECT_EQ("unfilled_box", report.warnings[1].code);
  EXPECT_EQ(side, numberOf(report.warnings[1], "side"));
}

TEST(PeriodicBox, IsRefusedWhereItIsNone)
{
  const auto samples = makePeriodicSamples(200, gyroid);
  for (const double bad : {-1.0,
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    IsosurfacePipelineParameters parameters = makePeriodicParameters(0.0);
    parameters.periodic[1] = bad;
    EXPECT_THROW(runPipeline(samples, parameters), InvalidArgument);
  }
  IsosurfacePipelineParameters parameters = makePeriodicParameters(0.0);
  parameters.validation.folds = 3;
  EXPECT_THROW(runPipeline(samples, parameters), InvalidArgument);
}

TEST(PlaneCut, KeepsWhatIsAbove)
{
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 3}};
  // Two quadrangles, which share the vertex on their common edge.
  const auto cut = detail::cutByPlane({3.0, -1.0, 1.0, 1.0}, triangles);
  ASSERT_EQ(4u, cut.triangles.size());
  ASSERT_EQ(6u, cut.vertices.size());
  std::size_t between = 0;
  for (const IsoEdge& vertex : cut.vertices)
    if (vertex.first != vertex.second) {
      ++between;
      EXPECT_EQ(1u, vertex.second);
      EXPECT_EQ(vertex.first == 0 ? 0.75f : 0.5f, vertex.t);
    }
  EXPECT_EQ(3u, between);
}

TEST(PlaneCut, TakesVerticesInThePlaneAsTheyAre)
{
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  EXPECT_TRUE(detail::cutByPlane({0.0, 0.0, -1.0}, triangles).triangles.empty());
  EXPECT_TRUE(detail::cutByPlane({0.0, -1.0, -1.0}, triangles).triangles.empty());
  const auto half = detail::cutByPlane({0.0, 1.0, -1.0}, triangles);
  EXPECT_EQ(1u, half.triangles.size());
  EXPECT_EQ(3u, half.vertices.size());
  const auto whole = detail::cutByPlane({0.0, 0.0, 1.0}, triangles);
  EXPECT_EQ((std::vector<Triangle>{{0, 1, 2}}), whole.triangles);
}

} // namespace test_periodic_box
