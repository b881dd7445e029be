// SPDX-License-Identifier: BSD-3-Clause
// Meshes in the formats of modelling and printing, read back by the formats' own rules.
#include "random_dataset.h"
#include "tools/tool_test.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <tuple>

namespace test_mesh_formats {

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

TEST(MeshFormats, WhatIsWrittenIsReadAgain)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  for (const char* const name : {"a.ply", "a.vtp", "a.vtkhdf", "a.obj", "a.off"}) {
    saveMesh(folder / name, shape.vertices, shape.triangles);
    std::vector<Triangle> triangles;
    const Dataset read = loadMesh(folder / name, triangles);
    EXPECT_EQ(shape.triangles, triangles) << name;
    for (std::size_t vertex = 0; vertex < 4; ++vertex)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(coordinateOf(shape.vertices, axis, vertex),
                  coordinateOf(read, axis, vertex))
            << name;
    if (name != std::string("a.off")) {
      EXPECT_EQ(fieldOf(shape.vertices, "normal_y"), fieldOf(read, "normal_y")) << name;
    }
    EXPECT_TRUE(isMeshPath(folder / name));
  }
  // Corners at one place are one vertex again.
  saveMesh(folder / "a.stl", shape.vertices, shape.triangles);
  const Mesh stl = loadMesh(folder / "a.stl");
  EXPECT_EQ(4u, stl.vertices.size());
  EXPECT_EQ((std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 3}}),
            stl.triangles);
  EXPECT_FALSE(isMeshPath("a.pcd"));
}

TEST(MeshFormats, OtherProgramsWriteOtherLines)
{
  const TemporaryFolder folder;
  const auto read = [&](const std::string& name,
                        const std::string& text,
                        std::vector<Triangle>& triangles) {
    writeFile(folder / name, text);
    return loadMesh(folder / name, triangles);
  };
  const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  std::vector<Triangle> triangles;
  // Groups, textures, and numbers that count from the last vertex.
  Dataset mesh = read("a.obj",
                      "# Blender\no Plane\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1.0\n"
                      "vt 0 0\nvn 0 0 2\nusemtl None\ns off\n"
                      "f 1/1/1 2/1/1 -2/1/-1 -1/1/1 # a square\n",
                      triangles);
  EXPECT_EQ(square, triangles);
  EXPECT_EQ((std::vector<double>{2, 2, 2, 2}), fieldOf(mesh, "normal_z"));
  // Normals of edges that are sharp are those of faces.
  mesh = read("b.obj",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 -1\n"
              "f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n",
              triangles);
  EXPECT_EQ(square, triangles);
  EXPECT_EQ(3u, mesh.cloud.fields.size());
  read("c.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/2 2/3 3/4 4/1\n", triangles);
  EXPECT_EQ(square, triangles);

  read("a.off",
       "OFF 4 1 0 # counts\n0 0 0\n1 0 0\n\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n",
       triangles);
  EXPECT_EQ(square, triangles);
  read("b.off",
       "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n3 0 1 2",
       triangles);
  EXPECT_EQ((std::vector<Triangle>{{0, 1, 2}}), triangles);

  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                            "0\nvertex -0 1 0\nendloop\nendfacet\n";
  mesh = read("a.stl", "solid two\n" + facet + facet + "endsolid two\n", triangles);
  EXPECT_EQ((std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}}), triangles);
  EXPECT_EQ(3u, mesh.cloud.width);
  EXPECT_FALSE(mesh.double_coordinates);
}

TEST(MeshFormats, DamagedMeshesAreRefusedInASentence)
{
  const TemporaryFolder folder;
  const auto refuses =
      [&](const std::string& name, const std::string& text, const std::string& code) {
        writeFile(folder / name, text);
        try {
          std::vector<Triangle> triangles;
          loadMesh(folder / name, triangles);
          ADD_FAILURE() << text;
        }
        catch (const IOError& error) {
          EXPECT_EQ(code, error.asMessage().code) << error.what();
        }
      };
  const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  refuses("a.obj", "v 0 0\n", "incomplete_entry");
  refuses("a.obj", "v 0 0 x\n", "unexpected_word");
  refuses("a.obj", corner + "f 1 2\n", "incomplete_entry");
  refuses("a.obj", corner + "f 1 2 4\n", "missing_target");
  refuses("a.obj", corner + "f 1 2 0\n", "unexpected_word");
  refuses("a.obj", corner + "f 1 2 -4\n", "unexpected_word");
  refuses("a.obj", corner + "vn 0 0 1\nf 1//1 2//1 3//2\n", "missing_target");
  refuses("a.obj", std::string("v 0 0 0\0", 8), "not_text_file");
  refuses("a.off", "ply\n", "wrong_start");
  refuses("a.off", "OFF\n3\n", "incomplete_entry");
  refuses("a.off", "OFF\n3 x 0\n", "unexpected_word");
  refuses("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "truncated_part");
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  refuses("a.off", off, "truncated_part");
  refuses("a.off", off + "3 0 1 3\n", "missing_target");
  refuses("a.off", off + "4 0 1 2\n", "incomplete_entry");
  refuses("a.off", off + "2 0 1\n", "incomplete_entry");
  refuses("a.stl", "solid a\nfacet normal 0 0 1\n", "missing_part");
  refuses("a.stl", "solid a\nfacet\nvertex 0 0 0\nendfacet\nendsolid\n", "wrong_count");
  refuses("a.stl", "solid a\nfacet\nvertex 0 nan 0\n", "invalid_part");
  refuses("a.stl", "vertex 0 0 0", "missing_part");
  const Tetrahedron shape;
  saveMesh(folder / "a.stl", shape.vertices, shape.triangles);
  const std::string bytes = readFile(folder / "a.stl");
  refuses("a.stl", bytes.substr(0, bytes.size() - 1), "truncated_rows");
  refuses("a.gltf", "{}", "other_ending");
}

TEST(MeshFormats, AnyBytesAreAMeshOrAnError)
{
  const TemporaryFolder folder;
  const Tetrahedron shape;
  Random random(3);
  for (const char* const name : {"a.obj", "a.off", "a.stl", "a.vtp"}) {
    saveMesh(folder / name, shape.vertices, shape.triangles);
    const std::string bytes = readFile(folder / name);
    for (std::size_t i = 0; i < 600; ++i) {
      std::string other = bytes;
      const auto at = static_cast<std::size_t>(random.uniform() *
                                               static_cast<double>(bytes.size()));
      if (i % 3 == 0)
        other.resize(at);
      else
        other[at] = i % 3 == 1 ? static_cast<char>(random.uniform() * 128.0)
                               : "0123456789-./ #"[i % 15];
      writeFile(folder / name, other);
      try {
        const Mesh mesh = loadMesh(folder / name);
        for (const Triangle& triangle : mesh.triangles)
          for (const std::uint32_t vertex : triangle)
            EXPECT_LT(vertex, mesh.vertices.size()) << name << ": " << other;
      }
      catch (const IOError&) {
      }
    }
  }
}

TEST(MeshFormats, PolygonsOfVtpFilesAreChecked)
{
  const TemporaryFolder folder;
  const auto file = [](const std::string& corners, const std::string& ends) {
    return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"4\" "
           "NumberOfPolys=\"2\"><Points><DataArray type=\"Float32\" "
           "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0"
           "</DataArray></Points><Polys>" +
           (corners.empty() ? corners
                            : "<DataArray type=\"Int64\" Name=\"connectivity\" "
                              "format=\"ascii\">" +
                                  corners + "</DataArray>") +
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" + ends +
           "</DataArray></Polys></Piece></PolyData></VTKFile>\n";
  };
  const auto refusal = [&](const std::string& corners, const std::string& ends) {
    writeFile(folder / "a.vtp", file(corners, ends));
    return codeOf([&] { loadMesh(folder / "a.vtp"); });
  };
  EXPECT_EQ("", refusal("0 1 2 3 0 2 3", "4 7"));
  EXPECT_EQ((std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 2, 3}}),
            loadMesh(folder / "a.vtp").triangles);
  for (const auto& [corners, ends, code] :
       {std::tuple{"0 1 2 3 0 2 4", "4 7", "missing_target"},
        {"0 1 2 3 0 2 -1", "4 7", "missing_target"},
        {"0 1 2 3 0 2 3", "7 4", "disagreeing_parts"},
        {"0 1 2", "3 9", "truncated_data"},
        {"", "4 7", "missing_part"},
        {"0 1 2", "3", "truncated_data"}}) {
    EXPECT_EQ(code, refusal(corners, ends)) << corners << ", " << ends;
  }
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

} // namespace test_mesh_formats
