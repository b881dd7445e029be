// SPDX-License-Identifier: BSD-3-Clause
// Distance fields of meshes against the distances to their triangles.
#include "multivariate/mesh_distance.h"
#include "support/meshes.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test_mesh_distance {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using pcl_uvol::distanceToMesh;
using pcl_uvol::GridCell;
using pcl_uvol::GridShape;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Mesh;
using pcl_uvol::Report;
using pcl_uvol::Triangle;

/** Between the centre of a marked cell and the mesh along an axis, and sideways. */
const double cell_diagonal = std::sqrt(3.0);

/** Cells of side 1. */
GridShape
unitCells(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  GridShape shape;
  shape.cells = {{x, y, z}};
  return shape;
}

void
addVertex(Mesh& mesh, const Vector3d& place)
{
  const Eigen::Vector3f vertex = place.cast<float>();
  mesh.vertices.push_back({{vertex[0], vertex[1], vertex[2]}});
}

/** A box of two triangles per side. */
Mesh
makeBox(const Vector3d& center, const Vector3d& half_sides, const Matrix3d& rotation)
{
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    addVertex(mesh,
              center + rotation * Vector3d((corner & 1) != 0 ? 1.0 : -1.0,
                                           (corner & 2) != 0 ? 1.0 : -1.0,
                                           (corner & 4) != 0 ? 1.0 : -1.0)
                                      .cwiseProduct(half_sides));
  mesh.triangles = {{{0, 2, 3}},
                    {{0, 3, 1}},
                    {{4, 5, 7}},
                    {{4, 7, 6}},
                    {{0, 1, 5}},
                    {{0, 5, 4}},
                    {{2, 6, 7}},
                    {{2, 7, 3}},
                    {{0, 4, 6}},
                    {{0, 6, 2}},
                    {{1, 3, 7}},
                    {{1, 7, 5}}};
  return mesh;
}

/** A sphere by meridians and parallels, with triangles of very different sizes. */
Mesh
makeSphere(const Vector3d& center, double radius, std::uint32_t steps)
{
  constexpr double pi = 3.14159265358979323846;
  Mesh mesh;
  addVertex(mesh, center + radius * Vector3d::UnitZ());
  for (std::uint32_t i = 1; i < steps; ++i)
    for (std::uint32_t j = 0; j < 2 * steps; ++j) {
      const double polar = pi * i / steps, around = pi * j / steps;
      addVertex(mesh,
                center + radius * Vector3d(std::sin(polar) * std::cos(around),
                                           std::sin(polar) * std::sin(around),
                                           std::cos(polar)));
    }
  addVertex(mesh, center - radius * Vector3d::UnitZ());
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i == 0 ? 0 : i == steps ? last : 1 + (i - 1) * 2 * steps + j % (2 * steps);
  };
  for (std::uint32_t i = 0; i < steps; ++i)
    for (std::uint32_t j = 0; j < 2 * steps; ++j) {
      if (i + 1 < steps)
        mesh.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      if (i > 0)
        mesh.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  return mesh;
}

std::vector<float>
distancesTo(const GridShape& shape, const Mesh& mesh, unsigned threads = 0)
{
  Report report;
  return distanceToMesh(shape, mesh, threads, report);
}

Vector3d
centerOf(const GridShape& shape, std::uint64_t cell)
{
  const auto center = shape.centerOf(shape.cellOf(cell));
  return {center[0], center[1], center[2]};
}

/** Each cell outside as far as it is, the cells well inside 0.
 * \param isInside of a place
 * \param unit side of a cell */
template <typename IsInside>
void
expectDistances(const GridShape& shape,
                const Mesh& mesh,
                double unit,
                const IsInside& isInside)
{
  const auto distances = distancesTo(shape, mesh);
  ASSERT_EQ(shape.size(), distances.size());
  std::size_t wrong = 0, inside = 0;
  double largest_error = 0.0;
  for (std::uint64_t cell = 0; cell < shape.size(); ++cell) {
    const Vector3d place = centerOf(shape, cell);
    if (isInside(place)) {
      wrong += distances[cell] != 0.0f;
      ++inside;
      continue;
    }
    const double error =
        std::abs(distances[cell] - uvol_test::distanceToTriangles(mesh, place));
    largest_error = std::max(largest_error, error / unit);
  }
  EXPECT_GT(inside, 0u);
  EXPECT_EQ(0u, wrong) << "cells inside that are not 0, of " << inside;
  EXPECT_LT(largest_error, cell_diagonal) << "in cells";
}

class DistancesToRotatedBoxes : public testing::TestWithParam<int> {};

/** Twelve large triangles, whose edges run along no axis. */
TEST_P(DistancesToRotatedBoxes, AreThoseToTheirSides)
{
  const int turn = GetParam();
  const Matrix3d rotation =
      (Eigen::AngleAxisd(0.15 * turn, Vector3d::UnitZ()) *
       Eigen::AngleAxisd(0.11 * turn, Vector3d(1.0, 0.3, 0.2).normalized()))
          .toRotationMatrix();
  const Vector3d center(20.3, 19.8, 20.1), half_sides(11.0, 8.5, 4.2);
  expectDistances(unitCells(40, 40, 40),
                  makeBox(center, half_sides, rotation),
                  1.0,
                  [&](const Vector3d& place) {
                    const Vector3d local = rotation.transpose() * (place - center);
                    return (local.cwiseAbs().array() < half_sides.array()).all();
                  });
}

INSTANTIATE_TEST_SUITE_P(Turns, DistancesToRotatedBoxes, testing::Range(0, 12));

/** Sides, edges and corners that go exactly through centres and between cells. */
TEST(MeshDistance, OfBoxesOnTheGridLeaksNowhere)
{
  for (const double shift : {0.0, 0.5, 0.25}) {
    const Vector3d center = Vector3d::Constant(10.0 + shift);
    const Vector3d half_sides(6.0, 5.0, 4.0);
    expectDistances(
        unitCells(21, 21, 21),
        makeBox(center, half_sides, Matrix3d::Identity()),
        1.0,
        [&](const Vector3d& place) {
          return ((place - center).cwiseAbs().array() < half_sides.array()).all();
        });
  }
}

TEST(MeshDistance, OfASphereIsThatToItsTriangles)
{
  const Vector3d center(15.2, 15.7, 14.9);
  for (const std::uint32_t steps : {4u, 12u}) {
    // Places inside the sphere of the triangles' middles are inside of the mesh.
    const double inner = 11.0 * std::pow(std::cos(1.5708 / steps), 2.0);
    const Mesh mesh = makeSphere(center, 11.0, steps);
    const auto distances = distancesTo(unitCells(30, 30, 30), mesh);
    for (std::uint64_t cell = 0; cell < distances.size(); ++cell) {
      const Vector3d place = centerOf(unitCells(30, 30, 30), cell);
      if ((place - center).norm() < inner) {
        ASSERT_EQ(0.0f, distances[cell]) << place.transpose();
      }
      else if ((place - center).norm() > 11.0) {
        ASSERT_NEAR(
            uvol_test::distanceToTriangles(mesh, place), distances[cell], cell_diagonal)
            << place.transpose();
      }
    }
  }
}

/** The grid of clusters at large coordinates, and of cells that are no cubes. */
TEST(MeshDistance, TakesGridsOfAnyPlaceAndSpacing)
{
  GridShape shape;
  shape.cells = {{30, 20, 25}};
  shape.origin = {{-500.0, 100.0, 3.0}};
  shape.spacing = {{0.1, 0.2, 0.15}};
  const Vector3d center(-498.5, 102.0, 4.8), half_sides(0.8, 1.1, 0.6);
  expectDistances(
      shape,
      makeBox(center, half_sides, Matrix3d::Identity()),
      0.2,
      [&](const Vector3d& place) {
        return ((place - center).cwiseAbs().array() < half_sides.array() - 1e-4).all();
      });
}

TEST(MeshDistance, AddsTheOriginOfTheMesh)
{
  const GridShape shape = unitCells(20, 20, 20);
  const Mesh whole = makeBox({10, 10, 10}, {5, 4, 3}, Matrix3d::Identity());
  Mesh moved = makeBox({2, 1, -3}, {5, 4, 3}, Matrix3d::Identity());
  moved.origin = {{8.0, 9.0, 13.0}};
  EXPECT_EQ(distancesTo(shape, whole), distancesTo(shape, moved));
}

/** A sheet that both sides of are outside, whichever way its triangles look. */
TEST(MeshDistance, OfAFlatSheetHasNoInside)
{
  const GridShape shape = unitCells(24, 24, 24);
  for (const double tilt : {0.0, 0.2, 0.7}) {
    const Matrix3d rotation =
        Eigen::AngleAxisd(tilt, Vector3d(1.0, 0.5, 0.0).normalized())
            .toRotationMatrix();
    Mesh sheet;
    for (const double x : {-8.0, 8.0})
      for (const double y : {-8.0, 8.0})
        addVertex(sheet, Vector3d(12.1, 12.2, 12.3) + rotation * Vector3d(x, y, 0.0));
    sheet.triangles = {{{0, 1, 2}}, {{0, 2, 1}}, {{1, 2, 3}}, {{1, 3, 2}}};
    const auto distances = distancesTo(shape, sheet);
    for (std::uint64_t cell = 0; cell < distances.size(); ++cell)
      ASSERT_NEAR(uvol_test::distanceToTriangles(sheet, centerOf(shape, cell)),
                  distances[cell],
                  cell_diagonal)
          << tilt;
  }
}

/** Hulls of points along a thread are that thin: no line through centres of cells need
 * meet them. */
TEST(MeshDistance, OfAThinTriangleReachesAlongIt)
{
  const GridShape shape = unitCells(40, 30, 30);
  for (const double width : {0.3, 0.05, 0.0}) {
    Mesh needle;
    addVertex(needle, {3.1, 4.2, 5.3});
    addVertex(needle, {36.2, 22.9, 19.6});
    addVertex(needle, Vector3d(19.65, 13.55, 12.45) + Vector3d(0.0, width, 0.0));
    needle.triangles = {{{0, 1, 2}}, {{0, 2, 1}}};
    const auto distances = distancesTo(shape, needle);
    double largest_error = 0.0;
    for (std::uint64_t cell = 0; cell < distances.size(); ++cell)
      largest_error = std::max(
          largest_error,
          std::abs(uvol_test::distanceToTriangles(needle, centerOf(shape, cell)) -
                   distances[cell]));
    EXPECT_LT(largest_error, cell_diagonal) << width;
  }
}

TEST(MeshDistance, OfVerticesOnlyIsThatToTheirCells)
{
  const GridShape shape = unitCells(9, 8, 7);
  Mesh mesh;
  addVertex(mesh, {1.2, 2.9, 3.0});
  addVertex(mesh, {7.5, 6.5, 5.5});
  const auto distances = distancesTo(shape, mesh);
  for (std::uint64_t cell = 0; cell < distances.size(); ++cell) {
    const GridCell here = shape.cellOf(cell);
    EXPECT_FLOAT_EQ(static_cast<float>(std::min(shape.distance(here, {{1, 2, 3}}),
                                                shape.distance(here, {{7, 6, 5}}))),
                    distances[cell]);
  }
}

TEST(MeshDistance, TakesWhatLiesBeyondTheGridToItsBorder)
{
  const GridShape shape = unitCells(6, 6, 6);
  Mesh mesh;
  addVertex(mesh, {-50.0, 2.5, 3.5});
  const auto distances = distancesTo(shape, mesh);
  EXPECT_EQ(0.0f, distances[shape.indexOf({{0, 2, 3}})]);
  EXPECT_EQ(5.0f, distances[shape.indexOf({{5, 2, 3}})]);
  // A wall beyond the last cells, larger than the grid.
  Mesh wall;
  for (const double y : {-90.0, 90.0})
    for (const double z : {-90.0, 90.0})
      addVertex(wall, {70.0, y, z});
  wall.triangles = {{{0, 1, 2}}, {{1, 3, 2}}};
  const auto from_wall = distancesTo(shape, wall);
  for (std::uint64_t cell = 0; cell < from_wall.size(); ++cell)
    EXPECT_EQ(5.0f - shape.cellOf(cell)[0], from_wall[cell]);
}

TEST(MeshDistance, RefusesAnEmptyMesh)
{
  EXPECT_THROW(distancesTo(unitCells(3, 3, 3), Mesh()), InvalidArgument);
}

TEST(MeshDistance, DoesNotDependOnThreads)
{
  const GridShape shape = unitCells(50, 45, 40);
  const Mesh mesh = makeSphere({25, 22, 20}, 15.0, 20);
  const auto first = distancesTo(shape, mesh, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(first, distancesTo(shape, mesh, threads)) << threads;
}

} // namespace test_mesh_distance
