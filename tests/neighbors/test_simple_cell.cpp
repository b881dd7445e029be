// SPDX-License-Identifier: BSD-3-Clause
// Cells kept as triangles of their faces, their parts, and the hole of the
// triangulation below them, against cells of polygons, cubes, and counted and moved
// places.
#include "common/random.h"
#include "src/neighbors/cell_parts.h"
#include "src/neighbors/delaunay_cavity.h"
#include "src/neighbors/voronoi_cell.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace test_simple_cell {

using namespace pcl_uvol;
using namespace pcl_uvol::detail;
using Eigen::Vector3d;

SampleSet::ConstPtr
buildSamples(const std::vector<Position>& positions)
{
  std::vector<std::uint32_t> use(positions.size());
  std::iota(use.begin(), use.end(), 0u);
  Report report;
  return SampleSet::build(
      positions.front().x, 3, use, Position{{1.0f, 1.0f, 1.0f}}, 1, report);
}

SampleSet::ConstPtr
buildRandomSamples(std::size_t n, std::uint64_t seed)
{
  std::vector<Position> positions(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int axis = 0; axis < 3; ++axis)
      positions[i][axis] =
          static_cast<float>(uniformAt(seed, i, static_cast<std::uint64_t>(axis)));
  return buildSamples(positions);
}

/** Height of the layers of nodes over a wall. */
double
heightOfLayer(int layer)
{
  return 1e-3 * (std::pow(1.1, layer) - 1.0);
}

constexpr int num_layers = 60;

/** Nodes of a structured grid over a wall, a thousand times as far apart along it as
 * across.
 * \param bend how much the wall rises */
SampleSet::ConstPtr
buildLayers(double bend)
{
  std::vector<Position> positions;
  for (int layer = 0; layer < num_layers; ++layer)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) {
        const double x = i / 10.0, y = j / 10.0;
        positions.push_back(
            {{static_cast<float>(x),
              static_cast<float>(y),
              static_cast<float>(heightOfLayer(layer) + bend * x * x)}});
      }
  return buildSamples(positions);
}

/** A place in the lower layers. */
Query
placeInLayers(const SampleSet& samples, double bend, std::uint64_t index)
{
  const double factor = static_cast<double>(samples.getUnit().factor),
               x = 0.3 + 0.5 * uniformAt(10, index, 0),
               y = 0.3 + 0.5 * uniformAt(10, index, 1),
               z = heightOfLayer(num_layers / 2) * uniformAt(10, index, 2);
  return {{factor * x, factor * y, factor * (z + bend * x * x)}};
}

Query
randomPlace(const SampleSet& samples, std::uint64_t index)
{
  const double factor = static_cast<double>(samples.getUnit().factor);
  Query place;
  for (int axis = 0; axis < 3; ++axis)
    place.x[axis] =
        factor * (0.2 + 0.6 * uniformAt(9, index, static_cast<std::uint64_t>(axis)));
  return place;
}

void
startAround(CellSearch& search,
            const SampleSet& samples,
            const Query& place,
            std::size_t near)
{
  std::vector<std::uint32_t> all(samples.size());
  std::iota(all.begin(), all.end(), 0u);
  std::sort(all.begin(), all.end(), [&](auto a, auto b) {
    return sqDistance(place, samples.getPositions()[a]) <
           sqDistance(place, samples.getPositions()[b]);
  });
  search.start(place, CellSearch::no_sample, all.data(), std::min(near, all.size()));
}

struct Measured {
  explicit Measured(const SimpleCell& cell)
      : ratios(cell.getNumFaces())
      , moments(cell.getNumFaces())
      , is_closed(cell.measureFaces(ratios.data(), moments.data()))
  {
  }

  std::vector<double> ratios;
  std::vector<Vector3d> moments;
  bool is_closed;
};

TEST(SimpleCell, IsACubeFirst)
{
  SimpleCell cell;
  cell.start(2.0);
  EXPECT_EQ(6u, cell.getNumFaces());
  EXPECT_EQ(8u, cell.getNumVertices());
  EXPECT_EQ(12.0, cell.getSqReach());
  EXPECT_TRUE(cell.isOnFaceOf(3, CellSearch::no_sample));
}

/** A box of 2 x 4 x 6 about the origin: areas by distances, with their centroids. */
TEST(SimpleCell, MeasuresFaces)
{
  SimpleCell cell;
  cell.start(100.0);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      EXPECT_EQ(SimpleCell::Cut::Part,
                cell.cut(side * 2.0 * (axis + 1) * Vector3d::Unit(axis),
                         static_cast<std::uint32_t>(axis)));
  EXPECT_EQ(SimpleCell::Cut::Nothing, cell.cut(Vector3d(9.0, 9.0, 9.0), 6));
  cell.dropEmptyFaces();
  ASSERT_EQ(6u, cell.getNumFaces());
  ASSERT_EQ(8u, cell.getNumVertices());
  EXPECT_NEAR(14.0, cell.getSqReach(), 1e-13);
  const Measured measured(cell);
  ASSERT_TRUE(measured.is_closed);
  const double areas[] = {24.0, 12.0, 8.0};
  for (std::size_t face = 0; face < 6; ++face) {
    const SimpleCell::Face& plane = cell.getFace(face);
    const double ratio = areas[plane.sample] / plane.length;
    EXPECT_NEAR(ratio, measured.ratios[face], 1e-13);
    EXPECT_LT((measured.moments[face] - 0.5 * ratio * plane.offset).norm(), 1e-12);
  }
}

TEST(SimpleCell, IsUndecidedForPlanesThroughVertices)
{
  SimpleCell cell;
  for (const double off : {-1e-13, 0.0, 1e-13}) {
    cell.start(1.0);
    // The bisector passes through the vertex (1, 1, 1), and three others.
    EXPECT_EQ(SimpleCell::Cut::Undecided, cell.cut({2.0 + off, 0.0, 0.0}, 0));
  }
  cell.start(1.0);
  EXPECT_EQ(SimpleCell::Cut::Part, cell.cut({1.99, 0.0, 0.0}, 0));
  cell.start(1.0);
  EXPECT_EQ(SimpleCell::Cut::Nothing, cell.cut({2.01, 0.0, 0.0}, 0));
}

/** Planes through one vertex of the cube, but for rounding and a little more: whatever
 * is taken to be over them, the cell is closed, and below all of them. */
TEST(SimpleCell, StaysClosedWhereManyPlanesMeet)
{
  const Vector3d vertex(1.0, 1.0, 1.0);
  for (const double noise : {0.0, 1e-15, 1e-11, 1e-10, 1e-6})
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
      SimpleCell cell;
      cell.start(1.0, SimpleCell::Ties::Keep);
      std::vector<SimpleCell::Face> planes;
      for (std::uint32_t i = 0; i < 40; ++i) {
        // Nearly parallel ones, some of them.
        Vector3d normal;
        for (int axis = 0; axis < 3; ++axis)
          normal[axis] = 0.01 + uniformAt(trial, i, static_cast<std::uint64_t>(axis));
        if (i % 2 == 1)
          normal = planes.back().offset + 1e-5 * normal;
        const double limit =
            normal.dot(vertex) + noise * (uniformAt(trial, i, 3) - 0.5);
        ASSERT_NE(SimpleCell::Cut::Undecided, cell.cut(normal, limit, i));
        planes.push_back({normal, limit, normal.norm(), i});
      }
      cell.dropEmptyFaces();
      EXPECT_EQ(2 * cell.getNumFaces() - 4, cell.getNumVertices());
      EXPECT_GT(cell.computeVolume(), 0.0);
      for (std::size_t v = 0; v < cell.getNumVertices(); ++v)
        for (const SimpleCell::Face& plane : planes)
          EXPECT_LT(plane.offset.dot(cell.getVertex(v)) - plane.limit, 1e-9);
    }
}

/** Bisectors of places on a sphere, each of which leaves a face: more than there is
 * room for in the beginning. */
TEST(SimpleCell, HasRoomForManyFaces)
{
  constexpr std::size_t count = 500;
  SimpleCell cell;
  cell.start(10.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / count,
                 angle = 2.4 * static_cast<double>(i), r = std::sqrt(1.0 - z * z);
    ASSERT_EQ(SimpleCell::Cut::Part,
              cell.cut({r * std::cos(angle), r * std::sin(angle), z},
                       static_cast<std::uint32_t>(i)));
  }
  cell.dropEmptyFaces();
  EXPECT_EQ(count, cell.getNumFaces());
  EXPECT_EQ(2 * count - 4, cell.getNumVertices());
  const Measured measured(cell);
  EXPECT_TRUE(measured.is_closed);
  double volume = 0.0;
  for (const double area : measured.ratios) // distances and heights are 1 and 1/2
    volume += area / 6.0;
  EXPECT_NEAR(volume, cell.computeVolume(), 1e-13);
}

/** No sample is nearer to a vertex of a cell than its place is: true of cells and of
 * nothing larger. */
TEST(VoronoiCellFinder, EndsWhereTheNearestSamplesDo)
{
  const auto samples = buildRandomSamples(1000, 2);
  CellSearch search(*samples);
  VoronoiCellFinder finder;
  for (const std::size_t near : {1, 4, 16, 64})
    for (std::uint64_t i = 0; i < 30; ++i) {
      startAround(search, *samples, randomPlace(*samples, i), near);
      ASSERT_TRUE(finder.find(search));
      finder.forFaces([&](const CellFace& face) {
        for (std::size_t k = 0; k < face.polygon.size(); ++k) {
          const Vector3d vertex = face.plane.placeOf(face.polygon[k]);
          for (std::uint32_t sample = 0; sample < samples->size(); ++sample)
            ASSERT_GE((search.offsetOf(sample) - vertex).squaredNorm(),
                      (1.0 - 1e-9) * vertex.squaredNorm())
                << near;
        }
      });
    }
}

/** The same faces as by polygons, whatever the cell begins with. */
TEST(SimpleCellFinder, FindsTheCellsOfPolygons)
{
  const auto samples = buildRandomSamples(3000, 1);
  CellSearch search(*samples);
  SimpleCellFinder simple;
  VoronoiCellFinder polygons;
  std::size_t found = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    startAround(search, *samples, randomPlace(*samples, i), i % 3 == 0 ? 4 : 60);
    ASSERT_TRUE(polygons.find(search));
    if (!simple.find(search))
      continue;
    ++found;
    std::map<std::uint32_t, std::pair<double, Vector3d>> expected;
    polygons.forFaces([&](const CellFace& face) {
      const std::uint32_t sample =
          polygons.getNeighbors()[static_cast<std::size_t>(face.tag)];
      const PolygonMoments moments = face.polygon.computeMoments();
      const double ratio = moments.area / search.offsetOf(sample).norm();
      expected[sample] = {ratio, ratio * face.plane.placeOf(moments.centroid)};
    });
    const SimpleCell& cell = simple.getCell();
    ASSERT_EQ(expected.size(), cell.getNumFaces());
    const double size = polygons.getReach();
    EXPECT_NEAR(size * size, cell.getSqReach(), 1e-11 * size * size);
    const Measured measured(cell);
    ASSERT_TRUE(measured.is_closed);
    for (std::size_t face = 0; face < cell.getNumFaces(); ++face) {
      const auto& [ratio, moment] = expected.at(cell.getFace(face).sample);
      EXPECT_NEAR(ratio, measured.ratios[face], 1e-10 * size);
      EXPECT_LT((moment - measured.moments[face]).norm(), 1e-10 * size * size);
    }
  }
  EXPECT_GT(found, 295u);
}

/** Also where four nodes are on a circle, and faces are hundreds. */
TEST(SimpleCellFinder, FindsAnyCellOfPolygons)
{
  SimpleCellFinder simple;
  VoronoiCellFinder polygons;
  std::size_t most_faces = 0;
  for (const double bend : {0.0, 0.2}) {
    const auto samples = buildLayers(bend);
    CellSearch search(*samples);
    for (std::uint64_t i = 0; i < 10; ++i) {
      startAround(search, *samples, placeInLayers(*samples, bend, i), 60);
      ASSERT_TRUE(polygons.find(search));
      ASSERT_TRUE(simple.findAny(search));
      std::map<std::uint32_t, double> differences;
      polygons.forFaces([&](const CellFace& face) {
        const std::uint32_t sample =
            polygons.getNeighbors()[static_cast<std::size_t>(face.tag)];
        differences[sample] =
            face.polygon.computeMoments().area / search.offsetOf(sample).norm();
      });
      const SimpleCell& cell = simple.getCell();
      EXPECT_EQ(2 * cell.getNumFaces() - 4, cell.getNumVertices());
      EXPECT_LE(simple.getTried().size(), 60 + 1.2 * cell.getNumFaces());
      most_faces = std::max(most_faces, cell.getNumFaces());
      const Measured measured(cell);
      EXPECT_TRUE(measured.is_closed);
      for (std::size_t face = 0; face < cell.getNumFaces(); ++face)
        differences[cell.getFace(face).sample] -= measured.ratios[face];
      double sum = 0.0;
      for (const double ratio : measured.ratios)
        sum += ratio;
      for (const auto& [sample, difference] : differences)
        EXPECT_NEAR(0.0, difference, 1e-9 * sum) << sample;
    }
  }
  EXPECT_GT(most_faces, 100u);
}

TEST(SimpleCellFinder, FindsThatACellIsOpen)
{
  const auto samples = buildLayers(0.0);
  CellSearch search(*samples);
  SimpleCellFinder finder;
  for (const double depth : {1e-4, 1e-2}) {
    Query place = placeInLayers(*samples, 0.0, 1);
    place.x[2] = -depth * static_cast<double>(samples->getUnit().factor);
    startAround(search, *samples, place, 60);
    EXPECT_FALSE(finder.findAny(search));
    place.x[2] *= -1.0;
    startAround(search, *samples, place, 60);
    EXPECT_TRUE(finder.findAny(search));
  }
}

TEST(SimpleCellFinder, LeavesOpenCellsAndLatticesToPolygons)
{
  std::vector<Position> lattice;
  lattice.reserve(512);
  for (int i = 0; i < 512; ++i)
    lattice.push_back({{static_cast<float>(i % 8),
                        static_cast<float>(i / 8 % 8),
                        static_cast<float>(i / 8 / 8 % 8)}});
  const auto samples = buildSamples(lattice);
  CellSearch search(*samples);
  SimpleCellFinder finder;
  const double unit = static_cast<double>(samples->getUnit().factor);
  for (const Vector3d& place :
       {Vector3d(3.5, 3.5, 3.5), Vector3d(3.2, 3.6, 3.7), Vector3d(-1.0, 3.2, 3.4)}) {
    startAround(
        search, *samples, {{unit * place.x(), unit * place.y(), unit * place.z()}}, 60);
    EXPECT_FALSE(finder.find(search)) << place.transpose();
  }
}

/** Four samples around the place, in whose one tetrahedron's sphere it lies: the cell
 * takes a corner of each one's. */
TEST(DelaunayCavity, OfOneTetrahedron)
{
  const Vector3d corners[] = {Vector3d(1.0, 1.0, 1.0),
                              Vector3d(1.1, -1.0, -1.0),
                              Vector3d(-1.0, 1.2, -1.0),
                              Vector3d(-1.0, -1.0, 1.3)};
  SimpleCell cell;
  cell.start(100.0);
  for (std::uint32_t i = 0; i < 4; ++i)
    ASSERT_EQ(SimpleCell::Cut::Part, cell.cut(corners[i], i));
  cell.dropEmptyFaces();
  ASSERT_EQ(4u, cell.getNumFaces());
  const Measured measured(cell);
  ASSERT_TRUE(measured.is_closed);
  DelaunayCavity cavity;
  std::array<double, 4> volumes;
  ASSERT_TRUE(cavity.measure(cell, measured.ratios.data(), volumes.data()));
  // Sibson's coordinates are the barycentric ones, scaled by the cell's volume.
  Eigen::Matrix4d system;
  double volume = 0.0;
  for (std::size_t face = 0; face < 4; ++face) {
    const SimpleCell::Face& plane = cell.getFace(face);
    system.col(static_cast<Eigen::Index>(face)) << plane.offset, 1.0;
    volume += measured.ratios[face] * plane.length * plane.length / 6.0;
  }
  const Eigen::Vector4d weights =
      system.inverse() * Eigen::Vector4d(0.0, 0.0, 0.0, volume);
  for (std::size_t face = 0; face < 4; ++face)
    EXPECT_NEAR(
        weights[static_cast<Eigen::Index>(face)], volumes[face], 1e-12 * volume);
}

/** The parts that the boundaries between the samples' cells, cut to the place's cell,
 * enclose: by areas of polygons, each of which is cut by all others. */
void
expectPartsOfPolygons(const SimpleCell& cell,
                      const Measured& measured,
                      const std::vector<double>& volumes)
{
  const std::size_t count = cell.getNumFaces();
  ConvexPolygon polygon;
  double volume = 0.0;
  std::vector<double> expected;
  for (std::size_t a = 0; a < count; ++a) {
    const SimpleCell::Face& own = cell.getFace(a);
    double part = measured.ratios[a] * own.limit / 3.0;
    volume += part;
    for (std::size_t b = 0; b < count; ++b) {
      if (b == a)
        continue;
      const SimpleCell::Face& other = cell.getFace(b);
      const CellPlane plane(other.offset - own.offset, other.limit - own.limit);
      polygon.start(10.0 * std::sqrt(cell.getSqReach()) + std::abs(plane.height));
      for (std::size_t c = 0; c < count && polygon.size() > 0; ++c) {
        plane.cut(polygon, cell.getFace(c).offset, cell.getFace(c).limit, 0.0);
        if (c != a && c != b && polygon.size() > 0)
          plane.cut(polygon,
                    cell.getFace(c).offset - own.offset,
                    cell.getFace(c).limit - own.limit,
                    0.0);
      }
      part += plane.height * polygon.computeMoments().area / 3.0;
    }
    expected.push_back(part);
  }
  for (std::size_t a = 0; a < count; ++a)
    EXPECT_NEAR(expected[a], volumes[a], 1e-9 * volume + 1e-9 * std::abs(expected[a]));
}

TEST(DelaunayCavity, MeasuresThePartsOfPolygons)
{
  const auto samples = buildRandomSamples(3000, 2);
  CellSearch search(*samples);
  SimpleCellFinder finder;
  DelaunayCavity cavity;
  CellParts parts;
  for (std::uint64_t i = 0; i < 100; ++i) {
    startAround(search, *samples, randomPlace(*samples, i), 60);
    if (!finder.find(search))
      continue;
    const SimpleCell& cell = finder.getCell();
    const Measured measured(cell);
    ASSERT_TRUE(measured.is_closed);
    std::vector<double> volumes(cell.getNumFaces());
    ASSERT_TRUE(cavity.measure(cell, measured.ratios.data(), volumes.data()));
    expectPartsOfPolygons(cell, measured, volumes);
    std::fill(volumes.begin(), volumes.end(), -1.0);
    parts.measure(cell, volumes.data());
    expectPartsOfPolygons(cell, measured, volumes);
  }
}

/** Sibson's identity: the volumes balance at the place. */
TEST(CellParts, FillTheCellAmongLayers)
{
  SimpleCellFinder finder;
  CellParts parts;
  for (const double bend : {0.0, 0.2}) {
    const auto samples = buildLayers(bend);
    CellSearch search(*samples);
    for (std::uint64_t i = 0; i < 30; ++i) {
      startAround(search, *samples, placeInLayers(*samples, bend, i), 60);
      ASSERT_TRUE(finder.findAny(search));
      const SimpleCell& cell = finder.getCell();
      std::vector<double> volumes(cell.getNumFaces());
      parts.measure(cell, volumes.data());
      const double volume = cell.computeVolume();
      double sum = 0.0, farthest = 0.0;
      Vector3d moment = Vector3d::Zero();
      for (std::size_t face = 0; face < volumes.size(); ++face) {
        EXPECT_GE(volumes[face], 0.0);
        sum += volumes[face];
        moment += volumes[face] * cell.getFace(face).offset;
        farthest = std::max(farthest, cell.getFace(face).length);
      }
      EXPECT_NEAR(volume, sum, 1e-11 * volume);
      EXPECT_LT(moment.norm(), 1e-11 * volume * farthest);
      if (i < 2)
        expectPartsOfPolygons(cell, Measured(cell), volumes);
    }
  }
}

/** A cell that is no Voronoi cell of these samples has no hole below it. */
TEST(DelaunayCavity, NoticesWrongCells)
{
  const auto samples = buildRandomSamples(3000, 3);
  CellSearch search(*samples);
  startAround(search, *samples, randomPlace(*samples, 5), 60);
  SimpleCellFinder finder;
  ASSERT_TRUE(finder.find(search));
  const SimpleCell& cell = finder.getCell();
  const Measured measured(cell);
  ASSERT_TRUE(measured.is_closed);
  DelaunayCavity cavity;
  std::vector<double> volumes(cell.getNumFaces());
  ASSERT_TRUE(cavity.measure(cell, measured.ratios.data(), volumes.data()));
  auto ratios = measured.ratios;
  ratios[0] *= 1.0 + 1e-6;
  EXPECT_FALSE(cavity.measure(cell, ratios.data(), volumes.data()));
  // All parts grow alike, so that they still balance; only their sum tells.
  ASSERT_TRUE(cavity.measure(cell, measured.ratios.data(), volumes.data()));
  ratios = measured.ratios;
  for (std::size_t face = 0; face < cell.getNumFaces(); ++face)
    ratios[face] += 6e-6 * volumes[face] / cell.getFace(face).offset.squaredNorm();
  EXPECT_FALSE(cavity.measure(cell, ratios.data(), volumes.data()));
}

} // namespace test_simple_cell
