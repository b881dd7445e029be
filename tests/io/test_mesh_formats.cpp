// SPDX-License-Identifier: BSD-3-Clause
// Meshes in the formats of modelling and printing, read back by the formats' own rules.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/mesh.h>

#include <cmath>
#include <cstring>
#include <sstream>

namespace {

using namespace pcl_uvol;
using namespace uvol_test;

/** A tetrahedron of legs 1, with normals, far from zero. */
struct Tetrahedron {
  Dataset vertices;
  std::vector<Triangle> triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

  Tetrahedron()
  {
    vertices.cloud.width = 4;
    vertices.cloud.height = 1;
    setCoordinates(vertices,
                   {5505024.25,
                    -2.0,
                    0.0,
                    5505025.25,
                    -2.0,
                    0.0,
                    5505024.25,
                    -1.0,
                    0.0,
                    5505024.25,
                    -2.0,
                    1.0});
    vertices.double_coordinates = true;
    setField(vertices, "normal_x", std::vector<float>{0.0f, 1.0f, 0.0f, 0.0f});
    setField(vertices, "normal_y", std::vector<float>{0.0f, 0.0f, 1.0f, 0.0f});
    setField(vertices, "normal_z", std::vector<float>{-1.0f, 0.0f, 0.0f, 1.0f});
    setField(vertices, "rho", std::vector<float>{1.0f, 2.0f, 3.0f, 4.0f});
  }
};

std::vector<std::string>
linesOf(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

TEST(MeshFormats, ObjHasVerticesNormalsAndFacesFromOne)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  SaveOptions options;
  options.comments = {"two\nlines"};
  saveMesh(folder / "a.obj", shape.vertices, shape.triangles, options);
  EXPECT_EQ((std::vector<std::string>{"# two lines",
                                      "v 5505024.25 -2 0",
                                      "v 5505025.25 -2 0",
                                      "v 5505024.25 -1 0",
                                      "v 5505024.25 -2 1",
                                      "vn 0 0 -1",
                                      "vn 1 0 0",
                                      "vn 0 1 0",
                                      "vn 0 0 1",
                                      "f 1//1 3//3 2//2",
                                      "f 1//1 2//2 4//4",
                                      "f 1//1 4//4 3//3",
                                      "f 2//2 3//3 4//4"}),
            linesOf(readFile(folder / "a.obj")));
  // Without normals.
  Dataset bare;
  bare.cloud.width = 3;
  bare.cloud.height = 1;
  setCoordinates(bare, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  saveMesh(folder / "b.obj", bare, {{0, 1, 2}});
  EXPECT_EQ((std::vector<std::string>{"v 0 0 0", "v 1 0 0", "v 0 1 0", "f 1 2 3"}),
            linesOf(readFile(folder / "b.obj")));
}

TEST(MeshFormats, OffHasCountsVerticesAndFaces)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  SaveOptions options;
  options.comments = {"a remark"};
  saveMesh(folder / "A.OFF", shape.vertices, shape.triangles, options);
  EXPECT_EQ((std::vector<std::string>{"OFF",
                                      "# a remark",
                                      "4 4 0",
                                      "5505024.25 -2 0",
                                      "5505025.25 -2 0",
                                      "5505024.25 -1 0",
                                      "5505024.25 -2 1",
                                      "3 0 2 1",
                                      "3 0 1 3",
                                      "3 0 3 2",
                                      "3 1 2 3"}),
            linesOf(readFile(folder / "A.OFF")));
}

TEST(MeshFormats, StlHasTrianglesRelativeToTheOrigin)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  saveMesh(folder / "a.stl", shape.vertices, shape.triangles);
  const std::string bytes = readFile(folder / "a.stl");
  ASSERT_EQ(80u + 4u + 4u * 50u, bytes.size());
  EXPECT_NE("solid", bytes.substr(0, 5)); // which would be taken for text
  std::uint32_t count = 0;
  std::memcpy(&count, &bytes[80], sizeof(count));
  EXPECT_EQ(4u, count);
  const double third = 1.0 / std::sqrt(3.0);
  const double normals[4][3] = {
      {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {third, third, third}};
  for (std::size_t i = 0; i < 4; ++i) {
    float numbers[12];
    std::memcpy(numbers, &bytes[84 + 50 * i], sizeof(numbers));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(normals[i][axis], numbers[axis], 1e-7);
      for (std::size_t corner = 0; corner < 3; ++corner)
        EXPECT_EQ(coordinateOf(shape.vertices, axis, shape.triangles[i][corner]) -
                      shape.vertices.origin[axis],
                  static_cast<double>(numbers[3 + 3 * corner + axis]));
    }
    EXPECT_EQ(std::string(2, '\0'), bytes.substr(84 + 50 * i + 48, 2));
  }
}

TEST(MeshFormats, VtpAndPlyKeepFields)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  for (const char* const name : {"a.vtp", "a.ply"}) {
    saveMesh(folder / name, shape.vertices, shape.triangles);
    expectSameFields(loadDataset(folder / name), shape.vertices);
  }
  EXPECT_NE(std::string::npos, readFile(folder / "a.vtp").find("NumberOfPolys=\"4\""));
  EXPECT_EQ(shape.triangles, loadMesh(folder / "a.ply").triangles);
}

TEST(MeshFormats, EmptyMeshesAreValidFiles)
{
  const TemporaryFolder folder;
  Dataset nothing;
  nothing.cloud.height = 1;
  setCoordinates(nothing, {});
  for (const char* const name : {"a.obj", "a.off", "a.stl", "a.vtp", "a.ply"})
    saveMesh(folder / name, nothing, {});
  EXPECT_EQ("OFF\n0 0 0\n", readFile(folder / "a.off"));
  EXPECT_EQ(84u, readFile(folder / "a.stl").size());
}

TEST(MeshFormats, OtherEndingsAreRefused)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  for (const char* const name : {"a.pcd", "a.csv", "a.gltf", "a"})
    EXPECT_THROW(saveMesh(folder / name, shape.vertices, shape.triangles), IOError);
  EXPECT_THROW(checkMeshPath(folder / "none/a.obj"), IOError);
  EXPECT_TRUE(isMeshOnly("x.STL"));
  EXPECT_FALSE(isMeshOnly("x.ply"));
  EXPECT_TRUE(folder.list().empty());
}

} // namespace
