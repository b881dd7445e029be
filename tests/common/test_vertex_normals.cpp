// SPDX-License-Identifier: BSD-3-Clause
// Normals of a mesh's vertices.
#include <pcl_uvol/common/dataset.h>

#include <gtest/gtest.h>

#include <cmath>

namespace test_vertex_normals {

using pcl_uvol::computeVertexNormals;
using pcl_uvol::Mesh;

void
expectNormal(const std::array<double, 3>& expected, const std::array<float, 3>& normal)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(expected[axis], normal[axis], 1e-6) << axis;
}

/** The corner of the unit cube at 0, and its three neighbours. */
Mesh
makeCorner()
{
  Mesh mesh;
  mesh.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 3, 2}}, {{0, 1, 3}}};
  return mesh;
}

TEST(VertexNormals, OfACornerLookAlongItsDiagonal)
{
  const auto normals = computeVertexNormals(makeCorner());
  ASSERT_EQ(4u, normals.size());
  const double third = -1.0 / std::sqrt(3.0), half = -1.0 / std::sqrt(2.0);
  expectNormal({{third, third, third}}, normals[0]);
  expectNormal({{0.0, half, half}}, normals[1]);
  expectNormal({{half, 0.0, half}}, normals[2]);
  expectNormal({{half, half, 0.0}}, normals[3]);
}

TEST(VertexNormals, AreWeightedByArea)
{
  Mesh mesh;
  mesh.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 3}}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 3, 1}}}; // 1/2 along z, 3/2 along y
  const auto normals = computeVertexNormals(mesh);
  expectNormal({{0.0, 3.0 / std::sqrt(10.0), 1.0 / std::sqrt(10.0)}}, normals[0]);
  expectNormal({{0.0, 0.0, 1.0}}, normals[2]);
  expectNormal({{0.0, 1.0, 0.0}}, normals[3]);
}

TEST(VertexNormals, AreUnitVectorsForAnyScale)
{
  for (const float scale : {1e-15f, 1.0f, 1e15f}) {
    Mesh mesh = makeCorner();
    for (auto& vertex : mesh.vertices)
      for (float& coordinate : vertex)
        coordinate *= scale;
    const double third = -1.0 / std::sqrt(3.0);
    expectNormal({{third, third, third}}, computeVertexNormals(mesh)[0]);
  }
}

TEST(VertexNormals, AreZeroWithoutTrianglesOfAnyArea)
{
  Mesh mesh = makeCorner();
  mesh.vertices.push_back({{5, 5, 5}}); // in no triangle
  mesh.vertices.push_back({{2, 0, 0}}); // in one without area
  mesh.triangles.push_back({{0, 1, 5}});
  const auto normals = computeVertexNormals(mesh);
  ASSERT_EQ(6u, normals.size());
  EXPECT_EQ((std::array<float, 3>{{0, 0, 0}}), normals[4]);
  EXPECT_EQ((std::array<float, 3>{{0, 0, 0}}), normals[5]);
  // Two sides of a sheet cancel.
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 1}}};
  EXPECT_EQ((std::array<float, 3>{{0, 0, 0}}), computeVertexNormals(mesh)[0]);
  EXPECT_TRUE(computeVertexNormals(Mesh()).empty());
}

} // namespace test_vertex_normals
