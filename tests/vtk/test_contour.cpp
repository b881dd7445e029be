// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of grids: where they lie, and that they are closed.
#include "common/random.h"
#include "support/meshes.h"
#include "vtk/contour.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace test_contour {

using Eigen::Vector3d;
using pcl_uvol::contourGrid;
using pcl_uvol::GridCell;
using pcl_uvol::GridShape;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Mesh;
using pcl_uvol::Triangle;
using uvol_test::signedVolume;
using uvol_test::vertexOf;

GridShape
makeShape(std::uint32_t cells, double spacing, const Vector3d& origin)
{
  GridShape shape;
  shape.cells = {{cells, cells + 2, cells + 5}};
  shape.spacing = {{spacing, spacing, spacing}};
  shape.origin = {{origin[0], origin[1], origin[2]}};
  return shape;
}

/** A value for every cell, by its centre. */
template <typename ValueAt>
std::vector<float>
fill(const GridShape& shape, const ValueAt& valueAt)
{
  std::vector<float> values(shape.size());
  for (std::uint64_t i = 0; i < shape.size(); ++i) {
    const auto center = shape.centerOf(shape.cellOf(i));
    values[i] = static_cast<float>(valueAt(Vector3d(center[0], center[1], center[2])));
  }
  return values;
}

/** Each edge belongs to two triangles, which walk it in opposite directions. */
void
expectClosed(const Mesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  std::size_t shared = 0, open = 0;
  for (const auto& edge : edges) {
    shared += edge.second != 1 || edge.first.first == edge.first.second;
    open += edges.count({edge.first.second, edge.first.first}) == 0;
  }
  EXPECT_EQ(0u, open) << "of " << edges.size();
  EXPECT_EQ(0u, shared) << "of " << edges.size();
}

TEST(ContourGrid, OfDistancesToAPointIsASphere)
{
  constexpr double pi = 3.14159265358979323846;
  for (const double spacing : {1.0, 0.01, 250.0})
    for (const Vector3d& origin :
         {Vector3d(0.0, 0.0, 0.0), Vector3d(-300.0, 20.0, 5.0)}) {
      const GridShape shape = makeShape(30, spacing, spacing * origin);
      const Vector3d center = spacing * (origin + Vector3d(14.7, 16.1, 17.4));
      const double radius = 10.0 * spacing;
      const Mesh mesh = contourGrid(
          shape,
          fill(shape, [&](const Vector3d& place) { return (place - center).norm(); }),
          radius);
      ASSERT_FALSE(mesh.vertices.empty());
      double largest_error = 0.0;
      for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i)
        largest_error = std::max(
            largest_error, std::abs((vertexOf(mesh, i) - center).norm() - radius));
      EXPECT_LT(largest_error, 0.1 * spacing);
      expectClosed(mesh);
      // Higher values are outside, and triangles look there.
      const double volume = 4.0 / 3.0 * pi * std::pow(radius, 3.0);
      EXPECT_NEAR(volume, signedVolume(mesh), 0.01 * volume);
      EXPECT_EQ(2,
                static_cast<long>(mesh.vertices.size()) -
                    static_cast<long>(mesh.triangles.size() / 2));
    }
}

TEST(ContourGrid, TakesCellsThatAreNoCubes)
{
  GridShape shape;
  shape.cells = {{25, 40, 30}};
  shape.spacing = {{1.0, 0.5, 0.75}};
  const Vector3d center(12.3, 10.2, 11.1);
  const Mesh mesh = contourGrid(
      shape,
      fill(shape, [&](const Vector3d& place) { return (place - center).norm(); }),
      8.0);
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_NEAR(8.0, (vertexOf(mesh, i) - center).norm(), 0.05);
  expectClosed(mesh);
  EXPECT_GT(signedVolume(mesh), 0.0);
}

/** Values that equal the isovalue: the surface goes through centres of cells. */
TEST(ContourGrid, IsClosedWhereValuesEqualTheIsovalue)
{
  const GridShape shape = makeShape(16, 1.0, Vector3d::Zero());
  const Vector3d center(8.5, 9.5, 10.5);
  const auto l1 = fill(
      shape, [&](const Vector3d& place) { return (place - center).cwiseAbs().sum(); });
  const auto largest = fill(shape, [&](const Vector3d& place) {
    return (place - center).cwiseAbs().maxCoeff();
  });
  for (const auto& values : {l1, largest}) {
    const Mesh mesh = contourGrid(shape, values, 5.0);
    ASSERT_FALSE(mesh.triangles.empty());
    expectClosed(mesh);
    EXPECT_GT(signedVolume(mesh), 0.0);
  }
}

/** All cases of a cell, ambiguous ones too: whoever walks the surface relies on edges
 * of two triangles. */
TEST(ContourGrid, IsClosedForAnyValues)
{
  const GridShape shape = makeShape(12, 1.0, Vector3d::Zero());
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    std::vector<float> values(shape.size());
    for (std::uint64_t i = 0; i < shape.size(); ++i) {
      const GridCell cell = shape.cellOf(i);
      bool is_border = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        is_border |= cell[axis] == 0 || cell[axis] + 1u == shape.cells[axis];
      values[i] =
          is_border ? 1.0f : static_cast<float>(pcl_uvol::uniformAt(seed, i, 0));
    }
    expectClosed(contourGrid(shape, values, 0.5));
  }
}

TEST(ContourGrid, IsEmptyForAnIsovalueThatNoCellPasses)
{
  const GridShape shape = makeShape(5, 1.0, Vector3d::Zero());
  const auto values = fill(shape, [](const Vector3d& place) { return place.x(); });
  for (const double isovalue : {-1.0, 100.0}) {
    const Mesh mesh = contourGrid(shape, values, isovalue);
    EXPECT_TRUE(mesh.vertices.empty());
    EXPECT_TRUE(mesh.triangles.empty());
  }
}

TEST(ContourGrid, IsEmptyForALayerOfCells)
{
  GridShape shape;
  for (const auto& cells : {std::array<std::uint32_t, 3>{{6, 6, 1}},
                            std::array<std::uint32_t, 3>{{6, 1, 6}},
                            std::array<std::uint32_t, 3>{{1, 6, 6}},
                            std::array<std::uint32_t, 3>{{1, 1, 1}}}) {
    shape.cells = cells;
    const auto values =
        fill(shape, [](const Vector3d& place) { return place.sum() - 4.0; });
    EXPECT_TRUE(contourGrid(shape, values, 0.1).triangles.empty());
  }
}

TEST(ContourGrid, RefusesAnotherNumberOfValues)
{
  const GridShape shape = makeShape(4, 1.0, Vector3d::Zero());
  for (const std::size_t count : {std::size_t{0},
                                  std::size_t{1},
                                  std::size_t(shape.size() - 1),
                                  std::size_t(shape.size() + 1)})
    EXPECT_THROW(contourGrid(shape, std::vector<float>(count), 0.5), InvalidArgument);
}

} // namespace test_contour
